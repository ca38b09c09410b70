// `jawari render` with --start, --end, --mono, several files in one, and short options.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/midi_bytes.h"
#include "support/read_wav.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

constexpr std::size_t rate_hz = 48000;

/// Settings at 0.1 s; a note from 0.5 to 0.9 s, one from 2 to 2.5 s; the end at 3 s. A tick is a millisecond.
std::string piece(std::uint8_t key = 33) {
    Bytes track;
    append_event(track, 100, {0xB0, 7, 90});
    append_event(track, 0, {0xB0, 10, 30});
    append_event(track, 0, {0xE0, 0, 72});
    append_event(track, 400, {0x90, key, 80});
    append_event(track, 400, {0x80, key, 64});
    append_event(track, 1100, {0x90, static_cast<std::uint8_t>(key + 5), 90});
    append_event(track, 500, {0x80, static_cast<std::uint8_t>(key + 5), 64});
    append_event(track, 500, end_of_track);
    const Bytes file = file_with_track(track, 500);
    return {file.begin(), file.end()};
}

struct Played {
    Ran ran;
    Wav wav;
};

Played play(const std::vector<std::string>& midi, const std::vector<std::string>& options) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"render"};
    for (const std::string& each : midi)
        arguments.push_back(folder.write(std::to_string(arguments.size()) + ".mid", each));
    arguments.insert(arguments.end(), {"--preset", "bass-fretted", "-o", folder.file("out.wav")});
    arguments.insert(arguments.end(), options.begin(), options.end());
    Played played{jawari(arguments), {}};
    EXPECT_EQ(played.ran.exit_code, 0) << played.ran.err;
    if (played.ran.exit_code == 0) played.wav = read_wav(folder.file("out.wav"));
    return played;
}

std::vector<double> from(const std::vector<double>& samples, std::size_t first) {
    return {samples.begin() + static_cast<std::ptrdiff_t>(std::min(first, samples.size())), samples.end()};
}

double largest(const std::vector<double>& samples) {
    double peak = 0;
    for (const double sample : samples) peak = std::max(peak, std::abs(sample));
    return peak;
}

std::vector<std::string> names_in(const TemporaryFolder& folder) {
    std::vector<std::string> names = folder.names();
    std::sort(names.begin(), names.end());
    return names;
}

const std::vector<std::string> exact{"--format", "float", "--tail", "0"};

std::vector<std::string> exactly(std::vector<std::string> options) {
    options.insert(options.end(), exact.begin(), exact.end());
    return options;
}

TEST(Excerpt, AfterSilenceItIsThatPartOfTheWhole) {
    const auto whole = play({piece()}, exact).wav;
    // The first note has ended long before: strings move by less than the noise of 24 bits.
    const auto part = play({piece()}, exactly({"--start", "0:01.95"})).wav;
    for (const std::size_t side : {0U, 1U}) {
        const auto expected = from(whole.channel(side), rate_hz * 195 / 100);
        const auto heard = part.channel(side);
        ASSERT_EQ(heard.size(), expected.size());
        double difference = 0;
        for (std::size_t n = 0; n < heard.size(); ++n)
            difference = std::max(difference, std::abs(heard[n] - expected[n]));
        EXPECT_LT(difference, 1e-3 * largest(expected));
        EXPECT_GT(largest(expected), 0.01);
    }
    // Volume, pan and bend of before: without them the sound is another one.
    EXPECT_NE(largest(part.channel(0)), largest(part.channel(1)));
}

TEST(Excerpt, UpToItsEndItIsTheWhole) {
    const auto whole = play({piece()}, exact).wav;
    const auto part = play({piece()}, exactly({"--end", "2.25"})).wav;
    auto expected = whole.channel(0);
    expected.resize(rate_hz * 225 / 100);
    EXPECT_EQ(part.channel(0), expected);
    const auto later = play({piece()}, exactly({"--end", "1:00:00"})).wav;
    EXPECT_EQ(later.data, whole.data);
}

TEST(Excerpt, NotesOfBeforeAreNotPlayedAndSaid) {
    const auto part = play({piece()}, exactly({"--start", "0.6", "--end", "1.9"}));
    EXPECT_EQ(largest(part.wav.channel(0)), 0);
    EXPECT_EQ(part.wav.channel(0).size(), rate_hz * 13 / 10);
    EXPECT_NE(part.ran.err.find("notice: 1 note began before --start and is not played"), std::string::npos)
        << part.ran.err;
}

TEST(Excerpt, TimesAreThoseOfTheTempoThatIsPlayed) {
    const auto part = play({piece()}, exactly({"--tempo", "200", "--start", "0.9"})).wav;
    EXPECT_EQ(part.channel(0).size(), rate_hz * 6 / 10);
}

