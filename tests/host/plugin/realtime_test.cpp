// The audio thread of a plugin takes no memory, no lock and makes no system call, whatever the host does.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <random>
#include <thread>

#include "commands/bench_latency/adversary.h"
#include "instrument/instrument_cache.h"
#include "realtime_traps.h"
#include "support/clap_host.h"
#ifdef JAWARI_LV2
#include "support/lv2_host.h"
#endif
#include "support/vst3_host.h"

#ifdef JAWARI_TRAPS_SYSTEM_CALLS

namespace jawari::host {
namespace {

using test::ClapInstance;
using test::small_state;

constexpr std::size_t most_block = 600;
constexpr int no_filter = 99;  // exit code: this system does not let a thread filter its calls

/// Events and buffers that are there before the traps are set.
class TrappedHost {
  public:
    explicit TrappedHost(ClapInstance& instance) : instance_(instance) {
        for (std::size_t c = 0; c < places_.size(); ++c) places_[c] = sound_[c].data();
        out_ = {this, [](const clap_output_events_t* list, const clap_event_header_t*) {
                    static_cast<TrappedHost*>(list->ctx)->ends += 1;
                    return true;
                }};
    }

    /// What comes in the next block: the adversary's messages, notes with ids, expressions, values.
    void prepare(Adversary& adversary, std::minstd_rand& random) {
        frames_ = static_cast<std::uint32_t>(random() % most_block);
        events_.clear();
        const auto id = static_cast<std::int32_t>(random() % 1000);
        const int key = 28 + static_cast<int>(random() % 30);
        if (frames_ > 0) {
            for (const AdversaryMessage& message : adversary.next(frames_))
                events_.midi(static_cast<std::uint32_t>(message.offset), message.message.status,
                             message.message.data1, message.message.data2);
        }
        const std::uint32_t last = frames_ == 0 ? 0 : frames_ - 1;
        events_.note_on(last, key, 0.7, id);
        events_.expression(last, CLAP_NOTE_EXPRESSION_TUNING, key, 0.3, id);
        events_.expression(last, CLAP_NOTE_EXPRESSION_PRESSURE, key, 0.3, id);
        events_.expression(last, CLAP_NOTE_EXPRESSION_BRIGHTNESS, key, 0.3, id);
        events_.parameter(last, static_cast<clap_id>(random() % 20), 0.5);
        if (random() % 3 == 0) events_.note(CLAP_EVENT_NOTE_OFF, last, -1, 0.5, -1, -1, -1);
        if (random() % 20 == 0) events_.note(CLAP_EVENT_NOTE_CHOKE, last, -1, 0, -1, -1, -1);
        if (random() % 50 == 0)
            for (int n = 0; n < 20000; ++n) events_.parameter(last, 1, 0.9);
        list_ = events_.list();
    }

    /// Of the audio thread.
    void play(bool reset) {
        std::array<clap_audio_buffer_t, 2> buffers{};
        buffers[0] = {places_.data(), nullptr, 2, 0, 0};
        buffers[1] = {places_.data() + 2, nullptr, 16, 0, 0};
        clap_process_t block{};
        block.steady_time = -1;
        block.frames_count = frames_;
        block.audio_outputs = buffers.data();
        block.audio_outputs_count = 2;
        block.in_events = list_;
        block.out_events = &out_;
        if (reset) instance_.plugin->reset(instance_.plugin);
        instance_.plugin->process(instance_.plugin, &block);
        if (frames_ == 0) instance_.params().flush(instance_.plugin, list_, &out_);
        for (std::size_t n = 0; n < frames_; ++n) loud = loud || std::abs(sound_[0][n]) > 1e-3F;
    }

    unsigned long ends = 0;
    bool loud = false;

