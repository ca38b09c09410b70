// Probes as comma-separated values (RFC 4180): a header `time_s` and the probe names, then one line per row.
#pragma once

#include <vector>

#include "base/output_file.h"
#include "commands/simulate/row_renderer.h"
#include "formats/scene/probe_names.h"

namespace jawari::host {

class CsvOutput {
  public:
    static Outcome<CsvOutput> create(OutputFile file, const std::vector<ProbeLabel>& probes,
                                     double output_rate_hz);

    /// Values with 17 significant digits; t = row/output_rate.
    MaybeError write(const RowBlock& block);
    MaybeError commit() { return file_.commit(); }

  private:
    CsvOutput(OutputFile file, double output_rate_hz)
        : file_(std::move(file)), output_rate_hz_(output_rate_hz) {}

    OutputFile file_;
    double output_rate_hz_;
};

}  // namespace jawari::host