TEST(Excerpt, ImpossibleTimesAreRefusedAndNothingIsWritten) {
    const TemporaryFolder folder;
    const std::string midi = folder.write("in.mid", piece());
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"--start", "2", "--end", "1"}, "--end: 1 (allowed: later than --start, 2 s)"},
        {{"--start", "2", "--end", "2"}, "--end: 2 (allowed: later than --start, 2 s)"},
        {{"--end", "0"}, "--end: 0 (allowed: later than --start, 0 s)"},
        {{"--start", "3"}, "--start: 3 (allowed: below 3 s, the end of " + midi + ")"},
        {{"--start", "-1"}, "--start: -1 (allowed: seconds, M:SS or H:MM:SS, to 3600000 s)"},
        {{"--start", "nan"}, "--start: nan (allowed: seconds"},
        {{"--end", "inf"}, "--end: inf (allowed: seconds"},
        {{"--end", "1:60"}, "--end: 1:60 (allowed: seconds"},
        {{"--end", "4e6"}, "--end: 4e6 (allowed: seconds"}};
    for (const auto& [options, message] : wrong) {
        std::vector<std::string> arguments{"render", midi, "-o", folder.file("o.wav")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Ran ran = jawari(arguments);
        EXPECT_EQ(ran.exit_code, 2) << message;
        EXPECT_EQ(ran.error_lines(), 1) << ran.err;
        EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"in.mid"});
}

TEST(OneFile, SeveralPiecesFollowEachOther) {
    for (const std::string tail : {"0", "0.25", "auto"}) {
        const std::vector<std::string> options{"--format", "float", "--tail", tail};
        const auto both = play({piece(33), piece(40)}, options).wav;
        const auto first = play({piece(33)}, options).wav;
        const auto second = play({piece(40)}, options).wav;
        for (const std::size_t side : {0U, 1U}) {
            auto expected = first.channel(side);
            const auto rest = second.channel(side);
            expected.insert(expected.end(), rest.begin(), rest.end());
            EXPECT_EQ(both.channel(side), expected) << tail;
        }
    }
}

TEST(OneFile, IsThereOnlyIfAllPiecesAre) {
    const TemporaryFolder folder;
    const Ran ran = jawari({"render", folder.write("good.mid", piece()), folder.write("bad.mid", "MThd"),
                            "-o", folder.file("o.wav")});
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.error_lines(), 1) << ran.err;
    EXPECT_NE(ran.err.find("bad.mid"), std::string::npos);
    EXPECT_EQ(names_in(folder), (std::vector<std::string>{"bad.mid", "good.mid"}));
}

TEST(OneFile, AFolderThatIsNotThereDoesNotBecomeASoundFile) {
    const TemporaryFolder folder;
    const std::string a = folder.write("a.mid", piece());
    const std::string b = folder.write("b.mid", piece());
    const Ran ran = jawari({"render", a, b, "-o", folder.file("songs")});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_NE(ran.err.find("songs (allowed: a folder, or a sound file such as song.wav"), std::string::npos)
        << ran.err;
    const Ran over = jawari({"render", "-o", a, b, a});  // jawari render -o *.mid
    EXPECT_EQ(over.exit_code, 2);
    EXPECT_EQ(read_text(a), piece());
    EXPECT_EQ(names_in(folder), (std::vector<std::string>{"a.mid", "b.mid"}));
}

TEST(Mono, IsTheMeanOfLeftAndRight) {
    const auto stereo = play({piece()}, exact).wav;
    const auto mono = play({piece()}, exactly({"--mono"})).wav;
    ASSERT_EQ(mono.channels, 1U);
    const auto left = stereo.channel(0), right = stereo.channel(1), both = mono.channel(0);
    ASSERT_EQ(both.size(), left.size());
    for (std::size_t n = 0; n < both.size(); ++n) ASSERT_NEAR(both[n], (left[n] + right[n]) / 2, 1e-7);
    EXPECT_GT(largest(both), 0.01);
}

TEST(Mono, TheLimiterHoldsTheMixThatIsWritten) {
    const auto limited = play({piece()}, exactly({"--mono", "--gain", "30", "--limiter", "-6"}));
    EXPECT_LE(largest(limited.wav.channel(0)), std::pow(10.0, -6.0 / 20) * (1 + 1e-7));
    EXPECT_GT(largest(limited.wav.channel(0)), 0.45);
}

TEST(ShortOptions, MeanWhatTheLongOnesMean) {
    const auto words =
        play({piece()}, exactly({"--rate", "44100", "--tempo", "150", "--transpose", "2"})).wav;
    EXPECT_EQ(play({piece()}, exactly({"-r", "44100", "-T150", "-K", "2"})).wav.data, words.data);
    EXPECT_EQ(play({piece()}, exactly({"-s44100", "-T", "150", "-K2", "-j", "1"})).wav.data, words.data);
    EXPECT_EQ(largest(play({piece()}, exactly({"-Q", "1"})).wav.channel(0)), 0);
}

}  // namespace
}  // namespace jawari::host
