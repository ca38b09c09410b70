// Numbers of a string's motion overwritten with what is no number, as a stray write or a fault of the memory
// would.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "jawari/instrument/state.h"

namespace jawari::test {

inline constexpr std::array<const char*, 12> injury_names{
    "Displacement", "Velocity",   "Gap",           "Impulse",         "Height",       "Level",
    "Mix",          "BendTarget", "BendSemitones", "ExciterPosition", "TouchDamping", "TouchShare"};
inline constexpr std::size_t injury_kinds = injury_names.size();

/// `what` and `where` choose the number. Nothing happens to a string without a motion.
inline void injure(InstrumentStringState& string, std::size_t what, std::size_t where) {
    using limits = std::numeric_limits<double>;
    constexpr std::array<double, 3> bad{limits::quiet_NaN(), limits::infinity(), -limits::infinity()};
    const double value = bad[where % bad.size()];
    Voice& voice = string.voices[where / 3 % string.voices.size()];
    if (voice.phase == VoicePhase::Idle) return;
    StringState& motion = voice.string;
    Touch& touch = voice.touches.touches[where / 9 % touch_slots];
    const auto at = [&](AlignedVector<double>& x) -> double& { return x[where % x.size()]; };
    switch (what % injury_kinds) {
        case 0:
            at(motion.displacement) = value;
            break;
        case 1:
            at(motion.velocity) = value;
            break;
        case 2:
            at(motion.contact.gap) = value;
            break;
        case 3:
            at(motion.contact.impulse) = value;
            break;
        case 4:
            at(motion.contact.height) = value;
            break;
        case 5:
            voice.gains.level = value;
            break;
        case 6:
            voice.gains.mix = value;
            break;
        case 7:
            voice.bend.target = value;
            break;
        case 8:
            voice.bend.semitones = value;
            break;
        case 9:
            voice.touches.exciter.position_m = value;
            break;
        case 10:
            touch.damping_kg_per_s = value;
            break;
        default:
            touch.share = value;
            break;
    }
}

}  // namespace jawari::test
