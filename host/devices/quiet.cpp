#include "devices/quiet.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string_view>
#include <utility>

#include "base/platform.h"
#include "base/text.h"

namespace jawari::host {

QuietStandardError::QuietStandardError() : collected_(platform::create_nameless_file()) {
    std::fflush(stderr);
    if (collected_ < 0) return;
    saved_ = platform::duplicate(platform::standard_error);
    if (saved_ >= 0) platform::redirect(platform::standard_error, collected_);
}

void QuietStandardError::restore() {
    std::fflush(stderr);
    if (saved_ >= 0) {
        platform::redirect(platform::standard_error, saved_);
        platform::close_file(std::exchange(saved_, -1));
    }
    if (collected_ >= 0) platform::close_file(std::exchange(collected_, -1));
}

std::string QuietStandardError::text() const {
    std::string text(4096, '\0');
    const std::ptrdiff_t length = collected_ < 0 ? 0 : platform::read_some_at(collected_, 0, text);
    text.resize(static_cast<std::size_t>(std::max<std::ptrdiff_t>(length, 0)));
    return text;
}

bool QuietStandardError::mentions(std::string_view part) const {
    return text().find(part) != std::string::npos;
}

std::string QuietStandardError::first_line() const {
    const std::string all = text();
    std::string_view rest = all;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
        if (std::any_of(line.begin(), line.end(), is_letter)) return printable(line);
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    }
    return {};
}

}  // namespace jawari::host
