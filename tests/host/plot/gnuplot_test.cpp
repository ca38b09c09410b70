#include "plot/gnuplot.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "plot/audio_plot.h"
#include "plot/scene_plot.h"

namespace jawari::host {
namespace {

namespace files = std::filesystem;

class Plot : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = files::temp_directory_path() / ("jawari_plot_" + std::to_string(::getpid()));
        files::create_directories(folder_);
    }
    void TearDown() override { files::remove_all(folder_); }

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] std::string content(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] std::size_t files_left() const {
        return static_cast<std::size_t>(
            std::distance(files::directory_iterator(folder_), files::directory_iterator()));
    }

  private:
    files::path folder_;
};

/// Width and height from a PNG file's header.
std::pair<unsigned, unsigned> png_size(const std::string& png) {
    const auto word = [&](std::size_t at) {
        unsigned value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value * 256 + static_cast<unsigned char>(png.at(at + i));
        return value;
    };
    EXPECT_EQ(png.substr(1, 3), "PNG");
    return {word(16), word(20)};
}

SceneRecording recording(std::size_t strings) {
    SceneRecording scene;
    scene.title = "it's \"a\" `touch oops` $(touch oops) @x <&> \\ \xff\x01";
    scene.duration_s = 0.01;
    scene.interval_s = 0.001;
    for (int n = 0; n <= 10; ++n) scene.times_s.push_back(0.001 * n);
    for (std::size_t s = 0; s < strings; ++s) {
        StringRecording string;
        string.name = "string '; system('touch oops'); #" + std::to_string(s);
        string.length_m = 0.6;
        string.grid_m = {0, 0.3, 0.6};
        string.snapshots = {{0, {0, 0.001, 0}}, {0.005, {0, -0.001, 0}}};
        string.obstacles = {{0.1, -0.0005, Side::Below}, {0.4, 0.002, Side::Above}};
        string.events = {{0.002, 0, 1e-5}, {0.006, 1, 2e-6}};
        string.probes = {{"u@0.1", "m", Quantity::Displacement, std::vector<double>(11, 0.001)},
                         {"H", "J", Quantity::Energy, std::vector<double>(11, 1e-3)}};
        scene.strings.push_back(string);
    }
    return scene;
}

TEST_F(Plot, QuotedTextCannotLeaveItsQuotes) {
    EXPECT_EQ(plot::quote("plain"), "'plain'");
    EXPECT_EQ(plot::quote("it's"), "'it''s'");
    EXPECT_EQ(plot::quote("a\nb\tc"), "'a b c'");
    EXPECT_EQ(plot::quote("\xc3\xa9\xff\xc3"),
              "'\xc3\xa9?"
              "?'");
    EXPECT_EQ(plot::quote("\xed\xa0\x80\xc0\xaf"),
              "'" + std::string(5, '?') + "'");  // a surrogate, an overlong slash
}

