#include "commands/simulate/csv_output.h"

#include <string>

#include "base/text.h"

namespace jawari::host {

namespace {

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string field = "\"";
    for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
    return field + '"';
}

}  // namespace

Outcome<CsvOutput> CsvOutput::create(OutputFile file, const std::vector<ProbeLabel>& probes,
                                     double output_rate_hz) {
    CsvOutput output(std::move(file), output_rate_hz);
    std::string header = "time_s";
    for (const ProbeLabel& probe : probes) header.append(",").append(csv_field(probe.name));
    if (auto error = output.file_.write(header + "\n")) return *error;
    return output;
}

MaybeError CsvOutput::write(const RowBlock& block) {
    std::string line;
    for (std::size_t i = 0; i < block.count; ++i) {
        line = seventeen_digits(static_cast<double>(block.first + i) / output_rate_hz_);
        for (const auto& probe : block.probes) {
            line += ',';
            line += seventeen_digits(probe[i]);
        }
        line += '\n';
        if (auto error = file_.write(line)) return error;
    }
    return std::nullopt;
}

}  // namespace jawari::host
