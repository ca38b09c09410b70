// Times in which the machine gave nobody its processors on time: on each processor a thread of a priority
// above the sound server's wakes every millisecond and compares the clock with its alarm. Prints `ready`,
// watches until its input ends, then prints the greatest delay in ms. What comes late while nothing here does
// is the fault of whoever was late; what comes late during such a gap says nothing.
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

void stay_on(unsigned int processor) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    pthread_setaffinity_np(pthread_self(), sizeof set,
                           &set);  // elsewhere it watches as well, if less closely
    sched_param priority{};
    priority.sched_priority = 90;
    pthread_setschedparam(pthread_self(), SCHED_FIFO,
                          &priority);  // without the right to it, delays only look longer
}

double greatest_delay_ms(unsigned int processor, const std::atomic<bool>& ended) {
    stay_on(processor);
    double greatest_ms = 0;
    auto alarm = Clock::now();
    while (!ended.load(std::memory_order_relaxed)) {
        alarm += std::chrono::milliseconds(1);
        std::this_thread::sleep_until(alarm);
        const auto now = Clock::now();
        greatest_ms = std::max(greatest_ms, std::chrono::duration<double, std::milli>(now - alarm).count());
        alarm = std::max(alarm, now - std::chrono::milliseconds(1));
    }
    return greatest_ms;
}

}  // namespace

int main() {
    const unsigned int processors = std::max(1U, std::thread::hardware_concurrency());
    std::vector<double> delays_ms(processors, 0.0);
    std::atomic<bool> ended{false};
    std::vector<std::thread> watchers;
    for (unsigned int i = 0; i < processors; ++i)
        watchers.emplace_back([&delays_ms, &ended, i] { delays_ms[i] = greatest_delay_ms(i, ended); });
    std::cout << "ready" << std::endl;
    while (std::cin.get() != std::istream::traits_type::eof()) {
    }
    ended = true;
    for (std::thread& watcher : watchers) watcher.join();
    std::cout << *std::max_element(delays_ms.begin(), delays_ms.end()) << std::endl;
    return 0;
}
