// Everything a simulation computes, as an HDF5 file (layout: docs/commands/simulate.md, section "HDF5
// output").
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/output_file.h"
#include "commands/simulate/row_renderer.h"
#include "commands/simulate/stats.h"
#include "formats/scene/probe_names.h"
#include "formats/scene/scene.h"
#include "jawari/detail/string_model.h"

namespace jawari::host {

class Hdf5Output {
  public:
    static Outcome<Hdf5Output> create(OutputFile file, const Scene& scene, const SceneModel& model,
                                      const std::vector<ProbeLabel>& probes, std::uint64_t rows,
                                      Metering metering);
    Hdf5Output(const Hdf5Output&) = delete;
    Hdf5Output& operator=(const Hdf5Output&) = delete;
    Hdf5Output(Hdf5Output&& other) noexcept;
    Hdf5Output& operator=(Hdf5Output&& other) noexcept;
    ~Hdf5Output();

    /// Blocks with contacts, in order.
    MaybeError write(const RowBlock& block);
    /// Final modal states and counters, to be written after the last block.
    MaybeError write_final(const SceneModel& model, const SceneState& state, const SimulationStats& stats);
    MaybeError commit();

  private:
    struct Tables;
    Hdf5Output(OutputFile file, std::unique_ptr<Tables> tables);
    [[nodiscard]] Error failure() const;

    OutputFile file_;
    std::unique_ptr<Tables> tables_;
    double output_rate_hz_ = 0;
};

}  // namespace jawari::host
