// Which compiled string is played: the quality level of a string, and the model of one voice.
#pragma once

#include <cstddef>

#include "jawari/detail/string_model.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"

namespace jawari {

/// String s at the rung on which it is played.
inline const InstrumentStringModel& string_of(const InstrumentModel& model, const InstrumentState& state,
                                              std::size_t s) {
    const std::size_t rung = state.strings[s].rung;
    return rung == 0 ? model.strings[s] : model.lower[rung - 1][s];
}

/// The string as the motion has it: compiled, or bent.
inline const StringModel& voice_model(const InstrumentStringModel& string, const Voice& voice) {
    return voice.bend.active ? voice.bend.model : string.stopped[voice.fret].string;
}

}  // namespace jawari
