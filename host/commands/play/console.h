// Where the player is told things and gives commands: a shell on a terminal, lines from a pipe, or neither.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/play/shell.h"

namespace jawari::host {

class Console {
  public:
    /// `commands`: whether standard input gives any.
    Console(bool commands, PresetNames presets);
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;
    ~Console();

    /// One line on standard error, whatever it contains.
    void say(const std::string& line);
    /// Lines on standard output.
    void answer(const std::vector<std::string>& lines);

    /// At most `columns()` characters; drawn on terminals only.
    void draw_status(const std::string& text);
    [[nodiscard]] bool draws_status() const { return shell_ != nullptr || status_on_error_; }
    [[nodiscard]] static std::size_t columns();

    /// -1: there are no more commands.
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Reads what is there; call it when the descriptor is readable.
    void take_input();
    /// The next line. After it was executed, call finished().
    std::optional<std::string> next_line();
    void finished();
    /// All commands have been given.
    [[nodiscard]] bool at_end() const { return had_commands_ && descriptor_ < 0 && lines_.empty(); }

  private:
    void take_piped();
    void hide();
    void show();

    bool had_commands_ = false;
    int descriptor_ = -1;
    bool status_on_error_ = false;
    bool status_drawn_ = false;
    std::string status_;
    std::string unfinished_;
    std::deque<std::string> lines_;
    std::unique_ptr<Shell> shell_;
};

}  // namespace jawari::host
