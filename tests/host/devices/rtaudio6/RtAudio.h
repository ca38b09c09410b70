// What host/audio uses of RtAudio 6, declared after its header (github.com/thestk/rtaudio, RtAudio.h, version
// 6): error codes instead of exceptions, ids instead of numbers of devices. Debian 12 has RtAudio 5;
// compiling against this shows that the branch for 6 is well-formed, and nothing more. No definitions: it is
// never linked.
#pragma once

#include <functional>
#include <string>
#include <vector>

#define RTAUDIO_VERSION_MAJOR 6

using RtAudioFormat = unsigned long;
static const RtAudioFormat RTAUDIO_FLOAT64 = 0x20;
using RtAudioStreamFlags = unsigned int;
static const RtAudioStreamFlags RTAUDIO_NONINTERLEAVED = 0x1;
static const RtAudioStreamFlags RTAUDIO_SCHEDULE_REALTIME = 0x8;
using RtAudioStreamStatus = unsigned int;
static const RtAudioStreamStatus RTAUDIO_OUTPUT_UNDERFLOW = 0x2;
using RtAudioCallback = int (*)(void* output, void* input, unsigned int frames, double time,
                                RtAudioStreamStatus status, void* user);

enum RtAudioErrorType { RTAUDIO_NO_ERROR = 0, RTAUDIO_WARNING, RTAUDIO_UNKNOWN_ERROR };
using RtAudioErrorCallback = std::function<void(RtAudioErrorType type, const std::string& text)>;

class RtAudio {
  public:
    enum Api { UNSPECIFIED, MACOSX_CORE, LINUX_ALSA, UNIX_JACK, LINUX_PULSE };
    struct DeviceInfo {
        unsigned int ID{};
        std::string name;
        unsigned int outputChannels{};
        bool isDefaultOutput{false};
        std::vector<unsigned int> sampleRates;
        unsigned int preferredSampleRate{};
    };
    struct StreamParameters {
        unsigned int deviceId{};
        unsigned int nChannels{};
        unsigned int firstChannel{};
    };
    struct StreamOptions {
        RtAudioStreamFlags flags{};
        unsigned int numberOfBuffers{};
        std::string streamName;
        int priority{};
    };

    static void getCompiledApi(std::vector<RtAudio::Api>& apis);
    static std::string getApiName(RtAudio::Api api);
    static std::string getApiDisplayName(RtAudio::Api api);
    static RtAudio::Api getCompiledApiByName(const std::string& name);

    explicit RtAudio(RtAudio::Api api = UNSPECIFIED, RtAudioErrorCallback&& error = nullptr);
    ~RtAudio();
    std::vector<unsigned int> getDeviceIds();
    RtAudio::DeviceInfo getDeviceInfo(unsigned int device);
    RtAudioErrorType openStream(StreamParameters* output, StreamParameters* input, RtAudioFormat format,
                                unsigned int rate, unsigned int* frames, RtAudioCallback callback,
                                void* user = nullptr, StreamOptions* options = nullptr);
    void closeStream();
    RtAudioErrorType startStream();
    RtAudioErrorType abortStream();
    const std::string getErrorText();
    bool isStreamOpen() const;
    bool isStreamRunning() const;
    long getStreamLatency();
    unsigned int getStreamSampleRate();
    void showWarnings(bool value = true);
};
