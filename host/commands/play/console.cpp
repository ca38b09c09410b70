#include "commands/play/console.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include "base/platform.h"
#include "base/text.h"

namespace jawari::host {

namespace {

constexpr std::size_t longest_line = 4096;

/// A pipe, a socket or a file. Services have /dev/null, which is none of them and gives no commands.
bool is_piped() {
    const auto facts = platform::file_facts(platform::standard_input);
    return facts && (facts->kind == platform::FileKind::Pipe || facts->kind == platform::FileKind::Regular);
}

void write_line(std::FILE* stream, const std::string& line) {
    const std::string text = printable(line) + "\n";
    std::fwrite(text.data(), 1, text.size(), stream);
    std::fflush(stream);
}

}  // namespace

Console::Console(bool commands, PresetNames presets) {
    if (commands && Shell::is_possible()) {
        shell_ = std::make_unique<Shell>(std::move(presets));
    } else if (platform::is_terminal(platform::standard_error)) {
        status_on_error_ = true;
    }
    if (shell_ || (commands && is_piped())) descriptor_ = platform::standard_input;
    had_commands_ = descriptor_ >= 0;
}

Console::~Console() {
    hide();
}

std::size_t Console::columns() {
    const std::size_t columns = platform::terminal_columns(platform::standard_error).value_or(80);
    return columns < 2 ? 79 : columns - 1;
}

void Console::hide() {
    if (shell_) shell_->hide();
    if (!status_drawn_) return;
    std::fputs("\r\x1b[K", stderr);
    status_drawn_ = false;
}

void Console::show() {
    if (shell_) shell_->show();
    if (status_on_error_) draw_status(status_);
}

void Console::say(const std::string& line) {
    hide();
    write_line(stderr, line);
    show();
}

void Console::answer(const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    hide();
    for (const std::string& line : lines) write_line(stdout, line);
    show();
}

void Console::draw_status(const std::string& text) {
    status_ = text;
    if (shell_) shell_->draw_status(text);
    if (!status_on_error_ || text.empty()) return;
    std::fprintf(stderr, "\r%s\x1b[K", text.c_str());
    std::fflush(stderr);
    status_drawn_ = true;
}

void Console::take_input() {
    if (!shell_) {
        take_piped();
        return;
    }
    if (auto line = shell_->take_input()) lines_.push_back(std::move(*line));
    if (shell_->at_end()) descriptor_ = -1;
}

void Console::take_piped() {
    std::array<char, 4096> bytes{};
    const std::ptrdiff_t count = platform::read_some(platform::standard_input, bytes);
    if (count < 0) return;  // a signal came
    unfinished_.append(bytes.data(), static_cast<std::size_t>(count));
    for (std::size_t end = unfinished_.find('\n'); end != std::string::npos; end = unfinished_.find('\n')) {
        lines_.push_back(unfinished_.substr(0, std::min(end, longest_line)));
        unfinished_.erase(0, end + 1);
    }
    if (count == 0) {
        if (!unfinished_.empty()) lines_.push_back(std::exchange(unfinished_, {}));
        descriptor_ = -1;
    }
    if (unfinished_.size() > longest_line) unfinished_.resize(longest_line);
}

std::optional<std::string> Console::next_line() {
    if (lines_.empty()) return std::nullopt;
    std::string line = std::move(lines_.front());
    lines_.pop_front();
    return line;
}

void Console::finished() {
    if (shell_) shell_->resume();
}

}  // namespace jawari::host
