// Windows on a display, with synthetic mouse and keys: run under Xvfb (window.display), which needs xdotool
// and ImageMagick. Pictures are left in JAWARI_SCREENSHOTS.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "instrument/preset_library.h"
#include "plugin/editor/plugin_performance.h"
#include "support/small_preset.h"
#include "window/load_window.h"
#include "window/model/layout.h"
#include "window/model/string_places.h"

namespace jawari::host {
namespace {

using window::Box;
using window::WindowCounts;
using window::WindowRequest;
using window::WindowSize;

void command(const std::string& line) {
    ASSERT_EQ(std::system(line.c_str()), 0) << line;  // NOLINT(concurrency-mt-unsafe)
}

struct Gestures {
    int begun = 0, ended = 0, values = 0;
};

/// An instance that plays in real time in this thread, with a window.
class Desk {
  public:
    explicit Desk(const std::string& preset = "bass-fretted", const WindowRequest& request = {},
                  bool whole = false) {
        EXPECT_FALSE(core_.load(test::small_state(preset)));
        if (whole) {
            EXPECT_FALSE(core_.load_preset(preset, preset_text(preset).value()));
        }
        EXPECT_FALSE(core_.activate(48000));
        EditorHost host;
        host.begin_edit = [this](ParameterId) { gestures.begun += 1; };
        host.edit = [this](ParameterId, double) { gestures.values += 1; };
        host.end_edit = [this](ParameterId) { gestures.ended += 1; };
        performance_ = std::make_unique<PluginPerformance>(core_, host);
        auto opened = window::open_window(request, *performance_);
        EXPECT_TRUE(opened) << (opened ? "" : opened.error().message);
        window_ = std::move(opened.value());
        window_->show();
        scale_ = request.scale > 0 ? request.scale : 1;
        run(0.3);
    }

    /// Blocks of 10 ms, each in its time.
    void run(double seconds, int key = -1) {
        const auto begun = std::chrono::steady_clock::now();
        for (int n = 0; n < static_cast<int>(seconds * 100); ++n) {
            block(n == 0 ? key : -1);
            performance_->tick();
            window_->idle();
            std::this_thread::sleep_until(begun + std::chrono::milliseconds(10 * (n + 1)));
        }
    }

    /// Largest magnitude of what is heard meanwhile.
    float heard(double seconds, int key = -1) {
        sound.clear();
        run(seconds, key);
        float largest = 0;
        for (const float sample : sound) largest = std::max(largest, std::abs(sample));
        return largest;
    }

    void input(const std::string& words) {
        command("xdotool " + words);
        run(0.25);
    }
    [[nodiscard]] std::string at(double x, double y) const {
        return "mousemove --window " + std::to_string(window_->native()) + " " +
               std::to_string(std::lround(x * scale_)) + " " + std::to_string(std::lround(y * scale_)) + " ";
    }
    void drag(double x, double y, double to_x, double to_y) {
        input(at(x, y) + "mousedown 1");
        constexpr int steps = 8;
        for (int i = 1; i <= steps; ++i) input(at(x + (to_x - x) * i / steps, y + (to_y - y) * i / steps));
        input("mouseup 1");
    }

    /// Red, green, blue of each pixel; also left as a PNG.
    std::vector<unsigned char> shot(const std::string& name) {
        const std::string folder = JAWARI_SCREENSHOTS;
        const std::string path = folder + "/" + name;
        command("mkdir -p " + folder + " && import -window " + std::to_string(window_->native()) + " " +
                path + ".png && convert " + path + ".png -depth 8 rgb:" + path + ".rgb");
        std::ifstream file(path + ".rgb", std::ios::binary);
        std::vector<unsigned char> pixels((std::istreambuf_iterator<char>(file)), {});
        std::remove((path + ".rgb").c_str());
        return pixels;
    }

    [[nodiscard]] window::Layout layout() const {
        const WindowSize size = window_->size();
        return window::lay_out(static_cast<float>(size.width / scale_),
                               static_cast<float>(size.height / scale_));
    }
    [[nodiscard]] window::StringPlaces places(std::optional<std::size_t> only = std::nullopt) const {
        window::StringPlaces places(*core_.instrument(), core_.instrument()->preset.instrument);
        places.place(layout().strings, only);
        return places;
    }

