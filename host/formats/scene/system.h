// What vibrates: a string, or a system of tabled shapes, whose points are collected while the rest of it is
// read.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "formats/json/object_reader.h"
#include "jawari/scene/description.h"
#include "jawari/scene/systems.h"

namespace jawari::host {

/// A place on a string, or a point of another system.
struct Place {
    double position_m = 0;
    std::size_t point = 0;
};

class System {
  public:
    /// "modes" of a string decide: physics or tables of a pinned string, a bar, a plate, or tables with
    /// shapes.
    static System read(const json::Value& modes, const std::string& path, json::Problems& problems);

    [[nodiscard]] bool is_string() const { return std::holds_alternative<std::monostate>(kind_); }
    /// `position_m`, or `point` where points are tabled.
    [[nodiscard]] std::string_view place_key() const;
    /// A place under that key. Bars and plates get a point for it.
    Place place(json::ObjectReader& reader);
    /// Writes modes and shapes. Once, when all places are known.
    void finish(StringDescription& string) const;

  private:
    std::variant<PhysicalModes, ModeTable> modes_;
    std::variant<std::monostate, Bar, Plate, ShapeTable> kind_;
    std::vector<double> bar_places_m_;
    std::vector<std::array<double, 2>> plate_places_m_;
};

}  // namespace jawari::host
