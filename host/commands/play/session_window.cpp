#include "commands/play/session_window.h"

#include <chrono>
#include <utility>

#include "instrument/preset_library.h"

namespace jawari::host {

Outcome<std::unique_ptr<SessionWindow>> SessionWindow::open(Session& session) {
    std::unique_ptr<SessionWindow> made(new SessionWindow(session));
    made->follow_preset();
    window::WindowRequest request;
    request.title = "Jawari: " + made->preset_.name;
    auto opened = window::open_window(request, *made);
    if (!opened) return opened.error();
    made->window_ = std::move(opened.value());
    made->window_->show();
    return made;
}

SessionWindow::~SessionWindow() {
    window_.reset();
    if (compiling_.valid()) compiling_.wait();
}

void SessionWindow::tick() {
    take_compiled();
    follow_preset();
    window_->idle();
}

void SessionWindow::tell(const std::string& line) {
    constexpr std::size_t most_lines = 16;
    if (lines_.size() < most_lines) lines_.push_back(line);
}

std::optional<std::string> SessionWindow::notice() {
    if (lines_.empty()) return std::nullopt;
    std::string line = std::move(lines_.front());
    lines_.pop_front();
    return line;
}

// ---------------------------------------------------------------------------------------------- parameters

double SessionWindow::value(ParameterId parameter) const {
    return session_.control().player().parameter(parameter);
}

bool SessionWindow::can_edit(ParameterId parameter) const {
    return parameter != ParameterId::BendRange;  // MIDI's alone while somebody plays
}

void SessionWindow::edit(ParameterId parameter, double value) {
    if (const auto error = session_.control().set_parameter(parameter, value)) tell(error->message);
}

// ---------------------------------------------------------------------------------------------- presets

/// The shell, OSC and program changes choose presets too.
void SessionWindow::follow_preset() {
    const SharedInstrument& playing = session_.control().player().instrument();
    if (playing == preset_.instrument) return;
    preset_.instrument = playing;
    preset_.name = session_.control().preset();
    const auto text = preset_text(preset_.name);
    preset_.text = text ? text.value() : std::string();
    preset_.edited = false;
    preset_.version += 1;
    if (window_ != nullptr) window_->set_title("Jawari: " + preset_.name);
}

void SessionWindow::begin(Wish wish) {
    if (compiling_.valid()) {
        next_ = std::move(wish);
        return;
    }
    compiling_ = std::async(std::launch::async, [wish, settings = session_.control().settings()] {
        if (wish.text) return Compiled{wish, compile_preset_text(*wish.text, wish.name, settings)};
        return Compiled{wish, load_and_compile(wish.name, settings)};
    });
}

void SessionWindow::load_preset(const std::string& name) {
    begin({name, std::nullopt});
}

void SessionWindow::edit_preset(const std::string& text) {
    begin({preset_.name, text});
}

void SessionWindow::take_compiled() {
    if (!compiling_.valid()) return;
    if (compiling_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    const Compiled compiled = compiling_.get();
    MaybeError failure;
    // The device may have come back with another rate meanwhile.
    const bool fits = !compiled.instrument ||
                      compiled.instrument.value()->model.output_rate_hz == session_.control().rate_hz();
    if (!compiled.instrument)
        failure = compiled.instrument.error();
    else if (fits)
        failure = session_.control().play_compiled(compiled.wish.name, compiled.instrument.value());
    else
        next_ = compiled.wish;
    if (failure) {
        tell(failure->message);
    } else if (fits && compiled.wish.text) {
        preset_.instrument = compiled.instrument.value();
        preset_.text = *compiled.wish.text;
        preset_.edited = true;
        preset_.version += 1;
    }
    if (next_) begin(*std::exchange(next_, std::nullopt));
}

window::PerformanceFacts SessionWindow::facts() {
    window::PerformanceFacts facts;
    facts.quality_level = session_.latest().overload_level;
    facts.adapts = session_.control().settings().lower_qualities;
    facts.compiling = compiling_.valid();
    facts.runs = session_.sounds();
    return facts;
}

}  // namespace jawari::host
