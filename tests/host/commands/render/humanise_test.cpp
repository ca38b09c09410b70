#include "commands/render/humanise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jawari::host {
namespace {

using Type = InstrumentEventType;

TimedEvent note(std::uint64_t frame, Type type, int key, double value) {
    return {frame, {.type = type, .key = key, .value = value}};
}

/// Notes of key 60 that touch each other, and a pedal.
Score staccato() {
    Score score;
    score.parts.resize(1);
    for (std::uint64_t i = 0; i < 500; ++i) {
        score.parts[0].events.push_back(note(1000 * i, Type::NoteOn, 60, 0.5));
        score.parts[0].events.push_back(note(1000 * i + 500, Type::Sustain, 0, 1));
        score.parts[0].events.push_back(note(1000 * i + 1000, Type::NoteOff, 60, 0.5));
    }
    score.end_frame = 500000;
    return score;
}

TEST(Humanise, TheSameSeedGivesTheSameScore) {
    Score a = staccato(), b = staccato(), c = staccato();
    humanise(a, 1, 48000);
    humanise(b, 1, 48000);
    humanise(c, 2, 48000);
    bool differs = false;
    for (std::size_t i = 0; i < a.parts[0].events.size(); ++i) {
        ASSERT_EQ(a.parts[0].events[i].frame, b.parts[0].events[i].frame);
        ASSERT_EQ(a.parts[0].events[i].event.value, b.parts[0].events[i].event.value);
        differs = differs || a.parts[0].events[i].frame != c.parts[0].events[i].frame;
    }
    EXPECT_TRUE(differs);
}

TEST(Humanise, NotesStayInOrderAndWithinTheirBounds) {
    Score score = staccato();
    humanise(score, 3, 48000);
    bool down = false;
    std::uint64_t last = 0;
    std::uint64_t index = 0;
    double mean = 0;
    for (const TimedEvent& timed : score.parts[0].events) {
        EXPECT_GE(timed.frame, last);
        last = timed.frame;
        if (timed.event.type == Type::Sustain) {
            EXPECT_EQ(timed.frame % 1000, 500U);
            continue;
        }
        EXPECT_NE(down, timed.event.type == Type::NoteOn);  // on and off in turn: no note is stuck or lost
        down = timed.event.type == Type::NoteOn;
        if (!down) continue;
        EXPECT_GE(timed.frame, 1000 * index);
        EXPECT_LE(timed.frame, 1000 * index + 576);
        EXPECT_NEAR(timed.event.value, 0.5, 0.5 * human_velocity);
        mean += timed.event.value / 500;
        ++index;
    }
    EXPECT_FALSE(down);
    EXPECT_NEAR(mean, 0.5, 0.005);
    EXPECT_GE(score.end_frame, score.parts[0].events.back().frame);
}

TEST(Humanise, VelocitiesStayInRange) {
    Score score;
    score.parts.resize(1);
    for (int key = 0; key < 100; ++key) {
        score.parts[0].events.push_back(note(0, Type::NoteOn, key, 1.0));
        score.parts[0].events.push_back(note(0, Type::NoteOn, key, 1.0 / 127));
    }
    humanise(score, 5, 48000);
    for (const TimedEvent& timed : score.parts[0].events) {
        EXPECT_GE(timed.event.value, 1.0 / 127);
        EXPECT_LE(timed.event.value, 1.0);
    }
}

}  // namespace
}  // namespace jawari::host
