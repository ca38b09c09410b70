// Renders a compiled scene into rows: row n holds everything at t = n/output_rate, n = 0 to the last row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"

namespace jawari::host {

/// Contacts and energies of one string, as its state has them at each row.
struct StringRows {
    std::vector<double>
        gap_m;  ///< row-major, one column per described contact; NaN for contacts that compile() dropped
    std::vector<double> impulse_Ns;  ///< row-major; sum over the output interval that ends at the row
    std::vector<double> energy_J;    ///< one per row
    /// One per row with Metering::Step, which alone measures them; else empty.
    std::vector<double> dissipated_J, contact_work_J, player_work_J;
};

/// Some consecutive rows.
struct RowBlock {
    std::uint64_t first = 0;
    std::size_t count = 0;
    std::vector<std::vector<double>> probes;  ///< per probe, `count` values each
    std::vector<StringRows> strings;          ///< empty unless asked for
};

class RowRenderer {
  public:
    /// Called with the state at each row, before it moves on; may be empty.
    using Observer = std::function<void(std::uint64_t row, const SceneState&)>;

    /// `with_contacts`: fill RowBlock::strings as well. The model must outlive the renderer.
    RowRenderer(const SceneModel& model, std::uint64_t last_row, Metering metering, const Skipping& skipping,
                bool with_contacts, Observer observer = {});

    /// Instead of t = 0: the row of the state comes first. Before next(); `state` is one of the model.
    void go_on_from(SceneState state);

    /// The next rows, 1 to 256 of them: few enough that it takes about a tenth of a second. Precondition:
    /// !finished().
    const RowBlock& next();

    [[nodiscard]] bool finished() const { return next_row_ > last_row_; }
    [[nodiscard]] std::uint64_t next_row() const { return next_row_; }
    [[nodiscard]] const SceneState& state() const { return state_; }
    /// CPU time spent in the engine's render().
    [[nodiscard]] double cpu_render_s() const { return cpu_render_s_; }

  private:
    void render_rows(std::size_t offset, std::size_t count);
    void write_last_row(std::size_t offset);
    void observe(std::size_t offset);
    void resize_block(std::size_t count);

    const SceneModel& model_;
    SceneState state_;
    RowBlock block_;
    Observer observer_;
    std::vector<double*> outputs_;
    std::uint64_t last_row_;
    std::uint64_t next_row_ = 0;
    std::size_t rows_per_block_;
    Metering metering_;
    bool with_contacts_;
    double cpu_render_s_ = 0;
};

}  // namespace jawari::host
