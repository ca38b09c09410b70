// Geometry of a preset, changed in its text: what is dragged in the window's picture. Everything else in the
// text stays as it is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "jawari/instrument/description.h"

namespace jawari::host::window {

/// Things of an instrument that can be dragged.
enum class Part {
    Exciter,        ///< index: the exciter. from_bridge_m
    Pickup,         ///< index: the pickup. from_bridge_m
    Fret,           ///< index: the fret, from 1. height_m
    Action,         ///< the strings above the last fret. height_m: by how much they rise
    Relief,         ///< the neck's curve. height_m: by how much the frets half-way to the last one rise
    ObstacleEnd,    ///< index: an obstacle with a parabola. from_bridge_m: its length; height_m: its drop
    ObstacleCorner  ///< index: an obstacle with corners; corner. height_m
};

struct PartName {
    Part part = Part::Exciter;
    std::size_t index = 0;
    std::size_t corner = 0;
    bool operator==(const PartName&) const = default;
};

/// A part and where it is on one string.
struct Handle {
    PartName name;
    double from_bridge_m = 0;
    double height_m = 0;  ///< from the open string's rest line
    bool along = false;   ///< it can be moved along the string
    bool across = false;  ///< it can be moved up and down
    std::string label;
};

/// Of string `string`, whose open length is `length_m`; `fret_from_bridge_m`: places of its frets, from 1.
/// Threads: any.
std::vector<Handle> handles_of(const InstrumentDescription& instrument, std::size_t string, double length_m,
                               const std::vector<double>& fret_from_bridge_m);

/// Where a part is dragged to: for Action and Relief height_m counts from where it was, for the others from
/// the rest line.
struct Move {
    double from_bridge_m = 0;
    double height_m = 0;
};

/// The preset's text with the part moved on string `string`, inside what the format allows; frets and their
/// like are common to all strings that do not have their own. Nothing if the text has no such part. Threads:
/// any.
std::optional<std::string> with_part_moved(const std::string& text, const InstrumentDescription& instrument,
                                           std::size_t string, double length_m,
                                           const std::vector<double>& fret_from_bridge_m,
                                           const PartName& name, const Move& move);

}  // namespace jawari::host::window