  private:
    ClapInstance& instance_;
    test::ClapEvents events_;
    const clap_input_events_t* list_ = nullptr;
    clap_output_events_t out_{};
    std::array<std::array<float, most_block>, 18> sound_{};
    std::array<float*, 18> places_{};
    std::uint32_t frames_ = 0;
};

/// What a host does: loads states and prepares blocks on its own thread, and plays them on one that is under
/// all traps.
struct Performance {
    std::function<void(const std::string& state)> load;
    std::function<void(int block)> prepare;
    std::function<void(int block)> play;  ///< the audio thread
    std::function<void(int block)> gather;
    std::function<bool()> was_heard;
    std::function<void()> misdeed;  ///< of the audio thread, at the end; may be empty
};

/// In this process, which it ends.
[[noreturn]] void perform_trapped(const Performance& performance) {
    constexpr int blocks = 400;
    const std::array<std::string, 3> states{small_state("guitar-steel"), small_state("bass-fretted"),
                                            small_state("sitar")};
    std::atomic<int> asked{0}, done{0};
    std::atomic<bool> filtered{true};
    unsigned long memory = 0, locked = 0, called = 0;
    std::thread audio([&] {
        std::free(test::used(std::malloc(100)));  // a trapped allocation must find its arena
        if (!test::trap_system_calls()) filtered = false;
        const test::Trap trap;
        for (int block = 1;; ++block) {
            while (asked.load() < block) __builtin_ia32_pause();
            performance.play(block);
            if (block == blocks && performance.misdeed) performance.misdeed();
            memory = allocations;
            locked = locks;
            called = static_cast<unsigned long>(test::system_calls);
            done.store(block);
        }
    });
    for (int block = 1; block <= blocks; ++block) {
        if (block % 40 == 0) performance.load(states[static_cast<std::size_t>(block / 40) % 3]);
        performance.prepare(block);
        asked.store(block);
        while (done.load() < block && filtered.load()) std::this_thread::yield();
        if (!filtered.load()) _exit(no_filter);
        performance.gather(block);
    }
    const int code = (memory > 0 ? 1 : 0) + (locked > 0 ? 2 : 0) + (called > 0 ? 4 : 0);
    _exit(code + (performance.was_heard() ? 0 : 8));
}

/// perform() ends a process of its own; the code with which it does.
int code_of(const std::function<void()>& perform) {
    const pid_t child = fork();
    if (child == 0) perform();
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    return WEXITSTATUS(status);
}

Adversary adversary_of_guitar() {
    static const auto model =
        compile_preset_text(test::small_preset_text("guitar-steel"), "guitar-steel", {}).value();
    return Adversary(model->model, 2);
}

void perform_clap(const std::function<void()>& misdeed) {
    ClapInstance instance;
    instance.load(small_state("guitar-steel"));
    if (!instance.activate(48000, 64)) _exit(98);
    TrappedHost host(instance);
    Adversary adversary = adversary_of_guitar();
    std::minstd_rand random(9);
    perform_trapped({[&](const std::string& state) { instance.load(state); },
                     [&](int block) {
                         if (block % 7 == 0) instance.plugin->on_main_thread(instance.plugin);
                         host.prepare(adversary, random);
                     },
                     [&](int block) { host.play(block % 97 == 0); }, [](int) {},
                     [&] { return host.loud && host.ends >= 100; }, misdeed});
}

int hits_of(const std::function<void()>& misdeed = {}) {
    return code_of([&] { perform_clap(misdeed); });
}

TEST(ClapRealtime, NoMemoryNoLocksNoSystemCalls) {
    const int code = hits_of();
    if (code == no_filter) GTEST_SKIP() << "this system does not let a thread filter its calls";
    EXPECT_EQ(code, 0) << "1: memory, 2: locks, 4: system calls, 8: nothing played";
}

TEST(ClapRealtime, EveryTrapFires) {
    const int code = hits_of([] { std::free(test::used(std::malloc(100))); });
    if (code == no_filter) GTEST_SKIP() << "this system does not let a thread filter its calls";
    EXPECT_EQ(code, 1);
    std::mutex mutex;
    EXPECT_EQ(hits_of([&] { const std::lock_guard lock(mutex); }), 2);
    EXPECT_EQ(hits_of([] { syscall(SYS_getppid); }), 4);
}

/// An allocation inside the plugin's file is seen: its calls end in the functions that the traps replace.
TEST(ClapRealtime, TheTrapsReachIntoThePlugin) {
    ClapInstance instance;
    const test::Trap trap;
    const std::string text = instance.save();
    EXPECT_GT(allocations, 10U);
}

// ------------------------------------------------------------------------------------------ other formats

template <class Instance>
class FormatRealtime : public testing::Test {};
#ifdef JAWARI_LV2
using TrappedFormats = testing::Types<test::Vst3Instance, test::Lv2Instance>;
#else
using TrappedFormats = testing::Types<test::Vst3Instance>;
#endif
TYPED_TEST_SUITE(FormatRealtime, TrappedFormats, test::FormatNames);

template <class Instance>
void perform_format() {
    Instance one;
    one.strings_wanted = 16;
    one.load(small_state("guitar-steel"));
    if (!one.activate(48000, 64)) _exit(98);
    Adversary adversary = adversary_of_guitar();
    std::minstd_rand random(9);
    const auto prepare = [&](int /*block*/) {
        const auto frames = static_cast<std::uint32_t>(random() % most_block);
        if (frames > 0)
            for (const AdversaryMessage& message : adversary.next(frames))
                one.events.midi(static_cast<std::uint32_t>(message.offset), message.message.status,
                                message.message.data1, message.message.data2);
        one.events.parameter(0, static_cast<std::uint32_t>(random() % 20), 0.5);
        one.prepare(frames);
    };
    const auto was_heard = [&] {
        return std::any_of(one.left.begin(), one.left.end(),
                           [](float sample) { return std::abs(sample) > 1e-3F; });
    };
    perform_trapped({[&](const std::string& state) { one.load(state); },
                     prepare,
                     [&](int) { one.call(); },
                     [&](int) { one.gather(); },
                     was_heard,
                     {}});
}

TYPED_TEST(FormatRealtime, NoMemoryNoLocksNoSystemCalls) {
    const int code = code_of([] { perform_format<TypeParam>(); });
    if (code == no_filter) GTEST_SKIP() << "this system does not let a thread filter its calls";
    EXPECT_EQ(code, 0) << "1: memory, 2: locks, 4: system calls, 8: nothing played";
}

}  // namespace
}  // namespace jawari::host

#else

TEST(ClapRealtime, IsTestedWithoutSanitizersOnX86) {
    GTEST_SKIP() << "sanitizers own the allocator; the filter is written for x86-64";
}

#endif
