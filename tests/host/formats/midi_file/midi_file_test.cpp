// Valid files: against hand-computed times and against midicsv, an independent reader.
#include "formats/midi_file/midi_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "support/midi_bytes.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

TEST(MidiFile, TempoChangesGiveExactTimes) {
    Bytes track;
    append_event(track, 0, {0x90, 60, 100});  // 0 s, default tempo: 0.5 s per quarter
    append_event(track, 960, {60, 0});        // running status, 2 quarters: 1 s
    append_event(track, 0, tempo_event(250000));
    append_event(track, 480, {0x93, 61, 1});  // 1.25 s
    append_event(track, 1, {61, 0});          // 1.25 s + 250000/480 us
    append_event(track, 0, end_of_track);
    const auto file = parse_midi(file_with_track(track));
    ASSERT_TRUE(file.ok()) << file.failure().line();
    const MidiFile& midi = file.value();
    ASSERT_EQ(midi.events.size(), 4U);
    EXPECT_EQ(midi.time_units_per_s, 480000000U);
    EXPECT_EQ(midi.events[0].time, 0U);
    EXPECT_EQ(midi.events[1].time, midi.time_units_per_s);
    EXPECT_EQ(midi.events[1].status, 0x90);
    EXPECT_EQ(midi.events[2].time, midi.time_units_per_s * 5 / 4);
    EXPECT_EQ(midi.events[2].status, 0x93);
    EXPECT_EQ(midi.events[3].time, midi.time_units_per_s * 5 / 4 + 250000);
    EXPECT_EQ(frame_of(midi, midi.events[2].time, 48000), 60000U);
    EXPECT_EQ(frame_of(midi, midi.events[3].time, 48000), 60025U);
    EXPECT_EQ(midi.end_time, midi.events[3].time);
}

TEST(MidiFile, TempoInAnyTrackOfType1AppliesToAll) {
    Bytes notes, tempo;
    append_event(notes, 200, {0x90, 40, 90});
    append_event(notes, 0, end_of_track);
    append_event(tempo, 100, tempo_event(1000000));
    append_event(tempo, 0, end_of_track);
    Bytes bytes = header_chunk(1, 2, 100);
    append(bytes, chunk("MTrk", notes));
    append(bytes, chunk("XYZW", {1, 2, 3}));  // chunks of other kinds are skipped
    append(bytes, chunk("MTrk", tempo));
    const auto file = parse_midi(bytes);
    ASSERT_TRUE(file.ok()) << file.failure().line();
    EXPECT_EQ(file.value().events.at(0).time, file.value().time_units_per_s * 3 / 2);
}

TEST(MidiFile, SmpteDivisionIgnoresTempo) {
    struct Case {
        int frames_per_s;
        double frame_s;
    };
    for (const Case c :
         {Case{24, 1.0 / 24}, Case{25, 1.0 / 25}, Case{29, 1001.0 / 30000}, Case{30, 1.0 / 30}}) {
        Bytes track;
        append_event(track, 0, tempo_event(123456));
        append_event(track, 40 * 100, {0x80, 1, 2});  // 100 frames of 40 ticks
        append_event(track, 0, end_of_track);
        const auto division = static_cast<std::uint32_t>((256 - c.frames_per_s) << 8 | 40);
        const auto file = parse_midi(file_with_track(track, division));
        ASSERT_TRUE(file.ok()) << file.failure().line();
        const double seconds = static_cast<double>(file.value().events.at(0).time) /
                               static_cast<double>(file.value().time_units_per_s);
        EXPECT_NEAR(seconds, 100 * c.frame_s, 1e-14) << c.frames_per_s;
    }
}

TEST(MidiFile, DoesNotDriftOverHours) {
    // 333 333 us at 7 ticks a quarter: no tick is a whole number of microseconds. 20 hours, then compare in
    // exact integers.
    Bytes track;
    append_event(track, 0, tempo_event(333333));
    constexpr std::uint32_t ticks = 1512000;
    for (std::uint32_t i = 0; i < ticks / 63; ++i) append_event(track, 63, {0x90, 1, 1});
    append_event(track, 0, end_of_track);
    const auto file = parse_midi(file_with_track(track, 7));
    ASSERT_TRUE(file.ok()) << file.failure().line();
    const std::uint64_t exact_us = std::uint64_t{ticks} / 7 * 333333;  // ticks is a multiple of 7
    EXPECT_EQ(file.value().end_time, exact_us * 7);
    const std::uint64_t frame = (exact_us * 48000 + 500000) / 1000000;
    EXPECT_EQ(frame_of(file.value(), file.value().end_time, 48000), frame);
}

