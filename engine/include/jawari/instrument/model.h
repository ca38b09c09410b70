// A compiled instrument: one compiled string for each string and fret. Never changed after
// compile_instrument() and add_qualities(): any number of threads may share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "jawari/detail/aligned.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/instrument/description.h"

namespace jawari {

/// A string stopped at one fret (or open). The string is the speaking length; the frets beyond the stop and
/// the obstacles are its contacts, with heights relative to the line from the stop's top to the bridge. Its
/// tension is the one at which the first partial is the note.
struct StoppedStringModel {
    /// MIDI note number; -1 if no key plays it, because the string is sympathetic, or because the tuning
    /// leaves it unmapped: `string` is empty then.
    int key = -1;
    double frequency_hz = 0;             ///< of the first partial [Hz]
    StringModel string;                  ///< the speaking length
    double inharmonicity = 0;            ///< B at this stop [1]
    double wave_impedance_kg_per_s = 0;  ///< sqrt(T mu) [kg/s]

    // For retuning (engine/src/instrument/voice/bend.h). Arrays over the string's modes, string.stride long.
    AlignedVector<double> loss_step;   ///< expm1(-sigma_k h)
    AlignedVector<double> loss_frame;  ///< expm1(-sigma_k m h), m steps in a frame
    AlignedVector<double>
        backward_q;  ///< [1/s]; backward velocity of free motion: v = backward_q q + backward_u u
    AlignedVector<double> backward_u;  ///< factor of the true velocity u in the backward velocity

    /// Rows of the pickups, pickups x stride: what each senses of q or v [m^(-1/2)]; of bridge force
    /// [N m^(-3/2)].
    AlignedVector<double> pickup_rows;
    AlignedVector<double> bridge_row;  ///< force on the bridge = row . q [N m^(-3/2)]; empty without a body
    /// The same for a moving bridge, with what meeting it once a frame takes (allow_for_frames(),
    /// pickups.cpp).
    AlignedVector<double> end_row;
    double end_rest_N = 0;  ///< end_row . q at rest [N]
    /// By how much a metre of the bridge's displacement, held over a frame, raises the root of the string's
    /// energy at most, at the compiled tension [J^(1/2)/m].
    double end_root = 0;
    double end_strength =
        0;  ///< and the point force that would bend the string as far within the frame [N/m]
    /// kappa: what the end at a moving bridge resists while the modes stand still,
    /// sum_k end_row_k^2/(mu omega_k^2) + T/L [N/m]; 0 if the bridge is rigid.
    double bridge_stiffness_N_per_m = 0;
    std::vector<double> pickup_rest;  ///< pickup_rows . q at rest, one value for each pickup
    double bridge_rest_N = 0;         ///< bridge_row . q at rest [N]

