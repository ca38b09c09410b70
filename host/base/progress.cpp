#include "base/progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/platform.h"

namespace jawari::host {

std::string clock_text(double seconds) {
    const auto total = static_cast<long long>(std::llround(std::clamp(seconds, 0.0, 3.6e9)));
    std::array<char, 40> text{};
    if (total >= 3600)
        std::snprintf(text.data(), text.size(), "%lld:%02lld:%02lld", total / 3600, total / 60 % 60,
                      total % 60);
    else
        std::snprintf(text.data(), text.size(), "%lld:%02lld", total / 60, total % 60);
    return text.data();
}

std::string progress_line(const std::string& label, double fraction, double elapsed_s) {
    constexpr std::size_t width = 30;
    const double part = std::clamp(fraction, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(part * static_cast<double>(width));
    std::array<char, 16> percent{};
    std::snprintf(percent.data(), percent.size(), "%3.0f %%", std::floor(100 * part));
    const std::string remaining = part > 0 ? clock_text(elapsed_s * (1 - part) / part) + " left" : "";
    return label + " [" + std::string(filled, '#') + std::string(width - filled, '-') + "] " +
           percent.data() + "  " + remaining;
}

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)),
      enabled_(platform::is_terminal(platform::standard_error)),
      started_(Clock::now()),
      last_drawn_(started_) {}

void ProgressBar::update(double fraction) {
    if (!enabled_) return;
    const auto now = Clock::now();
    if (now - last_drawn_ < std::chrono::milliseconds(100)) return;
    last_drawn_ = now;
    drawn_ = true;
    const double elapsed_s = std::chrono::duration<double>(now - started_).count();
    std::fprintf(stderr, "\r%s\x1b[K", progress_line(label_, fraction, elapsed_s).c_str());
    std::fflush(stderr);
}

void ProgressBar::clear() {
    if (!drawn_) return;
    drawn_ = false;
    std::fputs("\r\x1b[K", stderr);
    std::fflush(stderr);
}

}  // namespace jawari::host
