#include "base/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/interrupt.h"

namespace jawari::host {

namespace {

Outcome<std::string> read_all(int descriptor, const std::string& path, std::size_t longest) {
    std::string text;
    for (;;) {
        const std::size_t old_size = text.size();
        const std::size_t room = std::min(longest + 1 - old_size, std::size_t{1} << 16U);
        text.resize(old_size + room);
        const ssize_t count = ::read(descriptor, text.data() + old_size, room);
        if (count < 0 && errno != EINTR) return file_error(path, errno);
        if (auto stop = interruption()) return *stop;
        text.resize(old_size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        if (count == 0) return text;
        if (text.size() > longest)
            return Error{ExitCode::InvalidInput, path + ": the file is too long (allowed: at most " +
                                                     std::to_string(longest) + " bytes)"};
    }
}

}  // namespace

Outcome<std::string> read_file(const std::string& path, std::size_t longest) {
    if (path == "-") return read_all(STDIN_FILENO, "standard input", longest);
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return file_error(path, errno);
    auto text = read_all(descriptor, path, longest);
    ::close(descriptor);
    return text;
}

bool path_exists(const std::string& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 || errno != ENOENT;
}

}  // namespace jawari::host
