// A signal per string, as the channels of one WAV file or as a file each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file_plan.h"
#include "commands/render/audio_file.h"

namespace jawari::host {

inline constexpr std::size_t most_stem_files = 128;
inline constexpr std::size_t most_stem_channels = 1024;  ///< of one file

class StemFiles {
  public:
    /// `path` with a slash at its end, or an existing folder: `PATH/NAME.wav` for each stem; the folder must
    /// exist. Else one file, which is in the plan already.
    static Outcome<StemFiles> create(const std::string& path, const std::vector<std::string>& names,
                                     const AudioFormat& format, FilePlan& files);

    MaybeError write(const std::vector<std::vector<double>>& stems);
    MaybeError commit();
    [[nodiscard]] std::uint64_t clipped() const;

  private:
    StemFiles() = default;

    std::vector<AudioFile> files_;  ///< one, or one a stem
};

/// A stem's name as a file name: letters, digits, `-`, `_` and `.`, everything else becomes `-`.
std::string stem_file_name(const std::string& name);

}  // namespace jawari::host