    std::vector<double> full_force_N;  ///< for each exciter: a finger's force at velocity 1 [N], else 0
    std::vector<std::uint32_t> action_contacts;  ///< frets and neck, which the parameter `action` lowers
    double held_energy_J = 0;                    ///< H of the string at rest: what the obstacles hold [J]
    double rest_energy_J = 0;                    ///< a voice within this of held_energy_J is at rest [J]
};

/// One string of the instrument with all its stops.
struct InstrumentStringModel {
    std::string name;            ///< of the description
    std::size_t course = 0;      ///< index into InstrumentModel::courses
    double level = 1;            ///< factor of the string's signals: its level times the instrument's gain
    bool sympathetic = false;    ///< no key plays it
    double own_level = 1;        ///< of the description, by which the string acts on a moving bridge
    double pan = 0;              ///< -1 left to 1 right
    double excitation = 1;       ///< factor of lifts and hammer speeds
    double release_t60_s = 0.1;  ///< 60 dB decay time under the damping hand [s]
    std::vector<StringPlace> exciter_places;         ///< for each exciter
    std::vector<SoftTouchDescription> soft_touches;  ///< those that lie on this string
    std::vector<StoppedStringModel> stopped;         ///< index: fret, 0 is the open string
    StringSizes sizes;                               ///< the largest of all stops
};

/// Strings that sound together.
struct CourseModel {
    std::vector<std::size_t> strings;  ///< indices; the first one decides which keys the course has
};

/// Resonances of the body, driven by a force that is linear between frames. Arrays over the body's modes.
/// (y, v) at the next frame = [[yy, yv], [vy, vv]] (y, v) + held F + ramp (F_next - F).
struct BodyModel {
    AlignedVector<double> yy;      ///< free motion over one output frame: y from y
    AlignedVector<double> yv;      ///< free motion over one output frame: y from v [s]
    AlignedVector<double> vy;      ///< free motion over one output frame: v from y [1/s]
    AlignedVector<double> vv;      ///< free motion over one output frame: v from v
    AlignedVector<double> y_held;  ///< y after a frame under 1 N
    AlignedVector<double> v_held;  ///< v after a frame under 1 N
    AlignedVector<double> y_ramp;  ///< y after a frame in which the force grows from 0 to 1 N
    AlignedVector<double> v_ramp;  ///< v after a frame in which the force grows from 0 to 1 N
    /// Output on the left per velocity [s/m], as BodyModeDescription states it. The instrument's gain is not
    /// in it: the force that drives the body carries that, through InstrumentStringModel::level.
    AlignedVector<double> gain_left;
    AlignedVector<double>
        gain_right;         ///< output on the right per velocity [s/m], without the instrument's gain
    std::size_t count = 0;  ///< number of modes; the arrays are padded
};

/// The body under a bridge that moves. Arrays over its modes, `stride` long. In a frame with the modal force
/// F held, (y, v) at its end = [[yy, yv], [vy, vv]] (y, v) + (y_held, v_held) F.
struct BridgeModel {
    std::size_t count = 0;            ///< modes; 0: the bridge is rigid, and the body is in BodyModel
    std::size_t stride = 0;           ///< padded(count)
    AlignedVector<double> yy;         ///< free motion over one output frame: y from y
    AlignedVector<double> yv;         ///< y from v [s]
    AlignedVector<double> vy;         ///< v from y [1/s]
    AlignedVector<double> vv;         ///< v from v
    AlignedVector<double> y_held;     ///< y after a frame under 1 N [m/N]
    AlignedVector<double> v_held;     ///< v after a frame under 1 N [m/(N s)]
    AlignedVector<double> mass_kg;    ///< of each mode [kg]
    AlignedVector<double> stiffness;  ///< mass omega^2 [N/m]
    AlignedVector<double>
        gain_left;  ///< output on the left per velocity [s/m], the instrument's gain included
    AlignedVector<double> gain_right;  ///< output on the right per velocity [s/m]
    AlignedVector<double> shape;       ///< under each string, strings x stride
    std::size_t string_stride = 0;     ///< padded(strings)
    /// Displacement under each string at a frame's end per newton held under each [m/N], strings x
    /// string_stride.
    AlignedVector<double> receptance;
    double least_drive_J = 0;  ///< energy of the body above which open strings begin to answer [J]
    double open_strings = 1;   ///< BridgeDescription::open_strings
};

/// A compiled instrument.
struct InstrumentModel {
    std::string name;                          ///< of the description
    double output_rate_hz = 0;                 ///< output frames per second [Hz]
    double contact_rate_hz = 0;                ///< contact steps per second [Hz]
    std::size_t steps_per_frame = 0;           ///< contact_rate_hz / output_rate_hz
    PlayMode play = PlayMode::Keyboard;        ///< how strings are given to notes
    std::vector<ExciterDescription> exciters;  ///< of the description
    HandDescription hand;                      ///< of the description
    std::vector<PickupDescription> pickups;    ///< of the description
    std::vector<double>
        fade_shape;  ///< output gain of a voice that is taken away: from 1 to 0, one per frame
    std::vector<InstrumentStringModel> strings;  ///< at full quality
    /// The strings at lower quality levels, each lower than the one before (qualities.h): level n of a string
    /// is lower[n - 1], level 0 is `strings`.
    std::vector<std::vector<InstrumentStringModel>> lower;
    std::vector<CourseModel> courses;  ///< strings that sound together, each string in one course
    BodyModel body;                    ///< resonances of the body that listen
    BridgeModel bridge;                ///< resonances of the body that move the bridge
};

/// A voice whose energy is below this share of the string's energy at full velocity is at rest (-150 dB).
inline constexpr double rest_energy_ratio = 1e-15;
/// The same of a string that answers, over that of one that is played: -120 dB of the loudest.
inline constexpr double answer_energy_ratio = 1000;
/// Time in which a voice fades that is taken away before it is at rest [s].
inline constexpr double fade_s = 0.003;

}  // namespace jawari
