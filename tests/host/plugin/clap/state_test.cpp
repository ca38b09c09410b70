// States and presets in a running instance.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/clap_host.h"
#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

using nlohmann::ordered_json;
using test::ClapInstance;
using test::small_preset_text;
using test::small_state;

void set(ClapInstance& one, clap_id id, double value) {
    one.events.parameter(0, id, value);
    one.params().flush(one.plugin, one.events.list(), nullptr);
    one.events.clear();
}

double loudest(const std::vector<float>& sound, std::size_t from = 0) {
    double most = 0;
    for (std::size_t n = from; n < sound.size(); ++n) most = std::max<double>(most, std::abs(sound[n]));
    return most;
}

TEST(ClapState, GoesRoundExactlyInPiecesOfAnySize) {
    for (const std::size_t part : {std::size_t{1}, std::size_t{17}, std::size_t{100000}}) {
        ClapInstance from, to;
        ASSERT_TRUE(from.load(small_state("sitar")));
        set(from, 0, 0.1234567890123456);
        set(from, 19, -0.0012345678901234);
        const std::string text = from.save(part);
        ASSERT_TRUE(to.load(text, part));
        EXPECT_EQ(to.save(), text);
        EXPECT_EQ(to.value(0), 0.1234567890123456);
        EXPECT_EQ(to.value(19), -0.0012345678901234);
    }
}

TEST(ClapState, AReopenedSessionSoundsTheSame) {
    ClapInstance before, after;
    ASSERT_TRUE(before.load(small_state("sitar")));
    set(before, 6, 0.3);
    ASSERT_TRUE(after.load(before.save()));
    for (ClapInstance* each : {&before, &after}) {
        ASSERT_TRUE(each->activate());
        each->events.note_on(0, 50, 0.8);
        each->render(3000);
    }
    EXPECT_EQ(before.left, after.left);
    EXPECT_GT(loudest(after.left), 1e-3);
}

TEST(ClapState, TheHostHearsOfValuesThatALoadHasSet) {
    ClapInstance one;
    const std::string state = one.save();
    set(one, 0, 0.5);
    ASSERT_TRUE(one.load(state));
    EXPECT_EQ(one.value(0), 1.0);
    EXPECT_EQ(one.value_rescans, 1);
    EXPECT_EQ(one.other_rescans, 0);
}

/// Whatever is refused changes neither what plays nor what is kept.
TEST(ClapState, AHostileStateIsRefusedWhole) {
    ClapInstance attacked, left_alone;
    for (ClapInstance* each : {&attacked, &left_alone}) {
        ASSERT_TRUE(each->load(small_state()));
        set(*each, 0, 0.8);
        ASSERT_TRUE(each->activate());
        each->events.note_on(0, 33, 0.9);
        each->render(1000);
    }
    const std::string kept = attacked.save();
    std::vector<std::string> hostile{"", "{", "null", std::string(100000, '['), std::string(1000, '\0')};
    for (const auto& [key, value] :
         std::vector<std::pair<const char*, ordered_json>>{{"schema", "jawari.plugin/99"},
                                                           {"parameters", {{"volume", 0.1}, {"pan", 7}}},
                                                           {"preset", {{"text", "{}"}}},
                                                           {"preset", nullptr},
                                                           {"guitar_channel", -1},
                                                           {"midi_map", "{"},
                                                           {"tuning", {{"scale", "zzz"}}},
                                                           {"quality", 3}}) {
        ordered_json state = ordered_json::parse(kept);
        state[key] = value;
        hostile.push_back(state.dump());
    }
    {
        ordered_json state = ordered_json::parse(kept);  // a preset that reads well and cannot be compiled
        ordered_json preset = ordered_json::parse(state["preset"]["text"].get<std::string>());
        preset["strings"][0]["length_m"] = -1;
        state["preset"]["text"] = preset.dump();
        state["parameters"]["volume"] = 0.1;
        hostile.push_back(state.dump());
    }
    const int told = attacked.value_rescans;
    for (const std::string& state : hostile) {
        EXPECT_FALSE(attacked.load(state)) << state.substr(0, 80);
        attacked.process(10);
        left_alone.process(10);
    }
    EXPECT_EQ(attacked.value_rescans, told);
    EXPECT_NE(attacked.log.find("length_m"), std::string::npos);
    EXPECT_EQ(attacked.save(), kept);
    attacked.render(1000);
    left_alone.render(1000);
    EXPECT_EQ(attacked.left, left_alone.left);
}

