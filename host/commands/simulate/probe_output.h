// The file of `--out`, in the format of its name.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "commands/simulate/csv_output.h"
#include "commands/simulate/hdf5_output.h"
#include "commands/simulate/wav_output.h"

namespace jawari::host {

enum class OutputFormat { Csv, Hdf5, Wav };

/// By the end of the name, whatever its case; `-` is CSV. Empty if it is none of them.
std::optional<OutputFormat> output_format(const std::string& path);

using ProbeOutput = std::variant<CsvOutput, Hdf5Output, WavOutput>;

/// `metering`: what the rows will hold; HDF5 has tables of losses and work with Metering::Step.
Outcome<ProbeOutput> create_output(OutputFormat format, OutputFile file, const Scene& scene,
                                   const SceneModel& model, const std::vector<ProbeLabel>& probes,
                                   std::uint64_t rows, Metering metering);

}  // namespace jawari::host
