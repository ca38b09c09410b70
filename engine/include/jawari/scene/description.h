// What a scene is, in SI units, before compile(): plain structs with the names and units of the scene file
// format.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
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
    /// Of those, what each mode loses to something that is computed beside the string, 0 or more [1/s]; a
    /// tenth of a mode's losses stays its own. Empty: nothing.
    std::vector<double> lost_elsewhere_per_s{};
};

/// Modes from two tables of equal length N, 1 to limits::modes.
struct ModeTable {
    /// Undamped frequencies omega_k/(2 pi) [Hz], > 0; with a ShapeTable also 0: a motion that nothing holds.
    std::vector<double> frequency_hz;
    std::vector<double> decay_per_s;  ///< decay rates sigma_k, >= 0 [1/s]
};

/// Mode shapes by their values at points, for what is no string pinned at both ends: bars, plates, measured
/// structures. M_k (q_k'' + 2 sigma_k q_k' + omega_k^2 q_k) = sum psi_k(x) F, u(x) = sum psi_k(x) q_k, q_k in
/// metres. bar_shapes() and plate_shapes() (systems.h) make such tables.
struct ShapeTable {
    std::vector<double> modal_mass_kg;        ///< M_k, > 0, one per mode [kg]
    std::vector<std::vector<double>> points;  ///< psi_k at each point, one value per mode [1]
    std::vector<std::string> names = {};      ///< of the points, for output; may be empty
};

// ---------------------------------------------------------------------------------------------- obstacles

/// From which side a contact presses on the string.
enum class Side {
    Below,  ///< fret, neck, bridge: gap = u - height
    Above   ///< finger, hand, thread: gap = height - u
};

/// A contact that gives way. With the depth s = -gap it presses with K s^p (1 + beta s') + R s', never pulls
/// (Hunt and Crossley, J. Appl. Mech. 42, 1975). The exact scheme alone has it.
struct Compliance {
    double stiffness = 0;            ///< K, >= 0 [N/m^p]
    double exponent = 1;             ///< p, 1 to 10; 1.5 for two spheres (Hertz), 2 to 3 for felt [1]
    double loss_s_per_m = 0;         ///< beta, >= 0 [s/m]
    double resistance_kg_per_s = 0;  ///< R, >= 0; acts at any gap, so that it is for dashpots [kg/s]
};

/// A point obstacle.
struct ContactDescription {
    double position_m = 0;    ///< x_c, from the string's start, 0 to L; without a ShapeTable [m]
    double height_m = 0;      ///< h_c, from the rest line, negative below it [m]
    double restitution = 0;   ///< e_c, 0 (no rebound) to 1; ImpactLaw says which laws use it
    Side side = Side::Below;  ///< from which it presses on the string
    std::optional<Compliance> compliance = {};  ///< absent: rigid
    std::size_t point = 0;  ///< with a ShapeTable, in place of position_m: index of its points
};

/// A spring and a dashpot between the string and the ground: -K (u - height) - R u'. A thread, a felt, a
/// finger that rests. The exact scheme alone has it.
struct SpringDescription {
    double position_m = 0;           ///< 0 to L; without a ShapeTable [m]
    std::size_t point = 0;           ///< index into ShapeTable::points
    double height_m = 0;             ///< where it is relaxed, from the rest line [m]
    double stiffness_N_per_m = 0;    ///< K, >= 0 [N/m]
    double resistance_kg_per_s = 0;  ///< R, >= 0; a string with R > 0 is stepped uniformly [kg/s]
};

/// A mass that flies at the string without gravity and meets the rest line at `time_s`. The exact scheme
/// alone has it.
struct FlyingHammer {
    double position_m = 0;        ///< 0 to L; without a ShapeTable [m]
    std::size_t point = 0;        ///< index into ShapeTable::points
    Side side = Side::Below;      ///< from which it comes
    double time_s = 0;            ///< >= 0 [s]
    double mass_kg = 0;           ///< > 0 [kg]
    double velocity_m_per_s = 0;  ///< towards the string, >= 0 [m/s]
    Compliance compliance;        ///< of its felt
};

// ------------------------------------------------------------ what moves from outside

/// A force on a point of the string.
struct DrivenForce {
    double position_m = 0;  ///< 0 to L; without a ShapeTable [m]
    std::size_t point = 0;  ///< index into ShapeTable::points
    /// At output frames 0, 1, ..., linear between them, zero after the last [N].
    std::vector<double> force_N;
};

