// A sounding string goes on at another quality level.
#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "instrument/model/played_string.h"
#include "instrument/touch/touches.h"
#include "instrument/voice/bend.h"
#include "instrument/voice/pickups.h"
#include "jawari/instrument/qualities.h"
#include "jawari/scene/energy.h"

namespace jawari {
namespace {

/// v = backward_q q + backward_u u, with q from rest, at either quality level. Overdamped modes keep v.
void convert_modes(const StringModel& source, const double* backward_q, const double* backward_u,
                   const StoppedStringModel& to, StringState& string) {
    const StringModel& target = to.string;
    const std::size_t kept = std::min(source.shape->mode_count, target.shape->mode_count);
    for (std::size_t k = 0; k < kept; ++k) {
        const double q = string.displacement[k] - source.shape->rest_displacement[k];
        const double u = (string.velocity[k] - backward_q[k] * q) / backward_u[k];
        string.displacement[k] = q + target.shape->rest_displacement[k];
        string.velocity[k] = to.backward_q[k] * q + to.backward_u[k] * u;
    }
    for (std::size_t k = kept; k < target.shape->stride; ++k) {
        string.displacement[k] = target.shape->rest_displacement[k];
        string.velocity[k] = 0;
    }
}

/// What outputs read of a voice, before its gains, what is left of an earlier change included.
QualityRemainder read_voice(const InstrumentModel& model, const StoppedStringModel& stopped,
                            const Voice& voice) {
    OutputReadings readings;  // NOLINT(cppcoreguidelines-pro-type-member-init): set as far as it is read
    set_output_readings(model, stopped, readings);
    read_outputs(voice.string, 0, readings);
    QualityRemainder read;
    read.pickups = pickup_signal(model, stopped, readings, 0, voice.gains.mix);
    if (model.body.count > 0) read.bridge_N = bridge_force(stopped, readings, 0);
    if (!voice.remainder.active) return read;
    const double gain = model.fade_shape[voice.remainder.frame];
    read.pickups += gain * voice.remainder.pickups;
    read.bridge_N += gain * voice.remainder.bridge_N;
    return read;
}

void change_voice(const InstrumentModel& model, const InstrumentStringModel& from,
                  const InstrumentStringModel& to, Voice& voice, PlayerWork& work) {
    const StoppedStringModel& left = from.stopped[voice.fret];
    const StoppedStringModel& reached = to.stopped[voice.fret];
    const StringModel& source = voice_model(from, voice);
    const bool bent = voice.bend.active;
    const double semitones = voice.bend.semitones;
    const double before = energy(source, voice.string);
    const QualityRemainder heard = read_voice(model, left, voice);
    convert_modes(source, bent ? voice.bend.backward_q.data() : left.backward_q.data(),
                  bent ? voice.bend.backward_u.data() : left.backward_u.data(), reached, voice.string);
    const std::size_t kept = std::min(source.shape->mode_count, reached.string.shape->mode_count);
    forget_bend(voice);
    PlayerWork of_bend;  // the tension does not change: what it takes belongs to the change of quality
    if (bent) set_bend(reached, voice, semitones, of_bend);
    const StringModel& now = voice_model(to, voice);
    notice_change(now, voice.string);
    rewrite_touches(now, voice.touches, kept);
    voice.run.outdated = true;
    const double change_J = energy(now, voice.string) - before;
    if (std::isfinite(change_J)) work.quality_changes_J += change_J;
    voice.remainder = {};
    const QualityRemainder read = read_voice(model, reached, voice);
    voice.remainder = {true, heard.pickups - read.pickups, heard.bridge_N - read.bridge_N, 0};
    if (!std::isfinite(voice.remainder.pickups + voice.remainder.bridge_N)) voice.remainder = {};
}

}  // namespace

void change_quality(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                    std::size_t quality_level) JAWARI_REALTIME {
    JAWARI_ASSERT(s < state.strings.size());
    InstrumentStringState& string = state.strings[s];
    if (string.quality_level == quality_level || quality_level > model.lower.size()) return;
    const InstrumentStringModel& from = string_of(model, state, s);
    string.quality_level = quality_level;
    const InstrumentStringModel& to = string_of(model, state, s);
    for (Voice& voice : string.voices) {
        if (voice.phase != VoicePhase::Idle) change_voice(model, from, to, voice, state.work);
    }
}

}  // namespace jawari
