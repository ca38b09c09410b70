// The compiled scene: every coefficient that rendering needs, never changed after compile().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "jawari/detail/aligned.h"
#include "jawari/scene/description.h"

namespace jawari {

/// Free flight over one output frame of m steps: (q, v) <- (q, v) + F (q, v) + force response. Arrays over
/// modes.
struct FlightModel {
    AlignedVector<double> qq, qv, vq, vv;  ///< P^m - I, P = [[1-d, h e], [-d/h, e]]; qv in s, vq in 1/s
    /// Response at the frame's end to a force of 1 N held over it, and to one that grows by 1 N a step, per
    /// unit of phi.
    AlignedVector<double> q_held, v_held, q_ramp, v_ramp;
};

/// Weights of the gap certificate that hold at one tension (docs/engine/certificate.md). Arrays over modes
/// unless said otherwise.
struct CertificateTuning {
    AlignedVector<double> stiffness;  ///< kappa = 4d/((1+e+A) h^2): r^2 = v^2 + kappa (q - h v/2)^2 [1/s^2]
    AlignedVector<double> extent;     ///< |q| <= extent r [s]
    AlignedVector<double>
        detour;  ///< q leaves the line between its values at a frame's ends by <= detour r [s]
    AlignedVector<double> kick;  ///< rho w/mu: what an impulse on phi = 1 adds to r at most [1/kg m]
    /// How far 1 N s at contact c lowers the gaps of group g within a frame at most [m/(N s)], groups x
    /// contact_count; empty without a response table.
    std::vector<double> push_path;
    double push_growth = 1;   ///< factor of all CertificateShape::push_speed at this tension
    double reach_growth = 1;  ///< factor of all CertificateShape::reach at this tension
    double force_reach =
        0;  ///< a gap falls within a frame by this for each newton held on points of it [m/N]
};

/// What the gap certificate knows of the contacts, whatever the tension.
struct CertificateShape {
    std::vector<std::size_t> group_begin;  ///< first contact of each group, and the contact count at the end
    AlignedVector<double> envelope;        ///< max over a group's contacts of |phi_k|, groups x stride
    /// What 1 N s at contact c adds to the rate of the gaps of group g at most, at the compiled tension
    /// [1/kg], contact_count x groups.
    std::vector<double> push_speed;
    /// A gap of contact c falls by at most reach[c] sqrt(H) below -b_c, at any step, while the string's
    /// energy is below H, at the compiled tension [m/J^(1/2)]. Empty if it is not known.
    std::vector<double> reach;
};

/// Forces and heights that follow tables over output frames (docs/engine/model.md, "What moves from
/// outside").
struct Drives {
    AlignedVector<double> force_rows;           ///< phi_k of each force's point, forces x stride
    std::vector<std::vector<double>> force_N;   ///< per force: values at frames 0, 1, ...
    std::vector<std::size_t> moved;             ///< index of each described contact that moves
    std::vector<std::vector<double>> height_m;  ///< per moved contact: values at frames 0, 1, ...
    /// Frames [first, second) in which a force acts or a height changes, in order, apart from one another.
    std::vector<std::array<std::uint64_t, 2>> spans;
};

/// What a bend does not change: compile() makes it, and everything that plays the string shares it, read
/// only. Arrays over modes have length `stride` (the mode count N padded by modes at rest); rows over
/// contacts are `stride` apart.
struct StringShape {
    std::string name;
    double length_m = 0;
    double linear_density_kg_per_m = 0;
    std::size_t mode_count = 0;  ///< N, and one for each hammer after the string's own
    std::size_t hammer_count = 0;
    std::size_t stride = 0;  ///< padded(N)

    AlignedVector<double> sigma;  ///< sigma_k [1/s]

    // -- time step (step_coefficients.h)
    double step_s = 0;  ///< h
    double theta = 1;   ///< 1 for the exact scheme
    Scheme scheme = Scheme::Exact;
    ImpactLaw law = ImpactLaw::Signorini;
    std::size_t steps_per_frame = 1;      ///< m
    AlignedVector<double> carry, change;  ///< e_k = carry + change
    AlignedVector<double> mobility;       ///< w_k/mu [1/kg m]
    AlignedVector<double> dissipation;  ///< mu (1-e)/(4 w); for the theta scheme 2 mu sigma h; 0 where w = 0