TEST(ClapState, StreamsThatFailAreRefused) {
    ClapInstance one;
    const std::string kept = one.save();
    const clap_istream_t failing{
        nullptr, [](const clap_istream_t*, void*, std::uint64_t) { return std::int64_t{-1}; }};
    const clap_istream_t lying{nullptr, [](const clap_istream_t*, void*, std::uint64_t size) {
                                   return static_cast<std::int64_t>(size) + 1;
                               }};
    const clap_istream_t endless{nullptr, [](const clap_istream_t*, void* data, std::uint64_t size) {
                                     std::memset(data, ' ', size);
                                     return static_cast<std::int64_t>(size);
                                 }};
    const auto& state = one.get<clap_plugin_state_t>(CLAP_EXT_STATE);
    for (const clap_istream_t* stream : {&failing, &lying, &endless})
        EXPECT_FALSE(state.load(one.plugin, stream));
    const clap_ostream_t full{
        nullptr, [](const clap_ostream_t*, const void*, std::uint64_t) { return std::int64_t{0}; }};
    EXPECT_FALSE(state.save(one.plugin, &full));
    EXPECT_EQ(one.save(), kept);
}

TEST(ClapState, APresetChangedWhileItSoundsRingsOut) {
    ClapInstance one;
    ASSERT_TRUE(one.load(small_state("bass-fretted")));
    ASSERT_TRUE(one.activate());
    one.events.note_on(0, 33, 0.9, 7);
    one.render(2000);
    ASSERT_TRUE(one.load(small_state("sitar")));
    one.render(2000);
    EXPECT_GT(loudest(one.left, 3000), 1e-3);  // the bass, still held
    one.events.note_on(0, 50, 0.9, 8);
    one.events.note_off(1000, 33, 7);
    one.render(4000);
    // No click: no second difference more than twice that of the bass alone.
    const auto roughest = [&](std::size_t begin, std::size_t end) {
        double most = 0;
        for (std::size_t n = begin + 2; n < end; ++n)
            most = std::max<double>(most, std::abs(one.left[n] - 2 * one.left[n - 1] + one.left[n - 2]));
        return most;
    };
    EXPECT_LT(roughest(1990, 2200), 2 * roughest(1000, 1990));
    EXPECT_EQ(nlohmann::json::parse(one.save())["preset"]["name"], "sitar");
}

TEST(ClapState, ManyChangesWithoutABlockAreNoTrouble) {
    ClapInstance one;
    ASSERT_TRUE(one.load(small_state("bass-fretted")));
    ASSERT_TRUE(one.activate());
    for (int n = 0; n < 40; ++n) ASSERT_TRUE(one.load(small_state(n % 2 == 0 ? "sitar" : "bass-slap"))) << n;
    one.process(100);
    for (int n = 0; n < 40; ++n) {
        ASSERT_TRUE(one.load(small_state(n % 2 == 0 ? "sitar" : "bass-slap"))) << n;
        one.events.note_on(0, 40, 0.8);
        one.process(100);
    }
    EXPECT_GT(loudest(one.left), 1e-3);
}

TEST(ClapState, TheSameInstrumentIsNotCompiledAgain) {
    ClapInstance one, other;
    for (ClapInstance* each : {&one, &other}) {
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
        each->events.note_on(0, 33, 0.9);
        each->render(1000);
    }
    ASSERT_TRUE(one.load(one.save()));  // as hosts do for an undo: what sounds goes on
    for (ClapInstance* each : {&one, &other}) {
        each->events.note_on(10, 33, 0.9);  // on the string that sounds, not on one of another instrument
        each->render(1000);
    }
    EXPECT_EQ(one.left, other.left);
}

