// description -> const instrument model: one compiled string per string and fret, ringing and damped.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jawari/aligned.h"
#include "jawari/instrument_description.h"
#include "jawari/model.h"
#include "jawari/result.h"

namespace jawari {

/// A string stopped at one fret (or open): the speaking length is the string, the frets beyond are its
/// contacts, with heights relative to the line from the stopping fret's top to the bridge. Its tension is
/// that at which the first partial is the note.
struct StoppedStringModel {
    StringModel ringing;
    StringModel damped;  ///< the same modes and contacts with the damping hand's losses added

    /// Backward velocity under damped losses from that under ringing losses, true velocity unchanged:
    /// v_damped = velocity_share v + displacement_share q. Per mode, padded like the model.
    AlignedVector<double> velocity_share;
    AlignedVector<double> displacement_share;  ///< [1/s]

    AlignedVector<double> pluck_row;   ///< phi_k at the finger [m^(-1/2)]
    AlignedVector<double> output_row;  ///< pickups, string level and gain: output = sum_k output_row v_k
    double full_force_N = 0;           ///< finger force at velocity 1
    double rest_energy_J = 0;          ///< below this the string counts as at rest
};

struct InstrumentStringModel {
    std::string name;
    int open_note = 0;
    std::vector<StoppedStringModel> stopped;  ///< index: fret, 0 is the open string
};

struct InstrumentModel {
    std::string name;
    double output_rate_hz = 0;
    double contact_rate_hz = 0;
    std::size_t steps_per_frame = 0;
    double height_exponent = 1;
    std::vector<double> pluck_shape;  ///< force at the frames' boundaries, from 0 over 1 to 0
    std::vector<double> fade_shape;   ///< output gain of a voice being taken away, from 1 to 0, one per frame
    std::vector<InstrumentStringModel> strings;
};

/// Notes beyond 150 dB below the string's energy at full velocity are at rest.
inline constexpr double rest_energy_ratio = 1e-15;
/// Time in which a voice fades that is taken away before it is at rest [s].
inline constexpr double fade_s = 0.003;

/// Checks every value, then compiles all strings at all frets for one output rate. Failure::place is spelled
/// as in preset files.
Result<InstrumentModel> compile_instrument(const InstrumentDescription& instrument, double output_rate_hz);

}  // namespace jawari