TEST(MidiFile, AcceptsTheRiffWrapper) {
    Bytes track;
    append_event(track, 0, {0x90, 60, 100});
    append_event(track, 0, end_of_track);
    const Bytes inner = file_with_track(track);
    const auto little_endian = [](std::size_t n) {
        return Bytes{static_cast<std::uint8_t>(n), static_cast<std::uint8_t>(n >> 8), 0, 0};
    };
    Bytes bytes;
    append_tag(bytes, "RIFF");
    append(bytes, little_endian(inner.size() + 4 + 8 + 10));
    append_tag(bytes, "RMIDDISP");
    append(bytes, little_endian(1));
    append(bytes, {7, 0});  // one byte and its padding
    append_tag(bytes, "data");
    append(bytes, little_endian(inner.size()));
    append(bytes, inner);
    const auto file = parse_midi(bytes);
    ASSERT_TRUE(file.ok()) << file.failure().line();
    EXPECT_EQ(file.value().events.size(), 1U);

    const auto expect_refusal = [&](const Bytes& wrong, const std::string& reason) {
        const auto refused = parse_midi(wrong);
        ASSERT_FALSE(refused.ok()) << reason;
        EXPECT_NE(refused.failure().line().find(reason), std::string::npos) << refused.failure().line();
    };
    Bytes wave = bytes;
    std::copy_n("WAVE", 4, wave.begin() + 8);
    expect_refusal(wave, "a RIFF file of another kind (allowed: RMID)");
    const Bytes without_data(bytes.begin(), bytes.begin() + 12 + 10);
    expect_refusal(without_data, "an RMID file without a data chunk");
    Bytes cut = bytes;
    cut.pop_back();
    expect_refusal(cut, "RIFF chunk of " + std::to_string(inner.size()) + " bytes (allowed: at most the");
}

TEST(MidiFile, PortsByNumberAndByName) {
    Bytes first, second, third;
    append_event(first, 0, {0x90, 1, 1});
    append_event(first, 0, {0xFF, 0x21, 1, 3});
    append_event(first, 0, {0x90, 2, 1});
    append_event(first, 0, {0xFF, 0x09, 1, 'b'});  // the number says more
    append_event(first, 0, {0x90, 3, 1});
    append_event(second, 1, {0xFF, 0x09, 1, 'a'});
    append_event(second, 0, {0x90, 4, 1});
    append_event(third, 2, {0xFF, 0x09, 1, 'b'});
    append_event(third, 0, {0x90, 5, 1});
    append_event(third, 0, {0xFF, 0x09, 1, 'a'});
    append_event(third, 0, {0x90, 6, 1});
    Bytes bytes = header_chunk(1, 3, 96);
    for (Bytes* track : {&first, &second, &third}) {
        append_event(*track, 0, end_of_track);
        append(bytes, chunk("MTrk", *track));
    }
    const auto file = parse_midi(bytes);
    ASSERT_TRUE(file.ok()) << file.failure().line();
    std::vector<int> ports;
    for (const MidiEvent& event : file.value().events) ports.push_back(event.port);
    EXPECT_EQ(ports, (std::vector<int>{0, 3, 3, 0, 1, 0}));
}

TEST(MidiFile, ExclusivesInOneOrSeveralPackets) {
    Bytes track;
    append_event(track, 0, {0xF0, 3, 1, 2, 0xF7});
    append_event(track, 5, {0xF0, 2, 3, 4});
    append_event(track, 5, {0xF7, 1, 5});
    append_event(track, 5, {0xF7, 2, 6, 0xF7});
    append_event(track, 0, {0xF7, 3, 0x90, 60, 64});  // bytes for a cable
    append_event(track, 0, {0xF0, 2, 7, 8});          // without its F7
    append_event(track, 0, {0x90, 60, 1});
    append_event(track, 0, end_of_track);
    const auto file = parse_midi(file_with_track(track));
    ASSERT_TRUE(file.ok()) << file.failure().line();
    using Bodies = std::vector<std::vector<std::uint8_t>>;
    EXPECT_EQ(file.value().exclusives, (Bodies{{1, 2}, {3, 4, 5, 6}, {7, 8}}));
    ASSERT_EQ(file.value().events.size(), 4U);
    EXPECT_EQ(file.value().events[1].tick, 15U);
    EXPECT_EQ(file.value().escapes, 1U);
}

