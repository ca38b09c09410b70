#include "jawari/instrument/state.h"

#include <algorithm>

#include "base/assert.h"
#include "instrument/voice/body.h"
#include "instrument/voice/bridge_model.h"
#include "instrument/voice/end_run.h"
#include "instrument/voice/voice.h"
#include "jawari/instrument/qualities.h"

namespace jawari {
namespace {

/// The largest of string s over its quality levels.
StringSizes largest_sizes(const InstrumentModel& model, std::size_t s) {
    StringSizes sizes = model.strings[s].sizes;
    for (const auto& level : model.lower) sizes = larger(sizes, level[s].sizes);
    return sizes;
}

InstrumentStringState make_string(const InstrumentModel& model, std::size_t s) {
    InstrumentStringState string;
    const StringSizes sizes = largest_sizes(model, s);
    const std::size_t voices = model.strings[s].stopped.size() == 1 ? 1 : voices_per_string;
    for (std::size_t v = 0; v < voices; ++v) {
        string.voices.push_back(make_voice(sizes));
        string.voices.back().run = make_end_run(model, sizes.stride);
    }
    return string;
}

ChannelState neutral_channel() {
    ChannelState channel;
    for (const ParameterDeclaration& parameter : parameter_table())
        channel.parameters[static_cast<std::size_t>(parameter.id)] = parameter.neutral;
    return channel;
}

ImpactLog make_impact_log(const InstrumentModel& model) {
    ImpactLog log;
    log.sums_Ns.assign(model.strings.size() * impact_places, 0.0F);
    log.struck.assign(model.strings.size(), 0);
    for (const InstrumentStringModel& string : model.strings) {
        double longest_m = 0;
        for (const StoppedStringModel& stopped : string.stopped)
            longest_m = std::max(longest_m, stopped.string.shape->length_m);
        log.places_per_metre.push_back(longest_m > 0 ? static_cast<double>(impact_places) / longest_m : 0.0);
    }
    return log;
}

}  // namespace

InstrumentCounters& operator+=(InstrumentCounters& sum, const InstrumentCounters& more) JAWARI_REALTIME {
    sum.notes += more.notes;
    sum.ignored_notes += more.ignored_notes;
    sum.stolen_notes += more.stolen_notes;
    sum.delayed_notes += more.delayed_notes;
    sum.faded_voices += more.faded_voices;
    sum.legato_notes += more.legato_notes;
    return sum;
}

InstrumentState make_instrument_state(const InstrumentModel& model) {
    InstrumentState state;
    state.play = model.play;
    for (std::size_t s = 0; s < model.strings.size(); ++s) state.strings.push_back(make_string(model, s));
    state.courses.resize(model.courses.size());
    state.channels.fill(neutral_channel());
    state.body = make_body_state(model.body);
    state.bridge =
        make_bridge_state(model.bridge, model.strings.size(), model.strings.size() * voices_per_string);
    if (model.body.count > 0) state.string_bodies.assign(model.strings.size(), state.body);
    state.impacts = make_impact_log(model);
    return state;
}

void reset(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(state.strings.size() == model.strings.size());
    JAWARI_ASSERT(state.courses.size() == model.courses.size());
    for (InstrumentStringState& string : state.strings) {
        for (Voice& voice : string.voices) reset_voice(voice);
        string.sounding = no_voice;
        string.busy = 0;
        string.pending = {};
        string.quality_level = 0;
    }
    std::fill(state.courses.begin(), state.courses.end(), CourseState{});
    state.channels.fill(neutral_channel());
    reset_body(state.body);
    reset_bridge(state.bridge);
    for (BodyState& body : state.string_bodies) reset_body(body);
    state.play = model.play;
    state.note_order = 0;
    set_clock(state, 0);
    state.waiting = false;
    state.busy = false;
    state.counters = {};
    state.work = {};
    state.finished = {};
    ImpactLog& log = state.impacts;
    log.open = false;
    std::fill(log.sums_Ns.begin(), log.sums_Ns.end(), 0.0F);
    std::fill(log.struck.begin(), log.struck.end(), std::uint8_t{0});
}

void inherit_controls(const InstrumentState& from, InstrumentState& to) JAWARI_REALTIME {
    to.channels = from.channels;
}

void set_play_mode(InstrumentState& state, PlayMode mode) JAWARI_REALTIME {
    JAWARI_ASSERT(held_notes(state) == 0);
    state.play = mode;
}

void set_clock(InstrumentState& state, std::uint64_t frame) JAWARI_REALTIME {
    state.frame = frame;
    state.strokes_until = frame;
    for (InstrumentStringState& string : state.strings) {
        for (Voice& voice : string.voices) forget_run(voice);
    }
}

bool is_held(const InstrumentModel& model, const InstrumentState& state, std::size_t string) JAWARI_REALTIME {
    JAWARI_ASSERT(string < model.strings.size());
    return state.courses[model.strings[string].course].held.active;
}

std::size_t held_notes(const InstrumentState& state) JAWARI_REALTIME {
    std::size_t held = 0;
    for (const CourseState& course : state.courses) held += course.held.active ? 1 : 0;
    return held;
}

std::size_t sounding_voices(const InstrumentState& state) JAWARI_REALTIME {
    std::size_t voices = 0;
    for (const InstrumentStringState& string : state.strings) voices += string.busy;
    return voices;
}

std::size_t sounding_voices(const InstrumentState& state, std::size_t string) JAWARI_REALTIME {
    JAWARI_ASSERT(string < state.strings.size());
    return state.strings[string].busy;
}

std::size_t quality_level(const InstrumentState& state, std::size_t string) JAWARI_REALTIME {
    JAWARI_ASSERT(string < state.strings.size());
    return state.strings[string].quality_level;
}

std::uint64_t nonfinite_resets(const InstrumentState& state, std::size_t string) JAWARI_REALTIME {
    JAWARI_ASSERT(string < state.strings.size());
    std::uint64_t resets = 0;
    for (const Voice& voice : state.strings[string].voices) {
        if (voice.phase != VoicePhase::Idle) resets += voice.string.counters.nonfinite_resets;
    }
    return resets;
}

std::uint64_t finished_nonfinite_resets(const InstrumentState& state) JAWARI_REALTIME {
    return state.finished.nonfinite_resets + state.body.nonfinite_resets + state.bridge.nonfinite_resets;
}

Counters contact_counters(const InstrumentState& state) JAWARI_REALTIME {
    Counters sum = state.finished;
    for (const InstrumentStringState& string : state.strings) {
        for (const Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Idle) sum += voice.string.counters;
        }
    }
    return sum;
}

bool at_rest(const InstrumentState& state) JAWARI_REALTIME {
    return !state.busy && !state.body.ringing && !state.bridge.ringing &&
           std::all_of(state.strings.begin(), state.strings.end(), [](const InstrumentStringState& string) {
               return !string.pending.active &&
                      std::all_of(string.voices.begin(), string.voices.end(),
                                  [](const Voice& voice) { return voice.phase == VoicePhase::Idle; });
           });
}

}  // namespace jawari
