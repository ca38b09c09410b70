#include "devices/rtaudio_versions.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace jawari::host::rtaudio {

namespace {

constexpr unsigned int sides = 2;

Error device_error(std::string reason) {
    // "RtApiJack::probeDeviceOpen: the reason": where it was found is of no use to the user.
    const std::size_t place = reason.rfind(": ");
    if (reason.starts_with("RtApi") && place != std::string::npos) reason.erase(0, place + 2);
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) reason.pop_back();
    return {ErrorKind::Device, std::move(reason)};
}

/// What a call into the library comes to. RtAudio 6 returns a code, RtAudio 5 throws; the library's own
/// containers may throw with both.
template <class Call>
MaybeError attempt(RtAudio& audio, Call&& call) {
    try {
#ifdef RTAUDIO_VERSION_MAJOR
        const RtAudioErrorType type = call();
        if (type != RTAUDIO_NO_ERROR && type != RTAUDIO_WARNING) return device_error(audio.getErrorText());
#else
        (void)audio;
        call();
#endif
    } catch (const std::exception& problem) {
        return device_error(problem.what());
    }
    return std::nullopt;
}

std::vector<unsigned int> ids(RtAudio& audio) {
#ifdef RTAUDIO_VERSION_MAJOR
    return audio.getDeviceIds();
#else
    std::vector<unsigned int> numbers(audio.getDeviceCount());
    for (unsigned int i = 0; i < numbers.size(); ++i) numbers[i] = i;
    return numbers;
#endif
}

bool was_examined(const RtAudio::DeviceInfo& info) {
#ifdef RTAUDIO_VERSION_MAJOR
    return info.ID != 0;
#else
    return info.probed;
#endif
}

}  // namespace

std::unique_ptr<RtAudio> make(RtAudio::Api api) {
    try {
#ifdef RTAUDIO_VERSION_MAJOR
        // Errors come back as codes; without a receiver RtAudio 6 prints them as well.
        auto audio = std::make_unique<RtAudio>(api, [](RtAudioErrorType, const std::string&) {});
#else
        auto audio = std::make_unique<RtAudio>(api);
#endif
        audio->showWarnings(false);
        return audio;
    } catch (const std::exception&) {
        return nullptr;
    }
}

std::vector<Device> devices(RtAudio& audio) {
    std::vector<Device> found;
    try {
        for (const unsigned int id : ids(audio)) {
            const RtAudio::DeviceInfo info = audio.getDeviceInfo(id);
            if (was_examined(info)) found.push_back({id, info});
        }
    } catch (const std::exception&) {
        // A device that went away between counting and asking: the others stand.
    }
    return found;
}

MaybeError open(RtAudio& audio, unsigned int device, unsigned int rate_hz, unsigned int& frames,
                RtAudio::StreamOptions& options, RtAudioCallback callback, void* user) {
    RtAudio::StreamParameters output;
    output.deviceId = device;
    output.nChannels = sides;
    return attempt(audio, [&] {
        return audio.openStream(&output, nullptr, RTAUDIO_FLOAT64, rate_hz, &frames, callback, user,
                                &options);
    });
}

MaybeError start(RtAudio& audio) {
    return attempt(audio, [&] { return audio.startStream(); });
}

void stop(RtAudio& audio) {
    if (!audio.isStreamOpen()) return;
    if (audio.isStreamRunning()) (void)attempt(audio, [&] { return audio.abortStream(); });
    try {
        if (audio.isStreamOpen()) audio.closeStream();
    } catch (const std::exception&) {
        // The driver closed it in the meantime.
    }
}

}  // namespace jawari::host::rtaudio
