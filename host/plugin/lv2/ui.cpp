// The window as LV2 hosts have it: an X11UI in the plugin's file. It moves the strings of the instance
// itself, which it asks for by instance-access; values of parameters are the host's ports alone.
#include <lv2/instance-access/instance-access.h>
#include <lv2/options/options.h>
#include <lv2/ui/ui.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <vector>

#include "plugin/editor/plugin_performance.h"
#include "plugin/lv2/instance.h"
#include "window/load_window.h"

namespace jawari::host::lv2 {

namespace {

/// What the window does to a parameter, on its way to the host.
struct UiEdit {
    enum class Kind : std::uint8_t { Begin, Value, End };
    Kind kind = Kind::Value;
    ParameterId parameter{};
    float value = 0;  ///< of Kind::Value, in the parameter's unit
};

struct Ui {
    Instance* instance = nullptr;
    LV2UI_Write_Function write = nullptr;
    LV2UI_Controller controller = nullptr;
    const LV2UI_Touch* touch = nullptr;  ///< null: the host does not ask which control is held
    /// What the ports hold, as far as the host has said, and whether the window holds the control.
    std::array<double, parameter_count> shown{};
    std::array<bool, parameter_count> held{};
    std::vector<UiEdit> edits;
    std::unique_ptr<PluginPerformance> performance;
    std::unique_ptr<window::Window> window;
};

Ui& ui_of(LV2UI_Handle handle) {
    return *static_cast<Ui*>(handle);
}

std::uint32_t port_of(ParameterId parameter) {
    return first_parameter_port + static_cast<std::uint32_t>(parameter);
}

EditorHost ui_host(Ui& ui) {
    const auto index = [](ParameterId parameter) { return static_cast<std::size_t>(parameter); };
    EditorHost host;
    host.begin_edit = [&ui, index](ParameterId parameter) {
        ui.held[index(parameter)] = true;
        ui.edits.push_back({UiEdit::Kind::Begin, parameter, 0});
    };
    host.edit = [&ui, index](ParameterId parameter, double value) {
        const auto sent = static_cast<float>(value);
        ui.shown[index(parameter)] = static_cast<double>(sent);
        ui.edits.push_back({UiEdit::Kind::Value, parameter, sent});
    };
    host.end_edit = [&ui, index](ParameterId parameter) {
        ui.held[index(parameter)] = false;
        ui.edits.push_back({UiEdit::Kind::End, parameter, 0});
    };
    host.state_changed = [&ui] { ui.instance->state_changed.store(true); };
    host.value = [&ui, index](ParameterId parameter) { return ui.shown[index(parameter)]; };
    return host;
}

/// Outside of the instance's lock: the host may ask the instance for something at once.
void tell_edits(Ui& ui) {
    for (const UiEdit& edit : ui.edits) {
        const std::uint32_t port = port_of(edit.parameter);
        if (edit.kind == UiEdit::Kind::Value)
            ui.write(ui.controller, port, sizeof edit.value, 0, &edit.value);
        else if (ui.touch != nullptr)
            ui.touch->touch(ui.touch->handle, port, edit.kind == UiEdit::Kind::Begin);
    }
    ui.edits.clear();
}

/// In the host's log, else where its own messages go.
void refuse(const LV2_Feature* const* features, const std::string& why) {
    const auto* const log = static_cast<const LV2_Log_Log*>(find_feature(features, LV2_LOG__log));
    const auto* const map = static_cast<const LV2_URID_Map*>(find_feature(features, LV2_URID__map));
    if (log != nullptr && map != nullptr)
        log->printf(log->handle, map->map(map->handle, LV2_LOG__Error), "jawari: %s\n", why.c_str());
    else
        std::fprintf(stderr, "jawari: %s\n", why.c_str());
}

/// Pixels per unit, 0 if the host does not say.
double scale_of(const LV2_Feature* const* features) {
    const auto* const map = static_cast<const LV2_URID_Map*>(find_feature(features, LV2_URID__map));
    const auto* option = static_cast<const LV2_Options_Option*>(find_feature(features, LV2_OPTIONS__options));
    if (map == nullptr || option == nullptr) return 0;
    const LV2_URID key = map->map(map->handle, LV2_UI__scaleFactor);
    const LV2_URID type = map->map(map->handle, LV2_ATOM__Float);
    for (; option->key != 0 || option->value != nullptr; ++option) {
        if (option->key != key || option->type != type || option->size != sizeof(float)) continue;
        const float scale = *static_cast<const float*>(option->value);
        return scale > 0 ? static_cast<double>(scale) : 0;
    }
    return 0;
}

bool claim_window(Instance& instance) {
    const std::lock_guard lock(instance.control);
    if (instance.has_window) return false;
    instance.has_window = true;
    return true;
}

void give_up_window(Instance& instance) {
    const std::lock_guard lock(instance.control);
    instance.has_window = false;
}

void end_ui(LV2UI_Handle handle) {
    const std::unique_ptr<Ui> ui(&ui_of(handle));
    ui->window.reset();
    ui->performance.reset();
    give_up_window(*ui->instance);
}

/// Null, and why, if there can be no window.
std::unique_ptr<Ui> open_ui(Instance& instance, const LV2_Feature* const* features, std::string& why) {
    auto ui = std::make_unique<Ui>();
    ui->instance = &instance;
    ui->touch = static_cast<const LV2UI_Touch*>(find_feature(features, LV2_UI__touch));
    for (const ParameterDeclaration& parameter : parameter_table())
        ui->shown[static_cast<std::size_t>(parameter.id)] = instance.core.value(parameter.id);
    {
        const std::lock_guard lock(instance.control);
        ui->performance = std::make_unique<PluginPerformance>(instance.core, ui_host(*ui));
    }
    window::WindowRequest request;
    request.parent = reinterpret_cast<std::uintptr_t>(find_feature(features, LV2_UI__parent));
    request.scale = scale_of(features);
    auto opened = window::open_window(request, *ui->performance);
    if (!opened) {
        why = opened.error().message;
        return nullptr;
    }
    ui->window = std::move(opened.value());
    if (request.parent != 0) ui->window->show();
    return ui;
}

LV2UI_Handle begin_ui(const LV2UI_Descriptor* /*descriptor*/, const char* plugin, const char* /*bundle*/,
                      LV2UI_Write_Function write, LV2UI_Controller controller, LV2UI_Widget* widget,
                      const LV2_Feature* const* features) {
    auto* const instance = static_cast<Instance*>(find_feature(features, LV2_INSTANCE_ACCESS_URI));
    if (plugin == nullptr || std::strcmp(plugin, plugin_uri) != 0 || write == nullptr) return nullptr;
    Ui* made = nullptr;
    bool claimed = false;
    guarded([&] {
        std::string why = "window: the host gives no access to the instance (instance-access)";
        if (instance != nullptr && !claim_window(*instance)) {
            why = "window: the instance has one";
        } else if (instance != nullptr) {
            claimed = true;
            made = open_ui(*instance, features, why).release();
        }
        if (made == nullptr) refuse(features, why);
        return true;
    });
    if (made == nullptr) {
        if (claimed) give_up_window(*instance);
        return nullptr;
    }
    made->write = write;
    made->controller = controller;
    if (widget != nullptr)  // NOLINTNEXTLINE(performance-no-int-to-ptr): X11 has numbers, LV2 pointers
        *widget = reinterpret_cast<LV2UI_Widget>(made->window->native());
    const window::WindowSize size = made->window->size();
    if (const auto* const resize = static_cast<const LV2UI_Resize*>(find_feature(features, LV2_UI__resize)))
        resize->ui_resize(resize->handle, static_cast<int>(size.width), static_cast<int>(size.height));
    return made;
}

/// A control that the window holds shows what the hand does, not what comes late.
void take_port_value(LV2UI_Handle handle, std::uint32_t port, std::uint32_t bytes, std::uint32_t protocol,
                     const void* value) {
    Ui& ui = ui_of(handle);
    if (protocol != 0 || bytes != sizeof(float) || port < first_parameter_port || port >= notify_port) return;
    const std::size_t parameter = port - first_parameter_port;
    if (!ui.held[parameter]) ui.shown[parameter] = static_cast<double>(*static_cast<const float*>(value));
}

/// Not 0 once the user has closed it. While a state is being restored in another thread nothing is drawn.
int idle_ui(LV2UI_Handle handle) {
    Ui& ui = ui_of(handle);
    guarded([&] {
        const std::unique_lock lock(ui.instance->control, std::try_to_lock);
        if (!lock.owns_lock()) return true;
        ui.performance->tick();
        ui.window->idle();
        return true;
    });
    tell_edits(ui);
    return ui.window->is_closed() ? 1 : 0;
}

int show_ui(LV2UI_Handle handle) {
    ui_of(handle).window->show();
    return 0;
}

int hide_ui(LV2UI_Handle handle) {
    ui_of(handle).window->hide();
    return 0;
}

int resize_ui(LV2UI_Feature_Handle handle, int width, int height) {
    if (width <= 0 || height <= 0) return 1;
    ui_of(handle).window->set_size({static_cast<unsigned>(width), static_cast<unsigned>(height)});
    return 0;
}

const void* ui_extension(const char* uri) {
    static constexpr LV2UI_Idle_Interface idle{idle_ui};
    static constexpr LV2UI_Show_Interface show{show_ui, hide_ui};
    static constexpr LV2UI_Resize resize{nullptr, resize_ui};
    if (std::strcmp(uri, LV2_UI__idleInterface) == 0) return &idle;
    if (std::strcmp(uri, LV2_UI__showInterface) == 0) return &show;
    if (std::strcmp(uri, LV2_UI__resize) == 0) return &resize;
    return nullptr;
}

}  // namespace

}  // namespace jawari::host::lv2

LV2_SYMBOL_EXPORT const LV2UI_Descriptor* lv2ui_descriptor(std::uint32_t index) {
    namespace lv2 = jawari::host::lv2;
    static constexpr LV2UI_Descriptor descriptor{lv2::window_uri, lv2::begin_ui, lv2::end_ui,
                                                 lv2::take_port_value, lv2::ui_extension};
    return index == 0 ? &descriptor : nullptr;
}
