// Writes the texts of the LV2 bundle: write_turtle FOLDER [--window]. Part of the build.
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>

#include "plugin/lv2/turtle.h"

namespace {

bool write(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) std::fprintf(stderr, "write_turtle: cannot write '%s'\n", path.c_str());
    return static_cast<bool>(file);
}

}  // namespace

int main(int count, char** arguments) {
    const bool with_window = count == 3 && std::string_view(arguments[2]) == "--window";
    if (count != 2 && !with_window) {
        std::fputs("usage: write_turtle FOLDER [--window]\n", stderr);
        return 2;
    }
    const std::string folder = arguments[1];
    namespace lv2 = jawari::host::lv2;
    const bool written = write(folder + "/manifest.ttl", lv2::manifest_turtle(with_window)) &&
                         write(folder + "/jawari.ttl", lv2::plugin_turtle()) &&
                         write(folder + "/presets.ttl", lv2::presets_turtle());
    const bool whole = written && (!with_window || write(folder + "/window.ttl", lv2::window_turtle()));
    return whole ? 0 : 1;
}
