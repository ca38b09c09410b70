// Window, timer.
#include "plugin/clap/gui.h"

#include <clap/ext/gui.h>
#include <clap/ext/timer-support.h>

#include <cmath>
#include <cstring>

#include "plugin/clap/instance.h"

namespace jawari::host::clap {

namespace {

/// Of a window of its usual size, before there is one.
constexpr double usual_width = 1200;
constexpr double usual_height = 768;

bool is_x11(const char* api) {
    return api != nullptr && std::strcmp(api, CLAP_WINDOW_API_X11) == 0;
}

bool is_api_supported(const clap_plugin_t* /*plugin*/, const char* api, bool /*floats*/) {
    return is_x11(api) && window::has_window_module();
}

bool preferred_api(const clap_plugin_t* /*plugin*/, const char** api, bool* floats) {
    *api = CLAP_WINDOW_API_X11;
    *floats = false;
    return true;
}

void ask_for_flush(const Instance& instance) {
    const clap_host_params_t* const params = instance.extensions.params;
    if (params != nullptr && params->request_flush != nullptr) params->request_flush(instance.host);
}

EditorHost editor_host(Instance& instance) {
    const auto push = [&instance](const Edit& edit) {
        instance.edits.push(edit);
        ask_for_flush(instance);
    };
    EditorHost host;
    host.begin_edit = [push](ParameterId parameter) { push({Edit::Kind::Begin, parameter, 0}); };
    host.edit = [push](ParameterId parameter, double value) { push({Edit::Kind::Value, parameter, value}); };
    host.end_edit = [push](ParameterId parameter) { push({Edit::Kind::End, parameter, 0}); };
    host.wake = [&instance] { instance.host->request_process(instance.host); };
    host.state_changed = [&instance] {
        announce_values(instance);
        if (instance.extensions.state != nullptr) instance.extensions.state->mark_dirty(instance.host);
    };
    return host;
}

/// Says why in the host's log if there is none.
bool open(Instance& instance) {
    Gui& gui = *instance.gui;
    auto opened = window::open_window(gui.request, *gui.performance);
    if (!opened) {
        log_error_of(instance, opened.error());
        return false;
    }
    gui.window = std::move(opened.value());
    gui.clock = std::make_unique<GuiClock>(instance);
    return true;
}

void destroy_window(const clap_plugin_t* plugin) {
    Instance& instance = instance_of(plugin);
    if (instance.gui == nullptr) return;
    instance.gui->clock.reset();
    instance.gui->window.reset();
    instance.gui.reset();
}

/// A window without a display is refused here, not later: the host then shows its own.
bool create(const clap_plugin_t* plugin, const char* api, bool floats) {
    Instance& instance = instance_of(plugin);
    if (instance.gui != nullptr || !is_api_supported(plugin, api, floats)) return false;
    return guarded([&] {
        instance.gui = std::make_unique<Gui>();
        instance.gui->performance = std::make_unique<PluginPerformance>(instance.core, editor_host(instance));
        instance.gui->floats = floats;
        if (const auto trouble = window::display_trouble()) {
            log_error_of(instance, *trouble);
            instance.gui.reset();
            return false;
        }
        if (!floats || open(instance)) return true;
        destroy_window(plugin);
        return false;
    });
}

bool set_scale(const clap_plugin_t* plugin, double scale) {
    Gui* const gui = instance_of(plugin).gui.get();
    if (gui == nullptr || gui->window != nullptr || !(scale > 0)) return false;
    gui->request.scale = scale;
    return true;
}

bool get_size(const clap_plugin_t* plugin, std::uint32_t* width, std::uint32_t* height) {
    const Gui* const gui = instance_of(plugin).gui.get();
    if (gui == nullptr) return false;
    window::WindowSize size = gui->request.size;
    if (gui->window != nullptr) {
        size = gui->window->size();
    } else if (size == window::WindowSize{}) {
        const double scale = gui->request.scale > 0 ? gui->request.scale : 1;
        size = {static_cast<unsigned>(std::lround(usual_width * scale)),
                static_cast<unsigned>(std::lround(usual_height * scale))};
    }
    *width = size.width;
    *height = size.height;
    return true;
}

bool can_resize(const clap_plugin_t* /*plugin*/) {
    return true;
}

bool get_resize_hints(const clap_plugin_t* /*plugin*/, clap_gui_resize_hints_t* hints) {
    *hints = {true, true, false, 1, 1};
    return true;
}

bool adjust_size(const clap_plugin_t* plugin, std::uint32_t* width, std::uint32_t* height) {
    const Gui* const gui = instance_of(plugin).gui.get();
    if (gui == nullptr || gui->window == nullptr) return gui != nullptr;
    const window::WindowSize size = gui->window->nearest({*width, *height});
    *width = size.width;
    *height = size.height;
    return true;
}

bool set_size(const clap_plugin_t* plugin, std::uint32_t width, std::uint32_t height) {
    Gui* const gui = instance_of(plugin).gui.get();
    if (gui == nullptr) return false;
    gui->request.size = {width, height};
    if (gui->window != nullptr) gui->window->set_size({width, height});
    return true;
}

bool set_parent(const clap_plugin_t* plugin, const clap_window_t* parent) {
    Instance& instance = instance_of(plugin);
    if (instance.gui == nullptr || instance.gui->floats || instance.gui->window != nullptr ||
        parent == nullptr || !is_x11(parent->api))
        return false;
    return guarded([&] {
        instance.gui->request.parent = parent->x11;
        return open(instance);
    });
}

bool set_transient(const clap_plugin_t* plugin, const clap_window_t* owner) {
    const Gui* const gui = instance_of(plugin).gui.get();
    if (gui == nullptr || gui->window == nullptr || !gui->floats || owner == nullptr || !is_x11(owner->api))
        return false;
    gui->window->stay_above(owner->x11);
    return true;
}

void suggest_title(const clap_plugin_t* plugin, const char* title) {
    Gui* const gui = instance_of(plugin).gui.get();
    if (gui != nullptr && gui->window != nullptr && gui->floats && title != nullptr)
        gui->window->set_title(title);
}

bool show(const clap_plugin_t* plugin) {
    Gui* const gui = instance_of(plugin).gui.get();
    if (gui == nullptr || gui->window == nullptr) return false;
    gui->told_closed = false;
    gui->window->show();
    return true;
}

bool hide(const clap_plugin_t* plugin) {
    Gui* const gui = instance_of(plugin).gui.get();
    if (gui == nullptr || gui->window == nullptr) return false;
    gui->window->hide();
    return true;
}

/// Afterwards there may be no window any more.
void idle(Instance& instance) {
    Gui* const gui = instance.gui.get();
    guarded([&] {
        gui->performance->tick();
        gui->window->idle();
        return true;
    });
    if (!gui->floats || gui->told_closed || !gui->window->is_closed()) return;
    gui->told_closed = true;
    gui->window->hide();
    if (instance.extensions.gui != nullptr) instance.extensions.gui->closed(instance.host, false);
}

const GuiClock* clock_of(const Instance& instance) {
    return instance.gui == nullptr ? nullptr : instance.gui->clock.get();
}

void on_timer(const clap_plugin_t* plugin, clap_id timer) {
    Instance& instance = instance_of(plugin);
    const GuiClock* const clock = clock_of(instance);
    if (clock != nullptr && clock->is_timer(timer)) idle(instance);
}

void on_file(const clap_plugin_t* plugin, int file, std::uint32_t /*found*/) {
    Instance& instance = instance_of(plugin);
    const GuiClock* const clock = clock_of(instance);
    if (clock != nullptr && clock->is_file(file)) idle(instance);
}

}  // namespace

void take_gui_call(Instance& instance) {
    const GuiClock* const clock = clock_of(instance);
    if (clock == nullptr || !clock->is_thread()) return;
    idle(instance);
    if (clock_of(instance) != nullptr) instance.gui->clock->answer();
}

const void* gui_extension() {
    static constexpr clap_plugin_gui_t extension{
        is_api_supported, preferred_api, create,           destroy_window, set_scale,
        get_size,         can_resize,    get_resize_hints, adjust_size,    set_size,
        set_parent,       set_transient, suggest_title,    show,           hide};
    return &extension;
}

const void* timer_extension() {
    static constexpr clap_plugin_timer_support_t extension{on_timer};
    return &extension;
}

const void* files_extension() {
    static constexpr PluginFiles extension{on_file};
    return &extension;
}

}  // namespace jawari::host::clap