// ---------------------------------------------------------------------------------------------- midicsv

/// (tick, track, status, data1, data2), or tempo as (tick, track, 0xFF, us, 0): a line of midicsv's output.
using Line = std::tuple<std::uint64_t, int, int, int, int>;

/// A random track: every channel message, running status where it may be used, meta and system exclusive
/// events, tempos.
Bytes random_track(std::mt19937& random, int events) {
    const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
    Bytes track;
    unsigned running = 0;
    for (int i = 0; i < events; ++i) {
        const unsigned delta = below(4) == 0 ? below(1U << (1 + below(14))) : below(3);
        append_variable_length(track, delta);
        switch (below(12)) {
            case 0:
                append(track, tempo_event(1 + below(0xFFFFFF)));
                running = 0;
                break;
            case 1: {
                const unsigned length = below(200);
                track.push_back(0xFF);
                track.push_back(static_cast<std::uint8_t>(1 + below(7)));
                append_variable_length(track, length);
                for (unsigned n = 0; n < length; ++n)
                    track.push_back(static_cast<std::uint8_t>('a' + below(26)));
                running = 0;
                break;
            }
            case 2: {
                const unsigned length = 1 + below(40);
                track.push_back(0xF0);
                append_variable_length(track, length);
                for (unsigned n = 1; n < length; ++n) track.push_back(static_cast<std::uint8_t>(below(128)));
                track.push_back(0xF7);
                running = 0;
                break;
            }
            default: {
                const unsigned status = below(3) == 0 || running == 0 ? 0x80 + below(0x70) : running;
                if (status != running) track.push_back(static_cast<std::uint8_t>(status));
                running = status;
                track.push_back(static_cast<std::uint8_t>(below(128)));
                if ((status & 0xE0) != 0xC0) track.push_back(static_cast<std::uint8_t>(below(128)));
            }
        }
    }
    append_event(track, below(100), end_of_track);
    return track;
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::stringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) {
        fields.push_back(field.substr(std::min(field.find_first_not_of(' '), field.size())));
    }
    return fields;
}

/// What midicsv prints for a file, as Lines in its own order.
std::vector<Line> read_with_midicsv(const Bytes& bytes) {
    const auto path =
        std::filesystem::temp_directory_path() / ("jawari-midicsv-" + std::to_string(getpid()) + ".mid");
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    FILE* pipe = popen(("midicsv " + path.string()).c_str(), "r");
    std::string text;
    char buffer[4096];
    for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
    pclose(pipe);
    std::filesystem::remove(path);

    std::vector<Line> lines;
    std::stringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        const auto f = split(line);
        if (f.size() < 4) continue;
        const int track = std::stoi(f[0]) - 1;
        const std::uint64_t tick = std::stoull(f[1]);
        const auto add = [&](int status, int data1, int data2) {
            lines.emplace_back(tick, track, status + std::stoi(f[3]), data1, data2);
        };
        const auto number = [&](std::size_t i) { return std::stoi(f.at(i)); };
        if (f[2] == "Note_off_c") add(0x80, number(4), number(5));
        if (f[2] == "Note_on_c") add(0x90, number(4), number(5));
        if (f[2] == "Poly_aftertouch_c") add(0xA0, number(4), number(5));
        if (f[2] == "Control_c") add(0xB0, number(4), number(5));
        if (f[2] == "Program_c") add(0xC0, number(4), 0);
        if (f[2] == "Channel_aftertouch_c") add(0xD0, number(4), 0);
        if (f[2] == "Pitch_bend_c") add(0xE0, number(4) & 127, number(4) >> 7);
        if (f[2] == "Tempo") lines.emplace_back(tick, track, 0xFF, std::stoi(f[3]), 0);
    }
    return lines;
}

