// Which controller moves which parameter: plain data, looked up on the audio thread.
#pragma once

#include <array>
#include <cstddef>

#include "jawari/parameters.h"
#include "jawari/realtime.h"

namespace jawari::host {

enum class MidiSource {
    Controller,       ///< 7 bits
    Controller14,     ///< a pair of controllers n and n + 32, 14 bits
    ChannelPressure,  ///< instead of the pressure event
    Nrpn              ///< data entry to a non-registered parameter, 14 bits
};

struct MidiBinding {
    MidiSource source = MidiSource::Controller;
    int number = 0;    ///< controller (of the pair the coarse one), or NRPN 0 to 16383
    int channel = -1;  ///< 0 to 15; -1: every channel
    ParameterId parameter{};
    double low = 0;   ///< in the parameter's unit, at the control's lowest position; may be above `high`
    double high = 1;  ///< at its highest position
    Curve curve = Curve::Linear;
};

inline constexpr std::size_t most_bindings = 64;
/// Bindings that one control on one channel can have.
inline constexpr std::size_t most_bindings_per_source = 4;

struct MidiMap {
    std::array<MidiBinding, most_bindings> bindings{};
    std::size_t count = 0;
};

/// Controllers 1 vibrato_depth, 7 volume, 10 pan, 11 expression, 68 legato, over each parameter's range.
MidiMap default_midi_map();

/// A binding over the parameter's own range and curve.
MidiBinding whole_range(MidiSource source, int number, ParameterId parameter);

/// Value of the parameter at `travel` (0 to 1) of the control.
double bound_value(const MidiBinding& binding, double travel) JAWARI_REALTIME;

/// Whether the interpreter needs the controller itself (pedals, bank, data entry, modes ...), so that no
/// binding may have it.
bool is_reserved_controller(int controller) JAWARI_REALTIME;

/// Travel of a control of `bits` bits (7 or 14): 0 at 0, 0.5 at the centre (64 or 8192), 1 at the top, linear
/// on both sides, as MIDI 2.0 translates them ("Min-Center-Max", M2-115-U).
double control_travel(int value, int bits) JAWARI_REALTIME;

}  // namespace jawari::host
