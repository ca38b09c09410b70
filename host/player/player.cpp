#include "player/player.h"

#include <chrono>
#include <utility>

#include "player/audio_thread.h"

namespace jawari::host {

namespace {

/// 1 in the highest bit: something was asked for.
constexpr std::uint32_t asked_bit = 1U << 31U;
constexpr std::uint32_t unpitched_bit = 1U << 30U;

constexpr double most_gain = 1e6;

bool is_in_range(const LiveCommand& command) {
    if (command.channel < -1 || command.channel >= static_cast<int>(midi_channel_count)) return false;
    const ParameterDeclaration& parameter = declaration_of(command.parameter);
    return command.value >= parameter.low && command.value <= parameter.high;
}

}  // namespace

std::int64_t steady_clock_ns() noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::uint32_t pack(const ProgramRequest& request) JAWARI_REALTIME {
    return asked_bit | (request.unpitched ? unpitched_bit : 0) |
           static_cast<std::uint32_t>(request.bank) << 11U |
           static_cast<std::uint32_t>(request.channel) << 7U | static_cast<std::uint32_t>(request.program);
}

ProgramRequest unpack_program(std::uint32_t packed) {
    return {(packed & asked_bit) != 0, static_cast<int>(packed >> 7U & 15U),
            static_cast<int>(packed >> 11U & 0x3FFFU), static_cast<int>(packed & 127U),
            (packed & unpitched_bit) != 0};
}

struct LivePlayer::Shared {
    explicit Shared(const LiveSettings& live_settings)
        : settings(live_settings), audio_thread(live_settings, links) {}

    const LiveSettings settings;
    LiveLinks links;
    AudioThread audio_thread;

    // Of the control thread:
    SharedInstrument latest;
    std::size_t published = 0;  // and not yet collected
    std::vector<std::shared_ptr<CaptureRing>> captures;
};

LivePlayer::LivePlayer(const LiveSettings& settings) : shared_(std::make_unique<Shared>(settings)) {
    for (auto& channel : shared_->links.meters.parameters) {
        for (const ParameterDeclaration& parameter : parameter_table())
            channel[static_cast<std::size_t>(parameter.id)].store(parameter.neutral);
    }
}

LivePlayer::~LivePlayer() {
    shared_->audio_thread.give_back_all();
    shared_->links.commands.consume_all([](const LiveCommand& command) {
        delete command.instrument;  // NOLINT(cppcoreguidelines-owning-memory): never reached the stage
        if (command.capture != nullptr) command.capture->ended.store(true);
    });
    collect();
}

MidiPort* LivePlayer::add_port() {
    return shared_->links.inlet.add_port();
}

bool LivePlayer::publish(const SharedInstrument& instrument) {
    if (shared_->published == most_staged_instruments) return false;
    auto live = make_staged(instrument, shared_->audio_thread.stage_settings());
    LiveCommand command;
    command.kind = LiveCommand::Kind::Publish;
    command.instrument = live.get();
    if (!shared_->links.commands.push(command)) return false;
    live.release();  // NOLINT(bugprone-unused-return-value): the queue has it; collect() frees it
    shared_->published += 1;
    shared_->latest = instrument;
    return true;
}

bool LivePlayer::send(const LiveCommand& command) {
    using Kind = LiveCommand::Kind;
    if (command.kind == Kind::SetParameter && !is_in_range(command)) return false;
    if (command.kind == Kind::SetGain && !(command.value >= 0 && command.value <= most_gain)) return false;
    const bool plain =
        command.kind == Kind::SetParameter || command.kind == Kind::SetGain || command.kind == Kind::Panic;
    if (!plain) return false;
    LiveCommand sent = command;
    sent.instrument = nullptr;
    sent.capture = nullptr;
    return shared_->links.commands.push(sent);
}

bool LivePlayer::start_capture(std::shared_ptr<CaptureRing> ring) {
    LiveCommand command;
    command.kind = LiveCommand::Kind::StartCapture;
    command.capture = ring.get();
    if (!shared_->links.commands.push(command)) return false;
    shared_->captures.push_back(std::move(ring));
    return true;
}

bool LivePlayer::stop_capture() {
    LiveCommand command;
    command.kind = LiveCommand::Kind::StopCapture;
    return shared_->links.commands.push(command);
}

void LivePlayer::collect() {
    shared_->links.retired.consume_all([this](StagedInstrument* retired) {
        delete retired;  // NOLINT(cppcoreguidelines-owning-memory): made by publish()
        shared_->published -= 1;
    });
    std::erase_if(shared_->captures,
                  [](const auto& ring) { return ring->ended.load(std::memory_order_acquire); });
}

std::optional<ProgramRequest> LivePlayer::program_request() {
    const std::uint32_t packed = shared_->links.program.exchange(0, std::memory_order_acquire);
    if (packed == 0) return std::nullopt;
    return unpack_program(packed);
}

std::optional<LiveNotice> LivePlayer::notice() {
    LiveNotice next;
    if (!shared_->links.notices.pop(next)) return std::nullopt;
    return next;
}

void LivePlayer::set_monitor(bool on) noexcept {
    shared_->links.monitor.store(on, std::memory_order_relaxed);
}

std::optional<AppliedMessage> LivePlayer::applied() {
    AppliedMessage next;
    if (!shared_->links.applied.pop(next)) return std::nullopt;
    return next;
}

LiveStatistics LivePlayer::statistics() {
    LiveStatistics now = take_statistics(shared_->links.meters);
    now.dropped_messages = shared_->links.inlet.dropped();
    return now;
}

double LivePlayer::parameter(ParameterId id, int channel) const noexcept {
    const auto& values = shared_->links.meters.parameters[static_cast<std::size_t>(channel)];
    return values[static_cast<std::size_t>(id)].load(std::memory_order_relaxed);
}

const SharedInstrument& LivePlayer::instrument() const noexcept {
    return shared_->latest;
}

std::size_t LivePlayer::latency_frames() const noexcept {
    return shared_->audio_thread.limiter_frames();
}

void LivePlayer::report_xrun() noexcept {
    shared_->links.meters.xruns.fetch_add(1, std::memory_order_relaxed);
}

void LivePlayer::process(double* left, double* right, std::size_t frames,
                         std::int64_t now_ns) JAWARI_REALTIME {
    shared_->audio_thread.process(left, right, frames, now_ns);
}

}  // namespace jawari::host
