// The window of the built CLAP inside another one, as a host has it.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>
#include <clap/ext/gui.h>
#undef None
#undef Bool
#undef Status
#undef Success
#include <gtest/gtest.h>
#include <poll.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "support/clap_host.h"
#include "support/x11_close.h"
#include "window/model/layout.h"

namespace jawari::test {
namespace {

/// A host's window with the plugin's in it.
class HostWindow {
  public:
    explicit HostWindow(ClapClock clock = ClapClock::Timers) : instance(clock) {
        EXPECT_TRUE(instance.load(small_state()));
        EXPECT_TRUE(instance.activate());
        gui = &instance.get<clap_plugin_gui_t>(CLAP_EXT_GUI);
        display_ = XOpenDisplay(nullptr);
        window = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1200, 768, 0, 0, 0);
        XSelectInput(display_, window, KeyPressMask | KeyReleaseMask);
        XMapWindow(display_, window);
        // Where the pointer is, whatever a window that is gone has left.
        XSetInputFocus(display_, PointerRoot, RevertToPointerRoot, CurrentTime);
        XSync(display_, 0);
    }
    ~HostWindow() { XCloseDisplay(display_); }
    HostWindow(const HostWindow&) = delete;
    HostWindow& operator=(const HostWindow&) = delete;

    void open(double scale = 1) {
        ASSERT_TRUE(gui->create(instance.plugin, CLAP_WINDOW_API_X11, false));
        ASSERT_TRUE(gui->set_scale(instance.plugin, scale));
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        ASSERT_TRUE(gui->get_size(instance.plugin, &width, &height));
        EXPECT_EQ(width, static_cast<std::uint32_t>(1200 * scale));
        clap_window_t parent{};
        parent.api = CLAP_WINDOW_API_X11;
        parent.x11 = window;
        ASSERT_TRUE(gui->set_parent(instance.plugin, &parent));
        ASSERT_TRUE(gui->show(instance.plugin));
        run(0.5);
    }

    void run(double seconds) {
        for (int n = 0; n < static_cast<int>(seconds * 100); ++n) {
            instance.process(480);
            idle();
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }

    void resize(unsigned width, unsigned height) {
        XResizeWindow(display_, window, width, height);
        XSync(display_, 0);
        ASSERT_TRUE(gui->set_size(instance.plugin, width, height));
        run(0.3);
    }
    void input(const std::string& words) {
        ASSERT_EQ(std::system(("xdotool " + words).c_str()), 0);  // NOLINT(concurrency-mt-unsafe)
        run(0.3);
    }
    [[nodiscard]] std::string at(float x, float y) const {
        return "mousemove --window " + std::to_string(window) + " " + std::to_string(static_cast<int>(x)) +
               " " + std::to_string(static_cast<int>(y)) + " ";
    }

    /// Keys that have come to the host's window.
    std::vector<KeySym> keys() {
        std::vector<KeySym> found;
        while (XPending(display_) > 0) {
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == KeyPress) found.push_back(XLookupKeysym(&event.xkey, 0));
        }
        return found;
    }

    ClapInstance instance;
    const clap_plugin_gui_t* gui = nullptr;
    ::Window window = 0;

  private:
    /// As the host's main loop does it.
    void idle() {
        if (instance.timer != CLAP_INVALID_ID)
            instance.get<clap_plugin_timer_support_t>(CLAP_EXT_TIMER_SUPPORT)
                .on_timer(instance.plugin, instance.timer);
        pollfd waiting{instance.file, POLLIN, 0};
        if (instance.file >= 0 && poll(&waiting, 1, 0) == 1)
            instance.get<host::clap::PluginFiles>(host::clap::files_id)
                .on_file(instance.plugin, instance.file, host::clap::file_can_be_read);
        if (instance.callbacks.exchange(0) > 0) instance.plugin->on_main_thread(instance.plugin);
    }

