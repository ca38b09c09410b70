// Checks one string of a scene at the end of every block against what is proven of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "judge.h"
#include "reach.h"

namespace jawari::stress {

/// Beyond this the squares of what is computed from H overflow.
constexpr double largest_energy_J = 1e100;

/// Impulses on a string, added up over its contacts.
struct Strikes {
    double impulses_Ns = 0;
    double kicks = 0;  ///< weighted by kick_of(), reach.h
};

class StringWatch {
  public:
    StringWatch(const StringModel& model, const StringState& start, std::string name);

    /// After the player has acted, before the block is rendered.
    void begin_block(const StringState& state);
    /// After each of its frames.
    void note_frame(const StringState& state);
    /// After it has been rendered. outputs[p]: the block's values of the string's probe p.
    void end_block(const StringState& state, std::span<const std::span<const double>> outputs, Judge& judge);

    /// Bound of H at all steps so far.
    [[nodiscard]] double highest_energy() const { return highest_; }

  private:
    void raise_bounds(const StringState& state);
    /// An energy whose squares overflow, of a string whose energy may grow without limit.
    [[nodiscard]] bool has_burst() const;
    void check_energy(const StringState& state, Judge& judge) const;
    void check_gaps(const StringState& state, Judge& judge) const;
    void check_counters(const StringState& state, Judge& judge) const;
    void check_outputs(const StringState& state, std::span<const std::span<const double>> outputs,
                       Judge& judge) const;
    [[nodiscard]] double depth_bound(std::size_t contact) const;
    [[nodiscard]] double sinking() const;
    [[nodiscard]] double gap_rounding(std::size_t contact) const;
    [[nodiscard]] double lag_work(const StringState& state) const;
    [[nodiscard]] double lag_work_size(const StringState& state) const;
    [[nodiscard]] double stored_rounding(double gap_size) const;
    [[nodiscard]] double rise_of_block_allowed(const StringState& state) const;

    const StringModel& model_;
    std::string name_;
    std::vector<Reach> contacts_, probes_;
    std::vector<double> kicks_;     ///< kick_of() of the contacts
    double step_rounding_ = 0;      ///< share of H
    double longest_extent_ = 0;     ///< of the contacts
    double largest_answer_ = 0;     ///< of a gap to an impulse in the same step [m/(N s)]
    Strikes strongest_, of_block_;  ///< largest of a frame so far; sum over the block
    double all_impulses_Ns_ = 0;    ///< sum over all frames
    bool may_be_unsolvable_ = false;
    double highest_ = 0;      ///< bound of H at all steps so far
    double start_depth_ = 0;  ///< largest -gap of the initial state and of the step before it
    double rise_ = 0;         ///< fastest movement of an obstacle [m per step]
    double kick_ = 0;         ///< largest change of a gap by forces in one step [m]
    double highest_obstacle_ = 0;
    // of the block
    double before_ = 0;                  ///< H - F w
    double force_arm_ = 0;               ///< |F w| <= this sqrt(H)
    double force_work_size_ = 0;         ///< what F w is a sum of, at the block's start
    std::uint64_t impulses_before_ = 0;  ///< and of the frame
    std::uint64_t block_impulses_ = 0, roundings_before_ = 0;
};

}  // namespace jawari::stress