TEST(ClapRender, OfflineItIsComputedAtStudioQuality) {
    ordered_json preset = ordered_json::parse(small_preset_text("bass-fretted"));
    preset["studio"] = {{"contact_rate_min_hz", 192000}, {"mode_limit_hz", 6000}};
    ordered_json as_studio = preset;
    as_studio["contact_rate_min_hz"] = 192000;
    as_studio["mode_limit_hz"] = 6000;
    const auto state = [](const ordered_json& text) {
        return ordered_json{{"schema", "jawari.plugin/1"}, {"preset", {{"text", text.dump()}}}}.dump();
    };
    const auto sound = [&](const std::string& text, bool offline, bool while_active) {
        ClapInstance one;
        EXPECT_TRUE(one.load(text));
        const auto& mode = one.get<clap::PluginRender>(clap::render_id);
        EXPECT_FALSE(mode.has_hard_realtime_requirement(one.plugin));
        if (!while_active && offline) {
            EXPECT_TRUE(mode.set(one.plugin, clap::render_offline));
        }
        EXPECT_TRUE(one.activate());
        if (while_active && offline) {
            EXPECT_TRUE(mode.set(one.plugin, clap::render_offline));
        }
        one.events.note_on(0, 33, 0.9);
        one.render(2000);
        return one.left;
    };
    const auto studio = sound(state(as_studio), false, false);
    EXPECT_EQ(sound(state(preset), true, false), studio);
    EXPECT_EQ(sound(state(preset), true, true), studio);
    EXPECT_NE(sound(state(preset), false, false), studio);
}

TEST(ClapPresets, FilesOfAllKindsAreTakenUp) {
    const test::TemporaryFolder folder;
    ClapInstance one;
    const auto& loader = one.get<clap::PluginPresetLoad>(clap::preset_load_id);
    const auto load = [&](const std::string& path) {
        return loader.from_location(one.plugin, clap::location_file, path.c_str(), nullptr);
    };
    const auto kept = [&] { return ordered_json::parse(one.save()); };
    ASSERT_TRUE(load(folder.write("mine.json", small_preset_text("sitar"))));
    EXPECT_EQ(kept()["preset"]["name"], "mine");
    EXPECT_EQ(kept()["preset"]["text"], small_preset_text("sitar"));
    set(one, 0, 0.5);
    const std::string scale = "! caf\xE9\nseven\n 7\n171.43\n342.86\n514.29\n685.71\n857.14\n1028.57\n2/1\n";
    ASSERT_TRUE(load(folder.write("seven.scl", scale))) << one.log;
    EXPECT_EQ(kept()["tuning"]["scale"].get<std::string>().substr(0, 7), "! caf\xC3\xA9");
    EXPECT_EQ(kept()["preset"]["name"], "mine");
    EXPECT_EQ(one.value(0), 0.5);
    EXPECT_FALSE(load(folder.write("bad.kbm", "x")));
    EXPECT_FALSE(load(folder.file("nowhere.json")));
    EXPECT_FALSE(load(folder.write("not.json", "{}")));
    EXPECT_EQ(one.preset_errors, 3);
    EXPECT_EQ(one.loaded_presets, 2);
    EXPECT_EQ(one.dirty_marks, 2);
    EXPECT_EQ(kept()["preset"]["name"], "mine");
}

struct TuningCase {
    const char* file;
    std::string text;
    double hz;  ///< of the key above middle C
};

