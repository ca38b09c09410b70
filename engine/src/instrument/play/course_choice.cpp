#include "instrument/play/course_choice.h"

#include "instrument/play/control_targets.h"

namespace jawari {
namespace {

/// Smaller is better: free, then held by the pedal alone, then held by a key.
int occupation(const HeldNote& held) {
    if (!held.active) return 0;
    return held.key_down ? 2 : 1;
}

bool is_better(const InstrumentModel& model, const InstrumentState& state, std::size_t candidate,
               std::size_t best, int key) {
    if (best == no_course) return true;
    const HeldNote& a = state.courses[candidate].held;
    const HeldNote& b = state.courses[best].held;
    if (occupation(a) != occupation(b)) return occupation(a) < occupation(b);
    if (!a.active) return fret_of(model, candidate, key) < fret_of(model, best, key);
    return a.order < b.order;
}

std::size_t with_note(const InstrumentModel& model, std::size_t course, int key) {
    if (course >= model.courses.size() || fret_of(model, course, key) == no_fret) return no_course;
    return course;
}

}  // namespace

std::size_t fret_of(const InstrumentModel& model, std::size_t course, int key) JAWARI_REALTIME {
    const InstrumentStringModel& string = model.strings[model.courses[course].strings.front()];
    for (std::size_t fret = 0; fret < string.stopped.size(); ++fret) {
        if (string.stopped[fret].key == key) return fret;
    }
    return no_fret;
}

std::size_t course_holding(const InstrumentState& state, int channel, int key) JAWARI_REALTIME {
    for (std::size_t c = 0; c < state.courses.size(); ++c) {
        const HeldNote& held = state.courses[c].held;
        if (held.active && held.channel == channel && held.key == key) return c;
    }
    return no_course;
}

bool plays_legato(const InstrumentState& state, int channel) JAWARI_REALTIME {
    return state.play == PlayMode::Guitar || parameter_of(state, channel, ParameterId::Legato) >= 0.5;
}

std::size_t course_to_continue(const InstrumentModel& model, const InstrumentState& state, int channel,
                               int key) JAWARI_REALTIME {
    std::size_t latest = no_course;
    for (std::size_t c = 0; c < state.courses.size(); ++c) {
        const HeldNote& held = state.courses[c].held;
        if (!held.active || !held.key_down || held.channel != channel) continue;
        if (latest == no_course || held.order > state.courses[latest].held.order) latest = c;
    }
    return latest == no_course ? no_course : with_note(model, latest, key);
}

std::size_t choose_course(const InstrumentModel& model, const InstrumentState& state,
                          const InstrumentEvent& event) JAWARI_REALTIME {
    if (event.string >= 0) {
        const auto string = static_cast<std::size_t>(event.string);
        return string < model.strings.size() ? with_note(model, model.strings[string].course, event.key)
                                             : no_course;
    }
    if (state.play == PlayMode::Guitar)
        return with_note(model, static_cast<std::size_t>(event.channel), event.key);
    const std::size_t holding = course_holding(state, event.channel, event.key);
    if (holding != no_course) return holding;
    std::size_t best = no_course;
    for (std::size_t c = 0; c < model.courses.size(); ++c) {
        if (with_note(model, c, event.key) != no_course && is_better(model, state, c, best, event.key))
            best = c;
    }
    return best;
}

}  // namespace jawari
