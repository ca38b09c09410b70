// The note expressions that a VST 3 host may offer for single notes.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "base/text.h"
#include "plugin/vst3/extensions.h"
#include "plugin/vst3/instance.h"
#include "plugin/vst3/text16.h"

namespace jawari::host::vst3 {

namespace {

struct Expression {
    std::uint32_t type;
    const char* title;
    const char* short_title;
    const char* unit;
    std::int32_t flags;
    double neutral;
    double factor, offset;  ///< shown number: factor (value - offset)
    int decimals;
};

constexpr std::array<Expression, 4> expressions{{
    {tuning_type, "Tuning", "Tune", "st", expression_is_bipolar, 0.5, 240, 0.5, 2},
    {brightness_type, "Brightness", "Bright", "%", 0, 0.5, 100, 0, 0},
    {volume_type, "Volume", "Vol", "%", 0, 0.25, 400, 0, 0},
    {pan_type, "Pan", "Pan", "%", expression_is_bipolar, 0.5, 200, 0.5, 0},
}};

const Expression* find_expression(std::uint32_t type) {
    for (const Expression& each : expressions)
        if (each.type == type) return &each;
    return nullptr;
}

std::int32_t get_expression_count(void* /*self*/, std::int32_t bus, std::int16_t /*channel*/) {
    return bus == 0 ? static_cast<std::int32_t>(expressions.size()) : 0;
}

v3_result get_expression_info(void* self, std::int32_t bus, std::int16_t channel, std::int32_t index,
                              NoteExpressionInfo* info) {
    if (index < 0 || index >= get_expression_count(self, bus, channel)) return V3_INVALID_ARG;
    const Expression& expression = expressions[static_cast<std::size_t>(index)];
    *info = {};
    info->type_id = expression.type;
    write_text(expression.title, info->title);
    write_text(expression.short_title, info->short_title);
    write_text(expression.unit, info->units);
    info->unit_id = -1;
    info->default_value = expression.neutral;
    info->maximum = 1;
    info->flags = expression.flags;
    return V3_OK;
}

v3_result get_expression_text(void* /*self*/, std::int32_t /*bus*/, std::int16_t /*channel*/,
                              std::uint32_t type, double value, std::int16_t* text) {
    const Expression* const expression = find_expression(type);
    if (expression == nullptr || !std::isfinite(value)) return V3_INVALID_ARG;
    const double shown = expression->factor * (value - expression->offset);
    return guarded([&] {
        write_text(formatted("%.*f", expression->decimals, shown), text);
        return true;
    })
               ? V3_OK
               : V3_INTERNAL_ERR;
}

v3_result get_expression_value(void* /*self*/, std::int32_t /*bus*/, std::int16_t /*channel*/,
                               std::uint32_t type, const std::int16_t* text, double* value) {
    const Expression* const expression = find_expression(type);
    if (expression == nullptr || text == nullptr) return V3_INVALID_ARG;
    return guarded([&] {
        const auto shown = parse_number(read_text(text));
        if (!shown || !std::isfinite(*shown)) return false;
        *value = std::clamp(*shown / expression->factor + expression->offset, 0.0, 1.0);
        return true;
    })
               ? V3_OK
               : V3_INVALID_ARG;
}

}  // namespace

const void* note_expression_table() {
    static constexpr NoteExpressionTable table{unknown_table, get_expression_count, get_expression_info,
                                               get_expression_text, get_expression_value};
    return &table;
}

}  // namespace jawari::host::vst3
