// `jawari bench-latency`, and what it measures.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "commands/bench_latency/adversary.h"
#include "commands/bench_latency/block_times.h"
#include "commands/bench_latency/event_delay.h"
#include "midi/read_midi_map.h"
#include "support/live_stage.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using test::run;
using test::small_live_instrument;
using test::TemporaryFolder;

TEST(LatencyProgram, ReportsEveryFormat) {
    const TemporaryFolder folder;
    const auto ran =
        run({JAWARI_PROGRAM, "bench-latency", "--preset", "bass-fretted", "--frames", "64", "--frames", "16",
             "--blocks", "300", "--passes", "3", "--json", folder.file("l.json"), "--csv",
             folder.file("l.csv"), "--plot", folder.file("l.svg")});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_NE(ran.out.find("bass-fretted       at rest 0, while sounding 0"), std::string::npos) << ran.out;
    const auto json = nlohmann::json::parse(test::read_text(folder.file("l.json")));
    const auto& sizes = json.at("presets").at(0).at("block_share_of_deadline");
    ASSERT_EQ(sizes.size(), 2U);
    for (const auto& size : sizes) {
        EXPECT_EQ(size.at("blocks_per_pass"), 100);
        EXPECT_EQ(size.at("raw").at("count"), 300);
        EXPECT_EQ(size.at("minimum").at("count"), 100);
        EXPECT_LE(size.at("minimum").at("max"), size.at("raw").at("max"));
        EXPECT_GT(size.at("minimum").at("max"), 0);
        std::uint64_t counted = 0;
        for (const auto& bin : size.at("raw_histogram")) counted += bin.at(1).get<std::uint64_t>();
        EXPECT_EQ(counted, 300U);
    }
    std::istringstream csv(test::read_text(folder.file("l.csv")));
    std::string text;
    std::size_t lines = 0;
    while (std::getline(csv, text)) ++lines;
    EXPECT_EQ(lines, 5U);
    EXPECT_NE(test::read_text(folder.file("l.svg")).find("</svg>"), std::string::npos);
}

