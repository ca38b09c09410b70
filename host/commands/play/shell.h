// The terminal while one plays: a status line, below it a prompt with history and completion. Driven by the
// control thread, one key at a time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "commands/play/completion.h"

namespace jawari::host {

class Shell {
  public:
    /// Standard input and output are a terminal.
    static bool is_possible();

    explicit Shell(PresetNames presets);
    Shell(const Shell&) = delete;
    Shell& operator=(const Shell&) = delete;
    /// Gives the terminal back as it was.
    ~Shell();

    /// Reads what was typed; call it when standard input is readable. A finished line, or nothing. Between a
    /// line and resume() the terminal is an ordinary one.
    std::optional<std::string> take_input();
    void resume();

    /// Ctrl-D on an empty line, or the terminal is gone.
    [[nodiscard]] bool at_end() const;

    /// Takes status line and prompt away, for something to be printed, and puts them back.
    void hide();
    void show();

    void draw_status(const std::string& text);

  private:
    struct Editor;
    std::unique_ptr<Editor> editor_;
};

}  // namespace jawari::host
