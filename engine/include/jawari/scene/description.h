// What a scene is, in SI units, before compile(): plain structs with the names and units of the scene file
// format.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace jawari {

// ---------------------------------------------------------------------------------------------- modes

/// Stretching of the partials by bending stiffness; B = pi^2 E I / (T L^2).
enum class InharmonicityLaw {
    SquareRoot,  ///< f_k = k f_0 sqrt(1 + B k^2), the pinned stiff string (Fletcher 1964).
    FirstOrder   ///< f_k = k f_0 (1 + B k^2 / 2), as the published bass has it (Issanchou et al. 2018).
};

struct NoLoss {};

/// Valette's three losses (Issanchou et al. 2018, eq. 4):
/// 1/Q_k = R/(2 pi mu) f0_k/f_k^2 + (4 L^2 B mu delta / T) f0_k^3/f_k + 1/Q_0, R = 2 pi eta + 2 pi d sqrt(pi
/// eta rho f_k).
struct ValetteLoss {
    double diameter_m = 0;                   ///< d, > 0
    double air_viscosity_Pa_s = 0;           ///< eta, >= 0
    double air_density_kg_per_m3 = 0;        ///< rho, >= 0
    double viscoelastic_loss_angle_rad = 0;  ///< delta, >= 0
    double inverse_quality = 0;              ///< 1/Q_0, >= 0
};

/// A frequency and the time in which a partial there falls by 60 dB: T60 = ln(1000)/sigma.
struct DecayTime {
    double frequency_hz = 0;  ///< > 0
    double t60_s = 0;         ///< > 0
};

/// sigma_k = s_0 + s_1 (k pi / L)^2 through two points (Bilbao 2009, section 7.3); needs T60 not to rise with
/// frequency.
struct DecayTimePoints {
    std::array<DecayTime, 2> points;
};

/// Modes from the string's physics.
struct PhysicalModes {
    std::size_t count = 0;     ///< N, 1 to limits::modes
    double tension_N = 0;      ///< T, > 0
    double inharmonicity = 0;  ///< B, >= 0
    InharmonicityLaw inharmonicity_law = InharmonicityLaw::SquareRoot;
    std::variant<NoLoss, ValetteLoss, DecayTimePoints> damping;
};

/// Modes from tables of equal length N: omega_k/2pi and sigma_k.
struct ModeTable {
    std::vector<double> frequency_hz;  ///< undamped frequencies, > 0
    std::vector<double> decay_per_s;   ///< sigma_k, >= 0
};

// ---------------------------------------------------------------------------------------------- obstacles

/// From which side a contact presses on the string.
enum class Side {
    Below,  ///< fret, neck, bridge: gap = u - height
    Above   ///< finger, hand, thread: gap = height - u
};

struct ContactDescription {
    double position_m = 0;   ///< x_c, 0 to L
    double height_m = 0;     ///< h_c, negative: below the rest line
    double restitution = 0;  ///< e_c, 0 to 1
    Side side = Side::Below;
};

// ------------------------------------------------------------ initial state

/// How the backward velocity v = (q_now - q_before)/h of the first step follows from the true initial state.
enum class Start {
    Exact,    ///< from the analytic backward motion
    Backward  ///< v is the true velocity taken literally, as Siconos does
};

struct AtRest {};

/// A triangle released at t = 0, projected exactly onto the modes.
struct Pluck {
    double position_m = 0;  ///< inside (0, L)
    double height_m = 0;    ///< of the triangle's corner
};

/// Modal coordinates q_k(0) [m^(3/2)] and velocities; both of length N, or empty for zero.
struct ModalState {
    std::vector<double> displacement;
    std::vector<double> velocity;
};

struct InitialCondition {
    std::variant<AtRest, Pluck, ModalState> shape;
    Start start = Start::Exact;
};

// ---------------------------------------------------------------------------------------------- probes

enum class Quantity {
    Displacement,  ///< sum_k phi_k(x) q_k [m]
    Velocity,      ///< sum_k phi_k(x) v_k [m/s], backward over a contact step
    ContactForce,  ///< impulse of one contact per output interval [N]
    Energy         ///< H of the string [J]
};

struct ProbeDescription {
    Quantity quantity = Quantity::Displacement;
    double position_m = 0;    ///< for Displacement and Velocity: 0 to L
    std::size_t contact = 0;  ///< for ContactForce: index into the string's contacts
};

// ------------------------------------------------------------ string and scene

struct StringDescription {
    std::string name;
    double length_m = 0;                 ///< L, > 0
    double linear_density_kg_per_m = 0;  ///< mu, > 0
    std::variant<PhysicalModes, ModeTable> modes;
    InitialCondition initial;
    std::vector<ContactDescription> contacts;
    std::vector<ProbeDescription> probes;
};

enum class Scheme { Exact, Theta };

/// docs/engine/model.md, section "Impact laws".
enum class ImpactLaw { Newton, Passive, Signorini, PaoliSchatzman };

/// As scene files spell it: newton, passive, signorini, paoli-schatzman.
const char* name_of(ImpactLaw law);

struct SceneDescription {
    double output_rate_hz = 48000;     ///< > 0
    double contact_rate_hz = 2016000;  ///< an integer multiple of output_rate_hz
    Scheme scheme = Scheme::Exact;
    double theta = 0.5;  ///< 1/2 to 1; used by Scheme::Theta only
    ImpactLaw law = ImpactLaw::Signorini;
    std::vector<StringDescription> strings;
};

// ---------------------------------------------------------------------------------------------- limits

/// Largest sizes that compile() accepts, so that a hostile description is refused before memory is taken.
namespace limits {
inline constexpr std::size_t modes = 8192;           ///< per string
inline constexpr std::size_t contacts = 4096;        ///< per string
inline constexpr std::size_t strings = 256;          ///< per scene
inline constexpr std::size_t probes = 256;           ///< per string
inline constexpr std::size_t active_contacts = 128;  ///< simultaneous positive impulses per string and step
inline constexpr double min_rate_hz = 1;
inline constexpr double max_rate_hz = 1e9;
inline constexpr std::size_t steps_per_frame = 65536;
}  // namespace limits

}  // namespace jawari
