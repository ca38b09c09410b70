// What control and audio threads of live playing tell each other.
#pragma once

#include <cstdint>

#include "jawari/parameters.h"
#include "midi/channel_message.h"

namespace jawari::host {

struct CaptureRing;
struct StagedInstrument;

/// From the control thread. Takes effect at the start of the block in which it is read, before MIDI.
struct LiveCommand {
    enum class Kind : std::uint8_t {
        SetParameter,  ///< parameter, value in its unit
        SetGain,       ///< value: factor of everything, followed within 10 ms without a click
        Panic,         ///< all sound off and controllers reset, on every channel
        Publish,       ///< instrument: of LivePlayer::publish() alone
        StartCapture,  ///< capture: of LivePlayer::start_capture() alone
        StopCapture
    };
    Kind kind = Kind::Panic;
    ParameterId parameter{};
    int channel = -1;  ///< SetParameter: 0 to 15; -1: all
    double value = 0;
    StagedInstrument* instrument = nullptr;
    CaptureRing* capture = nullptr;
};

/// From the audio thread, to be told to the player.
struct LiveNotice {
    enum class Kind : std::uint8_t {
        OverloadLevel,   ///< value: the new level (governor.h)
        NonfiniteReset,  ///< value: strings or bodies put to rest because their state was not finite
        LostCapture      ///< value: the first frames that a recording has lost: its writer is too slow
    };
    Kind kind = Kind::OverloadLevel;
    std::uint64_t frame = 0;  ///< since the player began
    double value = 0;
};

/// A message as the instrument has got it, for a monitor.
struct AppliedMessage {
    std::uint64_t frame = 0;  ///< since the player began
    ChannelMessage message;
};

}  // namespace jawari::host
