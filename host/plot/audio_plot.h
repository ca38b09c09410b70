// The picture of a rendered sound: its waveform and its spectrogram.
#pragma once

#include <span>
#include <string>

#include "base/error.h"
#include "plot/spectrogram.h"

namespace jawari::host {

/// Draws one channel into `path` (`.svg` or `.png`), which appears whole or not at all.
/// `grid` is how finely the spectrogram is drawn, most of the work.
/// samples: full scale is 1; may be empty, which draws silence. rate_hz > 0.
MaybeError plot_audio(std::span<const float> samples, double rate_hz, const std::string& title,
                      const std::string& path, const plot::SpectrogramGrid& grid = {});

}  // namespace jawari::host
