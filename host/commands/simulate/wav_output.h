// Probes as channels of a WAV file with 64-bit float samples: values as they are, in metres, metres per
// second, newtons, joules.
#pragma once

#include <cstdint>
#include <vector>

#include "base/sound_file.h"
#include "commands/simulate/row_renderer.h"

namespace jawari::host {

class WavOutput {
  public:
    /// `rows` decides between WAV and, beyond 4 GiB, RF64. The output rate must be whole.
    static Outcome<WavOutput> create(OutputFile file, std::size_t channels, std::uint64_t rows,
                                     double output_rate_hz);

    MaybeError write(const RowBlock& block);
    MaybeError commit() { return sound_.commit(); }

  private:
    explicit WavOutput(SoundFile sound) : sound_(std::move(sound)) {}

    SoundFile sound_;
    std::vector<double> interleaved_;
};

}  // namespace jawari::host
