#include "window/model/layout.h"

#include <algorithm>

#include "window/model/theme.h"

namespace jawari::host::window {

namespace {

using theme::grid;

constexpr float margin = 2 * grid;
constexpr float head_height = 7 * grid;
constexpr float sidebar_width = 28 * grid;
constexpr float tabs_height = 3 * grid;
constexpr float row_height = 4 * grid - 2;
constexpr float heading_height = 3 * grid;
constexpr std::size_t rows = 5;
constexpr float parameters_height = heading_height + rows * row_height + 3 * grid;
constexpr float keyboard_height = 7 * grid;
constexpr float wide_from = 1040;

/// Columns of controls: each begins with a heading; a group may go on in the next column or share one.
struct Place {
    std::string_view group;
    std::size_t column, row;
};
constexpr std::array<Place, 6> places{{{"Mix", 0, 0},
                                       {"Pluck", 1, 0},
                                       {"Left hand", 2, 0},
                                       {"Right hand", 4, 0},
                                       {"Instrument", 4, rows - 1},
                                       {"", 0, 0}}};
constexpr std::size_t columns = 5;

Box cell(const Box& panel, std::size_t column, std::size_t row) {
    const float width = (panel.width - 2 * margin - (columns - 1) * 3 * grid) / columns;
    return {panel.x + margin + static_cast<float>(column) * (width + 3 * grid),
            panel.y + grid + heading_height + static_cast<float>(row) * row_height, width, row_height};
}

void place_controls(Layout& layout) {
    const Box& panel = layout.parameters;
    for (const Place& place : places) {
        if (place.group.empty()) continue;
        std::size_t column = place.column;
        std::size_t row = place.row;
        // In the row above its first control.
        Box heading = cell(panel, column, row);
        heading.y -= heading_height;
        heading.height = heading_height;
        layout.groups.push_back({place.group, heading});
        for (const ParameterDeclaration& parameter : parameter_table()) {
            if (parameter.group != place.group) continue;
            if (row == rows) {
                column += 1;
                row = 0;
            }
            layout.controls[static_cast<std::size_t>(parameter.id)] = cell(panel, column, row);
            row += 1;
        }
    }
}

void place_presets(Layout& layout, const Box& box) {
    layout.presets = box;
    layout.search = {box.x + grid, box.y + grid, box.width - 2 * grid, 3.5F * grid};
    const float list_y = layout.search.bottom() + grid;
    layout.list = {box.x + grid, list_y, box.width - 2 * grid, box.bottom() - grid - list_y};
}

}  // namespace

Layout lay_out(float width, float height) {
    Layout layout;
    layout.width = std::max(width, smallest_width);
    layout.height = std::max(height, smallest_height);
    layout.wide = layout.width >= wide_from;
    layout.head = {0, 0, layout.width, head_height};
    const float name_x = layout.wide ? margin + sidebar_width : margin + 12 * grid + grid;
    layout.presets_button = layout.wide ? Box{} : Box{margin, 1.5F * grid, 12 * grid, 4 * grid};
    const float meters_width = 40 * grid;
    layout.meters = {layout.width - margin - meters_width, grid, meters_width, head_height - 2 * grid};
    layout.description = {name_x + (layout.wide ? margin : grid), grid,
                          layout.meters.x - name_x - 2 * margin - grid, head_height - 2 * grid};

    layout.parameters = {0, layout.height - parameters_height, layout.width, parameters_height};
    const float bottom = layout.parameters.y - margin;
    const float left = layout.wide ? margin + sidebar_width + margin : margin;
    const float main_width = layout.width - margin - left;
    layout.keyboard = {left, bottom - keyboard_height, main_width, keyboard_height};
    const float top = layout.head.bottom();
    layout.play_tab = {left, top, 8 * grid, tabs_height};
    layout.setup_tab = {layout.play_tab.right(), top, 8 * grid, tabs_height};
    layout.notice = {layout.setup_tab.right() + margin, top,
                     left + main_width - layout.setup_tab.right() - margin, tabs_height};
    const float strings_y = layout.play_tab.bottom() + grid;
    const float room = layout.keyboard.y - grid - strings_y;
    const float contacts = std::clamp(room * 0.28F, 5 * grid, 14 * grid);
    layout.strings = {left, strings_y, main_width, room - contacts - grid};
    layout.contactogram = {left, layout.strings.bottom() + grid, main_width, contacts};
    if (layout.wide)
        place_presets(layout, {margin, top, sidebar_width, bottom - top});
    else
        place_presets(layout, {margin, top, 36 * grid, layout.keyboard.y - grid - top});
    place_controls(layout);
    return layout;
}

}  // namespace jawari::host::window
