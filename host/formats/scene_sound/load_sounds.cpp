#include "formats/scene_sound/load_sounds.h"

#include <sndfile.h>

#include <array>
#include <filesystem>
#include <memory>

#include "base/input_file.h"
#include "base/text.h"

namespace jawari::host {

namespace {

struct Close {
    void operator()(SNDFILE* file) const { sf_close(file); }
};

std::string path_of(const Scene& scene, const std::string& sound) {
    const std::filesystem::path path(sound);
    return path.is_absolute() ? sound : (std::filesystem::path(scene.file).parent_path() / path).string();
}

MaybeError load(const Scene& scene, TimeTable& table, std::string_view kind) {
    if (table.sound.empty()) return std::nullopt;
    const std::string path = path_of(scene, table.sound);
    const auto refuse = [&](const std::string& value, const std::string& allowed) {
        return invalid_input(scene.file, {table.place + "." + std::string(kind), value, allowed});
    };
    SF_INFO info{};
    const std::unique_ptr<SNDFILE, Close> file(sf_open(path.c_str(), SFM_READ, &info));
    if (file == nullptr) return refuse(in_quotes(path), "a sound file that can be read");
    const auto channels = static_cast<std::size_t>(info.channels);
    if (table.channel >= channels)
        return invalid_input(scene.file,
                             {table.place + ".channel", std::to_string(table.channel),
                              "0 to " + std::to_string(channels - 1) + ", channels of " + in_quotes(path)});
    if (info.frames <= 0 || static_cast<std::uint64_t>(info.frames) > most_driven_frames)
        return refuse(in_quotes(path), "a sound of 1 to " + std::to_string(most_driven_frames) + " frames");
    table.rate_hz = info.samplerate;
    table.value.reserve(static_cast<std::size_t>(info.frames));
    std::vector<double> block(4096 * channels);
    while (const auto read = sf_readf_double(file.get(), block.data(), 4096)) {
        if (read < 0) break;
        for (std::size_t n = 0; n < static_cast<std::size_t>(read); ++n)
            table.value.push_back(table.scale * block[n * channels + table.channel]);
    }
    if (table.value.empty()) return refuse(in_quotes(path), "a sound file that can be read");
    table.sound.clear();
    return std::nullopt;
}

}  // namespace

void plan_sounds(const Scene& scene, FilePlan& files) {
    for (const DrivenTables& tables : scene.tables) {
        for (const ForceTable& force : tables.forces) {
            if (!force.table.sound.empty()) files.add_input("SCENE", path_of(scene, force.table.sound));
        }
        for (const MotionTable& motion : tables.motions) {
            if (!motion.table.sound.empty()) files.add_input("SCENE", path_of(scene, motion.table.sound));
        }
    }
}

MaybeError load_sounds(Scene& scene) {
    for (DrivenTables& tables : scene.tables) {
        for (ForceTable& force : tables.forces) {
            if (auto error = load(scene, force.table, "sound")) return error;
        }
        for (MotionTable& motion : tables.motions) {
            if (auto error = load(scene, motion.table, "sound")) return error;
        }
    }
    resolve_defaults(scene);
    return std::nullopt;
}

}  // namespace jawari::host
