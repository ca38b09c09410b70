#include "plot/gnuplot.h"

#include <cerrno>
#include <cstdio>
#include <memory>

#include "base/output_file.h"
#include "base/platform.h"

namespace jawari::host::plot {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, CloseFile>;

bool ends_with(std::string_view text, std::string_view end) {
    return text.size() > end.size() && text.substr(text.size() - end.size()) == end;
}

/// Length of the UTF-8 sequence at the start of `text`, 0 if there is none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    std::size_t length = 0;
    if (byte(0) < 0x80) length = 1;
    if (byte(0) >= 0xC2 && byte(0) < 0xE0) length = 2;
    if (byte(0) >= 0xE0 && byte(0) < 0xF0) length = 3;
    if (byte(0) >= 0xF0 && byte(0) < 0xF5) length = 4;
    if (length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
    }
    if (length == 3 && byte(0) == 0xE0 && byte(1) < 0xA0) return 0;   // overlong
    if (length == 3 && byte(0) == 0xED && byte(1) >= 0xA0) return 0;  // surrogates
    if (length == 4 && byte(0) == 0xF0 && byte(1) < 0x90) return 0;
    if (length == 4 && byte(0) == 0xF4 && byte(1) >= 0x90) return 0;
    return length;
}

MaybeError fill(std::FILE* file, const std::string& text) {
    if (file == nullptr || std::fwrite(text.data(), 1, text.size(), file) != text.size() ||
        std::fflush(file) != 0 || std::fseek(file, 0, SEEK_SET) != 0) {
        return file_error("temporary file for gnuplot", errno);
    }
    return {};
}

/// gnuplot repeats the command and marks the place before it says what is wrong.
std::string last_line(std::FILE* file) {
    std::fseek(file, 0, SEEK_SET);
    std::string last, line;
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
        if (c == '\n') {
            if (!line.empty()) last = std::move(line);
            line.clear();
        } else if ((c > ' ' || !line.empty()) && line.size() < 200) {
            line.push_back(static_cast<char>(c));
        }
    }
    return line.empty() ? last : line;
}

/// --default-settings: the picture does not depend on the user's start-up files.
std::vector<std::string> gnuplot_command() {
    return {"gnuplot", "--default-settings"};
}

Error cannot_start(const std::string& path, int error) {
    if (error == ENOENT) {
        return file_error(
            path, "gnuplot is not installed, and pictures are drawn by it (Debian package gnuplot-nox)");
    }
    return file_error(std::string("gnuplot"), error);
}

}  // namespace

Outcome<PictureFormat> picture_format(const std::string& path) {
    if (ends_with(path, ".svg")) return PictureFormat::Svg;
    if (ends_with(path, ".png")) return PictureFormat::Png;
    return usage_error("--plot", path, "a file name that ends in .svg or .png");
}

MaybeError can_plot(const std::string& path) {
    if (const auto format = picture_format(path); !format) return format.error();
    const int nothing = platform::open_nothing();
    if (nothing < 0) return file_error("/dev/null", errno);
    auto command = gnuplot_command();
    command.emplace_back("--version");
    const auto end = platform::run_program(command, nothing, nothing, nothing);
    platform::close_file(nothing);
    if (end.start_error != 0) return cannot_start(path, end.start_error);
    if (!end.succeeded) return file_error(path, "gnuplot does not run (`gnuplot --version` fails)");
    return {};
}

std::string quote(std::string_view text) {
    std::string result = "'";
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto first = static_cast<unsigned char>(text[0]);
        if (length == 0) {
            result += '?';
        } else if (first < 0x20 || first == 0x7F) {
            result += ' ';
        } else if (first == '\'') {
            result += "''";
        } else {
            result += text.substr(0, length);
        }
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return result + "'";
}

std::string terminal(PictureFormat format, int width, int height) {
    const std::string size = std::to_string(width) + "," + std::to_string(height);
    if (format == PictureFormat::Png) {
        return "set terminal pngcairo noenhanced background rgb 'white' font 'DejaVu Sans,12' size " + size +
               "\n";
    }
    return "set terminal svg noenhanced background rgb 'white' font 'DejaVu "
           "Sans,Helvetica,Arial,sans-serif,12' size " +
           size + "\n";
}

MaybeError draw(const std::string& path, int width, int height, const std::string& script) {
    const auto format = picture_format(path);
    if (!format) return format.error();
    auto picture = OutputFile::create(path);
    if (!picture) return picture.error();

    const TemporaryFile input(std::tmpfile()), messages(std::tmpfile());
    if (messages == nullptr) return file_error("temporary file for gnuplot", errno);
    const std::string prologue = "set encoding utf8\nset output\n";
    if (auto error = fill(input.get(), prologue + terminal(format.value(), width, height) + script))
        return error;

    const auto end =
        platform::run_program(gnuplot_command(), platform::descriptor_of(input.get()),
                              picture.value().descriptor(), platform::descriptor_of(messages.get()));
    if (end.start_error != 0) return cannot_start(path, end.start_error);
    if (auto stopped = interruption()) return stopped;
    if (!end.succeeded) return file_error(path, "gnuplot failed: " + last_line(messages.get()));
    return picture.value().commit();
}

}  // namespace jawari::host::plot
