#include "base/error.h"

#include <cstdio>
#include <cstring>

#include "base/text.h"

namespace jawari::host {

Error invalid_input(const std::string& file, const Failure& failure) {
    return {ErrorKind::InvalidInput, file + ": " + failure.line()};
}

Error usage_error(const std::string& setting, const std::string& value, const std::string& allowed) {
    return {ErrorKind::Usage, Failure{setting, value, allowed}.line()};
}

Error file_error(const std::string& path, int system_error) {
    return file_error(path, std::strerror(system_error));
}

Error file_error(const std::string& path, const std::string& reason) {
    return {ErrorKind::File, path + ": " + reason};
}

void report(const std::string& message) {
    const std::string line = printable(message) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace jawari::host
