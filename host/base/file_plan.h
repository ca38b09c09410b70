// What a command reads and writes, so that no file is written over that it reads, or twice, and no file of
// another kind is replaced unasked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace jawari::host {

/// Kinds of files that commands write.
enum class FileContent { Sound, RawSound, Json, Picture, Table, Hdf5, Midi, State };

/// The file behind a name, links followed, also where no file is yet: two names of one file compare equal.
struct FileIdentity {
    std::uint64_t device = 0, number = 0;  ///< of the file, or of its folder if it does not exist
    std::string name;                      ///< in its folder, of a file that does not exist

    friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

/// `-`: standard input or output, whichever `input` says. Nothing for what may have several users: devices
/// such as /dev/null, and pipes that are read. Nothing for inputs, and folders of outputs, that do not exist.
std::optional<FileIdentity> file_identity(const std::string& path, bool input);

/// Whether the file at `path` is missing, empty, no regular file, or such that a file of the kind may replace
/// it: of the same kind, as far as its first bytes tell. JSON that users write (presets, scenes, maps,
/// configurations) is of another kind than the JSON that commands write.
bool may_replace(const std::string& path, FileContent kind);

/// Whether two names lead to one file.
bool is_same_file(const std::string& a, const std::string& b);

class FilePlan {
  public:
    /// `overwrite`: files of any kind may be replaced, but never those that are read or written already.
    explicit FilePlan(bool overwrite) : overwrite_(overwrite) {}

    /// `what`: as the user knows it: `MIDI`, `--preset`. An empty path is no file.
    void add_input(const std::string& what, const std::string& path);

    /// Refuses the path, or keeps it for those that come after. An empty path is no file.
    MaybeError add_output(const std::string& what, const std::string& path, FileContent kind);

  private:
    struct Entry {
        std::string what, path;
        std::optional<FileIdentity> identity;
    };
    bool overwrite_;
    std::vector<Entry> inputs_, outputs_;
};

}  // namespace jawari::host
