// Parts of VST 3 that the headers of dpf-source do not declare: names and layouts of the interface
// (https://steinbergmedia.github.io/vst3_dev_portal), as this adapter uses them.
#pragma once

#include <travesty/base.h>

#include <cstdint>

namespace jawari::host::vst3 {

inline constexpr v3_tuid note_expression_iid = V3_ID(0xB7F8F859, 0x41234872, 0x91169581, 0x4F3721A3);

/// Kinds of note expressions, and what 0 to 1 of each means.
inline constexpr std::uint32_t volume_type = 0;      ///< factor: 0 to 4
inline constexpr std::uint32_t pan_type = 1;         ///< left to right
inline constexpr std::uint32_t tuning_type = 2;      ///< -120 to 120 semitones
inline constexpr std::uint32_t brightness_type = 5;  ///< 0 to 1

inline constexpr std::int32_t expression_is_bipolar = 1;

/// Of a tuning between 0 and 1. Threads: any; realtime-safe.
constexpr double tuning_semitones(double value) {
    return 240 * (value - 0.5);
}

struct NoteExpressionInfo {
    std::uint32_t type_id;
    v3_str_128 title;
    v3_str_128 short_title;
    v3_str_128 units;
    std::int32_t unit_id;  ///< -1: none
    double default_value;  ///< of 0 to 1, as the two below
    double minimum;
    double maximum;
    std::int32_t step_count;
    v3_param_id associated_parameter;
    std::int32_t flags;
};

/// Factor that a volume between 0 and 1 means. Threads: any; realtime-safe.
constexpr double volume_factor(double value) {
    return 4 * value;
}

/// INoteExpressionController.
struct NoteExpressionTable : v3_funknown {
    std::int32_t(V3_API* get_count)(void* self, std::int32_t bus, std::int16_t channel);
    v3_result(V3_API* get_info)(void* self, std::int32_t bus, std::int16_t channel, std::int32_t index,
                                NoteExpressionInfo* info);
    v3_result(V3_API* get_text)(void* self, std::int32_t bus, std::int16_t channel, std::uint32_t type,
                                double value, std::int16_t* text);
    v3_result(V3_API* get_value)(void* self, std::int32_t bus, std::int16_t channel, std::uint32_t type,
                                 const std::int16_t* text, double* value);
};

/// Kinds of controllers beside MIDI's 0 to 127.
inline constexpr int channel_pressure_controller = 128;
inline constexpr int pitch_bend_controller = 129;

}  // namespace jawari::host::vst3