TEST(LatencyProgram, TimesThePlugin) {
    const auto ran = run({JAWARI_PROGRAM, "bench-latency", "--plugin", "--preset", "bass-fretted", "--frames",
                          "64", "--blocks", "200", "--passes", "2", "--json", "-"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto json = nlohmann::json::parse(ran.out);
    EXPECT_EQ(json.at("quality"), "live, in the plugin");
    const auto& size = json.at("presets").at(0).at("block_share_of_deadline").at(0);
    EXPECT_EQ(size.at("raw").at("count"), 200);
    EXPECT_GT(size.at("minimum").at("median"), 0);
    const auto refused = run({JAWARI_PROGRAM, "bench-latency", "--plugin", "--governor"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.error_lines(), 1) << refused.err;
}

TEST(Adversary, ItsMapAsTextIsItsMap) {
    const auto read = read_midi_map(adversary_map_text(), "text");
    ASSERT_TRUE(read) << read.error().message;
    const MidiMap map = adversary_map();
    ASSERT_EQ(read.value().count, map.count);
    for (int controller = 0; controller < 120; ++controller) {
        const auto bound_to = [controller](const MidiMap& one) {
            int parameter = -1;
            for (std::size_t i = 0; i < one.count; ++i)
                if (one.bindings[i].number == controller)
                    parameter = static_cast<int>(one.bindings[i].parameter);
            return parameter;
        };
        EXPECT_EQ(bound_to(read.value()), bound_to(map)) << controller;
    }
}

TEST(LatencyProgram, RefusesWhatMakesNoSense) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--frames", "0"},
                                                      {"--blocks", "many"},
                                                      {"--passes", "0"},
                                                      {"--rate", "1"},
                                                      {"--seed", "-1"},
                                                      {"--quality", "best"}}) {
        std::vector<std::string> command{JAWARI_PROGRAM, "bench-latency"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const auto ran = run(command);
        EXPECT_EQ(ran.exit_code, 2) << arguments[0];
        EXPECT_EQ(ran.error_lines(), 1) << ran.err;
        EXPECT_NE(ran.err.find("allowed:"), std::string::npos) << ran.err;
    }
    const auto unknown = run({JAWARI_PROGRAM, "bench-latency", "--preset", "banjo"});
    EXPECT_EQ(unknown.exit_code, 4) << unknown.err;
}

TEST(Latency, EventsChangeTheirOwnFrame) {
    for (const char* const preset :
         {"guitar-steel", "bass-slap", "clavichord", "dulcimer", "harpsichord", "sitar", "guitar-12"}) {
        const EventDelay delay = measure_event_delay(small_live_instrument(preset), 48000);
        EXPECT_EQ(delay.at_rest, std::optional<std::size_t>(0)) << preset;
        EXPECT_EQ(delay.sounding, std::optional<std::size_t>(0)) << preset;
        EXPECT_GE(delay.events, 4U);
    }
}

TEST(Latency, OrderStatisticsOfKnownNumbers) {
    std::vector<float> values;
    for (int n = 20000; n > 0; --n) values.push_back(static_cast<float>(n));
    const Distribution distribution = distribution_of(values);
    EXPECT_EQ(distribution.median, 10000);
    EXPECT_EQ(distribution.p99, 19800);
    EXPECT_EQ(distribution.p99_99, 19998);
    EXPECT_EQ(distribution.most, 20000);
    EXPECT_EQ(distribution.mean, 10000.5);
    EXPECT_EQ(distribution_of({3}).p99_99, 3);
    EXPECT_EQ(distribution_of({}).count, 0U);
}

/// Two hands strike ten keys at once, all courses in turn, and the pedal comes up for the runs alone.
TEST(Latency, TwoHandsReachEverythingByTen) {
    const SharedInstrument instrument = small_live_instrument("harpsichord");
    Adversary adversary(instrument->model, 3, AdversaryReach::TwoHands);
    std::array<bool, 128> struck{};
    std::size_t pedal_up = 0, pedal_down = 0;
    for (int block = 0; block < 3000; ++block) {
        std::size_t notes = 0;
        for (const AdversaryMessage& message : adversary.next(64)) {
            const ChannelMessage& sent = message.message;
            const bool pedal = kind_of(sent) == MessageKind::ControlChange && sent.data1 == 64;
            if (pedal) (sent.data2 > 0 ? pedal_down : pedal_up) += 1;
            if (kind_of(sent) != MessageKind::NoteOn || sent.data2 == 0) continue;
            notes += 1;
            struck[sent.data1] = true;
        }
        EXPECT_LE(notes, 12U) << block;  // a chord, and a cable's next messages
    }
    EXPECT_GT(pedal_down, 3 * pedal_up);
    for (const InstrumentStringModel& string : instrument->model.strings)
        EXPECT_TRUE(struck[static_cast<std::size_t>(string.stopped.front().key)]) << string.name;
}

/// The adversary plays what it says: every course, every parameter, within the instrument's compass.
TEST(Latency, TheAdversaryLeavesNothingOut) {
    const SharedInstrument instrument = small_live_instrument("guitar-steel");
    Adversary adversary(instrument->model, 3), same(instrument->model, 3);
    std::array<int, 256> kinds{};
    std::array<bool, 128> controllers{};
    std::size_t largest_chord = 0;
    for (int block = 0; block < 3000; ++block) {
        const auto& messages = adversary.next(64);
        const auto& again = same.next(64);
        ASSERT_EQ(messages.size(), again.size());
        std::size_t notes = 0;
        std::size_t before = 0;
        for (std::size_t i = 0; i < messages.size(); ++i) {
            const ChannelMessage& message = messages[i].message;
            ASSERT_EQ(message.data1, again[i].message.data1);
            ASSERT_LT(messages[i].offset, 64U);
            ASSERT_GE(messages[i].offset, before);
            ASSERT_LT(message.data1, 128);
            ASSERT_LT(message.data2, 128);
            before = messages[i].offset;
            kinds[message.status] += 1;
            if (message.status == 0xB0) controllers[message.data1] = true;
            notes += message.status == 0x90 ? 1 : 0;
        }
        largest_chord = std::max(largest_chord, notes);
    }
    EXPECT_GT(kinds[0x90], 500);
    EXPECT_NEAR(kinds[0x80], kinds[0x90], 30);  // nothing is forgotten
    EXPECT_GT(kinds[0xE0], 100);
    EXPECT_GT(kinds[0xD0], 100);
    EXPECT_GE(largest_chord, 3U);
    const MidiMap map = adversary_map();
    for (std::size_t i = map.count - parameter_count; i < map.count; ++i)
        EXPECT_TRUE(controllers[static_cast<std::size_t>(map.bindings[i].number)]) << i;
}

}  // namespace
}  // namespace jawari::host
