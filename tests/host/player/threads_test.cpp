// Everything that live playing does at once, from a thread each: to be run under the thread sanitizer.
#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

#include "player/recorder.h"
#include "support/live_stage.h"
#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

using test::live_settings;
using test::small_live_instrument;

TEST(LiveThreads, AudioMidiControlAndRecorderTogether) {
    const test::TemporaryFolder folder;
    const std::vector<SharedInstrument> instruments{small_live_instrument("bass-fretted", 48000, 2),
                                                    small_live_instrument("clavichord", 48000, 3)};
    LivePlayer player(live_settings());
    std::atomic<bool> stop{false};
    std::vector<std::thread> threads;
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        threads.emplace_back([&, port = player.add_port(), seed] {
            Adversary adversary(instruments[seed % 2]->model, seed);
            while (!stop) {
                for (const AdversaryMessage& message : adversary.next(48))
                    port->push({message.message, seed == 1 ? 0 : steady_clock_ns()});
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        });
    }
    threads.emplace_back([&] {  // audio
        std::vector<double> left(256), right(256);
        std::minstd_rand random(1);
        while (!stop) {
            player.process(left.data(), right.data(), 1 + random() % 256, steady_clock_ns());
            if (random() % 50 == 0) player.report_xrun();
        }
    });
    // This thread is the control thread.
    int published = 0;
    int recordings = 0;
    // However slow the machine, until enough has happened.
    const auto enough = [&] { return published > 5 && player.statistics().notes > 10; };
    for (int round = 0; round < 60 || (round < 6000 && !enough()); ++round) {
        if (player.publish(instruments[static_cast<std::size_t>(round) % 2])) ++published;
        player.send({.kind = LiveCommand::Kind::SetParameter,
                     .parameter = ParameterId::PalmMute,
                     .value = (round % 10) / 10.0});
        if (round % 9 == 4) player.send({.kind = LiveCommand::Kind::Panic});
        if (round % 20 == 2) {
            RecordingSettings settings;
            settings.sound = folder.file(std::to_string(round) + ".wav");
            settings.midi = folder.file(std::to_string(round) + ".mid");
            auto recorder = LiveRecorder::start(player, settings);
            ASSERT_TRUE(recorder.ok());
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
            for (int wait = 0; wait < 2000 && recorder.value()->status().frames == 0; ++wait)
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            EXPECT_FALSE(recorder.value()->stop());
            EXPECT_GT(recorder.value()->status().frames, 0U);
            ++recordings;
        }
        player.set_monitor(round % 2 == 0);
        while (player.applied()) {
        }
        while (player.notice()) {
        }
        player.program_request();
        player.statistics();
        (void)player.parameter(ParameterId::PalmMute, round % 16);
        player.collect();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    stop = true;
    for (std::thread& thread : threads) thread.join();
    EXPECT_GT(published, 5);
    EXPECT_GE(recordings, 3);
    EXPECT_GT(player.statistics().messages, 100U);
    EXPECT_GT(player.statistics().notes, 10U);
}

}  // namespace
}  // namespace jawari::host
