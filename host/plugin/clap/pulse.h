// Asks for a call again and again, where a host has no timers.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace jawari::host::clap {

/// `ask` is called in a thread of its own, a period after the answer to the time before; never while another
/// call waits for its answer. Threads: one makes it, answers and ends it.
class Pulse {
  public:
    Pulse(std::chrono::milliseconds period, std::function<void()> ask);
    /// Waits for an `ask` that runs.
    ~Pulse();
    Pulse(const Pulse&) = delete;
    Pulse& operator=(const Pulse&) = delete;
    Pulse(Pulse&&) = delete;
    Pulse& operator=(Pulse&&) = delete;

    void answer();

  private:
    void run();

    std::chrono::milliseconds period_;
    std::function<void()> ask_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ends_ = false;  // both guarded by mutex_
    bool answered_ = true;
    std::thread thread_;
};

}  // namespace jawari::host::clap
