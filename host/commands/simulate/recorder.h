// Collects a SceneRecording while a scene is rendered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "commands/simulate/row_renderer.h"
#include "formats/scene/probe_names.h"
#include "formats/scene/scene.h"
#include "jawari/detail/string_model.h"
#include "plot/recording.h"

namespace jawari::host {

class Recorder {
  public:
    /// The model must outlive the recorder.
    Recorder(const Scene& scene, const SceneModel& model, const std::vector<ProbeLabel>& probes,
             std::uint64_t last_row);

    /// Takes snapshots at the rows chosen: nine over the first period of each string, or over the duration if
    /// that is shorter.
    void observe(std::uint64_t row, const SceneState& state);

    /// Blocks with contacts, in order.
    void add(const RowBlock& block);

    [[nodiscard]] const SceneRecording& recording() const { return recording_; }

  private:
    void add_probes(const RowBlock& block);
    void add_events(const RowBlock& block, std::size_t string);

    const SceneModel& model_;
    SceneRecording recording_;
    std::uint64_t last_row_;
    std::uint64_t rows_per_bucket_;  // of probe values
    std::uint64_t rows_per_event_;
    std::vector<std::vector<std::uint64_t>> snapshot_rows_;  // per string
    std::vector<std::vector<double>> impulses_;              // per string and contact, of the interval so far
    std::vector<double> lowest_, highest_;                   // per probe, of the bucket so far
    std::uint64_t bucket_first_ = 0;
};

}  // namespace jawari::host
