// The window of the built LV2 inside another one, as hosts have it through suil, and by itself.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>
#undef Above
#undef Below
#undef None
#undef Bool
#undef Status
#undef Success
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include "support/lv2_ui.h"
#include "support/x11_close.h"
#include "window/model/layout.h"

namespace jawari::test {
namespace {

class Lv2Window {
  public:
    Lv2Window() {
        EXPECT_TRUE(instance.load(small_state()));
        EXPECT_TRUE(instance.activate());
        display_ = XOpenDisplay(nullptr);
        window = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1200, 768, 0, 0, 0);
        XSelectInput(display_, window, KeyPressMask | KeyReleaseMask);
        XMapWindow(display_, window);
        // Where the pointer is, whatever a window that is gone has left.
        XSetInputFocus(display_, PointerRoot, RevertToPointerRoot, CurrentTime);
        XSync(display_, 0);
    }
    ~Lv2Window() {
        ui.reset();
        XCloseDisplay(display_);
    }
    Lv2Window(const Lv2Window&) = delete;
    Lv2Window& operator=(const Lv2Window&) = delete;

    void open(float scale = 1) {
        Lv2UiOffer offer;
        offer.parent = window;
        offer.scale = scale;
        ui = std::make_unique<Lv2Ui>(instance, offer);
        ASSERT_NE(ui->handle, nullptr) << ui->log;
        ASSERT_NE(ui->widget, nullptr);
        run(0.5);
    }
    /// False once the window is closed.
    bool run(double seconds) {
        for (int n = 0; n < static_cast<int>(seconds * 100); ++n) {
            instance.process(480);
            if (ui->idle() != 0) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return true;
    }
    void input(const std::string& words) {
        ASSERT_EQ(std::system(("xdotool " + words).c_str()), 0);  // NOLINT(concurrency-mt-unsafe)
        run(0.3);
    }
    [[nodiscard]] std::string at(double x, double y) const {
        return "mousemove --window " + std::to_string(window) + " " + std::to_string(static_cast<int>(x)) +
               " " + std::to_string(static_cast<int>(y)) + " ";
    }
    std::vector<KeySym> keys() {
        std::vector<KeySym> found;
        while (XPending(display_) > 0) {
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == KeyPress) found.push_back(XLookupKeysym(&event.xkey, 0));
        }
        return found;
    }
    /// As X11 has it.
    [[nodiscard]] int width_of_child() const {
        XWindowAttributes attributes{};
        XGetWindowAttributes(display_, reinterpret_cast<::Window>(ui->widget), &attributes);
        return attributes.width;
    }
    [[nodiscard]] bool is_child_shown() const {
        XWindowAttributes attributes{};
        XGetWindowAttributes(display_, reinterpret_cast<::Window>(ui->widget), &attributes);
        return attributes.map_state != IsUnmapped;
    }
    static host::window::Box control(ParameterId parameter) {
        return host::window::lay_out(1200, 768).controls[static_cast<std::size_t>(parameter)];
    }

    Lv2Instance instance;
    std::unique_ptr<Lv2Ui> ui;
    ::Window window = 0;

