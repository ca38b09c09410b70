// One progress bar for several files that are rendered at the same time.
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "base/progress.h"

namespace jawari::host {

class ProgressBoard {
  public:
    explicit ProgressBoard(std::size_t files)
        : fractions_(files, 0.0),
          bar_(files == 1 ? "rendering" : "rendering " + std::to_string(files) + " files") {}

    /// Any thread. fraction: of the file, 0 to 1.
    void update(std::size_t file, double fraction) {
        const std::lock_guard lock(mutex_);
        fractions_[file] = fraction;
        double sum = 0;
        for (const double each : fractions_) sum += each;
        bar_.update(sum / static_cast<double>(fractions_.size()));
    }

    /// Before anything else is printed.
    void clear() {
        const std::lock_guard lock(mutex_);
        bar_.clear();
    }

  private:
    std::mutex mutex_;
    std::vector<double> fractions_;
    ProgressBar bar_;
};

}  // namespace jawari::host
