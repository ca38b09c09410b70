// The window of the built VST 3 inside another one, as a host has it: with a frame that has timers.
#include <X11/Xlib.h>
#undef None
#undef Bool
#undef Status
#undef Success
#include <gtest/gtest.h>
#include <travesty/view.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "support/small_preset.h"
#include "support/vst3_host.h"
#include "window/model/layout.h"

namespace jawari::test {
namespace {

class Vst3Window {
  public:
    Vst3Window() {
        EXPECT_TRUE(instance.load(small_state()));
        EXPECT_TRUE(instance.activate());
        display_ = XOpenDisplay(nullptr);
        parent_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1200, 768, 0, 0, 0);
        XMapWindow(display_, parent_);
        XSync(display_, 0);
        frame_ = {&frame_table(), this};
        loop_ = {&loop_table(), this};
        context_ = {&context_table(), this};
    }
    ~Vst3Window() { XCloseDisplay(display_); }
    Vst3Window(const Vst3Window&) = delete;
    Vst3Window& operator=(const Vst3Window&) = delete;

    void open(float scale = 1) {
        view = v3_cpp_obj(instance.controller)->create_view(instance.controller, "editor");
        ASSERT_NE(view, nullptr);
        EXPECT_EQ(v3_cpp_obj(view)->is_platform_type_supported(view, V3_VIEW_PLATFORM_TYPE_HWND), V3_FALSE);
        v3_plugin_view_content_scale** content = nullptr;
        ASSERT_EQ(v3_cpp_obj_query_interface(view, v3_plugin_view_content_scale_iid, &content), V3_OK);
        EXPECT_EQ(v3_cpp_obj(content)->set_content_scale_factor(content, scale), V3_OK);
        v3_cpp_obj_unref(content);
        v3_cpp_obj(view)->set_frame(view, frame_.as<v3_plugin_frame>());
        ASSERT_EQ(
            v3_cpp_obj(view)->attached(view, reinterpret_cast<void*>(parent_), V3_VIEW_PLATFORM_TYPE_X11),
            V3_OK);
        EXPECT_NE(timer_, nullptr);
        run(0.5);
    }
    /// Where the host has its timers: in the frame, in itself, nowhere.
    enum class Loop { OfTheFrame, OfTheHost, None };
    void offer(Loop loop) {
        offered_ = loop;
        v3_cpp_obj_initialize(instance.component, context_.as<v3_funknown>());
    }
    /// No timers, no window.
    void fail_to_open() {
        view = v3_cpp_obj(instance.controller)->create_view(instance.controller, "editor");
        ASSERT_NE(view, nullptr);
        v3_cpp_obj(view)->set_frame(view, frame_.as<v3_plugin_frame>());
        EXPECT_NE(
            v3_cpp_obj(view)->attached(view, reinterpret_cast<void*>(parent_), V3_VIEW_PLATFORM_TYPE_X11),
            V3_OK);
        EXPECT_EQ(timer_, nullptr);
        EXPECT_EQ(v3_cpp_obj_unref(view), 0U);
    }
    void close() {
        EXPECT_EQ(v3_cpp_obj(view)->removed(view), V3_OK);
        v3_cpp_obj(view)->set_frame(view, nullptr);
        EXPECT_EQ(timer_, nullptr);
        EXPECT_EQ(v3_cpp_obj_unref(view), 0U);
    }
    void run(double seconds) {
        for (int n = 0; n < static_cast<int>(seconds * 100); ++n) {
            instance.process(480);
            if (timer_ != nullptr) v3_cpp_obj(timer_)->on_timer(timer_);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    void input(const std::string& words) {
        ASSERT_EQ(std::system(("xdotool " + words).c_str()), 0);  // NOLINT(concurrency-mt-unsafe)
        run(0.3);
    }
    [[nodiscard]] std::string at(float x, float y) const {
        return "mousemove --window " + std::to_string(parent_) + " " + std::to_string(static_cast<int>(x)) +
               " " + std::to_string(static_cast<int>(y)) + " ";
    }

    Vst3Instance instance;
    v3_plugin_view** view = nullptr;

  private:
    struct FrameTable : v3_funknown {
        v3_plugin_frame frame;
    };
    struct LoopTable : v3_funknown {
        v3_run_loop loop;
    };

    static const FrameTable& frame_table() {
        static constexpr FrameTable table{
            {[](void* self, const v3_tuid iid, void** object) -> v3_result {
                 return owner_of<Vst3Window>(self).give_loop(Loop::OfTheFrame, iid, object);
             },
             HostObject<v3_funknown>::count, HostObject<v3_funknown>::count},
            {[](void*, v3_plugin_view**, v3_view_rect*) -> v3_result { return V3_OK; }}};
        return table;
    }
    static const v3_funknown& context_table() {
        static constexpr v3_funknown table{[](void* self, const v3_tuid iid, void** object) -> v3_result {
                                               return owner_of<Vst3Window>(self).give_loop(Loop::OfTheHost,
                                                                                           iid, object);
                                           },
                                           HostObject<v3_funknown>::count, HostObject<v3_funknown>::count};
        return table;
    }
    v3_result give_loop(Loop place, const v3_tuid iid, void** object) {
        *object = offered_ == place && v3_tuid_match(iid, v3_run_loop_iid) ? &loop_ : nullptr;
        return *object == nullptr ? V3_NO_INTERFACE : V3_OK;
    }
    static const LoopTable& loop_table() {
        static constexpr LoopTable table{
            HostObject<v3_funknown>::unknown,
            {[](void*, v3_event_handler**, int) -> v3_result { return V3_OK; },
             [](void*, v3_event_handler**) -> v3_result { return V3_OK; },
             [](void* self, v3_timer_handler** timer, std::uint64_t) -> v3_result {
                 owner_of<Vst3Window>(self).timer_ = timer;
                 return V3_OK;
             },
             [](void* self, v3_timer_handler**) -> v3_result {
                 owner_of<Vst3Window>(self).timer_ = nullptr;
                 return V3_OK;
             }}};
        return table;
    }

    Display* display_ = nullptr;
    ::Window parent_ = 0;
    HostObject<FrameTable> frame_;
    HostObject<LoopTable> loop_;
    HostObject<v3_funknown> context_;
    Loop offered_ = Loop::OfTheFrame;
    v3_timer_handler** timer_ = nullptr;
};

TEST(Vst3WindowDisplay, OpensInTheHostsWindowAndChangesNoState) {
    Vst3Window host;
    const std::string before = host.instance.save();
    for (int n = 0; n < 3; ++n) {
        ASSERT_NO_FATAL_FAILURE(host.open());
        v3_view_rect rect{};
        EXPECT_EQ(v3_cpp_obj(host.view)->get_size(host.view, &rect), V3_OK);
        EXPECT_EQ(rect.right, 1200);
        host.close();
    }
    EXPECT_EQ(host.instance.save(), before);
    EXPECT_TRUE(host.instance.edits.empty());
}

TEST(Vst3WindowDisplay, TimersAreTheFramesOrTheHostsAndWithoutThemThereIsNoWindow) {
    Vst3Window host;
    host.offer(Vst3Window::Loop::OfTheHost);
    ASSERT_NO_FATAL_FAILURE(host.open());
    host.close();
    const std::string before = host.instance.save();
    host.offer(Vst3Window::Loop::None);
    ASSERT_NO_FATAL_FAILURE(host.fail_to_open());
    host.instance.events.midi(0, 0x90, 40, 100);
    host.instance.process(4800);
    EXPECT_GT(*std::max_element(host.instance.left.begin(), host.instance.left.end()), 0);
    EXPECT_EQ(host.instance.save(), before);
}

TEST(Vst3WindowDisplay, AtTwiceTheScaleItIsTwiceAsLarge) {
    Vst3Window host;
    ASSERT_NO_FATAL_FAILURE(host.open(2));
    v3_view_rect rect{};
    EXPECT_EQ(v3_cpp_obj(host.view)->get_size(host.view, &rect), V3_OK);
    EXPECT_EQ(rect.right, 2400);
    EXPECT_EQ(rect.bottom, 1536);
    host.close();
}

TEST(Vst3WindowDisplay, ADragIsAnEditOfTheHosts) {
    Vst3Window host;
    ASSERT_NO_FATAL_FAILURE(host.open());
    const host::window::Box box =
        host::window::lay_out(1200, 768).controls[static_cast<std::size_t>(ParameterId::BodyMix)];
    host.input(host.at(box.middle_x(), box.y + 20) + "mousedown 1");
    for (const float x : {0.6F, 0.7F, 0.8F}) host.input(host.at(box.x + x * box.width, box.y + 20));
    host.input("mouseup 1");
    ASSERT_GE(host.instance.edits.size(), 3U);
    EXPECT_EQ(host.instance.edits.front(), 'b');
    EXPECT_EQ(host.instance.edits[1], 'v');
    EXPECT_EQ(host.instance.edits.back(), 'e');
    const auto id = static_cast<v3_param_id>(ParameterId::BodyMix);
    EXPECT_GT(v3_cpp_obj(host.instance.controller)->get_parameter_normalised(host.instance.controller, id),
              0.6);
    host.close();
}

}  // namespace
}  // namespace jawari::test
