// Files that appear whole or not at all: written under a temporary name in the same directory, then renamed.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "base/interrupt.h"

namespace jawari::host {

/// Unless commit() succeeds, the temporary file is removed and an older file of that name stays as it was.
/// An existing path that is no regular file (a device, a pipe), and `-` for standard output, are written
/// directly.
class OutputFile {
  public:
    /// Creates the temporary file, so that a path that cannot be written is known before any work is done.
    static Outcome<OutputFile> create(const std::string& path);

    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile() { discard(); }

    /// Appends through a buffer; a full disk may show here, in flush() or in commit().
    MaybeError write(std::string_view text);
    MaybeError flush();

    /// Flushes, asks the system to put everything on the disk, and gives the file its name.
    MaybeError commit();

    /// As given by the user, for messages.
    [[nodiscard]] const std::string& path() const { return path_; }
    /// For libraries that write by themselves, with seeking. Empty if the file is written directly.
    [[nodiscard]] const std::string& temporary_path() const { return temporary_path_; }
    [[nodiscard]] bool seekable() const { return !temporary_path_.empty(); }
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    OutputFile() = default;
    MaybeError create_temporary();
    void discard() noexcept;

    std::string path_;
    std::string final_path_;  // path_ with symbolic links followed: the link itself is kept
    std::string temporary_path_;
    TemporaryFileGuard guard_;
    int descriptor_ = -1;
    std::string buffer_;
};

/// Where a symbolic link leads to in the end, also if there is no file yet; else `path`.
std::string follow_links(const std::string& path);

/// Makes the folder if its own is there and it is not.
MaybeError make_folder(const std::string& path);

/// An existing folder, or a name that ends with a slash.
bool is_folder(const std::string& path);

}  // namespace jawari::host
