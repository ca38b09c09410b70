// The audio thread of a live performance takes no memory, no lock and makes no system call, whatever happens;
// and the traps that show it fire if it does.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "realtime_traps.h"
#include "support/live_stage.h"

#ifdef JAWARI_TRAPS_SYSTEM_CALLS

namespace jawari::host {
namespace {

using test::live_settings;
using test::small_live_instrument;

constexpr double rate_hz = 48000;
constexpr std::size_t most_block = 256;
constexpr std::size_t chunk_frames = 12000;

struct Hits {
    unsigned long allocations = 0, locks = 0, system_calls = 0;
};

/// The audio thread plays chunk after chunk; between them, while it waits, the control thread does its worst.
class TrappedStage {
  public:
    explicit TrappedStage(const LiveSettings& settings) : player(settings), port_(player.add_port()) {}

    /// Prepares a chunk's messages, each due at its own frame.
    void prepare(Adversary& adversary) {
        for (const AdversaryMessage& message : adversary.next(chunk_frames)) {
            const double due = static_cast<double>(frame_ + message.offset) - static_cast<double>(most_block);
            port_->push({message.message, start_ns + std::llround(due * 1e9 / rate_hz)});
        }
    }

    /// Of the audio thread: a chunk in blocks of many sizes.
    void play() {
        for (std::size_t done = 0; done < chunk_frames;) {
            const std::size_t frames = std::min(1 + random_() % most_block, chunk_frames - done);
            const auto now = start_ns + std::llround(static_cast<double>(frame_) * 1e9 / rate_hz);
            player.process(left_.data(), right_.data(), frames, now);
            frame_ += frames;
            done += frames;
        }
    }

    LivePlayer player;

