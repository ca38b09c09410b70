#include "base/output_file.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "base/platform.h"

namespace jawari::host {

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 18U;

}  // namespace

std::string follow_links(const std::string& path) {
    constexpr int most_links = 40;  // as Linux has it; a longer chain, or a ring, fails when it is opened
    std::filesystem::path at = path;
    for (int i = 0; i < most_links; ++i) {
        std::error_code none;
        const auto target = std::filesystem::read_symlink(at, none);
        if (none) break;
        at = target.is_absolute() ? target : at.parent_path() / target;
    }
    return at.string();
}

Outcome<OutputFile> OutputFile::create(const std::string& path) {
    OutputFile file;
    file.path_ = path;
    if (path == "-") {
        file.path_ = "standard output";
        file.descriptor_ = platform::duplicate(platform::standard_output);
        if (file.descriptor_ < 0) return file_error(file.path_, errno);
        return file;
    }
    const auto facts = platform::file_facts(path);
    if (facts && facts->kind != platform::FileKind::Regular) {
        if (facts->kind == platform::FileKind::Folder) return file_error(path, EISDIR);
        file.descriptor_ = platform::open_to_write(path);
        if (file.descriptor_ < 0) return file_error(path, errno);
        return file;
    }
    if (auto error = file.create_temporary()) return *error;
    return file;
}

MaybeError OutputFile::create_temporary() {
    if (path_.empty() || path_.back() == '/') return file_error(path_, path_.empty() ? ENOENT : EISDIR);
    final_path_ = follow_links(path_);
    const auto old = platform::file_facts(final_path_);
    if (!old && errno != ENOENT) return file_error(path_, errno);
    if (old && !platform::may_write(final_path_)) return file_error(path_, errno);

    const auto directory = std::filesystem::path(final_path_).parent_path();
    std::string name =
        ((directory.empty() ? std::filesystem::path(".") : directory) / ".jawari-XXXXXX").string();
    descriptor_ = platform::create_temporary_file(name);
    if (descriptor_ < 0) return file_error(path_, errno);
    temporary_path_ = name;
    guard_ = TemporaryFileGuard(temporary_path_);
    // As the old file, or as a new one would be: a temporary one is stricter than users expect of an output.
    if (!platform::set_permissions(descriptor_, old ? old->permissions : platform::ordinary_permissions()))
        return file_error(path_, errno);
    return std::nullopt;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      final_path_(std::move(other.final_path_)),
      temporary_path_(std::exchange(other.temporary_path_, {})),
      guard_(std::move(other.guard_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      buffer_(std::exchange(other.buffer_, {})) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    if (this == &other) return *this;
    discard();
    path_ = std::move(other.path_);
    final_path_ = std::move(other.final_path_);
    temporary_path_ = std::exchange(other.temporary_path_, {});
    guard_ = std::move(other.guard_);
    descriptor_ = std::exchange(other.descriptor_, -1);
    buffer_ = std::exchange(other.buffer_, {});
    return *this;
}

MaybeError OutputFile::write(std::string_view text) {
    buffer_ += text;
    return buffer_.size() >= buffer_bytes ? flush() : std::nullopt;
}

MaybeError OutputFile::flush() {
    std::string_view left = buffer_;
    while (!left.empty()) {
        const std::ptrdiff_t written = platform::write_some(descriptor_, left);
        if (written < 0 && errno == EINTR) {
            if (auto stop = interruption()) return stop;
            continue;
        }
        if (written < 0) return file_error(path_, errno);
        left.remove_prefix(static_cast<std::size_t>(written));
    }
    buffer_.clear();
    return std::nullopt;
}

MaybeError OutputFile::commit() {
    if (auto error = flush()) return error;
    if (seekable() && !platform::flush_to_disk(descriptor_)) return file_error(path_, errno);
    if (!platform::close_file(std::exchange(descriptor_, -1))) return file_error(path_, errno);
    if (!seekable()) return std::nullopt;
    if (std::rename(temporary_path_.c_str(), final_path_.c_str()) != 0) return file_error(path_, errno);
    guard_.forget();
    temporary_path_.clear();
    return std::nullopt;
}

void OutputFile::discard() noexcept {
    if (descriptor_ >= 0) platform::close_file(std::exchange(descriptor_, -1));
    if (!temporary_path_.empty()) platform::remove_file(temporary_path_.c_str());
    temporary_path_.clear();
    guard_.forget();
}

MaybeError make_folder(const std::string& path) {
    std::error_code failed;
    const auto folder = std::filesystem::path(path.ends_with('/') ? path.substr(0, path.size() - 1) : path);
    if (folder.empty() || std::filesystem::is_directory(folder, failed)) return std::nullopt;
    failed.clear();
    std::filesystem::create_directory(folder, failed);
    if (failed) return file_error(path, failed.value());
    return std::nullopt;
}

bool is_folder(const std::string& path) {
    std::error_code ignored;
    return path.ends_with('/') || std::filesystem::is_directory(path, ignored);
}

}  // namespace jawari::host
