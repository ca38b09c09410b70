#include <array>
#include <chrono>

#include "base/platform.h"
#include "plugin/clap/gui.h"
#include "plugin/clap/instance.h"

namespace jawari::host::clap {

namespace {

constexpr std::chrono::milliseconds clock_period{16};

}  // namespace

GuiClock::GuiClock(const Instance& instance) : instance_(instance) {
    const clap_host_t* const host = instance.host;
    const clap_host_timer_support_t* const timers = instance.extensions.timer;
    if (timers != nullptr && timers->register_timer(host, std::uint32_t{clock_period.count()}, &timer_))
        return;
    timer_ = CLAP_INVALID_ID;
    if (instance.extensions.files != nullptr) file_ = platform::open_timer(clock_period);
    if (file_ >= 0) {
        if (instance.extensions.files->register_file(host, file_, file_can_be_read)) return;
        platform::close_file(file_);
        file_ = -1;
    }
    pulse_ = std::make_unique<Pulse>(clock_period, [host] { host->request_callback(host); });
}

GuiClock::~GuiClock() {
    if (timer_ != CLAP_INVALID_ID) instance_.extensions.timer->unregister_timer(instance_.host, timer_);
    if (file_ < 0) return;
    instance_.extensions.files->unregister_file(instance_.host, file_);
    platform::close_file(file_);
}

bool GuiClock::is_file(int file) const {
    std::array<char, 8> periods{};
    return file_ >= 0 && file == file_ && platform::read_some(file_, periods) > 0;
}

void GuiClock::answer() {
    if (pulse_ != nullptr) pulse_->answer();
}

}  // namespace jawari::host::clap