  private:
    static constexpr std::int64_t start_ns = 1'000'000'000;
    MidiPort* port_;
    std::minstd_rand random_{5};
    std::uint64_t frame_ = 0;
    std::vector<double> left_ = std::vector<double>(most_block), right_ = std::vector<double>(most_block);
};

/// What the control thread does between two chunks.
void meddle(TrappedStage& stage, const std::vector<SharedInstrument>& instruments, int chunk,
            std::shared_ptr<CaptureRing>& ring) {
    LivePlayer& player = stage.player;
    player.collect();
    if (chunk % 2 == 0) {
        const int times = chunk % 8 == 0 ? 6 : 1;  // more than may sound at once
        for (int n = 0; n < times; ++n)
            player.publish(instruments[static_cast<std::size_t>(chunk + n) % instruments.size()]);
    }
    for (const ParameterDeclaration& parameter : parameter_table())
        player.send({.kind = LiveCommand::Kind::SetParameter,
                     .parameter = parameter.id,
                     .channel = chunk % 3 - 1,
                     .value = parameter_value(parameter, (chunk % 5) / 4.0)});
    if (chunk % 5 == 1) player.send({.kind = LiveCommand::Kind::SetGain, .value = 0.1 * (chunk % 7)});
    if (chunk % 11 == 3) player.send({.kind = LiveCommand::Kind::Panic});
    if (chunk % 7 == 2) {
        ring =
            std::make_shared<CaptureRing>(chunk % 14 == 2 ? 1000 : 100000, 50);  // too small, to be lost from
        player.start_capture(ring);
    }
    if (chunk % 7 == 5) player.stop_capture();
    player.set_monitor(chunk % 4 == 1);
    player.statistics();
    while (player.notice()) {
    }
    player.program_request();
}

/// In this process, which it ends: the audio thread is under all traps. Exit code: what has been hit.
[[noreturn]] void perform_trapped(const std::vector<SharedInstrument>& instruments,
                                  const LiveSettings& settings, double seconds) {
    constexpr int no_filter = 99;
    TrappedStage stage(settings);
    Adversary adversary(instruments.front()->model, 2);
    std::atomic<int> asked{0}, done{0};
    std::atomic<bool> filtered{true};
    Hits hits;
    std::thread audio([&] {
        std::free(test::used(std::malloc(100)));  // a trapped allocation must find its arena
        if (!test::trap_system_calls()) filtered = false;
        const test::Trap trap;
        for (int chunk = 1;; ++chunk) {
            while (asked.load() < chunk) __builtin_ia32_pause();
            stage.play();
            hits = {allocations, locks, static_cast<unsigned long>(test::system_calls)};
            done.store(chunk);
        }
    });
    std::shared_ptr<CaptureRing> ring;
    const int chunks = static_cast<int>(seconds * rate_hz / chunk_frames);
    for (int chunk = 1; chunk <= chunks; ++chunk) {
        meddle(stage, instruments, chunk, ring);
        stage.prepare(adversary);
        asked.store(chunk);
        while (done.load() < chunk && filtered.load()) std::this_thread::yield();
        if (!filtered.load()) _exit(no_filter);
    }
    const LiveStatistics statistics = stage.player.statistics();
    int code = (hits.allocations > 0 ? 1 : 0) + (hits.locks > 0 ? 2 : 0) + (hits.system_calls > 0 ? 4 : 0);
    if (statistics.notes < 100 || statistics.messages < 500) code += 8;  // it has not played at all
    if (settings.overload.enabled && statistics.overload_changes < 10) code += 16;
    _exit(code);
}

int hits_of(const std::vector<SharedInstrument>& instruments, const LiveSettings& settings, double seconds) {
    const pid_t child = fork();
    if (child == 0) perform_trapped(instruments, settings, seconds);
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    return WEXITSTATUS(status);
}

#define JAWARI_SKIP_WITHOUT_FILTER(code) \
    if ((code) == 99) GTEST_SKIP() << "this system does not let a thread filter its calls"

/// Simulated seconds; JAWARI_TRAP_SECONDS=60 for the long run.
double wanted_seconds(double usual) {
    const char* const asked = std::getenv("JAWARI_TRAP_SECONDS");  // NOLINT(concurrency-mt-unsafe)
    return asked == nullptr ? usual : std::atof(asked);
}

TEST(LiveRealtime, NoMemoryNoLocksNoSystemCalls) {
    const std::vector<SharedInstrument> instruments{small_live_instrument("guitar-steel", rate_hz, 2, true),
                                                    small_live_instrument("bass-fretted", rate_hz, 2, true),
                                                    small_live_instrument("clavichord", rate_hz, 4)};
    LiveSettings settings = live_settings();
    settings.overload = {
        .enabled = true, .high = 0.02, .low = 0.015, .return_s = 0.02};  // levels come and go
    settings.most_frames = 100;
    settings.limiter_dbfs = -6;
    const int code = hits_of(instruments, settings, wanted_seconds(10));
    JAWARI_SKIP_WITHOUT_FILTER(code);
    EXPECT_EQ(code, 0) << "1: memory, 2: locks, 4: system calls, 8: nothing played, 16: no overload";
}

TEST(LiveRealtime, NeitherAtFullQuality) {
    InstrumentCache cache({});
    bool compiled = false;
    const auto guitar = cache.get("guitar-steel", compiled);
    ASSERT_TRUE(guitar.ok());
    const int code = hits_of({guitar.value()}, live_settings(), wanted_seconds(1));
    JAWARI_SKIP_WITHOUT_FILTER(code);
    EXPECT_EQ(code, 0) << "1: memory, 2: locks, 4: system calls, 8: nothing played, 16: no overload";
}

// The player's clock is asked within process(): a way in for what must not be there.

std::int64_t allocating_clock() noexcept {
    std::free(test::used(std::malloc(100)));
    return steady_clock_ns();
}

std::int64_t locking_clock() noexcept {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    return steady_clock_ns();
}

std::int64_t calling_clock() noexcept {
    syscall(SYS_getppid);
    return steady_clock_ns();
}

TEST(LiveRealtime, EveryTrapFires) {
    const std::vector<SharedInstrument> instruments{small_live_instrument("bass-fretted", rate_hz, 2)};
    LiveSettings settings = live_settings();
    settings.clock = allocating_clock;
    const int code = hits_of(instruments, settings, 1);
    JAWARI_SKIP_WITHOUT_FILTER(code);
    EXPECT_EQ(code, 1);
    settings.clock = locking_clock;
    EXPECT_EQ(hits_of(instruments, settings, 1), 2);
    settings.clock = calling_clock;
    EXPECT_EQ(hits_of(instruments, settings, 1), 4);
}

}  // namespace
}  // namespace jawari::host

#else

TEST(LiveRealtime, IsTestedWithoutSanitizersOnX86) {
    GTEST_SKIP() << "sanitizers own the allocator; the filter is written for x86-64";
}

#endif
