#include "instrument/play/events.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "instrument/play/chord_choice.h"
#include "instrument/play/control_targets.h"
#include "instrument/play/controls.h"
#include "instrument/play/course_choice.h"
#include "instrument/play/strokes.h"
#include "instrument/touch/exciters.h"

namespace jawari {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
/// What the soft pedal takes from velocity and hardness when it is fully down.
constexpr double soft_velocity = 0.4;
constexpr double soft_hardness = 0.5;
/// Octaves of hardness over the whole travel of a channel's timbre: as many as ParameterId::PluckHardness
/// has.
constexpr double timbre_octaves = 4;

// ---------------------------------------------------------------------------------------------- strokes

std::size_t choose_exciter(const InstrumentModel& model, const ChannelState& channel, std::size_t string,
                           double velocity) {
    const auto named = static_cast<std::size_t>(parameter_of(channel, ParameterId::Articulation));
    if (named >= 1 && named <= model.exciters.size()) return named - 1;
    for (std::size_t i = 0; i < model.exciters.size(); ++i) {
        const ExciterDescription& exciter = model.exciters[i];
        if (velocity >= exciter.lowest_velocity && velocity <= exciter.highest_velocity &&
            string >= exciter.first_string && string <= exciter.last_string)
            return i;
    }
    return 0;
}

Stroke stroke_of(const InstrumentModel& model, const ChannelState& channel, std::size_t string,
                 std::size_t fret, double note_velocity, int number) {
    Stroke stroke;
    stroke.fret = fret;
    stroke.channel = number;
    stroke.exciter = choose_exciter(model, channel, string, note_velocity);
    const double curved = std::pow(note_velocity, parameter_of(channel, ParameterId::VelocityCurve));
    stroke.velocity = curved * (1 - soft_velocity * channel.soft);
    stroke.hardness = parameter_of(channel, ParameterId::PluckHardness) *
                      std::exp2(timbre_octaves * (channel.timbre - 0.5)) * (1 - soft_hardness * channel.soft);
    return stroke;
}

/// All strings of the course, one after the other; those that have no such stop stay as they are.
void play_course(const InstrumentModel& model, InstrumentState& state, std::size_t course, bool legato) {
    const HeldNote& held = state.courses[course].held;
    const std::size_t fret = fret_of(model, course, held.key);
    const ChannelState& channel = channel_of(state, held.channel);
    const std::vector<std::size_t>& strings = model.courses[course].strings;
    for (std::size_t i = 0; i < strings.size(); ++i) {
        const std::size_t s = strings[i];
        if (fret >= model.strings[s].stopped.size() || model.strings[s].stopped[fret].key < 0) continue;
        const Stroke stroke = stroke_of(model, channel, s, fret, held.velocity, held.channel);
        if (legato) {
            continue_string(model, state, s, stroke);
        } else if (i == 0 || model.hand.course_delay_s == 0) {
            stroke_string(model, state, s, stroke);
        } else {
            const double delay_s = model.hand.course_delay_s * static_cast<double>(i);
            state.waiting = true;
            state.strings[s].pending = {
                .active = true, .delay = frames_of(delay_s, model.output_rate_hz), .stroke = stroke};
        }
    }
}

void release_course(const InstrumentModel& model, InstrumentState& state, std::size_t course,
                    double release_velocity) {
    for (const std::size_t s : model.courses[course].strings)
        release_string(model, state, s, release_velocity);
    state.courses[course].held.active = false;
    state.courses[course].below_count = 0;
}

// ---------------------------------------------------------------------------------------------- legato

void remember_below(CourseState& course) {
    if (course.below_count == legato_depth) {
        std::rotate(course.below.begin(), course.below.begin() + 1, course.below.end());
        course.below_count -= 1;
    }
    course.below[course.below_count++] = course.held.key;
}

bool forget_below(CourseState& course, int key) {
    const auto end = course.below.begin() + static_cast<std::ptrdiff_t>(course.below_count);
    const auto found = std::find(course.below.begin(), end, key);
    if (found == end) return false;
    std::copy(found + 1, end, found);
    course.below_count -= 1;
    return true;
}

/// The key that is down below takes the note back: a pull-off.
bool pull_off(const InstrumentModel& model, InstrumentState& state, std::size_t course) {
    CourseState& played = state.courses[course];
    if (played.below_count == 0) return false;
    played.below_count -= 1;
    played.held.key = played.below[played.below_count];
    play_course(model, state, course, true);
    return true;
}

// ---------------------------------------------------------------------------------------------- notes

/// `chosen`: for the note as one of a chord, or no_course.
void note_on(const InstrumentModel& model, InstrumentState& state, const InstrumentEvent& event,
             std::size_t chosen) {
    bool legato = plays_legato(state, event.channel);
    std::size_t course = chosen;
    if (legato && event.string < 0) course = course_to_continue(model, state, event.channel, event.key);
    if (course == no_course) course = choose_course(model, state, event);
    if (course == no_course) {
        state.counters.ignored_notes += 1;
        return;
    }
    CourseState& played = state.courses[course];
    const HeldNote before = played.held;
    const bool same_channel = before.active && before.channel == event.channel;
    legato = legato && same_channel && before.key_down && before.key != event.key;
    if (before.active && !(same_channel && before.key == event.key) && !legato)
        state.counters.stolen_notes += 1;
    if (legato) {
        remember_below(played);
    } else {
        played.below_count = 0;
    }
    played.held = {.active = true,
                   .key_down = true,
                   .channel = event.channel,
                   .key = event.key,
                   .order = state.note_order++,
                   .velocity = event.value};
    play_course(model, state, course, legato);
}

/// The key goes up: the pedal may hold the note on.
void lift_key(const InstrumentModel& model, InstrumentState& state, std::size_t course,
              double release_velocity) {
    if (pull_off(model, state, course)) return;
    HeldNote& held = state.courses[course].held;
    held.key_down = false;
    if (!channel_of(state, held.channel).sustain) release_course(model, state, course, release_velocity);
}

void note_off(const InstrumentModel& model, InstrumentState& state, const InstrumentEvent& event,
              double release_velocity) {
    const std::size_t course = course_holding(state, event.channel, event.key);
    if (course != no_course) {
        if (state.courses[course].held.key_down) lift_key(model, state, course, release_velocity);
        return;
    }
    for (CourseState& other : state.courses) {
        if (other.held.active && other.held.channel == event.channel && forget_below(other, event.key))
            return;
    }
}

// ---------------------------------------------------------------------------------------------- controllers

void set_sustain(const InstrumentModel& model, InstrumentState& state, int channel, bool down) {
    channel_of(state, channel).sustain = down;
    if (down) return;
    for (std::size_t c = 0; c < state.courses.size(); ++c) {
        const HeldNote& held = state.courses[c].held;
        if (held.active && !held.key_down && held.channel == channel)
            release_course(model, state, c, neutral_release_velocity);
    }
}

void all_notes_off(const InstrumentModel& model, InstrumentState& state, int channel) {
    for (std::size_t c = 0; c < state.courses.size(); ++c) {
        CourseState& course = state.courses[c];
        if (!course.held.active || !course.held.key_down || course.held.channel != channel) continue;
        course.below_count = 0;
        lift_key(model, state, c, neutral_release_velocity);
    }
}

void all_sound_off(const InstrumentModel& model, InstrumentState& state, int channel) {
    for (std::size_t c = 0; c < state.courses.size(); ++c) {
        CourseState& course = state.courses[c];
        for (const std::size_t s : model.courses[c].strings) silence_string(model, state, s, channel);
        if (!course.held.active || course.held.channel != channel) continue;
        course.held.active = false;
        course.below_count = 0;
    }
}

/// Of the held note of that key, if there is one.
void set_of_note(InstrumentState& state, const InstrumentEvent& event, double HeldNote::*of_note) {
    const std::size_t course = course_holding(state, event.channel, event.key);
    if (course != no_course) state.courses[course].held.*of_note = event.value;
}

/// Of the whole channel if the event names no key.
void set_expression(InstrumentState& state, const InstrumentEvent& event, double HeldNote::*of_note,
                    double ChannelState::*of_channel) {
    if (event.key < 0) {
        channel_of(state, event.channel).*of_channel = event.value;
        return;
    }
    set_of_note(state, event, of_note);
}

void reset_controllers(const InstrumentModel& model, InstrumentState& state, int channel) {
    set_sustain(model, state, channel, false);
    ChannelState& controls = channel_of(state, channel);
    controls.soft = 0;
    controls.bend = 0;
    controls.pressure = 0;
    controls.timbre = 0.5;
    for (CourseState& course : state.courses) {
        if (!course.held.active || course.held.channel != channel) continue;
        course.held.bend = unknown;
        course.held.pressure = unknown;
    }
}

void set_parameter(InstrumentState& state, const InstrumentEvent& event) {
    const auto id = static_cast<std::size_t>(event.parameter);
    for (int channel = 0; channel < midi_channels; ++channel) {
        if (event.channel < 0 || event.channel == channel)
            channel_of(state, channel).parameters[id] = event.value;
    }
}

// ---------------------------------------------------------------------------------------------- events

bool has_valid_value(const InstrumentEvent& event) {
    switch (event.type) {
        case InstrumentEventType::Bend:
            return std::abs(event.value) <= 96;  // false for NaN
        case InstrumentEventType::NoteLevel:
            return event.value >= 0 && event.value <= most_note_level;
        case InstrumentEventType::NotePan:
            return std::abs(event.value) <= 1;
        case InstrumentEventType::SetParameter: {
            const auto id = static_cast<std::size_t>(event.parameter);
            if (id >= parameter_count) return false;
            const ParameterDeclaration& declared = declaration_of(event.parameter);
            return event.value >= declared.low && event.value <= declared.high;
        }
        default:
            return event.value >= 0 && event.value <= 1;
    }
}

bool is_valid(const InstrumentEvent& event) {
    const bool any_key =
        event.type == InstrumentEventType::Bend || event.type == InstrumentEventType::Pressure;
    const int lowest_channel = event.type == InstrumentEventType::SetParameter ? -1 : 0;
    return event.channel >= lowest_channel && event.channel < midi_channels &&
           event.key >= (any_key ? -1 : 0) && event.key <= 127 && has_valid_value(event);
}

/// Whether notes before and after the event are of one chord: all but those that free a string or change
/// whether notes continue others. Notes in legato go on where their channel's last note is.
bool is_of_chord(const InstrumentState& state, const InstrumentEvent& event) {
    switch (event.type) {
        case InstrumentEventType::NoteOn:
            return event.value > 0 && is_valid(event) && !plays_legato(state, event.channel);
        case InstrumentEventType::Bend:
        case InstrumentEventType::Pressure:
        case InstrumentEventType::Timbre:
        case InstrumentEventType::SoftPedal:
        case InstrumentEventType::NoteLevel:
        case InstrumentEventType::NotePan:
            return true;
        case InstrumentEventType::SetParameter:
            return event.parameter != ParameterId::Legato;
        default:
            return false;
    }
}

void apply_event(const InstrumentModel& model, InstrumentState& state, const InstrumentEvent& event,
                 std::size_t chosen = no_course) {
    if (!is_valid(event)) return;
    switch (event.type) {
        case InstrumentEventType::NoteOn:
            if (event.value > 0) {
                note_on(model, state, event, chosen);
            } else {
                note_off(model, state, event, neutral_release_velocity);
            }
            break;
        case InstrumentEventType::NoteOff:
            note_off(model, state, event, event.value);
            break;
        case InstrumentEventType::Bend:
            set_expression(state, event, &HeldNote::bend, &ChannelState::bend);
            break;
        case InstrumentEventType::Pressure:
            set_expression(state, event, &HeldNote::pressure, &ChannelState::pressure);
            break;
        case InstrumentEventType::Timbre:
            channel_of(state, event.channel).timbre = event.value;
            break;
        case InstrumentEventType::Sustain:
            set_sustain(model, state, event.channel, event.value >= 0.5);
            break;
        case InstrumentEventType::SoftPedal:
            channel_of(state, event.channel).soft = event.value;
            break;
        case InstrumentEventType::AllNotesOff:
            all_notes_off(model, state, event.channel);
            break;
        case InstrumentEventType::AllSoundOff:
            all_sound_off(model, state, event.channel);
            break;
        case InstrumentEventType::ResetControllers:
            reset_controllers(model, state, event.channel);
            break;
        case InstrumentEventType::SetParameter:
            set_parameter(state, event);
            break;
        case InstrumentEventType::NoteLevel:
            set_of_note(state, event, &HeldNote::level);
            break;
        case InstrumentEventType::NotePan:
            set_of_note(state, event, &HeldNote::pan);
            break;
    }
}

}  // namespace

void apply_events(const InstrumentModel& model, InstrumentState& state,
                  std::span<const InstrumentEvent> events) JAWARI_REALTIME {
    for (std::size_t i = 0; i < events.size();) {
        std::size_t end = i;
        while (end < events.size() && end - i < largest_chord && is_of_chord(state, events[end])) ++end;
        if (end - i < 2) {
            apply_event(model, state, events[i++]);
            continue;
        }
        ChordCourses chosen;
        choose_chord(model, state, events.subspan(i, end - i), chosen);
        for (std::size_t event = 0; i < end; ++i, ++event)
            apply_event(model, state, events[i], chosen[event]);
    }
}

}  // namespace jawari
