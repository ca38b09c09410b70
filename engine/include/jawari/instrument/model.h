// description -> const instrument model: one compiled string per string and fret.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "jawari/detail/aligned.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/instrument/description.h"
#include "jawari/result.h"

namespace jawari {

/// A string stopped at one fret (or open): the speaking length is the string; frets beyond the stop and
/// obstacles are its contacts, with heights relative to the line from the stop's top to the bridge. Its
/// tension is that at which the first partial is the note.
struct StoppedStringModel {
    int key = -1;             ///< MIDI note; -1 if the tuning leaves it unmapped: `string` is empty then
    double frequency_hz = 0;  ///< of the first partial
    StringModel string;
    double inharmonicity = 0;            ///< B at this stop
    double wave_impedance_kg_per_s = 0;  ///< sqrt(T mu)

    // For retuning (instrument_bend.h). Arrays over modes.
    AlignedVector<double> loss_step;   ///< expm1(-sigma h)
    AlignedVector<double> loss_frame;  ///< expm1(-sigma m h)
    /// Backward velocity of free motion: v = backward_q q + backward_u u, u the true velocity.
    AlignedVector<double> backward_q, backward_u;

    AlignedVector<double> pickup_rows;  ///< pickups x stride: what each senses of q or v [m^(-1/2)]; of
                                        ///< bridge_force [N m^(-3/2)]
    AlignedVector<double> bridge_row;   ///< force on the bridge = row . q [N m^(-3/2)]; empty without a body
    std::vector<double> pickup_rest;    ///< pickup_rows . q at rest
    double bridge_rest_N = 0;

    std::vector<double> full_force_N;            ///< per exciter: a finger's force at velocity 1, else 0
    std::vector<std::uint32_t> action_contacts;  ///< frets and neck, which the parameter `action` lowers
    double held_energy_J = 0;                    ///< H at rest: what obstacles hold
    double rest_energy_J = 0;                    ///< within this of held_energy_J the string is at rest
};

struct InstrumentStringModel {
    std::string name;
    std::size_t course = 0;
    double level = 1;  ///< with the instrument's gain
    double pan = 0;
    double excitation = 1;
    double release_t60_s = 0.1;
    std::vector<StringPlace> exciter_places;  ///< per exciter
    std::vector<SoftTouchDescription> soft_touches;
    std::vector<StoppedStringModel> stopped;  ///< index: fret, 0 is the open string
    StringSizes sizes;                        ///< the largest of all stops
};

/// Strings that sound together; the first gives the keys.
struct CourseModel {
    std::vector<std::size_t> strings;
};

/// Resonances of the body, driven by a force that is linear between frames. Arrays over the modes.
/// (y, v) at the next frame = [[yy, yv], [vy, vv]] (y, v) + held F + ramp (F_next - F).
struct BodyModel {
    AlignedVector<double> yy, yv, vy, vv;
    AlignedVector<double> y_held, v_held, y_ramp, v_ramp;
    AlignedVector<double> gain_left, gain_right;  ///< with the instrument's gain
    std::size_t count = 0;
};

struct InstrumentModel {
    std::string name;
    double output_rate_hz = 0;
    double contact_rate_hz = 0;
    std::size_t steps_per_frame = 0;
    PlayMode play = PlayMode::Keyboard;
    std::vector<ExciterDescription> exciters;
    HandDescription hand;
    std::vector<PickupDescription> pickups;
    std::vector<double> fade_shape;  ///< output gain of a motion being taken away, from 1 to 0, one per frame
    std::vector<InstrumentStringModel> strings;
    /// The same strings at lower qualities, each lower than the one before (instrument_rungs.h); rung r of a
    /// string is lower[r - 1], rung 0 is `strings`.
    std::vector<std::vector<InstrumentStringModel>> lower;
    std::vector<CourseModel> courses;
    BodyModel body;
};

/// Motions beyond 150 dB below the string's energy at full velocity are at rest.
inline constexpr double rest_energy_ratio = 1e-15;
/// Time in which a motion fades that is taken away before it is at rest [s].
inline constexpr double fade_s = 0.003;

/// Checks every value, then compiles all strings at all frets for one output rate. Failure::place is spelled
/// as in preset files.
Result<InstrumentModel> compile_instrument(const InstrumentDescription& instrument, double output_rate_hz);

}  // namespace jawari