    Display* display_ = nullptr;
};

TEST(ClapWindowDisplay, OpensInTheHostsWindowTenTimesAndChangesNoState) {
    HostWindow host;
    const std::string before = host.instance.save();
    for (int n = 0; n < 10; ++n) {
        ASSERT_NO_FATAL_FAILURE(host.open());
        EXPECT_NE(host.instance.timer, CLAP_INVALID_ID);
        host.gui->destroy(host.instance.plugin);
        EXPECT_EQ(host.instance.timer, CLAP_INVALID_ID);
    }
    EXPECT_EQ(host.instance.save(), before);
    EXPECT_EQ(host.instance.dirty_marks, 0);
    EXPECT_TRUE(host.instance.edits.empty());
}

/// A drag is seen and told however the host has the window drawn.
TEST(ClapWindowDisplay, WithoutTimersItLivesByAFileOrByCallsOfTheHost) {
    for (const ClapClock clock : {ClapClock::Files, ClapClock::Neither}) {
        HostWindow host(clock);
        for (int n = 0; n < 3; ++n) {
            ASSERT_NO_FATAL_FAILURE(host.open());
            EXPECT_EQ(host.instance.timer, CLAP_INVALID_ID);
            EXPECT_EQ(host.instance.file >= 0, clock == ClapClock::Files);
            host.instance.edits.clear();
            const host::window::Box box =
                host::window::lay_out(1200, 768).controls[static_cast<std::size_t>(ParameterId::BodyMix)];
            host.input(host.at(box.middle_x(), box.y + 20) + "mousedown 1");
            host.input(host.at(box.x + 0.8F * box.width, box.y + 20) + "mouseup 1");
            EXPECT_GE(host.instance.edits.size(), 3U) << static_cast<int>(clock);
            host.gui->destroy(host.instance.plugin);
            EXPECT_EQ(host.instance.file, -1);
        }
        // What was asked for before is no longer answered.
        host.instance.plugin->on_main_thread(host.instance.plugin);
        host.instance.callbacks = 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        EXPECT_EQ(host.instance.callbacks, 0);
    }
}

TEST(ClapWindowDisplay, AtTwiceTheScaleItIsTwiceAsLarge) {
    HostWindow host;
    ASSERT_NO_FATAL_FAILURE(host.open(2));
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    ASSERT_TRUE(host.gui->get_size(host.instance.plugin, &width, &height));
    EXPECT_EQ(width, 2400U);
    EXPECT_EQ(height, 1536U);
    // Its controls are where the layout has them, times two; in a size that the screen has room for.
    host.resize(2000, 1400);
    const host::window::Box box =
        host::window::lay_out(1000, 700).controls[static_cast<std::size_t>(ParameterId::BodyMix)];
    host.input(host.at(2 * box.middle_x(), 2 * (box.y + 20)) + "mousedown 1");
    host.input(host.at(2 * (box.x + 0.8F * box.width), 2 * (box.y + 20)) + "mouseup 1");
    EXPECT_GT(host.instance.value(static_cast<clap_id>(ParameterId::BodyMix)), 1.3);
    host.gui->destroy(host.instance.plugin);
}

TEST(ClapWindowDisplay, AFloatingOneThatTheUserClosesIsToldToTheHostEachTime) {
    ClapInstance instance;
    ASSERT_TRUE(instance.load(small_state()));
    const auto& gui = instance.get<clap_plugin_gui_t>(CLAP_EXT_GUI);
    const auto& timer = instance.get<clap_plugin_timer_support_t>(CLAP_EXT_TIMER_SUPPORT);
    ASSERT_TRUE(gui.create(instance.plugin, CLAP_WINDOW_API_X11, true));
    gui.suggest_title(instance.plugin, "Floating strings");
    for (int told = 1; told <= 2; ++told) {
        ASSERT_TRUE(gui.show(instance.plugin));
        const auto run = [&] {
            for (int n = 0; n < 50; ++n) {
                timer.on_timer(instance.plugin, instance.timer);
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            }
        };
        run();
        EXPECT_EQ(instance.closed_windows, told - 1);
        close_by_user("Floating strings");
        run();
        EXPECT_EQ(instance.closed_windows, told);
    }
    gui.destroy(instance.plugin);
}

TEST(ClapWindowDisplay, TheSpaceBarGoesOnToTheHost) {
    HostWindow host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    host.input(host.at(600, 300));
    host.keys();
    host.input("key space");
    EXPECT_EQ(host.keys(), std::vector<KeySym>{XK_space});
    // While a search is being typed it is a space.
    const host::window::Layout layout = host::window::lay_out(1200, 768);
    host.input(host.at(layout.search.middle_x(), layout.search.middle_y()) + "click 1");
    host.keys();
    host.input("key space");
    EXPECT_TRUE(host.keys().empty());
    host.gui->destroy(host.instance.plugin);
}

TEST(ClapWindowDisplay, ADragIsAGestureOfTheHostsAutomation) {
    HostWindow host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    const host::window::Box box =
        host::window::lay_out(1200, 768).controls[static_cast<std::size_t>(ParameterId::BodyMix)];
    host.input(host.at(box.middle_x(), box.y + 20) + "mousedown 1");
    for (const float x : {0.6F, 0.7F, 0.8F}) host.input(host.at(box.x + x * box.width, box.y + 20));
    host.input("mouseup 1");
    ASSERT_GE(host.instance.edits.size(), 3U);
    EXPECT_EQ(host.instance.edits.front(), CLAP_EVENT_PARAM_GESTURE_BEGIN);
    EXPECT_EQ(host.instance.edits[1], CLAP_EVENT_PARAM_VALUE);
    EXPECT_EQ(host.instance.edits.back(), CLAP_EVENT_PARAM_GESTURE_END);
    EXPECT_GT(host.instance.value(static_cast<clap_id>(ParameterId::BodyMix)), 1.3);
    host.gui->destroy(host.instance.plugin);
}

TEST(ClapWindowDisplay, ItFollowsTheSizeOfTheHost) {
    HostWindow host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    std::uint32_t width = 100;
    std::uint32_t height = 2000;
    ASSERT_TRUE(host.gui->adjust_size(host.instance.plugin, &width, &height));
    EXPECT_EQ(width, static_cast<std::uint32_t>(host::window::smallest_width));
    EXPECT_EQ(height, 2000U);
    ASSERT_TRUE(host.gui->set_size(host.instance.plugin, 1500, 900));
    host.run(0.5);
    ASSERT_TRUE(host.gui->get_size(host.instance.plugin, &width, &height));
    EXPECT_EQ(width, 1500U);
    EXPECT_EQ(height, 900U);
    host.gui->destroy(host.instance.plugin);
}

}  // namespace
}  // namespace jawari::test
