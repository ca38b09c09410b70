// The impact laws as target gaps: which contacts are candidates in a step, and the gap tau below which they
// may not end it.
#pragma once

#include <algorithm>

#include "jawari/scene/description.h"

namespace jawari {

/// What an impact law depends on: one contact at the start of a step.
struct ContactMoment {
    double gap = 0;         ///< y [m]
    double gap_before = 0;  ///< y one step earlier [m]
    double approach = 0;    ///< h S v, the gap's change at the step's start [m]; theta scheme only
    double restitution = 0;
    double theta = 1;
    Scheme scheme = Scheme::Exact;
    double excused = 0;  ///< depth that rounding explains, excused_depth() in contact_stage.h [m]
};

/// Whether the law acts on the contact. Newton and passive restitution act if the gap, extrapolated by half a
/// step, is closed.
inline bool is_candidate(ImpactLaw law, const ContactMoment& c) {
    if (law == ImpactLaw::Signorini || law == ImpactLaw::PaoliSchatzman) return true;
    const double change = c.scheme == Scheme::Theta ? c.approach : c.gap - c.gap_before;
    return c.gap + change / 2 <= 0;
}

/// Whether is_candidate() extrapolates the gap by half a step.
inline bool looks_ahead(ImpactLaw law) {
    return law == ImpactLaw::Newton || law == ImpactLaw::Passive;
}

/// Whether the law may act on a gap that is open at both ends of a step, because it was closed one step
/// earlier.
inline bool looks_back(ImpactLaw law) {
    return law == ImpactLaw::PaoliSchatzman;
}

/// Whether no impact raises the energy H: tau <= y_before wherever there is an impulse.
inline bool is_passive(ImpactLaw law) {
    return law == ImpactLaw::Passive || law == ImpactLaw::Signorini;
}

/// tau [m]: the step's complementarity problem is 0 <= y+ - tau  perp  lambda >= 0.
inline double target_gap(ImpactLaw law, const ContactMoment& c) {
    switch (law) {
        case ImpactLaw::Newton:
            if (c.scheme == Scheme::Theta)
                return c.gap + ((1 - c.theta) - c.theta * c.restitution) * c.approach;
            return c.gap - c.restitution * (c.gap - c.gap_before);
        case ImpactLaw::Passive:
            return c.gap <= c.gap_before ? c.gap - c.restitution * (c.gap - c.gap_before) : c.gap_before;
        case ImpactLaw::Signorini:
            // 0, but a contact left inside by a truncated solve must not be shot out. Rounding is no reason
            // to stay inside: a string at rest on an obstacle would sink a little further each time it is
            // unlucky.
            return std::min(0.0, c.gap_before + c.excused);
        case ImpactLaw::PaoliSchatzman:
            return -c.restitution * c.gap_before;
    }
    return 0;
}

}  // namespace jawari
