// Where strings and frets lie in the picture: seen from the side, one lane for each string, the nut on the
// left and the bridge on the right. Heights are drawn larger than lengths.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "instrument/instrument_cache.h"
#include "window/model/layout.h"

namespace jawari::host::window {

struct FretPlace {
    double from_bridge_m = 0;
    double height_m = 0;   ///< of its top from the open string's rest line; 0 if it is not known
    bool has_top = false;  ///< the string can strike it
    int key = -1;          ///< MIDI note number; -1: unmapped
};

struct StringLane {
    double length_m = 0;           ///< of the open string
    int open_key = -1;             ///< MIDI note number
    std::vector<FretPlace> frets;  ///< fret n is frets[n - 1]
    std::size_t course = 0;
};

struct PicturePoint {
    float x = 0, y = 0;
};

/// What the mouse is at.
struct StringHit {
    std::size_t string = 0;
    std::size_t fret = 0;  ///< that a finger there would press; 0: none, the string is plucked there
    double from_bridge_m = 0;
};

/// Where the string is plucked, as its preset has it, and the way from there to a factor of the parameter
/// pluck_position.
struct PluckPlace {
    std::optional<double> from_bridge_m;  ///< nothing for tangents
};

class StringPlaces {
  public:
    /// Of a compiled instrument. `shown`: the description whose heights are drawn: the instrument's own, or
    /// one that is being edited, with the same strings.
    StringPlaces(const LoadedInstrument& instrument, const InstrumentDescription& shown);

    /// The picture lies in `box`. `only`: that string alone fills it.
    void place(const Box& box, std::optional<std::size_t> only = std::nullopt);

    [[nodiscard]] const std::vector<StringLane>& lanes() const { return lanes_; }
    [[nodiscard]] std::optional<std::size_t> only() const { return only_; }
    [[nodiscard]] float lane_height() const { return lane_height_; }
    [[nodiscard]] double pixels_per_height_m() const { return height_scale_; }
    [[nodiscard]] int lowest_key() const { return lowest_key_; }
    [[nodiscard]] int highest_key() const { return highest_key_; }

    [[nodiscard]] float x_of(double from_bridge_m) const;
    [[nodiscard]] double from_bridge_at(float x) const;
    [[nodiscard]] float rest_y(std::size_t string) const;
    [[nodiscard]] PicturePoint point(std::size_t string, double from_bridge_m, double height_m) const;
    [[nodiscard]] double height_at(std::size_t string, float y) const;

    /// Nothing beside the strings.
    [[nodiscard]] std::optional<StringHit> hit(float x, float y) const;
    [[nodiscard]] PluckPlace pluck_place(std::size_t string) const;

  private:
    std::vector<StringLane> lanes_;
    std::vector<PluckPlace> plucks_;
    double longest_m_ = 0;
    double extent_m_ = 0.001;  ///< height that half a lane shows
    int lowest_key_ = 127, highest_key_ = 0;
    Box box_;
    std::optional<std::size_t> only_;
    float lane_height_ = 1;
    double height_scale_ = 1;
};

}  // namespace jawari::host::window
