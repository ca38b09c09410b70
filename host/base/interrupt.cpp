#include "base/interrupt.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <utility>

#include "base/platform.h"

namespace jawari::host {

namespace {

using platform::EndRequest;

// Signal handlers can reach nothing but globals; lock-free atomics and removing files are all they may do.
std::atomic<EndRequest> received{EndRequest::None};
static_assert(std::atomic<EndRequest>::is_always_lock_free);

struct Slot {
    std::atomic<int> state{0};  // 0 free, 1 being written, 2 in use
    std::array<char, platform::longest_path_bytes> path{};
};
std::array<Slot, 160> slots;  // enough for a file per string of the largest instrument

void on_request(EndRequest request) {
    if (received.exchange(request) == EndRequest::None) return;
    for (Slot& slot : slots)
        if (slot.state.load() == 2) platform::remove_file(slot.path.data());
    platform::end_at_once(request);
}

}  // namespace

void install_signal_handlers() {
    platform::on_end_request(&on_request);
}

MaybeError interruption() {
    switch (received.load(std::memory_order_relaxed)) {
        case EndRequest::None:
            break;
        case EndRequest::Terminate:
            return Error{ErrorKind::Terminated, "jawari: terminated, nothing was written"};
        case EndRequest::HangUp:
            return Error{ErrorKind::HungUp, "jawari: the terminal is gone, nothing was written"};
        case EndRequest::Interrupt:
            return Error{ErrorKind::Interrupted, "jawari: interrupted, nothing was written"};
    }
    return std::nullopt;
}

TemporaryFileGuard::TemporaryFileGuard(const std::string& path) {
    if (path.size() >= platform::longest_path_bytes) return;
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
