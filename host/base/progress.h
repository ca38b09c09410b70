// A progress bar with the remaining time, on standard error, only if that is a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace jawari::host {

class ProgressBar {
  public:
    /// `label`: what is being done, a word or two.
    explicit ProgressBar(std::string label);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { clear(); }

    /// `fraction` done, 0 to 1. Draws at most ten times a second.
    void update(double fraction);

    /// Removes the bar from the terminal, before anything else is printed.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    std::string label_;
    bool enabled_ = false;
    bool drawn_ = false;
    Clock::time_point started_;
    Clock::time_point last_drawn_;
};

/// The bar's text without colours or cursor movements: `rendering [#####-----]  50 %  0:12 left`.
std::string progress_line(const std::string& label, double fraction, double elapsed_s);

/// `0:05`, `12:34`, `1:02:03`.
std::string clock_text(double seconds);

}  // namespace jawari::host
