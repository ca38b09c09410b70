// The action: what lies below the strings is lowered, or raised as far as the strings at rest.
#include "instrument/voice/voice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "jawari/instrument/compile.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

const InstrumentModel& model_of_small() {
    static const InstrumentModel model = compile_instrument(test::small_instrument(), 48000).value();
    return model;
}

/// The string with a bridge and a rattle, stopped at a fret.
constexpr std::size_t string_index = 2;
constexpr std::size_t fret = 1;

const StoppedStringModel& stopped() {
    return model_of_small().strings[string_index].stopped[fret];
}

Voice voice_with_action(double action_m) {
    const InstrumentStringModel& string = model_of_small().strings[string_index];
    Voice voice = make_voice(string.sizes);
    start_voice(model_of_small(), string, voice, fret, 0, action_m);
    return voice;
}

bool is_on_neck(std::size_t contact) {
    const auto& neck = stopped().action_contacts;
    return std::find(neck.begin(), neck.end(), contact) != neck.end();
}

TEST(Action, LowersFretsAndNothingElse) {
    const Voice voice = voice_with_action(0.0013);
    const std::size_t frets = stopped().action_contacts.size();
    EXPECT_GE(frets, 5U);  // seven, but for those that the finger covers
    EXPECT_LT(frets, stopped().string.shape->contact_count);
    for (std::size_t c = 0; c < stopped().string.shape->contact_count; ++c) {
        const double described = stopped().string.shape->contact_height[c];
        EXPECT_DOUBLE_EQ(voice.string.contact.height[c], is_on_neck(c) ? described - 0.0013 : described);
    }
}

TEST(Action, RaisesFretsNoHigherThanTheStringAtRest) {
    const Voice voice = voice_with_action(-0.002);
    std::size_t stopped_short = 0;
    for (const std::uint32_t c : stopped().action_contacts) {
        const double described = stopped().string.shape->contact_height[c];
        const double height = voice.string.contact.height[c];
        ASSERT_LT(described, -1e-5);  // else the string would lie on it, and it would have to stay
        EXPECT_GE(height, described);
        EXPECT_LE(height, -1e-5);
        if (described + 0.002 < -1e-5) {
            EXPECT_DOUBLE_EQ(height, described + 0.002);
        } else {
            ++stopped_short;
        }
    }
    EXPECT_GT(stopped_short, 0U);
}

TEST(Action, DecidesHowHardANoteStrikesTheFrets) {
    const auto impulses = [](double action_m) {
        InstrumentState state = make_instrument_state(model_of_small());
        const InstrumentEvent turn = set_parameter(0, ParameterId::Action, action_m);
        test::play(model_of_small(), state, {turn, note_on(0, 28, 1)}, 4800);
        return contact_counters(state).impulses;
    };
    const std::uint64_t described = impulses(0);
    EXPECT_GT(described, 0U);
    EXPECT_GT(impulses(-0.0005), described);
    EXPECT_EQ(impulses(0.004), 0U);
}

}  // namespace
}  // namespace jawari
