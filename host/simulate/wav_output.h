// Probes as channels of a WAV file with 64-bit float samples: values as they are, in metres, metres per
// second, newtons, joules.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/output_file.h"
#include "simulate/row_renderer.h"

struct sf_private_tag;

namespace jawari::host {

class WavOutput {
  public:
    /// `rows` decides between WAV and, beyond 4 GiB, RF64. The output rate must be whole.
    static Outcome<WavOutput> create(OutputFile file, std::size_t channels, std::uint64_t rows,
                                     double output_rate_hz);

    MaybeError write(const RowBlock& block);
    MaybeError commit();

  private:
    struct Close {
        void operator()(sf_private_tag* sound) const;
    };
    WavOutput(OutputFile file, std::unique_ptr<sf_private_tag, Close> sound)
        : file_(std::move(file)), sound_(std::move(sound)) {}
    [[nodiscard]] MaybeError failure() const;

    OutputFile file_;
    std::unique_ptr<sf_private_tag, Close> sound_;
    std::vector<double> interleaved_;
    std::uint64_t bytes_ = 0;
};

}  // namespace jawari::host
