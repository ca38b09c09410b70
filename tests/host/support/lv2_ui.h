// The window of an LV2 instance as a host for tests has it: what the window writes to ports is in force with
// the next block, and what it tells is kept.
#pragma once

#include <lv2/instance-access/instance-access.h>
#include <lv2/options/options.h>
#include <lv2/ui/ui.h>

#include "support/lv2_host.h"
#include "support/small_preset.h"

namespace jawari::test {

inline const LV2UI_Descriptor& lv2_window() {
    static const LV2UI_Descriptor* const descriptor = [] {
        const auto get = reinterpret_cast<LV2UI_DescriptorFunction>(
            dlsym(dlopen(JAWARI_LV2, RTLD_NOW | RTLD_LOCAL), "lv2ui_descriptor"));
        if (get == nullptr || get(0) == nullptr || get(1) != nullptr) throw std::runtime_error("no window");
        return get(0);
    }();
    return *descriptor;
}

/// What the host offers a window.
struct Lv2UiOffer {
    std::uintptr_t parent = 0;  ///< X11 window; 0: none
    float scale = 0;            ///< 0: does not say
    bool instance_access = true;
    bool log = true;
    bool touch = true;
};

class Lv2Ui {
  public:
    Lv2Ui(Lv2Instance& instance, const Lv2UiOffer& offer) : instance_(instance) {
        map_ = {nullptr, [](LV2_URID_Map_Handle, const char* uri) { return lv2_urid(uri); }};
        log_ = {this, print, print_list};
        resize_ = {this, [](LV2UI_Feature_Handle self, int wide, int high) {
                       static_cast<Lv2Ui*>(self)->width = wide;
                       static_cast<Lv2Ui*>(self)->height = high;
                       return 0;
                   }};
        touch_ = {this, [](LV2UI_Feature_Handle self, std::uint32_t touched, bool grabbed) {
                      static_cast<Lv2Ui*>(self)->told += grabbed ? 'b' : 'e';
                      static_cast<Lv2Ui*>(self)->port = touched;
                  }};
        scale_ = offer.scale;
        options_[0] = {LV2_OPTIONS_INSTANCE,      0,      lv2_urid(LV2_UI__scaleFactor), sizeof(float),
                       lv2_urid(LV2_ATOM__Float), &scale_};
        add(LV2_URID__map, &map_);
        if (offer.log) add(LV2_LOG__log, &log_);
        if (offer.touch) add(LV2_UI__touch, &touch_);
        if (offer.scale > 0) add(LV2_OPTIONS__options, options_.data());
        if (offer.instance_access) add(LV2_INSTANCE_ACCESS_URI, instance.handle);
        if (offer.parent != 0) add(LV2_UI__parent, reinterpret_cast<void*>(offer.parent));
        add(LV2_UI__resize, &resize_);
        add(LV2_UI__idleInterface, nullptr);
        std::vector<const LV2_Feature*> list;
        for (const LV2_Feature& feature : features_) list.push_back(&feature);
        list.push_back(nullptr);
        handle = lv2_window().instantiate(&lv2_window(), "urn:jawari:instrument", "", write, this, &widget,
                                          list.data());
    }
    ~Lv2Ui() {
        if (handle != nullptr) lv2_window().cleanup(handle);
    }
    Lv2Ui(const Lv2Ui&) = delete;
    Lv2Ui& operator=(const Lv2Ui&) = delete;

    template <class Extension>
    const Extension& get(const char* uri) const {
        return *static_cast<const Extension*>(lv2_window().extension_data(uri));
    }
    /// Not 0 once it is closed.
    int idle() { return get<LV2UI_Idle_Interface>(LV2_UI__idleInterface).idle(handle); }
    /// The host has moved a port.
    void say(std::uint32_t parameter, float value) {
        lv2_window().port_event(handle, host::lv2::first_parameter_port + parameter, sizeof value, 0, &value);
    }

    LV2UI_Handle handle = nullptr;  ///< null: refused
    LV2UI_Widget widget = nullptr;
    std::string told;        ///< b for each control taken hold of, v for each value, e for each let go
    std::uint32_t port = 0;  ///< of the latest
    int width = 0, height = 0;
    std::string log;

  private:
    void add(const char* uri, void* data) { features_.push_back({uri, data}); }

    static void write(LV2UI_Controller self, std::uint32_t port, std::uint32_t size, std::uint32_t protocol,
                      const void* value) {
        auto& ui = *static_cast<Lv2Ui*>(self);
        ASSERT_EQ(size, sizeof(float));
        ASSERT_EQ(protocol, 0U);
        ASSERT_GE(port, host::lv2::first_parameter_port);
        ASSERT_LT(port, host::lv2::notify_port);
        ui.told += 'v';
        ui.port = port;
        std::memcpy(&ui.instance_.events.values[port - host::lv2::first_parameter_port], value, size);
    }
    static int print_list(LV2_Log_Handle self, LV2_URID /*type*/, const char* format, std::va_list list) {
        std::array<char, 1000> text{};
        const int count = std::vsnprintf(text.data(), text.size(), format, list);
        static_cast<Lv2Ui*>(self)->log += text.data();
        return count;
    }

    static int print(LV2_Log_Handle self, LV2_URID type, const char* format, ...) {
        std::va_list list;
        va_start(list, format);
        const int count = print_list(self, type, format, list);
        va_end(list);
        return count;
    }

    Lv2Instance& instance_;
    LV2_URID_Map map_{};
    LV2_Log_Log log_{};
    LV2UI_Resize resize_{};
    LV2UI_Touch touch_{};
    float scale_ = 0;
    std::array<LV2_Options_Option, 2> options_{};
    std::vector<LV2_Feature> features_;
};

}  // namespace jawari::test
