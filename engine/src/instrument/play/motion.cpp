#include "jawari/instrument/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/assert.h"
#include "instrument/model/played_string.h"

namespace jawari {

namespace {

/// Of a string in intervals between points.
constexpr std::size_t intervals = shape_points + 1;
/// sin(pi k j / intervals) depends on k j modulo this.
constexpr std::size_t turn = 2 * intervals;

std::array<double, turn> turn_of_sines() noexcept {
    std::array<double, turn> sines{};
    for (std::size_t i = 0; i < turn; ++i)
        sines[i] = std::sin(std::numbers::pi * static_cast<double>(i) / intervals);
    return sines;
}

const std::array<double, turn> sines = turn_of_sines();

/// Mode k has the shape of mode k modulo `turn` at the points, and that of `turn` - k upside down.
std::array<double, intervals> fold_modes(const AlignedVector<double>& displacement, std::size_t count) {
    std::array<double, intervals> folded{};
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t k = (i + 1) % turn;
        if (k == 0 || k == intervals) continue;
        if (k < intervals)
            folded[k] += displacement[i];
        else
            folded[turn - k] -= displacement[i];
    }
    return folded;
}

/// Null for a string at rest.
const Voice* shown_voice(const InstrumentStringState& string) {
    if (string.sounding < string.voices.size() && string.voices[string.sounding].phase != VoicePhase::Idle)
        return &string.voices[string.sounding];
    for (const Voice& voice : string.voices)
        if (voice.phase != VoicePhase::Idle) return &voice;
    return nullptr;
}

}  // namespace

StringMotion string_motion(const InstrumentModel& model, const InstrumentState& state,
                           std::size_t string) JAWARI_REALTIME {
    JAWARI_ASSERT(string < state.strings.size());
    const Voice* const voice = shown_voice(state.strings[string]);
    if (voice == nullptr) return {};
    const StoppedStringModel& stopped = string_of(model, state, string).stopped[voice->fret];
    const double bend = voice->bend.active ? std::exp2(voice->bend.semitones / 12) : 1.0;
    return {true, voice->fret, stopped.string.shape->length_m, stopped.frequency_hz * bend};
}

void string_shape(const InstrumentModel& model, const InstrumentState& state, std::size_t string,
                  std::span<double, shape_points> heights_m) JAWARI_REALTIME {
    JAWARI_ASSERT(string < state.strings.size());
    std::fill(heights_m.begin(), heights_m.end(), 0.0);
    const Voice* const voice = shown_voice(state.strings[string]);
    if (voice == nullptr) return;
    const StringShape& shape = *voice_model(string_of(model, state, string), *voice).shape;
    const auto folded = fold_modes(voice->string.displacement, shape.mode_count - shape.hammer_count);
    const double unit = std::sqrt(2 / shape.length_m);
    // Odd modes are even about the middle, and even ones odd.
    for (std::size_t j = 1; j <= intervals / 2; ++j) {
        double odd = 0;
        double even = 0;
        for (std::size_t k = 1; k < intervals; k += 2) odd += folded[k] * sines[k * j % turn];
        for (std::size_t k = 2; k < intervals; k += 2) even += folded[k] * sines[k * j % turn];
        heights_m[j - 1] = unit * (odd + even);
        heights_m[intervals - j - 1] = unit * (odd - even);
    }
}

void watch_impacts(InstrumentState& state, bool on) JAWARI_REALTIME {
    state.impacts.open = on;
    std::fill(state.impacts.sums_Ns.begin(), state.impacts.sums_Ns.end(), 0.0F);
    std::fill(state.impacts.struck.begin(), state.impacts.struck.end(), std::uint8_t{0});
}

bool take_impacts(InstrumentState& state, std::size_t string,
                  std::span<float, impact_places> sums_Ns) JAWARI_REALTIME {
    JAWARI_ASSERT(string < state.strings.size());
    ImpactLog& log = state.impacts;
    if (log.struck[string] == 0) return false;
    float* const own = log.sums_Ns.data() + string * impact_places;
    for (std::size_t place = 0; place < impact_places; ++place) {
        sums_Ns[place] += own[place];
        own[place] = 0;
    }
    log.struck[string] = 0;
    return true;
}

}  // namespace jawari
