// RtAudio 5 throws and numbers devices; RtAudio 6 returns error codes and gives devices ids. Only this header
// and its source know which one it is.
#pragma once

#include <RtAudio.h>

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"

namespace jawari::host::rtaudio {

/// Null if the API cannot be used at all.
std::unique_ptr<RtAudio> make(RtAudio::Api api);

/// Ids of the devices that could be examined, with what was found.
struct Device {
    unsigned int id = 0;
    RtAudio::DeviceInfo info;
};
std::vector<Device> devices(RtAudio& audio);

/// Stereo output, doubles, sides apart. `frames`: wanted, then what the driver takes. Nothing: it is open.
MaybeError open(RtAudio& audio, unsigned int device, unsigned int rate_hz, unsigned int& frames,
                RtAudio::StreamOptions& options, RtAudioCallback callback, void* user);

MaybeError start(RtAudio& audio);

/// Ends callbacks at once, what the driver still holds is dropped. A stream that is gone already is no error.
void stop(RtAudio& audio);

}  // namespace jawari::host::rtaudio
