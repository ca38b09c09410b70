#include "commands/play/shell.h"

#include <histedit.h>

#include <chrono>
#include <clocale>
#include <cstdio>
#include <cwchar>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/platform.h"

namespace jawari::host {

namespace {

constexpr const char* prompt_text = "jawari> ";
constexpr int history_length = 500;
/// A key that sends several bytes sends them at once; a lone Escape must not hold the control thread.
constexpr std::chrono::milliseconds key_rest{50};
constexpr wchar_t abandon_key = 7;  // Ctrl-G

std::string history_path() {
    const std::string base = platform::user_folder(platform::UserFolder::State);
    return base.empty() ? base : base + "/jawari/history";
}

std::size_t terminal_columns() {
    return platform::terminal_columns(platform::standard_output).value_or(80);
}

/// Columns of UTF-8 text: its characters.
std::size_t characters(std::string_view text) {
    std::size_t count = 0;
    for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1U : 0U;
    return count;
}

char* prompt(EditLine* /*editor*/) {
    static std::string text = prompt_text;
    return text.data();
}

/// One character from the terminal. The first byte is there already; the rest must follow soon.
int read_character(EditLine* /*editor*/, wchar_t* character) {
    std::mbstate_t state{};
    for (;;) {
        platform::Input input{platform::standard_input};
        if (!platform::wait_for_input({&input, 1}, key_rest)) {
            *character = abandon_key;
            return 1;
        }
        char byte = 0;
        if (platform::read_some(platform::standard_input, {&byte, 1}) != 1) return 0;
        const std::size_t length = std::mbrtowc(character, &byte, 1, &state);
        if (length == static_cast<std::size_t>(-2)) continue;
        if (length == static_cast<std::size_t>(-1)) *character = abandon_key;
        return 1;
    }
}

}  // namespace

struct Shell::Editor {
    EditLine* line = nullptr;
    History* history = nullptr;
    PresetNames presets;
    std::string history_file;
    std::string status;
    bool ended = false;
    bool shown = false;
    bool busy = false;  ///< between a line and resume()

    [[nodiscard]] std::size_t rows_above_cursor() const {
        const LineInfo* info = el_line(line);
        const std::string_view before(info->buffer, static_cast<std::size_t>(info->cursor - info->buffer));
        return (characters(prompt_text) + characters(before)) / terminal_columns();
    }
};

namespace {

/// Bound to the tabulator key.
unsigned char complete(EditLine* line, int /*key*/) {
    PresetNames* presets = nullptr;
    el_get(line, EL_CLIENTDATA, &presets);
    const LineInfo* info = el_line(line);
    const std::string_view before(info->buffer, static_cast<std::size_t>(info->cursor - info->buffer));
    const std::vector<std::string> words = completions(before, *presets);
    if (words.empty()) return CC_ERROR;
    const std::string_view typed = last_word(before);
    std::string more = common_start(words).substr(typed.size());
    if (words.size() == 1) more += ' ';
    if (!more.empty()) return el_insertstr(line, more.c_str()) == 0 ? CC_REFRESH : CC_ERROR;
    std::fputs("\r\n", stdout);
    for (const std::string& word : words) std::printf("%s  ", word.c_str());
    std::fputs("\r\n\r\n", stdout);  // the second line is the status line's
    return CC_REDISPLAY;
}

}  // namespace

bool Shell::is_possible() {
    return platform::is_terminal(platform::standard_input) &&
           platform::is_terminal(platform::standard_output);
}

Shell::Shell(PresetNames presets) : editor_(std::make_unique<Editor>()) {
    std::setlocale(LC_CTYPE, "");  // NOLINT(concurrency-mt-unsafe): before any thread
    Editor& editor = *editor_;
    editor.presets = std::move(presets);
    editor.line = el_init("jawari", stdin, stdout, stderr);
    editor.history = history_init();
    HistEvent event{};
    history(editor.history, &event, H_SETSIZE, history_length);
    history(editor.history, &event, H_SETUNIQUE, 1);
    editor.history_file = history_path();
    if (!editor.history_file.empty()) history(editor.history, &event, H_LOAD, editor.history_file.c_str());
    el_set(editor.line, EL_EDITOR, "emacs");
    el_set(editor.line, EL_PROMPT, &prompt);
    el_set(editor.line, EL_HIST, &history, editor.history);
    el_set(editor.line, EL_GETCFN, &read_character);
    el_set(editor.line, EL_CLIENTDATA, &editor.presets);
    el_set(editor.line, EL_ADDFN, "jawari-complete", "completes commands, presets and parameters", &complete);
    el_set(editor.line, EL_BIND, "^I", "jawari-complete", nullptr);
    el_set(editor.line, EL_BIND, "^R", "em-inc-search-prev", nullptr);
    resume();
}

Shell::~Shell() {
    hide();
    el_set(editor_->line, EL_UNBUFFERED, 0);
    if (!editor_->history_file.empty()) {
        std::error_code ignored;
        std::filesystem::create_directories(std::filesystem::path(editor_->history_file).parent_path(),
                                            ignored);
        HistEvent event{};
        history(editor_->history, &event, H_SAVE, editor_->history_file.c_str());
    }
    history_end(editor_->history);
    el_end(editor_->line);
}

void Shell::resume() {
    std::printf("%s\n", editor_->status.c_str());
    std::fflush(stdout);
    el_set(editor_->line, EL_UNBUFFERED, 1);  // draws the prompt
    editor_->shown = true;
    editor_->busy = false;
}

std::optional<std::string> Shell::take_input() {
    int count = 0;
    const char* text = el_gets(editor_->line, &count);
    if (text == nullptr || count <= 0) {
        // Nothing yet, or the terminal is gone: then it stays readable without a character.
        platform::Input input{platform::standard_input};
        if (platform::wait_for_input({&input, 1}, std::chrono::milliseconds(0)) && input.hung_up)
            editor_->ended = true;
        return std::nullopt;
    }
    const std::string line(text, static_cast<std::size_t>(count));
    if (line == "\x04") editor_->ended = true;
    if (line.back() != '\n' && line.back() != '\r') return std::nullopt;
    HistEvent event{};
    if (line.find_first_not_of(" \t\r\n") != std::string::npos)
        history(editor_->history, &event, H_ENTER, line.c_str());
    el_set(editor_->line, EL_UNBUFFERED, 0);
    editor_->shown = false;
    editor_->busy = true;
    return line;
}

bool Shell::at_end() const {
    return editor_->ended;
}

void Shell::hide() {
    if (!editor_->shown) return;
    std::printf("\r\x1b[%zuA\x1b[J", editor_->rows_above_cursor() + 1);
    std::fflush(stdout);
    editor_->shown = false;
}

void Shell::show() {
    if (editor_->shown || editor_->busy) return;
    std::printf("%s\n", editor_->status.c_str());
    std::fflush(stdout);
    el_set(editor_->line, EL_REFRESH);
    editor_->shown = true;
}

void Shell::draw_status(const std::string& text) {
    editor_->status = text;
    if (!editor_->shown) return;
    std::printf(
        "\x1b"
        "7\x1b[%zuA\r%s\x1b[K\x1b"
        "8",
        editor_->rows_above_cursor() + 1, text.c_str());
    std::fflush(stdout);
}

}  // namespace jawari::host