    /// The next one, which the window does not get.
    const StagePicture* picture() {
        core_.link().picture();
        for (int n = 0; n < 10; ++n) {
            block(-1);
            if (const StagePicture* const picture = core_.link().picture()) return picture;
        }
        return nullptr;
    }

    PluginCore& core() { return core_; }
    PluginPerformance& performance() { return *performance_; }
    window::Window& window() { return *window_; }

    Gestures gestures;
    std::vector<float> sound;

  private:
    void block(int key) {
        std::array<float, 480> left{};
        std::array<float, 480> right{};
        PluginOutput output;
        output.main = {left.data(), right.data()};
        core_.begin_block(output, left.size(), 0);
        if (key >= 0) core_.note_on({-1, 0, 0, static_cast<std::int16_t>(key)}, 0.9, 0);
        core_.end_block();
        sound.insert(sound.end(), left.begin(), left.end());
    }

    PluginCore core_;
    std::unique_ptr<PluginPerformance> performance_;
    std::unique_ptr<window::Window> window_;
    double scale_ = 1;
};

std::size_t different(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i + 2 < std::min(a.size(), b.size()); i += 3)
        count += std::abs(a[i] - b[i]) + std::abs(a[i + 1] - b[i + 1]) > 24 ? 1 : 0;
    return count;
}

TEST(WindowDisplay, FivePresetsAtThreeSizesHavePicturesOfTheirOwn) {
    struct Wanted {
        WindowSize size;
        double scale;
    };
    for (const Wanted& wanted : {Wanted{{800, 560}, 1}, Wanted{{1200, 768}, 1}, Wanted{{2000, 1400}, 2}}) {
        std::vector<unsigned char> before;
        for (const char* preset : {"bass-fretted", "guitar-steel", "sitar", "harpsichord", "dulcimer"}) {
            WindowRequest request;
            request.size = wanted.size;
            request.scale = wanted.scale;
            Desk desk(preset, request);
            EXPECT_EQ(desk.window().size(), wanted.size);
            desk.run(0.05, 52);
            desk.run(0.8, 57);
            const std::string name = std::string(preset) + "-" + std::to_string(wanted.size.width);
            const std::vector<unsigned char> pixels = desk.shot(name);
            ASSERT_EQ(pixels.size(), std::size_t{3} * wanted.size.width * wanted.size.height) << name;
            std::size_t bright = 0;
            for (const unsigned char byte : pixels) bright += byte > 150 ? 1 : 0;
            EXPECT_GT(bright, pixels.size() / 200) << name << " is blank";
            if (!before.empty()) {
                EXPECT_GT(different(pixels, before), pixels.size() / 600) << name;
            }
            before = pixels;
        }
    }
}

/// For scripts/window_picture.sh.
TEST(WindowDisplay, ThePictureOfTheDocumentation) {
    Desk desk("bass-fretted", {}, true);
    desk.run(0.7, 38);
    desk.run(0.5, 33);
    desk.run(0.35, 52);
    desk.run(0.25, 47);
    EXPECT_FALSE(desk.shot("window").empty());
}

TEST(WindowDisplay, AStringIsPluckedWithTheMouse) {
    Desk desk;
    ASSERT_EQ(desk.heard(0.2), 0);
    const auto places = desk.places();
    desk.input(desk.at(places.x_of(0.12), places.rest_y(2)) + "click 1");
    const float plucked = desk.heard(0.3);
    EXPECT_GT(plucked, 1e-4F);
    // The right button silences it.
    desk.input(desk.at(places.x_of(0.12), places.rest_y(2)) + "mousedown 3");
    desk.run(1);
    desk.input("mouseup 3");
    EXPECT_LT(desk.heard(0.3), plucked / 20);
}

TEST(WindowDisplay, AFingerPressesAFretAndSlides) {
    Desk desk;
    const auto places = desk.places();
    const auto fret = [&](std::size_t n) {
        return places.x_of(places.lanes()[1].frets[n - 1].from_bridge_m * 1.015);
    };
    desk.input(desk.at(fret(5), places.rest_y(1)) + "mousedown 1");
    const auto key = [&] {
        const StagePicture* const picture = desk.picture();
        return picture != nullptr && picture->note_count > 0 ? int{picture->notes[0].key} : -1;
    };
    EXPECT_EQ(key(), 33 + 5);
    desk.input(desk.at(fret(7), places.rest_y(1)));
    EXPECT_EQ(key(), 33 + 7);
    desk.input("mouseup 1");
}

TEST(WindowDisplay, ADraggedParameterIsHeardAndReported) {
    Desk desk;
    const Box box = desk.layout().controls[static_cast<std::size_t>(ParameterId::Volume)];
    const float loud = desk.heard(0.5, 40);
    desk.run(1);
    desk.drag(box.right() - 2, box.y + 20, box.x + box.width * 0.2, box.y + 20);
    EXPECT_EQ(desk.gestures.begun, 1);
    EXPECT_EQ(desk.gestures.ended, 1);
    EXPECT_GT(desk.gestures.values, 0);
    EXPECT_LT(desk.core().value(ParameterId::Volume), 0.3);
    EXPECT_LT(desk.heard(0.5, 40), loud / 4);
    // A double click brings the default back.
    desk.input(desk.at(box.middle_x(), box.y + 8) + "click --repeat 2 --delay 60 1");
    EXPECT_EQ(desk.core().value(ParameterId::Volume), 1);
}

TEST(WindowDisplay, ADraggedPluckPlaceIsHeardAndKept) {
    Desk desk;
    const std::string before = desk.core().state().preset_text;
    const window::Layout layout = desk.layout();
    desk.input(desk.at(layout.setup_tab.middle_x(), layout.setup_tab.middle_y()) + "click 1");
    const auto places = desk.places(0);
    const double y = layout.strings.y + 26;
    desk.drag(places.x_of(0.16), y, places.x_of(0.24), y);
    for (int n = 0; n < 100 && desk.core().state().preset_text == before; ++n) desk.run(0.05);
    desk.run(0.5);
    const auto& exciters = desk.core().instrument()->preset.instrument.exciters;
    EXPECT_NEAR(exciters[0].place.from_bridge_m, 0.24, 0.01);
    EXPECT_NE(desk.core().state().preset_text, before);
    EXPECT_TRUE(desk.performance().preset().edited);
    EXPECT_GT(desk.heard(0.3, 40), 0);
    desk.shot("setup");
}

TEST(WindowDisplay, NothingIsDrawnWhileNothingMovesOrWhileHidden) {
    Desk desk;
    desk.input(desk.at(5, 3));
    desk.run(1);
    const std::uint64_t drawn = desk.window().counts().drawn;
    desk.run(2);
    EXPECT_EQ(desk.window().counts().drawn, drawn);
    desk.run(0.5, 40);
    EXPECT_GT(desk.window().counts().drawn, drawn);
    desk.window().hide();
    desk.run(0.2);
    const std::uint64_t hidden = desk.window().counts().drawn;
    desk.run(1, 45);
    EXPECT_EQ(desk.window().counts().drawn, hidden);
}

TEST(WindowDisplay, DrawingTakesAtMostAFifthOfACore) {
    Desk desk;
    desk.run(1, 40);
    const WindowCounts before = desk.window().counts();
    constexpr double seconds = 4;
    desk.run(seconds, 45);
    const WindowCounts after = desk.window().counts();
    EXPECT_GT(after.drawn, before.drawn);
    EXPECT_LE((after.drawing_s - before.drawing_s) / seconds, 0.22);
}

TEST(WindowDisplay, OpeningAndClosingChangesNoState) {
    PluginCore core;
    ASSERT_FALSE(core.load(test::small_state()));
    ASSERT_FALSE(core.activate(48000));
    const std::string before = core.save();
    for (int n = 0; n < 5; ++n) {
        PluginPerformance performance(core, {});
        auto opened = window::open_window({}, performance);
        ASSERT_TRUE(opened);
        opened.value()->show();
        for (int i = 0; i < 10; ++i) {
            performance.tick();
            opened.value()->idle();
        }
    }
    EXPECT_EQ(core.save(), before);
}

TEST(WindowDisplay, TabReachesEveryControlAndArrowsMoveIt) {
    Desk desk;
    desk.input("windowfocus " + std::to_string(desk.window().native()));
    // Search, list, strings, keyboard, then the parameters: the fifth stop is the first of them.
    desk.input("key --delay 30 Tab Tab Tab Tab Tab");
    desk.input("key --delay 30 Left Left Left");
    EXPECT_LT(desk.core().value(ParameterId::Volume), 1);
    EXPECT_GT(desk.core().value(ParameterId::Volume), 0.9);
    desk.input("key Delete");
    EXPECT_EQ(desk.core().value(ParameterId::Volume), 1);
}

}  // namespace
}  // namespace jawari::host
