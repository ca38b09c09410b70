// Checks a whole instrument after every few frames: energy against the player's work, and the output's bound.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "judge.h"

namespace jawari::stress {

/// Stereo samples of one piece of a performance.
struct Piece {
    std::span<const double> left, right;
};

/// Largest over a string's contacts, reach.h.
struct ContactReach {
    double impulse = 0;  ///< lambda <= this sqrt(H), as one impulse changes the velocity by at most 2 sqrt(H)
    double extent = 0;
    double height_m = 0;
};

class InstrumentWatch {
  public:
    /// `frame_by_frame`: every piece is one frame, so that the energy is known at which each was heard.
    InstrumentWatch(const InstrumentModel& model, const InstrumentDescription& description,
                    bool frame_by_frame);

    void begin_piece(const InstrumentState& state);
    void end_piece(const InstrumentState& state, const Piece& piece, Judge& judge);

  private:
    struct Energies {
        double beyond_rest = 0;  ///< sum over motions of H less what obstacles hold
        double largest = 0;      ///< sum of H
        double rounding = 0;     ///< of one frame [J]
        double impulse = 0;      ///< of one impulse [J]
    };
    struct Bounds {
        double left = 0, right = 0;  ///< of the pickups' sum
        double bridge_N = 0;
    };

    [[nodiscard]] Energies energies_of(const InstrumentState& state) const;
    void add_bounds(const InstrumentState& state, std::size_t s, std::size_t v, Bounds& bounds) const;
    void check_energy(const InstrumentState& state, double frames, Judge& judge);
    void check_gaps(const InstrumentState& state, Judge& judge);
    void check_sound(const InstrumentState& state, const Piece& piece, Judge& judge);
    void remember_motions(const InstrumentState& state);

    const InstrumentModel& model_;
    bool frame_by_frame_ = false;
    bool passive_ = true;  ///< what obstacles do cannot raise the energy: all laws but newton
    std::vector<std::vector<std::vector<ContactReach>>> contacts_;  ///< [quality level][string][fret]
    bool never_penetrates_ = false;                                 ///< signorini
    double gap_rounding_m_ = 0;                                     ///< largest so far
    double body_left_ = 0, body_right_ = 0;  ///< most that the body answers to a force of at most 1 N
    double largest_bridge_N_ = 0;
    Energies before_;
    PlayerWork work_before_;
    std::uint64_t impulses_before_ = 0, hand_overs_before_ = 0;
    std::vector<std::vector<std::uint8_t>>
        heard_;  ///< [string][voice]: 1 compiled, 2 bent at the piece's start
};

}  // namespace jawari::stress
