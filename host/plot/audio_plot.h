// The picture of a rendered sound: its waveform and its spectrogram.
#pragma once

#include <span>
#include <string>

#include "base/error.h"

namespace jawari::host {

/// Draws one channel into `path` (`.svg` or `.png`), which appears whole or not at all.
/// samples: full scale is 1; may be empty, which draws silence. rate_hz > 0.
MaybeError plot_audio(std::span<const float> samples, double rate_hz, const std::string& title,
                      const std::string& path);

}  // namespace jawari::host
