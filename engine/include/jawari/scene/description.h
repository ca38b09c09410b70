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

/// No losses: sigma_k = 0.
struct NoLoss {};

/// Valette's three losses: air, viscoelastic, constant quality factor (Issanchou et al. 2018, eq. 4):
/// 1/Q_k = R/(2 pi mu) f0_k/f_k^2 + (4 L^2 B mu delta / T) f0_k^3/f_k + 1/Q_0 with
/// R = 2 pi eta + 2 pi d sqrt(pi eta rho f_k).
struct ValetteLoss {
    double diameter_m = 0;                   ///< diameter d, > 0 [m]
    double air_viscosity_Pa_s = 0;           ///< dynamic viscosity of air eta, >= 0 [Pa s]
    double air_density_kg_per_m3 = 0;        ///< density of air rho, >= 0 [kg/m^3]
    double viscoelastic_loss_angle_rad = 0;  ///< loss angle of the material delta, >= 0 [rad]
    double inverse_quality = 0;              ///< constant part 1/Q_0, >= 0 [1]
};

/// A frequency and the time in which a partial there falls by 60 dB: T60 = ln(1000)/sigma.
struct DecayTime {
    double frequency_hz = 0;  ///< of the partial, > 0 [Hz]
    double t60_s = 0;         ///< T60, > 0 [s]
};

/// sigma_k = s_0 + s_1 (k pi / L)^2 through two points (Bilbao 2009, section 7.3). T60 must not rise with
/// frequency.
struct DecayTimePoints {
    std::array<DecayTime, 2> points;  ///< in either order; one point given twice means s_1 = 0
};

/// Modes from the string's physics.
struct PhysicalModes {
    std::size_t count = 0;     ///< number of modes N, 1 to limits::modes
    double tension_N = 0;      ///< tension T, > 0 [N]
    double inharmonicity = 0;  ///< inharmonicity B, >= 0 [1]
    InharmonicityLaw inharmonicity_law = InharmonicityLaw::SquareRoot;  ///< of the partials
    std::variant<NoLoss, ValetteLoss, DecayTimePoints> damping;         ///< losses
};

/// Modes from two tables of equal length N, 1 to limits::modes.
struct ModeTable {
    std::vector<double> frequency_hz;  ///< undamped frequencies omega_k/(2 pi), > 0 [Hz]
    std::vector<double> decay_per_s;   ///< decay rates sigma_k, >= 0 [1/s]
};

// ---------------------------------------------------------------------------------------------- obstacles

/// From which side a contact presses on the string.
enum class Side {
    Below,  ///< fret, neck, bridge: gap = u - height
    Above   ///< finger, hand, thread: gap = height - u
};

/// A rigid point obstacle.
struct ContactDescription {
    double position_m = 0;    ///< x_c, from the string's start, 0 to L [m]
    double height_m = 0;      ///< h_c, from the rest line, negative below it [m]
    double restitution = 0;   ///< e_c, 0 (no rebound) to 1; ImpactLaw says which laws use it
    Side side = Side::Below;  ///< from which it presses on the string
};

// ------------------------------------------------------------ initial state

/// How the backward velocity v = (q_now - q_before)/h of the first step follows from the true initial state.
enum class Start {
    Exact,    ///< from the analytic backward motion
    Backward  ///< v is the true velocity taken literally, as Siconos does
};

/// At rest against the obstacles.
struct AtRest {};

/// A triangle released at t = 0, projected exactly onto the modes.
struct Pluck {
    double position_m = 0;  ///< of the triangle's corner, inside (0, L) [m]
    double height_m = 0;    ///< of the triangle's corner, any finite value [m]
};

/// Modal coordinates at t = 0.
struct ModalState {
    std::vector<double> displacement;  ///< q_k(0) [m^(3/2)], N values, or empty for zero
    std::vector<double> velocity;      ///< true velocity of q_k [m^(3/2)/s], N values, or empty for zero
};

/// State of a string at t = 0.
struct InitialCondition {
    std::variant<AtRest, Pluck, ModalState> shape;  ///< displacement and true velocity
    Start start = Start::Exact;                     ///< how the backward velocity follows
};

// ---------------------------------------------------------------------------------------------- probes

/// What a probe reads.
enum class Quantity {
    Displacement,  ///< sum_k phi_k(x) q_k [m]
    Velocity,      ///< sum_k phi_k(x) v_k [m/s], backward over a contact step
    ContactForce,  ///< impulse of one contact per output interval [N]
    Energy         ///< H of the string [J]
};

/// One output of a string.
struct ProbeDescription {
    Quantity quantity = Quantity::Displacement;  ///< what it reads
    double position_m = 0;                       ///< for Displacement and Velocity: 0 to L [m]
    std::size_t contact = 0;                     ///< for ContactForce: index into StringDescription::contacts
};

// ------------------------------------------------------------ string and scene

/// One string with its obstacles and probes.
struct StringDescription {
    std::string name;                              ///< for output files; may be empty
    double length_m = 0;                           ///< L, > 0 [m]
    double linear_density_kg_per_m = 0;            ///< mu, > 0 [kg/m]
    std::variant<PhysicalModes, ModeTable> modes;  ///< frequencies and losses
    InitialCondition initial;                      ///< state at t = 0
    std::vector<ContactDescription> contacts;      ///< at most limits::contacts
    std::vector<ProbeDescription> probes;          ///< at most limits::probes
};

/// Time integration of the modes.
enum class Scheme {
    Exact,  ///< free motion without error ("Modal-Moreau-Jean", Issanchou et al. 2018)
    Theta   ///< the theta method (Moreau-Jean, as Siconos has it)
};

/// What a contact does at an impact; docs/engine/model.md, section "Impact laws", has the equations.
enum class ImpactLaw {
    Newton,         ///< Newton's law of restitution at velocity level (Moreau-Jean)
    Passive,        ///< Newton's law without restitution for a contact that already separates
    Signorini,      ///< no penetration at position level; restitution is ignored
    PaoliSchatzman  ///< y+ >= -e y_before (Paoli and Schatzman 2002); may raise the energy
};

/// The law's name in scene files: newton, passive, signorini or paoli-schatzman. Static storage. Threads:
/// any; realtime-safe.
const char* name_of(ImpactLaw law);

/// Strings that are computed together.
struct SceneDescription {
    double output_rate_hz = 48000;  ///< output frames per second, limits::min_rate_hz to max_rate_hz [Hz]
    double contact_rate_hz =
        2016000;                    ///< contact steps per second, an integer multiple of output_rate_hz [Hz]
    Scheme scheme = Scheme::Exact;  ///< time integration; Theta allows ImpactLaw::Newton only
    double theta = 0.5;             ///< 1/2 to 1; used by Scheme::Theta only
    ImpactLaw law = ImpactLaw::Signorini;    ///< of all contacts
    std::vector<StringDescription> strings;  ///< 1 to limits::strings
};

// ---------------------------------------------------------------------------------------------- limits

/// Largest sizes that compile() accepts, so that a hostile description is refused before memory is taken.
namespace limits {
inline constexpr std::size_t modes = 8192;             ///< per string
inline constexpr std::size_t contacts = 4096;          ///< per string
inline constexpr std::size_t strings = 256;            ///< per scene
inline constexpr std::size_t probes = 256;             ///< per string
inline constexpr double min_rate_hz = 1;               ///< of output and contact [Hz]
inline constexpr double max_rate_hz = 1e9;             ///< of output and contact [Hz]
inline constexpr std::size_t steps_per_frame = 65536;  ///< contact steps in an output frame
}  // namespace limits

}  // namespace jawari
