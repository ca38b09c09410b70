#include "report.h"

#include <cstdio>

namespace jawari::stress {
namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// Names and reasons here hold no control characters.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

std::string count_text(const char* key, std::uint64_t value) {
    return formatted(", \"%s\": %llu", key, static_cast<unsigned long long>(value));
}

std::string replay_of(const Report& report) {
    return formatted("jawari_stress --seed 0x%016llx --blocks %llu --verbose",
                     static_cast<unsigned long long>(report.seed),
                     static_cast<unsigned long long>(report.blocks));
}

std::string number_text(double value) {
    const std::string text = formatted("%.6g", value);
    return text.find_first_of("in") == std::string::npos ? text : quoted(text);  // inf, nan
}

}  // namespace

std::string json_line(const Report& report) {
    std::string line = formatted("{\"seed\": %llu", static_cast<unsigned long long>(report.seed));
    line += ", \"kind\": " + quoted(report.kind);
    if (!report.refused.empty()) line += ", \"refused\": " + quoted(report.refused);
    line += count_text("blocks", report.blocks) + count_text("frames", report.frames);
    line += count_text("strings", report.strings) + count_text("contacts", report.contacts);
    line += count_text("impulses", report.impulses) + count_text("notes", report.notes);
    line += count_text("truncated", report.truncated);
    line += formatted(", \"sound_s\": %.6g, \"cpu_s\": %.4f", report.sound_s, report.cpu_s);
    if (report.exploded) line += ", \"exploded\": true";
    line += ", \"closest\": {";
    for (std::size_t i = 0; i < invariant_count; ++i) {
        const auto invariant = static_cast<Invariant>(i);
        line += formatted("%s\"%s\": ", i == 0 ? "" : ", ", name_of(invariant)) +
                number_text(report.judge.closest(invariant));
    }
    line += "}, \"violations\": [";
    for (const Violation& v : report.judge.violations()) {
        if (&v != &report.judge.violations().front()) line += ", ";
        line += "{\"invariant\": " + quoted(name_of(v.invariant)) + ", \"where\": " + quoted(v.where) +
                ", \"found\": " + number_text(v.found) + ", \"allowed\": " + number_text(v.allowed) +
                ", \"replay\": " + quoted(replay_of(report)) + "}";
    }
    return line + "]}";
}

std::string violation_lines(const Report& report) {
    std::string lines;
    for (const Violation& v : report.judge.violations()) {
        lines += formatted("VIOLATION %s: %s, %s: %.9g, allowed %.9g; replay: ", name_of(v.invariant),
                           report.kind.c_str(), v.where.c_str(), v.found, v.allowed) +
                 replay_of(report) + "\n";
    }
    return lines;
}

}  // namespace jawari::stress
