#include "base/file_plan.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "base/output_file.h"
#include "base/platform.h"
#include "base/text.h"

namespace jawari::host {

namespace {

constexpr std::size_t looked_at_bytes = 4096;

std::string first_bytes(const std::string& path) {
    const int file = platform::open_to_read(path);
    if (file < 0) return {};
    std::string bytes(looked_at_bytes, '\0');
    std::size_t size = 0;
    for (std::ptrdiff_t count = 1; count > 0 && size < bytes.size();) {
        count = platform::read_some(file, {bytes.data() + size, bytes.size() - size});
        size += static_cast<std::size_t>(std::max<std::ptrdiff_t>(count, 0));
    }
    platform::close_file(file);
    bytes.resize(size);
    return bytes;
}

template <std::size_t count>
bool starts_with_any(std::string_view bytes, const std::array<std::string_view, count>& tags) {
    return std::any_of(tags.begin(), tags.end(),
                       [bytes](std::string_view tag) { return bytes.starts_with(tag); });
}

/// Headers of the formats that libsndfile writes; RMID, a MIDI file, is a RIFF file too.
bool is_sound(std::string_view bytes) {
    using namespace std::string_view_literals;
    constexpr std::array headers{"RF64"sv, "riff"sv, "FORM"sv, "fLaC"sv, "OggS"sv, ".snd"sv, "caff"sv};
    if (bytes.starts_with("RIFF")) return bytes.substr(std::min<std::size_t>(8, bytes.size()), 4) == "WAVE";
    return starts_with_any(bytes, headers);
}

bool is_midi(std::string_view bytes) {
    return bytes.starts_with("MThd") ||
           (bytes.starts_with("RIFF") && bytes.size() >= 12 && bytes.substr(8, 4) == "RMID");
}

bool is_picture(std::string_view bytes) {
    return bytes.starts_with("\x89PNG") || bytes.find("<svg") != std::string_view::npos;
}

bool is_text(std::string_view bytes) {
    return std::none_of(bytes.begin(), bytes.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
    });
}

/// The JSON of a command: not one of the kinds that people write for it.
bool is_written_json(std::string_view bytes) {
    using namespace std::string_view_literals;
    constexpr std::array of_people{"jawari.preset/"sv, "jawari.scene/"sv, "jawari.midi-map/"sv,
                                   "jawari.play-config/"sv};
    const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos || bytes[begin] != '{') return false;
    return std::none_of(of_people.begin(), of_people.end(), [bytes](std::string_view schema) {
        return bytes.find(schema) != std::string_view::npos;
    });
}

/// First lines of the tables that `jawari simulate` and `jawari bench-latency` write.
bool is_table(std::string_view bytes) {
    return bytes.starts_with("time_s") || bytes.starts_with("preset,");
}

bool is_of_kind(std::string_view bytes, FileContent kind) {
    switch (kind) {
        case FileContent::Sound:
            return is_sound(bytes);
        case FileContent::RawSound:  // has no header: anything that is not known to be something else
            return !is_sound(bytes) && !is_midi(bytes) && !is_picture(bytes) && !is_text(bytes);
        case FileContent::Json:
            return is_written_json(bytes);
        case FileContent::Picture:
            return is_picture(bytes);
        case FileContent::Table:
            return is_table(bytes);
        case FileContent::Hdf5:
            return bytes.starts_with("\x89HDF");
        case FileContent::Midi:
            return is_midi(bytes);
        case FileContent::State:
            return bytes.starts_with("jawari.state/");
    }
    return false;
}

const char* name_of_kind(FileContent kind) {
    switch (kind) {
        case FileContent::Sound:
            return "a sound file";
        case FileContent::RawSound:
            return "headerless sound";
        case FileContent::Json:
            return "statistics as JSON";
        case FileContent::Picture:
            return "a picture";
        case FileContent::Table:
            return "a table of this command";
        case FileContent::Hdf5:
            return "an HDF5 file";
        case FileContent::Midi:
            return "a MIDI file";
        case FileContent::State:
            return "a saved state";
    }
    return "";
}

std::optional<platform::FileFacts> facts_behind(const std::string& path, bool input) {
    if (path != "-") return platform::file_facts(path);
    return platform::file_facts(input ? platform::standard_input : platform::standard_output);
}

}  // namespace

std::optional<FileIdentity> file_identity(const std::string& path, bool input) {
    if (const auto facts = facts_behind(path, input)) {
        const bool shared = facts->kind == platform::FileKind::Device ||
                            (input && facts->kind != platform::FileKind::Regular);
        if (shared) return std::nullopt;
        return FileIdentity{facts->device, facts->number, ""};
    }
    if (input) return std::nullopt;
    const std::filesystem::path target = follow_links(path);
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    const auto facts = platform::file_facts(folder.string());
    if (!facts) return std::nullopt;
    return FileIdentity{facts->device, facts->number, target.filename().string()};
}

bool may_replace(const std::string& path, FileContent kind) {
    if (path == "-") return true;
    const auto facts = platform::file_facts(path);
    if (!facts || facts->kind != platform::FileKind::Regular || facts->bytes == 0) return true;
    return is_of_kind(first_bytes(path), kind);
}

bool is_same_file(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return false;
    const auto identity = file_identity(a, false);
    return a == b || (identity && identity == file_identity(b, false));
}

void FilePlan::add_input(const std::string& what, const std::string& path) {
    if (!path.empty()) inputs_.push_back({what, path, file_identity(path, true)});
}

MaybeError FilePlan::add_output(const std::string& what, const std::string& path, FileContent kind) {
    if (path.empty()) return std::nullopt;
    const Entry output{what, path, file_identity(path, false)};
    for (const Entry& input : inputs_) {
        if (output.identity && input.identity == output.identity)
            return usage_error(
                what, path,
                "another file than that of " + input.what + ", " + printable(input.path) + ", which is read");
    }
    for (const Entry& other : outputs_) {
        const bool both_standard = path == "-" && other.path == "-";
        if (both_standard || (output.identity && other.identity == output.identity))
            return usage_error(what, path,
                               "another name than that of the other outputs, here " + other.what + " " +
                                   printable(other.path));
    }
    if (!overwrite_ && !may_replace(path, kind))
        return usage_error(what, path,
                           std::string("a new file, or ") + name_of_kind(kind) +
                               " to replace; this file is of another kind, --overwrite replaces it too");
    outputs_.push_back(output);
    return std::nullopt;
}

}  // namespace jawari::host