/// Seven equal steps to the octave, from middle C as usual, from 270 Hz by Ableton's lines, and as AnaMark's
/// cents above 8.1758 Hz.
std::vector<TuningCase> sevenths() {
    const std::string seven = "s\n 7\n171.4286\n342.8571\n514.2857\n685.7143\n857.1429\n1028.5714\n2/1\n";
    const double step = std::exp2(1.0 / 7);
    return {{"s.scl", seven, 261.6256 * step},
            {"s.ascl", seven + "! @ABL REFERENCE_PITCH 3 0 270\n", 270 * step},
            {"s.tun", "[Exact Tuning]\nnote 61=6171.4286\n", 261.6256 * step}};
}

TEST(ClapPresets, TuningsOfAllKindsAreHeard) {
    for (const TuningCase& each : sevenths()) {
        const test::TemporaryFolder folder;
        const std::string path = folder.write(each.file, each.text);
        ClapInstance one;
        ASSERT_TRUE(one.load(small_state("dulcimer")));
        const auto& loader = one.get<clap::PluginPresetLoad>(clap::preset_load_id);
        ASSERT_TRUE(loader.from_location(one.plugin, clap::location_file, path.c_str(), nullptr)) << one.log;
        ASSERT_TRUE(one.activate());
        one.events.note_on(0, 61, 0.7);
        one.render(48000);
        const auto strength = [&](double hz) {
            double real = 0, imaginary = 0;
            for (std::size_t n = 0; n < one.left.size(); ++n) {
                const double turn = 6.283185307179586 * hz * static_cast<double>(n) / 48000;
                real += static_cast<double>(one.left[n]) * std::cos(turn);
                imaginary += static_cast<double>(one.left[n]) * std::sin(turn);
            }
            return std::hypot(real, imaginary);
        };
        EXPECT_GT(strength(each.hz), 4 * strength(277.18)) << each.file;
        EXPECT_GT(strength(each.hz), 4 * strength(1.03 * each.hz)) << each.file;
    }
}

/// One tuning takes the other's place.
TEST(ClapPresets, ATunFileStandsInPlaceOfScaleAndMap) {
    const test::TemporaryFolder folder;
    ClapInstance one;
    const auto& loader = one.get<clap::PluginPresetLoad>(clap::preset_load_id);
    const auto tuning_with = [&](const TuningCase& each) {
        const std::string path = folder.write(each.file, each.text);
        EXPECT_TRUE(loader.from_location(one.plugin, clap::location_file, path.c_str(), nullptr)) << one.log;
        return ordered_json::parse(one.save())["tuning"];
    };
    const std::vector<TuningCase> cases = sevenths();
    EXPECT_EQ(tuning_with(cases[0])["scale"], cases[0].text);
    const auto tun = tuning_with(cases[2]);
    EXPECT_EQ(tun["tun"], cases[2].text);
    EXPECT_EQ(tun["scale"], "");
    EXPECT_EQ(tuning_with(cases[1])["tun"], "");
}

struct Found {
    std::string name, key, plugin, description, feature;
    std::uint32_t flags = 0;
};

