// Shapes of strings against sums over modes, one by one; impulses against the momentum that they change.
#include "jawari/instrument/motion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "instrument/model/played_string.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/events.h"
#include "jawari/instrument/render.h"
#include "support/bass_instrument.h"

namespace jawari {
namespace {

const InstrumentModel& moving_bass() {
    static const InstrumentModel model = compile_instrument(test::bass_instrument(), 48000).value();
    return model;
}

InstrumentState moving(const std::vector<InstrumentEvent>& events, std::size_t frames, bool watched = false) {
    InstrumentState state = make_instrument_state(moving_bass());
    if (watched) watch_impacts(state, true);
    std::vector<double> output(frames);
    render_instrument(moving_bass(), state, events, output.data(), frames);
    return state;
}

/// sqrt(2/L) sin(k pi x/L), added up mode by mode.
double displacement_at(const Voice& voice, const StringShape& shape, double share) {
    double sum = 0;
    for (std::size_t k = 1; k <= shape.mode_count - shape.hammer_count; ++k)
        sum += voice.string.displacement[k - 1] * std::sqrt(2 / shape.length_m) *
               std::sin(std::numbers::pi * static_cast<double>(k) * share);
    return sum;
}

TEST(Motion, ShapesAreTheSumsOfTheirModes) {
    for (const int key : {28, 33, 40}) {
        const InstrumentState state = moving({note_on_string(0, 0, key, 0.9)}, 1500);
        const StringMotion motion = string_motion(moving_bass(), state, 0);
        ASSERT_TRUE(motion.moves);
        EXPECT_EQ(motion.fret, static_cast<std::size_t>(key - 28));
        const Voice& voice = state.strings[0].voices[state.strings[0].sounding];
        const StringShape& shape = *voice_model(string_of(moving_bass(), state, 0), voice).shape;
        std::array<double, shape_points> heights_m{};
        string_shape(moving_bass(), state, 0, heights_m);
        double largest = 0;
        for (std::size_t j = 0; j < shape_points; ++j) {
            const double share = static_cast<double>(j + 1) / (shape_points + 1);
            EXPECT_NEAR(heights_m[j], displacement_at(voice, shape, share), 1e-14) << key << " " << j;
            largest = std::max(largest, std::abs(heights_m[j]));
        }
        EXPECT_GT(largest, 1e-4);  // the test would else say nothing
    }
}

TEST(Motion, AStringAtRestHasNone) {
    const InstrumentState state = moving({note_on_string(0, 0, 28, 0.9)}, 1500);
    EXPECT_FALSE(string_motion(moving_bass(), state, 2).moves);
    std::array<double, shape_points> heights_m{};
    heights_m.fill(1);
    string_shape(moving_bass(), state, 2, heights_m);
    for (const double height_m : heights_m) EXPECT_EQ(height_m, 0);
}

TEST(Motion, ABendRaisesTheFrequency) {
    const InstrumentState plain = moving({note_on_string(0, 0, 28, 0.5)}, 4800);
    const InstrumentState bent = moving({bend_channel(0, 2), note_on_string(0, 0, 28, 0.5)}, 4800);
    EXPECT_NEAR(string_motion(moving_bass(), bent, 0).frequency_hz /
                    string_motion(moving_bass(), plain, 0).frequency_hz,
                std::exp2(2.0 / 12), 1e-9);
}

/// The impulses of each frame, read from the state, are what the log has added up.
TEST(Motion, ImpactsAreAddedUpByPlace) {
    InstrumentState state = make_instrument_state(moving_bass());
    watch_impacts(state, true);
    std::array<double, impact_places> expected{};
    double total = 0;
    for (std::size_t n = 0; n < 9600; ++n) {
        std::vector<InstrumentEvent> events;
        if (n == 0) events.push_back(note_on_string(0, 0, 28, 1));
        double output = 0;
        const std::uint64_t before = contact_counters(state).impulses;
        render_instrument(moving_bass(), state, events, &output, 1);
        if (contact_counters(state).impulses == before) continue;
        const Voice& voice = state.strings[0].voices[state.strings[0].sounding];
        const StringShape& shape = *voice_model(string_of(moving_bass(), state, 0), voice).shape;
        for (std::size_t c = 0; c < shape.contact_count; ++c) {
            const double share = (shape.length_m - shape.contact_position[c]) / shape.length_m;
            expected[static_cast<std::size_t>(share * impact_places)] +=
                voice.string.contact.frame_impulse[c];
            total += voice.string.contact.frame_impulse[c];
        }
    }
    ASSERT_GT(total, 0);
    std::array<float, impact_places> sums_Ns{};
    EXPECT_TRUE(take_impacts(state, 0, sums_Ns));
    for (std::size_t place = 0; place < impact_places; ++place)
        EXPECT_NEAR(sums_Ns[place], expected[place], 1e-5 * total);
    EXPECT_FALSE(take_impacts(state, 0, sums_Ns));
    EXPECT_FALSE(take_impacts(state, 1, sums_Ns));
}

TEST(Motion, WatchingChangesNoBitOfTheSound) {
    const std::vector<InstrumentEvent> events{note_on_string(0, 0, 28, 1), note_on_string(500, 1, 38, 0.8)};
    std::array<std::vector<double>, 2> outputs;
    for (const bool watched : {false, true}) {
        InstrumentState state = make_instrument_state(moving_bass());
        watch_impacts(state, watched);
        std::vector<double>& output = outputs[watched ? 1 : 0];
        output.resize(9600);
        render_instrument(moving_bass(), state, events, output.data(), output.size());
        EXPECT_EQ(state.impacts.struck[0] != 0, watched);
    }
    EXPECT_EQ(outputs[0], outputs[1]);
}

}  // namespace
}  // namespace jawari
