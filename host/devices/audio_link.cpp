#include "devices/audio_link.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include "base/text.h"
#include "devices/audio_devices.h"

namespace jawari::host {

namespace {

std::string milliseconds(double frames, double rate_hz) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f ms", 1000 * frames / rate_hz);
    return text.data();
}

}  // namespace

MaybeError AudioLink::open_system(const std::string& system) {
    auto stream = AudioStream::open({system, wish_.device, wish_.rate_hz, wish_.frames});
    if (!stream) return stream.error();
    stream_ = std::move(stream.value());
    facts_ = stream_->facts();
    health_ = {};
    state_ = StreamState::Running;
    priority_told_ = false;
    return std::nullopt;
}

MaybeError AudioLink::open() {
    const std::vector<std::string> built_in = audio_systems();
    const bool automatic = wish_.system == "auto";
    if (!automatic && std::find(built_in.begin(), built_in.end(), wish_.system) == built_in.end())
        return Error{ErrorKind::Device,
                     "audio: " + wish_.system + ": not built in (built in: " + join(built_in) + ")"};
    std::vector<std::string> reasons;
    for (const std::string& system : automatic ? built_in : std::vector<std::string>{wish_.system}) {
        const auto error = open_system(system);
        if (!error) {
            for (const std::string& reason : reasons) report_("audio: " + reason);
            describe();
            return std::nullopt;
        }
        reasons.push_back(system + ": " + error->message);
    }
    return Error{ErrorKind::Device,
                 "audio: " + (reasons.empty() ? "no system is built in" : join(reasons, "; "))};
}

void AudioLink::describe() {
    report_("audio: " + facts_.system + ": " + in_quotes(facts_.device) + ", " +
            std::to_string(facts_.rate_hz) + " Hz, blocks of " + std::to_string(facts_.frames) + " frames (" +
            milliseconds(facts_.frames, facts_.rate_hz) + ")");
    if (facts_.rate_hz != wish_.rate_hz)
        report_("notice: audio: the device runs at " + std::to_string(facts_.rate_hz) + " Hz, not at " +
                std::to_string(wish_.rate_hz) + "; so does the instrument");
    if (wish_.frames_matter && facts_.frames != wish_.frames)
        report_("notice: audio: the device takes blocks of " + std::to_string(facts_.frames) +
                " frames, not of " + std::to_string(wish_.frames));
}

MaybeError AudioLink::start(AudioRender render, void* player) {
    if (auto error = stream_->start(render, player)) {
        stream_.reset();
        return Error{error->kind, "audio: " + facts_.system + ": " + error->message};
    }
    facts_ = stream_->facts();
    return std::nullopt;
}

bool AudioLink::reopen() {
    if (open_system(facts_.system)) return false;
    describe();
    return true;
}

StreamState AudioLink::check(double now_s) {
    if (!stream_) return StreamState::Lost;
    const AudioCounters& counters = stream_->counters();
    const int priority = counters.real_time_priority.load(std::memory_order_relaxed);
    if (!priority_told_ && priority >= 0) {
        priority_told_ = true;
        report_(priority > 0
                    ? "audio: real-time priority " + std::to_string(priority)
                    : "notice: audio: no real-time priority for the audio thread, other programs may "
                      "disturb it (docs/commands/play.md)");
    }
    const std::uint64_t frames = counters.frames.load(std::memory_order_relaxed);
    const StreamState state =
        look(health_, stream_->is_open(), frames, facts_.rate_hz, facts_.system == "jack", now_s);
    if (state == StreamState::Silent && state_ == StreamState::Running)
        report_("warning: audio: " + facts_.system + " asks for no sound any more");
    if (state == StreamState::Running && state_ == StreamState::Silent)
        report_("audio: sound is asked for again");
    if (state == StreamState::Lost) stream_.reset();
    state_ = state;
    return state;
}

}  // namespace jawari::host
