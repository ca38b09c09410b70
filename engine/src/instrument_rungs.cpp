#include "jawari/instrument_rungs.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "instrument_bend.h"
#include "instrument_touch.h"
#include "instrument_voice.h"
#include "jawari/energy.h"

namespace jawari {
namespace {

bool have_same_contacts(const InstrumentStringModel& a, const InstrumentStringModel& b) {
    for (std::size_t fret = 0; fret < a.stopped.size(); ++fret) {
        if (a.stopped[fret].string.contact_position != b.stopped[fret].string.contact_position) return false;
    }
    return true;
}

/// v = backward_q q + backward_u u, with q from rest, at either rung. Overdamped modes keep v.
void convert_modes(const StringModel& source, const double* backward_q, const double* backward_u,
                   const StoppedStringModel& to, StringState& string) {
    const StringModel& target = to.string;
    const std::size_t kept = std::min(source.mode_count, target.mode_count);
    for (std::size_t k = 0; k < kept; ++k) {
        const double q = string.displacement[k] - source.rest_displacement[k];
        const double u = (string.velocity[k] - backward_q[k] * q) / backward_u[k];
        string.displacement[k] = q + target.rest_displacement[k];
        string.velocity[k] = to.backward_q[k] * q + to.backward_u[k] * u;
    }
    for (std::size_t k = kept; k < target.stride; ++k) {
        string.displacement[k] = target.rest_displacement[k];
        string.velocity[k] = 0;
    }
}

void change_voice(const InstrumentStringModel& from, const InstrumentStringModel& to, Voice& voice,
                  PlayerWork& work) {
    const StoppedStringModel& left = from.stopped[voice.fret];
    const StoppedStringModel& reached = to.stopped[voice.fret];
    const StringModel& source = voice_model(from, voice);
    const bool bent = voice.bend.active;
    const double semitones = voice.bend.semitones;
    const double before = energy(source, voice.string);
    convert_modes(source, bent ? voice.bend.backward_q.data() : left.backward_q.data(),
                  bent ? voice.bend.backward_u.data() : left.backward_u.data(), reached, voice.string);
    const std::size_t kept = std::min(source.mode_count, reached.string.mode_count);
    forget_bend(voice);
    PlayerWork of_bend;  // the tension does not change: what it takes belongs to the rung
    if (bent) set_bend(reached, voice, semitones, of_bend);
    const StringModel& now = voice_model(to, voice);
    notice_change(now, voice.string);
    rewrite_touches(now, voice.touches, kept);
    const double change_J = energy(now, voice.string) - before;
    if (std::isfinite(change_J)) work.rungs_J += change_J;
}

}  // namespace

std::optional<Failure> add_rungs(InstrumentModel& model, const InstrumentDescription& instrument,
                                 std::span<const QualityDescription> lower) {
    for (const QualityDescription& quality : lower) {
        InstrumentDescription rung = instrument;
        rung.quality = quality;
        auto compiled = compile_instrument(rung, model.output_rate_hz);
        if (!compiled) return compiled.failure();
        for (std::size_t s = 0; s < model.strings.size(); ++s) {
            if (!have_same_contacts(model.strings[s], compiled.value().strings[s]))
                return Failure{"strings[" + std::to_string(s) + "]", "other contacts at a lower quality",
                               "contacts that every quality has"};
        }
        model.lower.push_back(std::move(compiled.value().strings));
    }
    return {};
}

void change_rung(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                 std::size_t rung) JAWARI_REALTIME {
    InstrumentStringState& string = state.strings[s];
    if (string.rung == rung || rung > model.lower.size()) return;
    const InstrumentStringModel& from = string_of(model, state, s);
    string.rung = rung;
    const InstrumentStringModel& to = string_of(model, state, s);
    for (Voice& voice : string.voices) {
        if (voice.phase != VoicePhase::Idle) change_voice(from, to, voice, state.work);
    }
}

bool fade_oldest_released(InstrumentState& state) JAWARI_REALTIME {
    Voice* oldest = nullptr;
    for (InstrumentStringState& string : state.strings) {
        if (string.busy == 0) continue;
        for (Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Damped || voice.fading) continue;
            if (oldest == nullptr || voice.age > oldest->age) oldest = &voice;
        }
    }
    if (oldest == nullptr) return false;
    fade_voice(*oldest);
    state.counters.faded_voices += 1;
    return true;
}

}  // namespace jawari
