#include "instrument/preset_library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/builtin.h"
#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

/// A variable for the length of a test.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        const char* old = std::getenv(name);
        had_ = old != nullptr;
        if (had_) old_ = old;
        setenv(name, value.c_str(), 1);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() {
        if (had_) {
            setenv(name_, old_.c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }

  private:
    const char* name_;
    std::string old_;
    bool had_ = false;
};

/// The built-in bass under another title, so that it can be told apart.
std::string titled(const std::string& title) {
    std::string text(find_builtin("instruments", "bass-fretted")->text);
    const std::string old = "\"name\": \"Fretted bass\"";
    return text.replace(text.find(old), old.size(), "\"name\": \"" + title + "\"");
}

std::string title_of(const std::string& argument) {
    const auto preset = load_preset(argument);
    return preset.ok() ? preset.value().instrument.name : preset.error().message;
}

class PresetLibrary : public testing::Test {
  protected:
    void put(const std::string& base, const std::string& name, const std::string& title) const {
        std::filesystem::create_directories(folder.file(base + "/jawari/presets"));
        folder.write(base + "/jawari/presets/" + name + ".json", titled(title));
    }

    test::TemporaryFolder folder;
    Variable config{"XDG_CONFIG_HOME", folder.file("config")};
    Variable data{"XDG_DATA_HOME", folder.file("data")};
    Variable system{"XDG_DATA_DIRS", folder.file("one") + ":relative:" + folder.file("two")};
};

TEST_F(PresetLibrary, FoldersAreSearchedInOrder) {
    put("two", "bass-fretted", "from two");
    EXPECT_EQ(title_of("bass-fretted"), "from two");
    put("one", "bass-fretted", "from one");
    EXPECT_EQ(title_of("bass-fretted"), "from one");
    put("data", "bass-fretted", "from data");
    EXPECT_EQ(title_of("bass-fretted"), "from data");
    put("config", "bass-fretted", "from config");
    EXPECT_EQ(title_of("bass-fretted"), "from config");
    EXPECT_EQ(title_of(folder.write("my.json", titled("a file"))), "a file");
}

TEST_F(PresetLibrary, TheFoldersAreThoseOfTheSpecification) {
    const auto folders = preset_folders();
    ASSERT_EQ(folders.size(), 4U);  // the relative one is ignored
    EXPECT_EQ(folders[0].path, folder.file("config/jawari/presets"));
    EXPECT_EQ(folders[3].path, folder.file("two/jawari/presets"));
    const Variable no_config("XDG_CONFIG_HOME", "");
    const Variable no_data("XDG_DATA_HOME", "not/absolute");
    const Variable no_dirs("XDG_DATA_DIRS", "");
    const Variable home("HOME", "/home/x");
    const auto defaults = preset_folders();
    ASSERT_EQ(defaults.size(), 4U);
    EXPECT_EQ(defaults[0].path, "/home/x/.config/jawari/presets");
    EXPECT_EQ(defaults[1].path, "/home/x/.local/share/jawari/presets");
    EXPECT_EQ(defaults[2].path, "/usr/local/share/jawari/presets");
    EXPECT_EQ(defaults[3].path, "/usr/share/jawari/presets");
}

TEST_F(PresetLibrary, EveryNameIsListedOnce) {
    put("config", "bass-fretted", "mine");
    put("one", "zither", "zither");
    const auto presets = named_presets();
    EXPECT_TRUE(std::is_sorted(presets.begin(), presets.end(),
                               [](const auto& a, const auto& b) { return a.name < b.name; }));
    const auto find = [&](const std::string& name) {
        return std::find_if(presets.begin(), presets.end(), [&](const auto& p) { return p.name == name; });
    };
    ASSERT_NE(find("bass-fretted"), presets.end());
    EXPECT_EQ(find("bass-fretted")->origin, PresetOrigin::UserConfig);
    EXPECT_EQ(find("zither")->origin, PresetOrigin::System);
    EXPECT_TRUE(preset_exists("zither"));
    EXPECT_FALSE(preset_exists("zithe"));
    EXPECT_FALSE(preset_exists("../one/jawari/presets/zither"));
}

TEST_F(PresetLibrary, MissingPresetsNameTheOthers) {
    put("one", "zither", "zither");
    const auto missing = load_preset("zithe");
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().kind, ErrorKind::File);
    EXPECT_NE(missing.error().message.find(
                  "zithe: no such file, and no preset of that name; did you mean \"zither\"? (presets: "),
              std::string::npos);
    EXPECT_NE(missing.error().message.find("zither)"), std::string::npos);
}

TEST_F(PresetLibrary, FaultsNameTheFile) {
    std::filesystem::create_directories(folder.file("data/jawari/presets"));
    const std::string path = folder.write("data/jawari/presets/bad.json", "{");
    const auto bad = load_preset("bad");
    EXPECT_EQ(bad.error().kind, ErrorKind::InvalidInput);
    EXPECT_EQ(bad.error().message.rfind(path, 0), 0U) << bad.error().message;
}

}  // namespace
}  // namespace jawari::host
