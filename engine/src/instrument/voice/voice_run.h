// A voice on its way through output frames: gains, fades, what the outputs get, and its end.
#pragma once

#include <cstddef>
#include <cstdint>

#include "instrument/voice/pickups.h"
#include "instrument/voice/voice.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// A voice in frames of a run.
struct VoiceRun {
    const InstrumentModel& model;
    const InstrumentStringModel& string;
    Voice& voice;
    double smoothing;
    InstrumentState& state;
    OutputReadings& readings;
    std::uint64_t frame;  ///< InstrumentState::frame of the run's frame 0
};

/// Frames until the voice may end: the last of a fade, or one after which its energy is looked at.
std::size_t frames_to_end(const VoiceRun& run) JAWARI_REALTIME;

/// Gain of fading in and out in the coming frame.
double fade_gain(const InstrumentModel& model, const Voice& voice) JAWARI_REALTIME;

/// What the outputs get of frame n, which the string has passed. `resets`: of the string before that.
void add_signals(VoiceRun& run, std::size_t n, std::uint64_t resets, VoiceSignals& sum) JAWARI_REALTIME;

}  // namespace jawari
