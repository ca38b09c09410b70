#include "commands/play/play.h"

#include <array>
#include <chrono>
#include <iostream>
#include <optional>
#include <streambuf>
#include <utility>

#include "base/interrupt.h"
#include "base/platform.h"
#include "commands/play/console.h"
#include "commands/play/osc_server.h"
#include "commands/play/session.h"
#include "commands/play/session_window.h"
#include "instrument/preset_library.h"

namespace jawari::host {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds tick{10};
constexpr auto status_period = std::chrono::milliseconds(100);

/// The sound libraries write to std::cerr from threads of their own, when a server goes for instance; what
/// happened is said in one line elsewhere. Nothing else here uses std::cerr.
class MutedCerr {
  public:
    MutedCerr() : before_(std::cerr.rdbuf(&nothing_)) {}
    MutedCerr(const MutedCerr&) = delete;
    MutedCerr& operator=(const MutedCerr&) = delete;
    ~MutedCerr() { std::cerr.rdbuf(before_); }

  private:
    class Nothing : public std::streambuf {
        int overflow(int character) override { return traits_type::not_eof(character); }
        std::streamsize xsputn(const char* /*text*/, std::streamsize count) override { return count; }
    };
    Nothing nothing_;
    std::streambuf* before_;
};

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const NamedPreset& preset : named_presets()) names.push_back(preset.name);
    return names;
}

/// The loop of the control thread.
class Conductor {
  public:
    /// `osc`, `window`: null if there is none.
    Conductor(Session& session, Console& console, OscServer* osc, SessionWindow* window)
        : session_(session), console_(console), osc_(osc), window_(window) {}

    MaybeError run() {
        while (!interruption() && !is_over()) {
            wait();
            if (osc_ != nullptr)
                osc_->take_packets([this](const VerbCall& call) { return execute_remote(call); });
            take_command();
            if (auto error = session_.tick()) return error;
            if (window_ != nullptr) window_->tick();
            draw_status();
        }
        return std::nullopt;
    }

  private:
    /// After the last command of a pipe the notes that it asked for are heard to their ends.
    [[nodiscard]] bool is_over() const {
        if (window_ != nullptr) return session_.wants_to_end() || window_->is_closed();
        return session_.wants_to_end() || (console_.at_end() && !is_paused() && !session_.has_notes());
    }
    [[nodiscard]] bool is_paused() const { return paused_until_ && Clock::now() < *paused_until_; }

    void wait() {
        const int commands = is_paused() ? -1 : console_.descriptor();
        std::array<platform::Input, 2> inputs{{{commands}, {osc_ == nullptr ? -1 : osc_->descriptor()}}};
        if (platform::wait_for_input(inputs, tick) && inputs[0].ready) console_.take_input();
    }

    void take_command() {
        if (is_paused()) return;
        if (paused_until_) {
            paused_until_.reset();
            console_.finished();
        }
        const auto line = console_.next_line();
        if (!line) return;
        const auto call = parse_line(*line);
        if (!call)
            console_.say(call.error().message);
        else if (call.value())
            execute(*call.value());
        if (!paused_until_) console_.finished();
    }

    void execute(const VerbCall& call) {
        const auto reply = session_.execute(call);
        if (!reply) {
            console_.say(reply.error().message);
            return;
        }
        console_.answer(reply.value().lines);
        if (reply.value().pause_s > 0)
            paused_until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                               std::chrono::duration<double>(reply.value().pause_s));
    }

    Outcome<VerbReply> execute_remote(const VerbCall& call) {
        if (call.verb->id == VerbId::Wait)
            return Error{ErrorKind::Usage, "wait: for the shell and pipes alone"};
        return session_.execute(call);
    }

    void draw_status() {
        if (!console_.draws_status() || Clock::now() - status_drawn_ < status_period) return;
        status_drawn_ = Clock::now();
        console_.draw_status(status_text(session_.status(), Console::columns()));
    }

    Session& session_;
    Console& console_;
    OscServer* osc_;
    SessionWindow* window_;
    std::optional<Clock::time_point> paused_until_;
    Clock::time_point status_drawn_;
};

}  // namespace

MaybeError play(const PlayOptions& options) {
    const auto whole = with_config_file(options);
    if (!whole) return whole.error();
    const PlayOptions& wanted = whole.value();
    if (auto error = check_options(wanted)) return error;
    std::optional<OscServer> osc;
    if (wanted.osc_port) {
        auto server = OscServer::open(wanted.osc_host.value_or(play_defaults::osc_host), *wanted.osc_port);
        if (!server) return server.error();
        osc.emplace(std::move(server.value()));
    }
    const MutedCerr muted;
    std::unique_ptr<Console> console;
    std::unique_ptr<SessionWindow> window;
    const auto say = [&console, &window](const std::string& line) {
        if (window) window->tell(line);
        if (console)
            console->say(line);
        else
            report(line);
    };
    Session session(wanted, say);
    if (auto error = session.open()) return error;
    if (wanted.window.value_or(false)) {
        auto opened = SessionWindow::open(session);
        if (!opened) return opened.error();
        window = std::move(opened.value());
    }
    console = std::make_unique<Console>(wanted.shell.value_or(true), preset_names);
    auto error = Conductor(session, *console, osc ? &*osc : nullptr, window.get()).run();
    window.reset();
    console.reset();
    if (auto failed = session.close(); failed && !error) return failed;
    return error;
}

}  // namespace jawari::host
