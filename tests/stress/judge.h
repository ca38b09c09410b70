// What a run has found: the invariants that failed, and how near the others came to their bounds.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace jawari::stress {

enum class Invariant {
    Finite,         ///< state and output are finite, no string was reset
    EnergyBalance,  ///< the metered terms of each step close
    EnergyRise,     ///< H rises by no more than the player's work
    Penetration,    ///< gaps stay above the bound of their law
    Residual,       ///< finished contact problems are solved
    Truncation,     ///< contact problems that can be solved are
    Output,         ///< outputs stay below the bound that H gives them
    Determinism     ///< other block sizes, same bits
};
inline constexpr std::size_t invariant_count = 8;

/// As reports spell it.
const char* name_of(Invariant invariant);

struct Violation {
    Invariant invariant{};
    double found = 0;
    double allowed = 0;
    std::string where;
};

class Judge {
  public:
    /// A violation unless found <= allowed; not-a-number is one.
    void at_most(Invariant invariant, double found, double allowed, const std::string& where);

    [[nodiscard]] const std::vector<Violation>& violations() const { return violations_; }
    /// Largest found/allowed of an invariant, over finite bounds.
    [[nodiscard]] double closest(Invariant invariant) const {
        return closest_[static_cast<std::size_t>(invariant)];
    }

  private:
    std::vector<Violation> violations_;  // the first of each invariant
    std::array<double, invariant_count> closest_{};
};

}  // namespace jawari::stress