    // -- contacts
    std::size_t contact_count = 0;   ///< contacts kept, <= those described
    std::size_t contact_stride = 0;  ///< padded(contact_count)
    AlignedVector<double>
        contact_rows;  ///< S: +phi_k(x_c) from below, -phi_k(x_c) from above; contact_count x stride
    /// S^T where frames are short (short_frame.h), stride x contact_stride; else empty.
    AlignedVector<double> contact_columns;
    std::vector<double> contact_height;  ///< b_c = +-h_c [m]: gap = S q - b
    /// What rounding may leave of a gap [m], the largest over the contacts: `signorini` lifts
    /// a contact that lies inside by this much a step (docs/engine/stability.md, "Gaps").
    double gap_rounding_m = 0;
    std::vector<double> contact_restitution;  ///< e_c
    /// Of each contact; stiffness and resistance 0: rigid. Empty if all are.
    std::vector<Compliance> contact_compliance;
    bool has_dashpots = false;                      ///< some contact has a resistance, which acts at any gap
    std::vector<std::ptrdiff_t> contact_of_hammer;  ///< model index, -1 if dropped
    Drives drives;
    std::vector<double> contact_position;  ///< x_c [m]
    std::vector<Side> contact_side;
    /// A = h theta D = h theta S diag(w/mu) S^T [m/(N s)]: contact_count x contact_stride, or by grid
    /// distance.
    AlignedVector<double> compliance;
    /// Made of the compliance's numbers: strings with the same id have the same operator. Not 0, which stands
    /// for none.
    std::uint64_t compliance_id = 0;
    double compliance_norm = 0;      ///< bound of the norm of A_ij/sqrt(A_ii A_jj); ContactOperator::norm
    std::size_t grid_intervals = 0;  ///< M if all contacts lie at x = j L/M below the string, else 0
    std::vector<std::uint32_t> grid_node;  ///< j of each contact, empty without a grid
    std::vector<std::ptrdiff_t>
        contact_of_description;       ///< model index of each described contact, -1 if dropped
    CertificateShape certificate;     ///< exact scheme only
    std::size_t response_stride = 0;  ///< padded(steps_per_frame); exact scheme only

    // -- states of the string as compiled
    AlignedVector<double> initial_displacement;  ///< q
    AlignedVector<double> initial_velocity;      ///< backward velocity v
    AlignedVector<double> rest_displacement;     ///< q at rest against the obstacles; where a string with
                                                 ///< non-finite state restarts

    // -- probes, in the order described
    std::vector<ProbeDescription> probes;
    /// What a linear probe reads of displacement or velocity, zero for others; probes x stride. For
    /// Acceleration phi_k(x).
    AlignedVector<double> probe_rows;
    /// Modal coordinates as described, in units of the engine's: 1, or 1/sqrt(M_k) with a ShapeTable, whose
    /// modes the engine scales to the mass of 1 kg/m.
    AlignedVector<double> coordinate_unit;
};

/// What holds at one tension only: compile() fills all of it, retuning (retune_kernel.h) what it can in one
/// pass over the modes. Arrays over modes have length `stride`.
struct StringTuning {
    AlignedVector<double> omega;      ///< omega_k [rad/s]; 0 in the padding
    AlignedVector<double> restoring;  ///< -d_k/h [1/s]

    // -- energy (energy.h): H = sum kinetic v^2 + potential (q - h v/2)^2, or + potential q^2 for the theta
    // scheme
    AlignedVector<double> kinetic;    ///< mu (1+e+A)/(8 w), or mu/2 for the theta scheme; 0 where w = 0
    AlignedVector<double> potential;  ///< mu omega^2/2

    // -- skipping; exact scheme only
    FlightModel flight;
    CertificateTuning certificate;

    // -- tables over contacts, which are too large to make anew at another tension: a bent string has none
    /// Gap rates within a frame after an impulse of 1 N s [1/kg], rows of response_stride: one per pair of
    /// contacts, or one per grid distance (contact_response.h); empty where the table would be too large.
    AlignedVector<double> response;
    /// The same step by step where frames have few steps (contact_tables.h): row [n][struck] over contacts,
    /// contact_stride apart; else empty.
    AlignedVector<double> step_response;
};

/// The arrays over modes of a tuning: what retuning fills. The other members it leaves empty, or scales.
inline std::array<AlignedVector<double>*, 16> mode_arrays(StringTuning& tuning) {
    FlightModel& f = tuning.flight;
    CertificateTuning& c = tuning.certificate;
    return {&tuning.omega,   &tuning.restoring,
            &tuning.kinetic, &tuning.potential,
            &f.qq,           &f.qv,
            &f.vq,           &f.vv,
            &f.q_held,       &f.v_held,
            &f.q_ramp,       &f.v_ramp,
            &c.stiffness,    &c.extent,
            &c.detour,       &c.kick};
}

/// A string at one tension. Copies share the shape.
struct StringModel {
    /// Set by compile(), which gives stops that no key plays the shape of a string without modes; of a bent
    /// string by its first bend, null before.
    std::shared_ptr<const StringShape> shape;
    StringTuning tuning;
};

struct SceneModel {
    double output_rate_hz = 0;
    double contact_rate_hz = 0;
    std::size_t steps_per_frame = 0;  ///< m = contact_rate / output_rate
    std::vector<StringModel> strings;
    std::size_t probe_count = 0;  ///< over all strings: outputs of render()
};

}  // namespace jawari
