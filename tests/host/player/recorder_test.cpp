#include "player/recorder.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/input_file.h"
#include "formats/midi_file/midi_file.h"
#include "support/live_stage.h"
#include "support/read_wav.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using test::live_settings;
using test::LiveSound;
using test::read_wav;
using test::small_live_instrument;
using test::TemporaryFolder;

constexpr double rate_hz = 48000;

MidiFile parsed(const std::string& path) {
    const std::string bytes = test::read_text(path);
    const auto file = parse_midi({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    EXPECT_TRUE(file.ok()) << path;
    return file.ok() ? file.value() : MidiFile{};
}

/// Plays random music into the player, `blocks` blocks of 256 frames, no faster than the writer follows.
struct Performance {
    LivePlayer player{live_settings()};
    MidiPort* port = player.add_port();
    Adversary adversary;
    LiveSound sound;
    std::int64_t now = 1'000'000'000;

    explicit Performance(const SharedInstrument& instrument) : adversary(instrument->model, 4) {
        player.publish(instrument);
    }
    void play(int blocks) {
        for (int n = 0; n < blocks; ++n) {
            for (const AdversaryMessage& message : adversary.next(256)) {
                const auto before = static_cast<std::int64_t>(
                    (256.0 - 0.5 - static_cast<double>(message.offset)) * 1e9 / rate_hz);
                port->push({message.message, now - before});
            }
            now = sound.add(player, 256, now, rate_hz);
        }
    }
    /// The recorder's end needs blocks to go on.
    MaybeError stop(LiveRecorder& recorder) {
        std::atomic<bool> done{false};
        MaybeError error;
        std::thread control([&] {
            error = recorder.stop();
            done = true;
        });
        while (!done) {
            play(1);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        control.join();
        return error;
    }
};

TEST(LiveRecorder, TheTakeRendersToTheRecording) {
    const TemporaryFolder folder;
    // As the program would have it; its default map, for `render` knows no other here.
    const SharedInstrument instrument = [] {
        InstrumentCache cache({});
        bool compiled = false;
        return cache.get("bass-fretted", compiled).value();
    }();
    LiveSettings plain;
    plain.overload.enabled = false;
    LivePlayer player(plain);
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    RecordingSettings settings;
    settings.sound = folder.file("take.wav");
    settings.midi = folder.file("take.mid");
    auto recorder = LiveRecorder::start(player, settings);
    ASSERT_TRUE(recorder.ok()) << recorder.error().message;
    LiveSound sound;
    std::int64_t now = 1'000'000'000;
    Adversary adversary(instrument->model, 9);
    std::size_t block = 1;
    while (sound.left.size() < 24000) {
        block = block * 7 % 997 + 1;
        for (const AdversaryMessage& message : adversary.next(block))
            port.push({message.message, now - 1000000});
        now = sound.add(player, block, now, rate_hz);
    }
    ASSERT_TRUE(player.stop_capture());
    sound.add(player, 0, now, rate_hz);
    ASSERT_FALSE(recorder.value()->stop());
    EXPECT_EQ(recorder.value()->status().lost_frames, 0U);
    const auto run = test::run({JAWARI_PROGRAM, "render", settings.midi, "--preset", "bass-fretted",
                                "--format", "float", "--tail", "0", "-o", folder.file("again.wav")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto live = read_wav(settings.sound);
    const auto again = read_wav(folder.file("again.wav"));
    EXPECT_EQ(live.format, 65534);  // extensible, as RF64 has to be
    EXPECT_EQ(live.bits, 32);
    EXPECT_EQ(live.rate_hz, 48000U);
    EXPECT_EQ(live.channels, 2);
    ASSERT_EQ(live.data.size(), sound.left.size() * 8);
    ASSERT_GE(again.data.size(), live.data.size());
    EXPECT_EQ(again.data.substr(0, live.data.size()), live.data);
    EXPECT_GT(*std::max_element(sound.left.begin(), sound.left.end()), 0.01);
}

TEST(LiveRecorder, ItsMidiHasEveryMessageAtItsFrame) {
    const TemporaryFolder folder;
    for (const std::uint32_t rate :
         {48000U, 44100U, 22050U, 8001U, 96000U, 88200U, 192000U, 384000U, 40005U}) {
        const std::string path = folder.file(std::to_string(rate) + ".mid");
        auto take = TakeMidi::create(path, rate, false);
        ASSERT_TRUE(take.ok()) << rate;
        take.value().add({0, {0xC0, 5, 0}});
        take.value().add({127, {0x90, 60, 100}});
        ASSERT_FALSE(take.value().update(200));
        const MidiFile begun =
            parsed(path);  // whole although it goes on: the key that is down goes up at the end
        ASSERT_EQ(begun.events.size(), 3U) << rate;
        EXPECT_EQ(begun.events[2].status, 0x80) << rate;
        EXPECT_EQ(frame_of(begun, begun.events[2].time, rate), 200U);
        take.value().add({128, {0x80, 60, 1}});
        take.value().add({300'000'000, {0xE5, 1, 2}});  // longer than one delta time can be
        ASSERT_FALSE(take.value().close(300'000'500));
        const MidiFile file = parsed(path);
        ASSERT_EQ(file.events.size(), 4U) << rate;
        EXPECT_EQ(frame_of(file, file.events[0].time, rate), 0U);
        EXPECT_EQ(frame_of(file, file.events[1].time, rate), 127U);
        EXPECT_EQ(frame_of(file, file.events[2].time, rate), 128U);
        EXPECT_EQ(frame_of(file, file.events[3].time, rate), 300'000'000U);
        EXPECT_EQ(frame_of(file, file.end_time, rate), 300'000'500U);
        EXPECT_EQ(file.events[0].data1, 5);
        EXPECT_EQ(file.events[3].status, 0xE5);
        EXPECT_EQ(file.events[3].data2, 2);
    }
    const auto impossible = TakeMidi::create(folder.file("x.mid"), 44101, false);
    ASSERT_FALSE(impossible.ok());
    EXPECT_EQ(impossible.error().kind, ErrorKind::Usage);
    EXPECT_FALSE(std::ifstream(folder.file("x.mid")).good());
}

TEST(LiveRecorder, TicksMakeTheRateExactly) {
    for (std::uint32_t rate = 8000; rate <= 384000; rate += 100) {
        const auto ticks = ticks_per_frame(rate);
        ASSERT_TRUE(ticks) << rate;
        ASSERT_EQ(static_cast<std::uint64_t>(rate) * ticks->us_per_quarter,
                  std::uint64_t{1000000} * ticks->division);
        ASSERT_LE(ticks->division, 32767);
        ASSERT_GE(ticks->division, 1);
    }
}

TEST(LiveRecorder, KeepsAnExistingFile) {
    const TemporaryFolder folder;
    Performance performance(small_live_instrument("bass-fretted"));
    RecordingSettings settings;
    settings.sound = folder.file("take.wav");
    std::ofstream(settings.sound) << "precious";
    auto refused = LiveRecorder::start(performance.player, settings);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::File);
    EXPECT_NE(refused.error().message.find("take.wav: exists already"), std::string::npos);
    EXPECT_EQ(test::read_text(settings.sound), "precious");
    settings.overwrite = true;
    settings.format = SampleFormat::Pcm24;
    auto recorder = LiveRecorder::start(performance.player, settings);
    ASSERT_TRUE(recorder.ok());
    performance.play(10);
    ASSERT_FALSE(performance.stop(*recorder.value()));
    const auto wav = read_wav(settings.sound);
    EXPECT_EQ(wav.bits, 24);
    EXPECT_GE(wav.data.size(), 10U * 256 * 6);
}

TEST(LiveRecorder, SurvivesTheDeathOfTheProgram) {
    const TemporaryFolder folder;
    const SharedInstrument instrument = small_live_instrument("bass-fretted");
    RecordingSettings settings;
    settings.sound = folder.file("take.wav");
    settings.midi = folder.file("take.mid");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        Performance performance(instrument);
        auto recorder = LiveRecorder::start(performance.player, settings);
        const auto begun = std::chrono::steady_clock::now();
        for (int n = 0;; ++n) {  // in real time
            performance.play(1);
            std::this_thread::sleep_until(begun + std::chrono::microseconds(std::int64_t{5333} * n));
        }
    }
    // However slow the machine: once half a second of sound lies on the disk, another 1.1 s make it whole.
    constexpr std::size_t sound_frames = 24000;
    std::error_code missing;
    for (int wait = 0; wait < 600; ++wait) {
        const auto bytes = std::filesystem::file_size(settings.sound, missing);
        if (!missing && bytes > sound_frames * 8) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    const auto wav = read_wav(settings.sound);
    const std::size_t frames = wav.data.size() / 8;
    EXPECT_GE(frames, sound_frames);
    const auto left = wav.channel(0);
    EXPECT_GT(*std::max_element(left.begin(), left.end()), 0);
    const MidiFile midi = parsed(settings.midi);
    EXPECT_GT(midi.events.size(), 10U);
    EXPECT_NEAR(static_cast<double>(frame_of(midi, midi.end_time, 48000)), static_cast<double>(frames),
                30000);
}

TEST(LiveRecorder, AFullDiskIsReportedAndThePlayingGoesOn) {
    if (access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full";
    Performance performance(small_live_instrument("bass-fretted"));
    RecordingSettings settings;
    settings.midi = "/dev/full";
    settings.overwrite = true;
    const auto refused = LiveRecorder::start(performance.player, settings);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().message, "/dev/full: No space left on device");
    performance.play(10);
    EXPECT_EQ(performance.player.statistics().frames, 2560U);
}

TEST(LiveRecorder, EndsWithoutAnAudioThread) {
    const TemporaryFolder folder;
    Performance performance(small_live_instrument("bass-fretted"));
    RecordingSettings settings;
    settings.sound = folder.file("take.wav");
    auto recorder = LiveRecorder::start(performance.player, settings);
    ASSERT_TRUE(recorder.ok());
    performance.play(20);
    ASSERT_FALSE(recorder.value()->stop());  // nobody calls process() any more
    EXPECT_EQ(read_wav(settings.sound).data.size(), 20U * 256 * 8);
}

}  // namespace
}  // namespace jawari::host
