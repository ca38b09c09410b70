#include "midi/midi_map.h"

#include <algorithm>

namespace jawari::host {

namespace {

/// At the top of the modulation wheel: a strong vibrato of the left hand. The parameter itself goes further.
constexpr double wheel_vibrato_semitones = 0.5;

}  // namespace

MidiBinding whole_range(MidiSource source, int number, ParameterId parameter) {
    const ParameterDeclaration& declared = declaration_of(parameter);
    return {source, number, -1, parameter, declared.low, declared.high, declared.curve};
}

MidiMap default_midi_map() {
    MidiMap map;
    const auto bind = [&map](int controller, ParameterId parameter) -> MidiBinding& {
        return map.bindings[map.count++] = whole_range(MidiSource::Controller, controller, parameter);
    };
    bind(1, ParameterId::VibratoDepth).high = wheel_vibrato_semitones;
    bind(7, ParameterId::Volume);
    bind(10, ParameterId::Pan);
    bind(11, ParameterId::Expression);
    bind(68, ParameterId::Legato);
    return map;
}

double bound_value(const MidiBinding& binding, double travel) JAWARI_REALTIME {
    const ParameterDeclaration& declared = declaration_of(binding.parameter);
    ParameterDeclaration range = declared;
    range.low = binding.low;
    range.high = binding.high;
    range.curve = binding.curve;
    // Rounding, also to whole numbers of a stepped curve, must not leave the declared range.
    return std::clamp(parameter_value(range, travel), declared.low, declared.high);
}

bool is_reserved_controller(int controller) JAWARI_REALTIME {
    switch (controller) {
        case 0:
        case 6:
        case 32:
        case 38:
        case 64:
        case 67:
        case 74:
        case 88:
            return true;
        default:
            return (controller >= 96 && controller <= 101) || controller >= 120;
    }
}

double control_travel(int value, int bits) JAWARI_REALTIME {
    const int top = (1 << bits) - 1;
    const int centre = 1 << (bits - 1);
    if (value <= centre) return 0.5 * value / centre;
    return 0.5 + 0.5 * (value - centre) / (top - centre);
}

}  // namespace jawari::host