std::vector<Line> lines_of(const MidiFile& file) {
    std::vector<Line> lines;
    for (const MidiEvent& e : file.events)
        if (e.status != exclusive_status) lines.emplace_back(e.tick, e.track, e.status, e.data1, e.data2);
    return lines;
}

/// Time of a tick by summing tempo segments in extended precision.
long double seconds_at(std::uint64_t tick, const std::vector<Line>& tempos, unsigned division) {
    long double seconds = 0;
    std::uint64_t at = 0;
    long double tempo = 500000;
    for (const Line& t : tempos) {
        const std::uint64_t until = std::min(std::get<0>(t), tick);
        seconds += static_cast<long double>(until - at) * tempo / division / 1e6L;
        at = until;
        tempo = std::get<3>(t);
    }
    return seconds + static_cast<long double>(tick - at) * tempo / division / 1e6L;
}

/// Times ascend, each track is in its own order, and at one time no track's notes come before what another
/// does ahead of its own.
void expect_track_order(const std::vector<Line>& lines, const std::vector<Line>& expected, int trial) {
    ASSERT_EQ(lines.size(), expected.size());
    std::vector<Line> by_track = lines, expected_by_track = expected;
    const auto track_first = [](const Line& a, const Line& b) { return std::get<1>(a) < std::get<1>(b); };
    std::stable_sort(by_track.begin(), by_track.end(), track_first);
    std::stable_sort(expected_by_track.begin(), expected_by_track.end(), track_first);
    EXPECT_EQ(by_track, expected_by_track) << "trial " << trial;
    const auto is_note = [](const Line& line) {
        return std::get<2>(line) >> 4 == 9 && std::get<4>(line) > 0;
    };
    std::set<std::pair<std::uint64_t, int>> begun;  // (tick, track) with a note so far
    std::set<std::uint64_t> noted;                  // ticks with a note so far
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::uint64_t tick = std::get<0>(lines[i]);
        if (i > 0) {
            EXPECT_GE(tick, std::get<0>(lines[i - 1]));
        }
        const std::pair track{tick, std::get<1>(lines[i])};
        if (is_note(lines[i])) {
            begun.insert(track);
            noted.insert(tick);
        } else if (noted.contains(tick)) {
            EXPECT_TRUE(begun.contains(track)) << "trial " << trial << ", tick " << tick;
        }
    }
}

TEST(MidiFile, AgreesWithMidicsvOnRandomFiles) {
    if (std::system("command -v midicsv > /dev/null") != 0) GTEST_SKIP() << "midicsv is not installed";
    std::mt19937 random(20180615);
    for (int trial = 0; trial < 30; ++trial) {
        const unsigned format = trial % 2 == 0 ? 0U : 1U;
        const unsigned tracks = format == 0 ? 1U : 1 + static_cast<unsigned>(random() % 5);
        const unsigned division = 1 + static_cast<unsigned>(random() % 960);
        Bytes bytes = header_chunk(format, tracks, division);
        for (unsigned t = 0; t < tracks; ++t) append(bytes, chunk("MTrk", random_track(random, 300)));
        const auto file = parse_midi(bytes);
        ASSERT_TRUE(file.ok()) << file.failure().line();
        std::vector<Line> expected = read_with_midicsv(bytes);
        ASSERT_GT(expected.size(), 100U);
        std::stable_sort(expected.begin(), expected.end(),
                         [](const Line& a, const Line& b) { return std::get<0>(a) < std::get<0>(b); });
        std::vector<Line> tempos;
        std::copy_if(expected.begin(), expected.end(), std::back_inserter(tempos),
                     [](const Line& line) { return std::get<2>(line) == 0xFF; });
        std::erase_if(expected, [](const Line& line) { return std::get<2>(line) == 0xFF; });
        expect_track_order(lines_of(file.value()), expected, trial);
        EXPECT_EQ(file.value().tempos.size(), tempos.size());
        for (const MidiEvent& e : file.value().events) {
            const long double seconds =
                static_cast<long double>(e.time) / static_cast<long double>(file.value().time_units_per_s);
            const long double reference = seconds_at(e.tick, tempos, division);
            ASSERT_LE(std::abs(seconds - reference), 1e-15L * (1 + reference)) << "tick " << e.tick;
        }
    }
}

}  // namespace
}  // namespace jawari::host
