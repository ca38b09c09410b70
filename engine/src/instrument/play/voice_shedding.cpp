// Ends released voices early, for hosts that must not be late.
#include "instrument/voice/voice.h"
#include "jawari/instrument/qualities.h"

namespace jawari {

bool fade_oldest_released(InstrumentState& state) JAWARI_REALTIME {
    Voice* oldest = nullptr;
    for (InstrumentStringState& string : state.strings) {
        if (string.busy == 0) continue;
        for (Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Damped || voice.fading) continue;
            if (oldest == nullptr || voice.age > oldest->age) oldest = &voice;
        }
    }
    if (oldest == nullptr) return false;
    fade_voice(*oldest);
    state.counters.faded_voices += 1;
    return true;
}

}  // namespace jawari
