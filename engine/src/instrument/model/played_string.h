// Which compiled string is played: the quality level of a string, and the model of one voice.
#pragma once

#include <cstddef>

#include "jawari/detail/string_model.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"

namespace jawari {

/// String s at the quality level at which it is played.
inline const InstrumentStringModel& string_of(const InstrumentModel& model, const InstrumentState& state,
                                              std::size_t s) {
    const std::size_t quality_level = state.strings[s].quality_level;
    return quality_level == 0 ? model.strings[s] : model.lower[quality_level - 1][s];
}

/// The string as the voice has it: compiled, or bent.
inline const StringModel& voice_model(const InstrumentStringModel& string, const Voice& voice) {
    return voice.bend.active ? voice.bend.model : string.stopped[voice.fret].string;
}

}  // namespace jawari
