#include "devices/quiet.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string_view>
#include <utility>

#include "base/text.h"

namespace jawari::host {

QuietStandardError::QuietStandardError() : collected_(memfd_create("jawari-quiet", MFD_CLOEXEC)) {
    std::fflush(stderr);
    if (collected_ < 0) return;
    saved_ = dup(STDERR_FILENO);
    if (saved_ >= 0) dup2(collected_, STDERR_FILENO);
}

void QuietStandardError::restore() {
    std::fflush(stderr);
    if (saved_ >= 0) {
        dup2(saved_, STDERR_FILENO);
        close(std::exchange(saved_, -1));
    }
    if (collected_ >= 0) close(std::exchange(collected_, -1));
}

std::string QuietStandardError::text() const {
    std::string text(4096, '\0');
    const ssize_t length = collected_ < 0 ? 0 : pread(collected_, text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
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
