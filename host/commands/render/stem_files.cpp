#include "commands/render/stem_files.h"

#include <filesystem>
#include <set>
#include <span>
#include <utility>

#include "base/output_file.h"

namespace jawari::host {

namespace {

bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
}

}  // namespace

std::string stem_file_name(const std::string& name) {
    std::string result = name;
    for (char& c : result)
        if (!is_plain(c)) c = '-';
    return result + ".wav";
}

Outcome<StemFiles> StemFiles::create(const std::string& path, const std::vector<std::string>& names,
                                     const AudioFormat& format, FilePlan& files) {
    StemFiles stems;
    const bool folder = is_folder(path);
    const std::size_t most = folder ? most_stem_files : most_stem_channels;
    if (names.size() > most)
        return usage_error("--stems", path,
                           std::string(folder ? "one file for more than " : "a folder for more than ") +
                               std::to_string(most) + " strings, here " + std::to_string(names.size()));
    if (names.empty()) return stems;
    if (!folder) {
        auto file = AudioFile::create(path, names.size(), format);
        if (!file) return file.error();
        stems.files_.push_back(std::move(file.value()));
        return stems;
    }
    std::set<std::string> taken;
    for (const std::string& name : names) {
        std::string unique = name;
        for (int i = 2; !taken.insert(stem_file_name(unique)).second; ++i)
            unique = name + "-" + std::to_string(i);
        AudioFormat named = format;
        named.tags.title += ", " + name;
        const std::string stem = (std::filesystem::path(path) / stem_file_name(unique)).string();
        if (auto error = files.add_output("--stems", stem, FileContent::Sound)) return *error;
        auto file = AudioFile::create(stem, 1, named);
        if (!file) return file.error();
        stems.files_.push_back(std::move(file.value()));
    }
    return stems;
}

MaybeError StemFiles::write(const std::vector<std::vector<double>>& stems) {
    std::vector<std::span<const double>> channels(stems.begin(), stems.end());
    if (files_.size() == 1) return files_.front().write(channels);
    for (std::size_t i = 0; i < files_.size(); ++i) {
        if (auto error = files_[i].write(std::span(channels).subspan(i, 1))) return error;
    }
    return std::nullopt;
}

MaybeError StemFiles::commit() {
    for (AudioFile& file : files_) {
        if (auto error = file.commit()) return error;
    }
    return std::nullopt;
}

std::uint64_t StemFiles::clipped() const {
    std::uint64_t sum = 0;
    for (const AudioFile& file : files_) sum += file.clipped();
    return sum;
}

}  // namespace jawari::host
