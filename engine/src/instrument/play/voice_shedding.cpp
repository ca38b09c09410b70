// Ends released voices early, for hosts that must not be late.
#include "instrument/voice/voice.h"
#include "jawari/instrument/qualities.h"

namespace jawari {

namespace {

/// Output frames in which no open string begins to answer after one had to stop.
constexpr std::uint64_t frames_without_answers = 48000;

/// Open strings that answer go first.
bool fade_answering(InstrumentState& state) {
    bool faded = false;
    for (InstrumentStringState& string : state.strings) {
        for (Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Answering || voice.fading) continue;
            fade_voice(voice);
            faded = true;
        }
    }
    if (faded) state.bridge.answers_from = state.frame + frames_without_answers;
    return faded;
}

}  // namespace

bool fade_oldest_released(InstrumentState& state) JAWARI_REALTIME {
    if (fade_answering(state)) return true;
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