/// An obstacle that moves.
struct DrivenHeight {
    std::size_t contact = 0;  ///< index into StringDescription::contacts
    /// At output frames 0, 1, ..., linear between them, then constant [m]. The first is the contact's
    /// height_m.
    std::vector<double> height_m;
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
    std::vector<double> displacement;  ///< q_k(0) [m^(3/2); m with a ShapeTable], N values, or empty for zero
    std::vector<double> velocity;      ///< true velocity of q_k [the same/s], N values, or empty for zero
};

/// Displacement and velocity at places of a string, linear between them, zero outside; projected exactly onto
/// the modes. All lists have one length, 2 to limits::profile_points; an empty one of the last two stands for
/// zero.
struct Profile {
    std::vector<double> position_m;        ///< 0 to L, rising; twice the same place is a jump [m]
    std::vector<double> displacement_m;    ///< u(x, 0) [m]
    std::vector<double> velocity_m_per_s;  ///< u_t(x, 0) [m/s]
};

/// State of a string at t = 0.
struct InitialCondition {
    std::variant<AtRest, Pluck, ModalState, Profile> shape;  ///< displacement and true velocity
    Start start = Start::Exact;                              ///< how the backward velocity follows
};

// ---------------------------------------------------------------------------------------------- probes

/// What a probe reads.
enum class Quantity {
    Displacement,  ///< sum_k phi_k(x) q_k [m]
    Velocity,      ///< sum_k phi_k(x) v_k [m/s], backward over a contact step
    /// sum_k phi_k(x) q_k'' [m/s^2] over the coming contact step, forces included, impulses of contacts not.
    Acceleration,
    Slope,     ///< sum_k phi_k'(x) q_k [1]; strings only
    NutForce,  ///< of the string on its support at x = 0, upwards: sum mu omega_k^2 a_k q_k [N]; strings only
    BridgeForce,  ///< the same at x = L; a_k = sqrt(2/L) L/(k pi), with (-1)^(k+1) here [N]; strings only
    ModeDisplacement,    ///< q_k [m^(3/2); m with a ShapeTable]
    ModeVelocity,        ///< v_k [the same/s], backward over a contact step
    ModeEnergy,          ///< the mode's part of H [J]
    ContactForce,        ///< impulse of one contact per output interval [N]
    HammerForce,         ///< the same of one hammer [N]
    HammerDisplacement,  ///< of one hammer, from the rest line [m]
    Energy  ///< H of the string, with its hammers and what compliant contacts and springs store [J]
};

/// One output of a string.
struct ProbeDescription {
    Quantity quantity = Quantity::Displacement;  ///< what it reads
    double position_m = 0;    ///< for Displacement to Slope, without a ShapeTable: 0 to L [m]
    std::size_t contact = 0;  ///< for ContactForce: index into StringDescription::contacts
    std::size_t point = 0;    ///< for Displacement to Acceleration: index into ShapeTable::points
    std::size_t mode = 0;     ///< for ModeDisplacement to ModeEnergy: from 1
    std::size_t hammer =
        0;  ///< for HammerForce and HammerDisplacement: index into StringDescription::hammers
};

// ------------------------------------------------------------ string and scene

/// One string with its obstacles and probes.
struct StringDescription {
    std::string name;                              ///< for output files; may be empty
    double length_m = 0;                           ///< L, > 0; not with a ShapeTable [m]
    double linear_density_kg_per_m = 0;            ///< mu, > 0; not with a ShapeTable [kg/m]
    std::variant<PhysicalModes, ModeTable> modes;  ///< frequencies and losses
    InitialCondition initial;                      ///< state at t = 0
    std::vector<ContactDescription> contacts;      ///< at most limits::contacts, hammers and springs included
    std::vector<ProbeDescription> probes;          ///< at most limits::probes
    std::optional<ShapeTable> shapes = {};  ///< with a ModeTable: no pinned string; then places are points
    std::vector<SpringDescription> springs = {};  ///< each counts as up to four contacts
    std::vector<FlyingHammer> hammers = {};  ///< at most limits::hammers; each counts as a contact and a mode
    std::vector<DrivenForce> forces = {};    ///< at most limits::forces
    std::vector<DrivenHeight> motions = {};  ///< of obstacles; one for each that moves
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
inline constexpr std::size_t hammers = 256;            ///< per string
inline constexpr std::size_t forces = 256;             ///< per string
inline constexpr std::size_t profile_points = 65536;   ///< of an initial profile
inline constexpr std::size_t shape_points = 8192;      ///< of a ShapeTable
inline constexpr double min_rate_hz = 1;               ///< of output and contact [Hz]
inline constexpr double max_rate_hz = 1e9;             ///< of output and contact [Hz]
inline constexpr std::size_t steps_per_frame = 65536;  ///< contact steps in an output frame
}  // namespace limits

}  // namespace jawari