TEST_F(Plot, PicturesHaveTheirSizeAndNothingElseHappens) {
    for (const std::size_t strings : {1u, 3u}) {
        const SceneRecording scene = recording(strings);
        const SceneFigure figure = scene_figure(scene);
        ASSERT_FALSE(plot_scene(scene, path("scene.png")).has_value());
        EXPECT_EQ(png_size(content("scene.png")),
                  std::make_pair(static_cast<unsigned>(figure.width), static_cast<unsigned>(figure.height)));
    }
    ASSERT_FALSE(plot_scene(recording(1), path("scene.svg")).has_value());
    const std::string svg = content("scene.svg");
    EXPECT_NE(svg.find("<svg"), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_NE(svg.find("`touch oops`"), std::string::npos);  // shown, not run
    EXPECT_FALSE(files::exists("oops"));
    EXPECT_EQ(files_left(), 2u);
}

TEST_F(Plot, PoorRecordingsAreDrawnToo) {
    SceneRecording scene = recording(1);
    scene.strings[0].events.clear();
    scene.strings[0].probes.clear();
    EXPECT_FALSE(plot_scene(scene, path("a.png")).has_value());
    scene.strings[0].obstacles.clear();
    scene.strings[0].snapshots = {{0, {0, 0, 0}}};
    EXPECT_FALSE(plot_scene(scene, path("b.png")).has_value());
    scene.duration_s = 0;
    scene.interval_s = 0;
    scene.times_s = {0};
    scene.strings[0].probes = {{"u@0.1", "m", Quantity::Displacement, {0}}};
    EXPECT_FALSE(plot_scene(scene, path("c.png")).has_value());
    scene.strings[0].probes[0].values = {NAN};
    EXPECT_FALSE(plot_scene(scene, path("d.png")).has_value());
}

TEST_F(Plot, LongRecordingsMakeSmallPictures) {
    SceneRecording scene = recording(1);
    scene.times_s.clear();
    scene.strings[0].probes.resize(1);
    scene.strings[0].probes[0].values.clear();
    for (int n = 0; n < 200000; ++n) {
        scene.times_s.push_back(1e-5 * n);
        scene.strings[0].probes[0].values.push_back(1e-3 * std::sin(0.01 * n));
        scene.strings[0].events.push_back({1e-5 * n, static_cast<std::size_t>(n % 2), 1e-6});
    }
    scene.duration_s = 2;
    ASSERT_FALSE(plot_scene(scene, path("long.svg")).has_value());
    EXPECT_LT(content("long.svg").size(), 4000000u);
}

struct Text {
    double left = 0, right = 0, bottom = 0, top = 0;  ///< in pixels from the picture's upper left corner
    std::string text;
};

/// The texts of a picture by gnuplot's SVG terminal, as wide as they are in its PNG, whose fonts are in
/// points of 4/3 pixels: characters of DejaVu Sans are 0.56 of the size wide in long texts.
std::vector<Text> texts_of(const std::string& svg) {
    static const std::regex group(
        R"re(<g transform="translate\(([-\d.]+),([-\d.]+)\)( rotate\([-\d.]+\))?"[^>]*font-size="([\d.]+)"\s+text-anchor="(\w+)">\s*<text>([^<]*)</text>)re");
    std::vector<Text> texts;
    for (std::sregex_iterator at(svg.begin(), svg.end(), group), end; at != end; ++at) {
        const std::smatch& match = *at;
        const double x = std::stod(match[1]), y = std::stod(match[2]), size = std::stod(match[4]);
        const std::string content = match[6];
        const auto characters = std::count_if(content.begin(), content.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
        });
        const double width = 0.56 * 4 / 3 * size * static_cast<double>(characters);
        const double before = match[5] == "middle" ? width / 2 : match[5] == "end" ? width : 0;
        if (match[3].matched) {
            texts.push_back({x - size, x + size / 4, y + before, y + before - width, content});
        } else {
            texts.push_back({x - before, x - before + width, y + size / 4, y - size, content});
        }
    }
    return texts;
}

/// A recording whose texts are long: names, numbers on axes, places of probes.
SceneRecording recording_of_long_texts(std::size_t strings) {
    SceneRecording scene = recording(strings);
    scene.title = std::string(200, 'a') + "/scene.json";
    for (StringRecording& string : scene.strings) {
        string.name = std::string(120, 'n');
        string.obstacles = {{0.50101, -0.0005, Side::Below}, {0.50102, 0.002, Side::Above}};
        string.probes[0].name = "displacement_m@0.13699912345#12";
    }
    return scene;
}

TEST_F(Plot, NoTextIsClipped) {
    for (const std::size_t strings : {1U, 2U}) {
        const SceneRecording scene = recording_of_long_texts(strings);
        const SceneFigure figure = scene_figure(scene);
        ASSERT_FALSE(plot_scene(scene, path("texts.svg")).has_value());
        const auto texts = texts_of(content("texts.svg"));
        std::size_t labels = 0;
        for (const Text& text : texts) {
            EXPECT_GE(text.left, 0) << text.text;
            EXPECT_LE(text.right, figure.width) << text.text;
            EXPECT_GE(text.top, 0) << text.text;
            EXPECT_LE(text.bottom, figure.height) << text.text;
            labels += text.text == "contact position x (m)" ? 1 : 0;
        }
        EXPECT_EQ(labels, strings);
    }
}