std::vector<Found> discovered(std::uint32_t kind, const char* location,
                              std::vector<std::string>* places = nullptr) {
    const auto& entry = test::clap_entry_of_file();
    const auto* factory =
        static_cast<const clap::PresetDiscoveryFactory*>(entry.get_factory(clap::discovery_factory_id));
    EXPECT_EQ(entry.get_factory(clap::discovery_factory_draft_id), factory);
    EXPECT_EQ(factory->count(factory), 1U);
    clap::PresetIndexer indexer{};
    indexer.indexer_data = places;
    indexer.declare_filetype = [](const clap::PresetIndexer*, const clap::PresetFiletype* type) {
        return std::string(type->file_extension) == "json";
    };
    indexer.declare_location = [](const clap::PresetIndexer* self, const clap::PresetLocation* place) {
        EXPECT_EQ(place->kind == clap::location_plugin, place->location == nullptr);
        if (self->indexer_data != nullptr)
            static_cast<std::vector<std::string>*>(self->indexer_data)
                ->push_back(place->location == nullptr ? "inside" : place->location);
        return true;
    };
    EXPECT_EQ(factory->create(factory, &indexer, "jawari.presets "), nullptr);
    const auto* provider = factory->create(factory, &indexer, factory->get_descriptor(factory, 0)->id);
    EXPECT_TRUE(provider->init(provider));
    std::vector<Found> found;
    clap::MetadataReceiver receiver{};
    receiver.receiver_data = &found;
    const auto last = [](const clap::MetadataReceiver* self) -> Found& {
        return static_cast<std::vector<Found>*>(self->receiver_data)->back();
    };
    static const auto at = last;
    receiver.on_error = [](const clap::MetadataReceiver*, std::int32_t, const char*) {};
    receiver.begin_preset = [](const clap::MetadataReceiver* self, const char* name, const char* key) {
        static_cast<std::vector<Found>*>(self->receiver_data)
            ->push_back({name, key == nullptr ? "" : key, "", "", "", 0});
        return true;
    };
    receiver.add_plugin_id = [](const clap::MetadataReceiver* self, const clap::UniversalPluginId* id) {
        at(self).plugin = std::string(id->abi) + ":" + id->id;
    };
    receiver.set_flags = [](const clap::MetadataReceiver* self, std::uint32_t flags) {
        at(self).flags = flags;
    };
    receiver.set_description = [](const clap::MetadataReceiver* self, const char* text) {
        at(self).description = text;
    };
    receiver.add_feature = [](const clap::MetadataReceiver* self, const char* text) {
        at(self).feature = text;
    };
    provider->get_metadata(provider, kind, location, &receiver);
    provider->destroy(provider);
    return found;
}

TEST(ClapPresets, HostsFindTheFactoryPresetsAndLoadThem) {
    std::vector<std::string> places;
    const std::vector<Found> found = discovered(clap::location_plugin, nullptr, &places);
    ASSERT_EQ(found.size(), builtin_files("instruments").size());
    ASSERT_FALSE(places.empty());
    EXPECT_EQ(places.front(), "inside");
    for (const Found& preset : found) {
        EXPECT_EQ(preset.plugin, "clap:jawari.jawari");
        EXPECT_EQ(preset.flags, clap::factory_content);
        EXPECT_FALSE(preset.name.empty());
        EXPECT_EQ(preset.feature, "instrument");
        EXPECT_NE(find_builtin("instruments", preset.key), nullptr) << preset.key;
    }
    ClapInstance one;
    set(one, 0, 0.5);
    const auto& loader = one.get<clap::PluginPresetLoad>(clap::preset_load_draft_id);
    ASSERT_TRUE(loader.from_location(one.plugin, clap::location_plugin, nullptr, "tanpura"));
    EXPECT_FALSE(loader.from_location(one.plugin, clap::location_plugin, nullptr, "theremin"));
    EXPECT_FALSE(loader.from_location(one.plugin, clap::location_plugin, nullptr, nullptr));
    EXPECT_EQ(ordered_json::parse(one.save())["preset"]["name"], "tanpura");
    EXPECT_EQ(ordered_json::parse(one.save())["preset"]["text"],
              find_builtin("instruments", "tanpura")->text);
    EXPECT_EQ(one.value(0), 1.0);
    EXPECT_EQ(one.value_rescans, 1);
}

TEST(ClapPresets, HostsReadWhatAFileSaysOfItself) {
    const test::TemporaryFolder folder;
    const auto found =
        discovered(clap::location_file, folder.write("a.json", small_preset_text("sitar")).c_str());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].name, "Sitar");
    EXPECT_EQ(found[0].key, "");
    EXPECT_EQ(found[0].flags, clap::user_content);
    EXPECT_NE(found[0].description.find("parabola"), std::string::npos);
    EXPECT_TRUE(discovered(clap::location_file, folder.write("b.json", "{\"a\": 1}").c_str()).empty());
    EXPECT_TRUE(discovered(clap::location_file, folder.file("none.json").c_str()).empty());
}

}  // namespace
}  // namespace jawari::host
