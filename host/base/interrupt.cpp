#include "base/interrupt.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <utility>

namespace jawari::host {

namespace {

// Signal handlers can reach nothing but globals; lock-free atomics and unlink() are all they may touch.
std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

struct Slot {
    std::atomic<int> state{0};  // 0 free, 1 being written, 2 in use
    std::array<char, PATH_MAX> path{};
};
std::array<Slot, 160> slots;  // enough for a file per string of the largest instrument

extern "C" void on_signal(int signal) {
    if (received_signal.exchange(signal) == 0) return;
    for (Slot& slot : slots)
        if (slot.state.load() == 2) unlink(slot.path.data());
    _exit(128 + signal);
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

/// As nohup leaves it: the program is to outlive its terminal.
bool is_ignored(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void install_signal_handlers() {
    handle(SIGINT, on_signal);
    handle(SIGTERM, on_signal);
    if (!is_ignored(SIGHUP)) handle(SIGHUP, on_signal);
    handle(SIGPIPE, SIG_IGN);
    handle(SIGXFSZ, SIG_IGN);
}

MaybeError interruption() {
    switch (received_signal.load(std::memory_order_relaxed)) {
        case 0:
            return std::nullopt;
        case SIGTERM:
            return Error{ExitCode::Terminated, "jawari: terminated, nothing was written"};
        case SIGHUP:
            return Error{ExitCode::HungUp, "jawari: the terminal is gone, nothing was written"};
        default:
            return Error{ExitCode::Interrupted, "jawari: interrupted, nothing was written"};
    }
}

TemporaryFileGuard::TemporaryFileGuard(const std::string& path) {
    if (path.size() >= PATH_MAX) return;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        int free = 0;
        if (!slots[i].state.compare_exchange_strong(free, 1)) continue;
        std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
        slots[i].state.store(2);
        slot_ = static_cast<int>(i);
        return;
    }
}

TemporaryFileGuard::TemporaryFileGuard(TemporaryFileGuard&& other) noexcept
    : slot_(std::exchange(other.slot_, -1)) {}

TemporaryFileGuard& TemporaryFileGuard::operator=(TemporaryFileGuard&& other) noexcept {
    if (this != &other) {
        forget();
        slot_ = std::exchange(other.slot_, -1);
    }
    return *this;
}

void TemporaryFileGuard::forget() noexcept {
    if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state.store(0);
    slot_ = -1;
}

}  // namespace jawari::host