TEST_F(Plot, LegendsLieBesideTheCurves) {
    const SceneRecording scene = recording(1);
    const SceneFigure figure = scene_figure(scene);
    std::smatch margin;
    ASSERT_TRUE(std::regex_search(figure.script, margin, std::regex("set rmargin at screen ([\\d.]+)")));
    const double curves_end_px = std::stod(margin[1]) * figure.width;
    ASSERT_FALSE(plot_scene(scene, path("legend.svg")).has_value());
    std::size_t found = 0;
    for (const Text& text : texts_of(content("legend.svg"))) {
        if (text.text != "obstacle below" && text.text != "obstacle above" && text.text != "x = 0.1 m")
            continue;
        ++found;
        EXPECT_GT(text.left, curves_end_px) << text.text;
    }
    EXPECT_EQ(found, 3U);
}

/// Spectrograms in few cells, which take gnuplot a hundredth of the time.
plot::SpectrogramGrid coarse() {
    plot::SpectrogramGrid grid;
    grid.columns = 80;
    grid.rows = 60;
    return grid;
}

TEST_F(Plot, SoundsOfAnyLength) {
    for (const std::size_t count : {0u, 1u, 7u, 30000u}) {
        std::vector<float> samples(count);
        for (std::size_t n = 0; n < count; ++n)
            samples[n] = static_cast<float>(0.5 * std::sin(0.05 * static_cast<double>(n)));
        ASSERT_FALSE(plot_audio(samples, 48000, "sound", path("sound.png"), coarse()).has_value()) << count;
        EXPECT_EQ(png_size(content("sound.png")).first, 1120u);
    }
    ASSERT_FALSE(plot_audio(std::vector<float>(5000, 0.25F), 8000, "sound", path("sound.svg")).has_value());
    EXPECT_LT(content("sound.svg").size(), 3000000u);
}

TEST_F(Plot, OtherExtensionsAreWrongCommandLines) {
    for (const char* name : {"picture.pdf", "picture", ".png", "a.PNG"}) {
        const auto error = plot::can_plot(name);
        ASSERT_TRUE(error.has_value()) << name;
        EXPECT_EQ(error->kind, ErrorKind::Usage);
        EXPECT_NE(error->message.find(".svg or .png"), std::string::npos);
    }
    EXPECT_FALSE(plot::can_plot("a.png").has_value());
}

TEST_F(Plot, FailuresNameTheReasonAndLeaveNoFile) {
    const auto wrong = plot::draw(path("wrong.png"), 100, 100, "plot sin(\n");
    ASSERT_TRUE(wrong.has_value());
    EXPECT_EQ(wrong->kind, ErrorKind::File);
    EXPECT_NE(wrong->message.find("gnuplot failed"), std::string::npos);
    EXPECT_EQ(wrong->message.find('\n'), std::string::npos);
    EXPECT_EQ(files_left(), 0u);

    const std::string search_path = std::getenv("PATH");
    ::setenv("PATH", "/nonexistent", 1);
    const auto missing = plot_scene(recording(1), path("missing.png"));
    const auto early = plot::can_plot(path("missing.png"));
    ::setenv("PATH", search_path.c_str(), 1);
    for (const auto& error : {missing, early}) {
        ASSERT_TRUE(error.has_value());
        EXPECT_EQ(error->kind, ErrorKind::File);
        EXPECT_NE(error->message.find("gnuplot is not installed"), std::string::npos);
    }
    EXPECT_EQ(files_left(), 0u);
    EXPECT_TRUE(plot_scene(recording(1), path("no/such/folder/x.png")).has_value());
}

}  // namespace
}  // namespace jawari::host
