#include "base/input_file.h"

#include <algorithm>
#include <cerrno>

#include "base/interrupt.h"
#include "base/platform.h"

namespace jawari::host {

namespace {

Outcome<std::string> read_all(int file, const std::string& path, std::size_t longest) {
    std::string text;
    for (;;) {
        const std::size_t old_size = text.size();
        const std::size_t room = std::min(longest + 1 - old_size, std::size_t{1} << 16U);
        text.resize(old_size + room);
        const std::ptrdiff_t count = platform::read_some(file, {text.data() + old_size, room});
        if (count < 0 && errno != EINTR) return file_error(path, errno);
        if (auto stop = interruption()) return *stop;
        text.resize(old_size + static_cast<std::size_t>(std::max<std::ptrdiff_t>(count, 0)));
        if (count == 0) return text;
        if (text.size() > longest)
            return Error{ErrorKind::InvalidInput, path + ": the file is too long (allowed: at most " +
                                                      std::to_string(longest) + " bytes)"};
    }
}

}  // namespace

Outcome<std::string> read_file(const std::string& path, std::size_t longest) {
    if (path == "-") return read_all(platform::standard_input, "standard input", longest);
    const int file = platform::open_to_read(path);
    if (file < 0) return file_error(path, errno);
    auto text = read_all(file, path, longest);
    platform::close_file(file);
    return text;
}

bool path_exists(const std::string& path) {
    return platform::file_facts(path) || errno != ENOENT;
}

}  // namespace jawari::host
