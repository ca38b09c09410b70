#include "plugin/clap/pulse.h"

#include <utility>

namespace jawari::host::clap {

Pulse::Pulse(std::chrono::milliseconds period, std::function<void()> ask)
    : period_(period), ask_(std::move(ask)), thread_([this] { run(); }) {}

Pulse::~Pulse() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void Pulse::answer() {
    {
        const std::lock_guard lock(mutex_);
        answered_ = true;
    }
    changed_.notify_one();
}

void Pulse::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ends_ || answered_; });
        if (changed_.wait_for(lock, period_, [this] { return ends_; })) return;
        answered_ = false;
        lock.unlock();
        ask_();
        lock.lock();
    }
}

}  // namespace jawari::host::clap