  private:
    Display* display_ = nullptr;
};

constexpr auto body_mix = static_cast<std::uint32_t>(ParameterId::BodyMix);

TEST(Lv2WindowDisplay, OpensInTheHostsWindowTenTimesAndChangesNoState) {
    Lv2Window host;
    const std::string before = host.instance.save();
    for (int n = 0; n < 10; ++n) {
        ASSERT_NO_FATAL_FAILURE(host.open());
        EXPECT_EQ(host.ui->told, "");
        host.ui.reset();
    }
    EXPECT_EQ(host.instance.save(), before);
    EXPECT_EQ(host.instance.state_changes, 0);
}

TEST(Lv2WindowDisplay, AnInstanceHasOneWindow) {
    Lv2Window host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    Lv2UiOffer offer;
    const Lv2Ui second(host.instance, offer);
    EXPECT_EQ(second.handle, nullptr);
    EXPECT_EQ(second.log, "jawari: window: the instance has one\n");
    host.run(0.1);
    host.ui.reset();
    ASSERT_NO_FATAL_FAILURE(host.open());
}

TEST(Lv2WindowDisplay, ADragIsWrittenToThePortAndIsInForce) {
    Lv2Window host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    const host::window::Box box = Lv2Window::control(ParameterId::BodyMix);
    host.input(host.at(box.middle_x(), box.y + 20) + "mousedown 1");
    for (const float x : {0.6F, 0.7F, 0.8F}) {
        host.ui->say(body_mix, 0.01F);  // what comes late while the hand is on the control
        host.input(host.at(box.x + x * box.width, box.y + 20));
    }
    host.ui->say(body_mix, 0.01F);
    host.input("mouseup 1");
    host.input("key Right");  // a step from where the hand has let go
    ASSERT_GE(host.ui->told.size(), 3U);
    EXPECT_EQ(host.ui->told.front(), 'b');
    EXPECT_EQ(host.ui->told[1], 'v');
    EXPECT_EQ(host.ui->told.back(), 'e');
    EXPECT_EQ(host.ui->port, host::lv2::first_parameter_port + body_mix);
    EXPECT_GT(host.instance.events.values[body_mix], 1.3F);
    const auto saved = nlohmann::json::parse(host.instance.save());
    EXPECT_EQ(saved["parameters"]["body_mix"], static_cast<double>(host.instance.events.values[body_mix]));
}

/// A key moves the value by a step from where the host has put it.
TEST(Lv2WindowDisplay, WhatTheHostMovesIsWhatTheControlShows) {
    Lv2Window host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    const host::window::Box box = Lv2Window::control(ParameterId::BodyMix);
    host.input(host.at(box.middle_x(), box.y + 8) + "click 1");
    host.run(0.5);  // not a double click
    const auto moved_from = [&](float value) {
        host.instance.events.values[body_mix] = value;
        host.ui->say(body_mix, value);
        host.run(0.1);
        host.input("key Right");
        return host.instance.events.values[body_mix];
    };
    const float low = moved_from(0.2F);
    EXPECT_GT(low, 0.2F);
    EXPECT_LT(low, 0.4F);
    const float high = moved_from(1.5F);
    EXPECT_GT(high, 1.5F);
    EXPECT_LT(high, 1.7F);
}

TEST(Lv2WindowDisplay, TheSpaceBarGoesOnToTheHost) {
    Lv2Window host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    host.input(host.at(600, 300));
    host.keys();
    host.input("key space");
    EXPECT_EQ(host.keys(), std::vector<KeySym>{XK_space});
}

TEST(Lv2WindowDisplay, ItSaysItsSizeAndFollowsTheHosts) {
    Lv2Window host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    EXPECT_EQ(host.ui->width, 1200);
    EXPECT_EQ(host.ui->height, 768);
    EXPECT_EQ(host.width_of_child(), 1200);
    const auto& resize = host.ui->get<LV2UI_Resize>(LV2_UI__resize);
    EXPECT_EQ(resize.ui_resize(host.ui->handle, 1500, 900), 0);
    EXPECT_NE(resize.ui_resize(host.ui->handle, 0, -3), 0);
    host.run(0.3);
    EXPECT_EQ(host.width_of_child(), 1500);
    host.ui.reset();
    ASSERT_NO_FATAL_FAILURE(host.open(2));
    EXPECT_EQ(host.ui->width, 2400);
    EXPECT_EQ(host.width_of_child(), 2400);
}

/// Its parameters are neutral, which the host's ports have to say, and the session has changed.
TEST(Lv2WindowDisplay, APresetChosenInTheWindowIsToldToTheHost) {
    Lv2Window host;
    host.instance.events.parameter(0, body_mix, 0.25);
    host.instance.process(64);
    ASSERT_NO_FATAL_FAILURE(host.open());
    const std::string before = host.instance.save();
    const host::window::Layout layout = host::window::lay_out(1200, 768);
    host.input(host.at(layout.search.middle_x(), layout.search.middle_y()) + "click 1");
    host.input("type dulcimer");
    host.input("key Tab Return");
    for (int n = 0; n < 600 && host.instance.state_changes == 0; ++n) host.run(0.05);
    EXPECT_EQ(host.instance.state_changes, 1);
    const auto saved = nlohmann::json::parse(host.instance.save());
    EXPECT_EQ(saved["preset"]["name"], "dulcimer");
    EXPECT_EQ(host.instance.events.values[body_mix], 1);
    host.run(0.1);
    const auto later = nlohmann::json::parse(host.instance.save());
    EXPECT_FALSE(later["parameters"].contains("body_mix") && later["parameters"]["body_mix"] != 1);
}

/// jalv -s has no window of its own to put it into.
TEST(Lv2WindowDisplay, WithoutAParentItIsAWindowOfItsOwnUntilTheUserClosesIt) {
    Lv2Window host;
    host.ui = std::make_unique<Lv2Ui>(host.instance, Lv2UiOffer{});
    ASSERT_NE(host.ui->handle, nullptr);
    const auto& show = host.ui->get<LV2UI_Show_Interface>(LV2_UI__showInterface);
    ASSERT_EQ(show.show(host.ui->handle), 0);
    EXPECT_TRUE(host.run(0.5));
    EXPECT_EQ(show.hide(host.ui->handle), 0);
    EXPECT_TRUE(host.run(0.1));
    EXPECT_EQ(show.show(host.ui->handle), 0);
    EXPECT_TRUE(host.run(0.3));
    close_by_user(reinterpret_cast<::Window>(host.ui->widget));
    EXPECT_FALSE(host.run(1));
    // jalv asks for nothing more then.
    EXPECT_EQ(show.hide(host.ui->handle), 0);
    EXPECT_FALSE(host.is_child_shown());
}

}  // namespace
}  // namespace jawari::test
