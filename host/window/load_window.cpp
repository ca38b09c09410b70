#include "window/load_window.h"

#include <array>
#include <string>
#include <vector>

#include "base/platform.h"

namespace jawari::host::window {

namespace {

std::string folder_of(const std::string& path) {
    const auto slash = path.find_last_of('/');
    return slash == std::string::npos ? "." : path.substr(0, slash);
}

std::string module_path() {
    // The address tells programs, plugins and tests apart, which all have this code.
    const std::string own = platform::path_of_code(reinterpret_cast<const void*>(&module_path));
    const std::string folder = folder_of(own.empty() ? platform::own_path() : own);
    for (const std::string& place : {folder, folder + "/../lib/jawari"}) {
        std::string path = place + "/" + module_file;
        if (platform::file_facts(path)) return path;
    }
    return {};
}

using Trouble = std::array<char, 256>;

struct Entry {
    void (*function)() = nullptr;  ///< null: there is none
    std::string trouble;
};

Entry entry_of(const char* symbol) {
    const std::string path = module_path();
    if (path.empty()) return {nullptr, std::string("window: ") + module_file + " is not installed"};
    const auto loaded = platform::load_function(path, symbol);
    return {loaded.found, "window: " + loaded.trouble};
}

}  // namespace

bool has_window_module() {
    return !module_path().empty();
}

MaybeError display_trouble() {
    const Entry entry = entry_of(find_display_symbol);
    if (entry.function == nullptr) return Error{ErrorKind::Device, entry.trouble};
    Trouble trouble{};
    const auto find = reinterpret_cast<FindDisplayFunction>(entry.function);
    if (find(trouble.data(), trouble.size())) return std::nullopt;
    return Error{ErrorKind::Device, std::string("window: ") + trouble.data()};
}

Outcome<std::unique_ptr<Window>> open_window(const WindowRequest& request, Performance& performance) {
    const Entry entry = entry_of(open_window_symbol);
    if (entry.function == nullptr) return Error{ErrorKind::Device, entry.trouble};
    Trouble trouble{};
    const auto open = reinterpret_cast<OpenWindowFunction>(entry.function);
    std::unique_ptr<Window> opened(open(request, performance, trouble.data(), trouble.size()));
    if (opened == nullptr) return Error{ErrorKind::Device, std::string("window: ") + trouble.data()};
    return opened;
}

}  // namespace jawari::host::window
