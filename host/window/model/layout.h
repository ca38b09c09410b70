// Where everything lies in a window of a given size. Units are pixels at a scale of 1.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "jawari/parameters.h"

namespace jawari::host::window {

struct Box {
    float x = 0, y = 0, width = 0, height = 0;

    [[nodiscard]] float right() const { return x + width; }
    [[nodiscard]] float bottom() const { return y + height; }
    [[nodiscard]] float middle_x() const { return x + width / 2; }
    [[nodiscard]] float middle_y() const { return y + height / 2; }
    [[nodiscard]] bool has(float px, float py) const {
        return px >= x && px < right() && py >= y && py < bottom();
    }
};

/// A heading over controls.
struct GroupPlace {
    std::string_view name;
    Box box;
};

inline constexpr float smallest_width = 800;
inline constexpr float smallest_height = 560;
inline constexpr float usual_width = 1200;
inline constexpr float usual_height = 768;

struct Layout {
    float width = 0, height = 0;
    bool wide = false;   ///< the list of presets has a place of its own
    Box head;            ///< name of the preset, meters
    Box presets_button;  ///< opens the list where it has no place of its own
    Box description;     ///< of the preset, beside its name
    Box meters;
    Box presets;  ///< list with search; over the strings unless `wide`
    Box search;
    Box list;  ///< its rows
    Box play_tab, setup_tab;
    Box notice;        ///< a line beside the tabs
    Box strings;       ///< the picture of the strings
    Box contactogram;  ///< below, with the same places from left to right
    Box keyboard;
    Box parameters;
    std::array<Box, parameter_count> controls;
    std::vector<GroupPlace> groups;
};

inline constexpr float preset_row_height = 24;

/// For sizes below the smallest, that of the smallest. Threads: any.
Layout lay_out(float width, float height);

}  // namespace jawari::host::window
