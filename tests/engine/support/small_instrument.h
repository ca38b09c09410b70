// A small instrument with everything that instruments can have, for tests that play.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "jawari/instrument/render.h"
#include "support/bass_instrument.h"

namespace jawari::test {

/// Two courses: the bass's E string with an octave companion, and its G string; seven frets, a thread, soft
/// cotton, three exciters, two pickups and a body.
inline InstrumentDescription small_instrument() {
    InstrumentDescription small = bass_instrument();
    small.name = "small";
    small.quality = {.contact_rate_min_hz = 200000, .mode_limit_hz = 8000};
    small.strings = {small.strings[0], small.strings[2], small.strings[3]};
    small.strings[0].course = 0;
    small.strings[1].course = 0;
    small.strings[0].pan = -0.5;
    small.strings[2].pan = 0.5;
    small.frets.height_m.resize(7);
    small.frets.count = 7;
    small.hand.course_delay_s = 0.001;
    small.exciters.push_back({.name = "hammer",
                              .place = {.share = 0.1},
                              .width_m = 0.01,
                              .body = HammerDescription{.mass_kg = 0.01,
                                                        .stiffness = 1e7,
                                                        .exponent = 2.3,
                                                        .loss_s_per_m = 0.05,
                                                        .full_speed_m_per_s = 2}});
    small.exciters.push_back({.name = "tangent",
                              .place = {},
                              .body = TangentDescription{.rise_s = 0.003, .full_height_m = 0.001}});
    small.obstacles.push_back({.name = "rattle",
                               .origin = Origin::Bridge,
                               .side = Side::Above,
                               .profile = CornerProfile{{0.2, 0.0015}},
                               .strings = {2}});
    small.obstacles.push_back(
        {.name = "bridge",
         .origin = Origin::Bridge,
         .profile = ParabolicProfile{.length_m = 0.02, .drop_m = 0.0005, .height_m = -1e-5},
         .points = 4,
         .strings = {2}});
    small.soft_touches.push_back(
        {.name = "cotton", .place = {.share = 0.02}, .damping_kg_per_s = 0.02, .strings = {1}});
    small.pickups.push_back({.place = {.share = 0.2}, .level = 0.5, .magnet_distance_m = 0.01});
    small.body = {{.frequency_hz = 90, .t60_s = 0.3, .gain_left = 0.02, .gain_right = 0.01},
                  {.frequency_hz = 240, .t60_s = 0.2, .gain_left = -0.01, .gain_right = 0.02}};
    return small;
}

struct Played {
    std::vector<double> left, right;
    bool operator==(const Played&) const = default;
};

/// A whole performance in blocks of the given size.
inline Played play(const InstrumentModel& model, InstrumentState& state,
                   const std::vector<InstrumentEvent>& events, std::size_t frames, std::size_t block = 256) {
    Played played{std::vector<double>(frames), std::vector<double>(frames)};
    std::size_t next = 0;
    for (std::size_t begin = 0; begin < frames; begin += block) {
        const std::size_t count = std::min(block, frames - begin);
        std::vector<InstrumentEvent> here;
        for (; next < events.size() && events[next].frame < begin + count; ++next) {
            here.push_back(events[next]);
            here.back().frame -= begin;
        }
        render_instrument(model, state, here,
                          InstrumentOutput{played.left.data() + begin, played.right.data() + begin, {}},
                          count);
    }
    return played;
}

/// Every kind of event at random moments, from gentle to absurd.
inline std::vector<InstrumentEvent> storm(unsigned seed, std::size_t frames, std::size_t count) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const auto unit = [&] { return static_cast<double>(random() % 1001) / 1000; };
    std::vector<InstrumentEvent> events;
    for (std::size_t i = 0; i < count; ++i) {
        InstrumentEvent event;
        event.frame = below(frames);
        event.channel = static_cast<int>(below(3));
        event.key = 28 + static_cast<int>(below(24));
        event.value = unit();
        switch (below(16)) {
            case 0:
            case 1:
            case 2:
            case 3:
            case 4:
                event.type = InstrumentEventType::NoteOn;
                break;
            case 5:
            case 6:
                event.type = InstrumentEventType::NoteOff;
                break;
            case 7:
                event.type = InstrumentEventType::Bend;
                event.key = below(2) == 0 ? -1 : event.key;
                event.value = 8 * unit() - 4;
                break;
            case 8:
                event.type = InstrumentEventType::Pressure;
                event.key = -1;
                break;
            case 9:
                event.type = InstrumentEventType::Timbre;
                break;
            case 10:
                event.type = InstrumentEventType::Sustain;
                break;
            case 11:
                event.type = InstrumentEventType::SoftPedal;
                break;
            case 12:
                event.type =
                    below(4) == 0 ? InstrumentEventType::AllSoundOff : InstrumentEventType::AllNotesOff;
                break;
            case 13:
                event.type = InstrumentEventType::ResetControllers;
                break;
            default: {
                event.type = InstrumentEventType::SetParameter;
                const ParameterDeclaration& parameter = parameter_table()[below(parameter_count)];
                event.parameter = parameter.id;
                event.value = parameter_value(parameter, unit());
                if (parameter.id == ParameterId::SlideTime) event.value *= 0.005;  // short enough to arrive
                event.channel = static_cast<int>(below(4)) - 1;
                break;
            }
        }
        events.push_back(event);
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const auto& a, const auto& b) { return a.frame < b.frame; });
    return events;
}

}  // namespace jawari::test
