#include "commands/simulate/probe_output.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/text.h"

namespace jawari::host {

namespace {

template <class Output>
Outcome<ProbeOutput> as_output(Outcome<Output> created) {
    if (!created) return created.error();
    return ProbeOutput(std::move(created.value()));
}

}  // namespace

std::optional<OutputFormat> output_format(const std::string& path) {
    if (path == "-") return OutputFormat::Csv;
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    if (extension == ".csv") return OutputFormat::Csv;
    if (extension == ".h5") return OutputFormat::Hdf5;
    if (extension == ".wav") return OutputFormat::Wav;
    return std::nullopt;
}

Outcome<ProbeOutput> create_output(OutputFormat format, OutputFile file, const Scene& scene,
                                   const SceneModel& model, const std::vector<ProbeLabel>& probes,
                                   std::uint64_t rows, Metering metering) {
    switch (format) {
        case OutputFormat::Hdf5:
            return as_output(Hdf5Output::create(std::move(file), scene, model, probes, rows, metering));
        case OutputFormat::Wav:
            return as_output(WavOutput::create(std::move(file), probes.size(), rows, model.output_rate_hz));
        case OutputFormat::Csv:
            break;
    }
    return as_output(CsvOutput::create(std::move(file), probes, model.output_rate_hz));
}

}  // namespace jawari::host
