#include "plugin/vst3/view.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "plugin/editor/plugin_performance.h"
#include "window/load_window.h"

namespace jawari::host::vst3 {

namespace {

constexpr std::uint64_t timer_ms = 16;
/// Of a window of its usual size, before there is one.
constexpr double usual_width = 1200;
constexpr double usual_height = 768;

struct View;

/// As Interface of an instance.
struct ViewInterface {
    const void* table = nullptr;
    View* view = nullptr;
};

struct View {
    ViewInterface plugin_view, scale_support, timer_handler;
    std::atomic<std::uint32_t> references{1};
    Instance* instance = nullptr;
    v3_plugin_frame** frame = nullptr;  ///< of the host
    v3_run_loop** loop = nullptr;       ///< likewise, while attached
    window::WindowRequest request;
    std::unique_ptr<PluginPerformance> performance;
    std::unique_ptr<window::Window> window;
};

View& view_of(void* self) {
    return *static_cast<ViewInterface*>(self)->view;
}

void* of_instance(View& view) {
    return &view.instance->interfaces[component_interface];
}

// ---------------------------------------------------------------------------------------------- FUnknown

std::uint32_t add_view_reference(void* self) {
    return view_of(self).references.fetch_add(1) + 1;
}

v3_result query_view(void* self, const v3_tuid iid, void** object) {
    View& view = view_of(self);
    *object = nullptr;
    if (v3_tuid_match(iid, v3_plugin_view_content_scale_iid))
        *object = &view.scale_support;
    else if (v3_tuid_match(iid, v3_timer_handler_iid))
        *object = &view.timer_handler;
    else if (v3_tuid_match(iid, v3_funknown_iid) || v3_tuid_match(iid, v3_plugin_view_iid))
        *object = &view.plugin_view;
    if (*object == nullptr) return V3_NO_INTERFACE;
    add_view_reference(self);
    return V3_OK;
}

void close_window(View& view) {
    if (view.loop != nullptr) {
        v3_cpp_obj(view.loop)->unregister_timer(view.loop,
                                                reinterpret_cast<v3_timer_handler**>(&view.timer_handler));
        v3_cpp_obj_unref(view.loop);
        view.loop = nullptr;
    }
    view.window.reset();
    view.performance.reset();
}

std::uint32_t release_view(void* self) {
    View& view = view_of(self);
    const std::uint32_t left = view.references.fetch_sub(1) - 1;
    if (left > 0) return left;
    close_window(view);
    if (view.frame != nullptr) v3_cpp_obj_unref(view.frame);
    release_reference(of_instance(view));
    delete &view;  // NOLINT(cppcoreguidelines-owning-memory): the host owned it
    return 0;
}

constexpr v3_funknown view_unknown{query_view, add_view_reference, release_view};

// ---------------------------------------------------------------------------------------------- IPlugView

v3_result is_type_supported(void* /*self*/, const char* type) {
    return type != nullptr && std::strcmp(type, V3_VIEW_PLATFORM_TYPE_X11) == 0 ? V3_TRUE : V3_FALSE;
}

EditorHost editor_of(Instance& instance) {
    const auto id = [](ParameterId parameter) { return static_cast<v3_param_id>(parameter); };
    EditorHost host;
    host.begin_edit = [&instance, id](ParameterId parameter) {
        if (instance.handler != nullptr)
            v3_cpp_obj(instance.handler)->begin_edit(instance.handler, id(parameter));
    };
    host.edit = [&instance, id](ParameterId parameter, double value) {
        const double travel = parameter_travel(declaration_of(parameter), value);
        instance.travels[static_cast<std::size_t>(parameter)] = travel;
        if (instance.handler != nullptr)
            v3_cpp_obj(instance.handler)->perform_edit(instance.handler, id(parameter), travel);
    };
    host.end_edit = [&instance, id](ParameterId parameter) {
        if (instance.handler != nullptr)
            v3_cpp_obj(instance.handler)->end_edit(instance.handler, id(parameter));
    };
    host.state_changed = [&instance] { announce_values(instance); };
    return host;
}

/// The host's timers are asked of its frame, as the standard has it; some hosts have them themselves.
bool begin_timer(View& view) {
    if (view.frame != nullptr) v3_cpp_obj_query_interface(view.frame, v3_run_loop_iid, &view.loop);
    v3_funknown** const context = view.instance->context;
    if (view.loop == nullptr && context != nullptr)
        v3_cpp_obj_query_interface(context, v3_run_loop_iid, &view.loop);
    if (view.loop == nullptr) return false;
    return v3_cpp_obj(view.loop)->register_timer(
               view.loop, reinterpret_cast<v3_timer_handler**>(&view.timer_handler), timer_ms) == V3_OK;
}

v3_result attached(void* self, void* parent, const char* type) {
    View& view = view_of(self);
    if (view.window != nullptr || is_type_supported(self, type) != V3_TRUE) return V3_FALSE;
    const bool opened = guarded([&] {
        view.performance =
            std::make_unique<PluginPerformance>(view.instance->core, editor_of(*view.instance));
        view.request.parent = reinterpret_cast<std::uintptr_t>(parent);
        auto window = window::open_window(view.request, *view.performance);
        if (!window) return false;
        view.window = std::move(window.value());
        view.window->show();
        return begin_timer(view);
    });
    if (!opened) close_window(view);
    return opened ? V3_OK : V3_FALSE;
}

v3_result removed(void* self) {
    close_window(view_of(self));
    return V3_OK;
}

/// The window takes them from X11.
v3_result on_wheel(void* /*self*/, float /*distance*/) {
    return V3_FALSE;
}
v3_result on_key(void* /*self*/, std::int16_t /*character*/, std::int16_t /*code*/,
                 std::int16_t /*modifiers*/) {
    return V3_FALSE;
}
v3_result on_focus(void* /*self*/, v3_bool /*state*/) {
    return V3_OK;
}

window::WindowSize size_of(const View& view) {
    if (view.window != nullptr) return view.window->size();
    if (view.request.size != window::WindowSize{}) return view.request.size;
    const double scale = view.request.scale > 0 ? view.request.scale : 1;
    return {static_cast<unsigned>(std::lround(usual_width * scale)),
            static_cast<unsigned>(std::lround(usual_height * scale))};
}

window::WindowSize size_of(const v3_view_rect& rect) {
    return {static_cast<unsigned>(std::max(1, rect.right - rect.left)),
            static_cast<unsigned>(std::max(1, rect.bottom - rect.top))};
}

v3_result get_size(void* self, v3_view_rect* rect) {
    const window::WindowSize size = size_of(view_of(self));
    *rect = {0, 0, static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height)};
    return V3_OK;
}

v3_result on_size(void* self, v3_view_rect* rect) {
    View& view = view_of(self);
    view.request.size = size_of(*rect);
    if (view.window != nullptr) view.window->set_size(view.request.size);
    return V3_OK;
}

v3_result set_frame(void* self, v3_plugin_frame** frame) {
    View& view = view_of(self);
    if (frame != nullptr) v3_cpp_obj_ref(frame);
    if (view.frame != nullptr) v3_cpp_obj_unref(view.frame);
    view.frame = frame;
    return V3_OK;
}

v3_result can_resize(void* /*self*/) {
    return V3_TRUE;
}

v3_result check_size(void* self, v3_view_rect* rect) {
    const View& view = view_of(self);
    if (view.window == nullptr) return V3_OK;
    const window::WindowSize size = view.window->nearest(size_of(*rect));
    rect->right = rect->left + static_cast<std::int32_t>(size.width);
    rect->bottom = rect->top + static_cast<std::int32_t>(size.height);
    return V3_OK;
}

v3_result set_scale_factor(void* self, float factor) {
    View& view = view_of(self);
    if (view.window != nullptr || !(factor > 0)) return V3_FALSE;
    view.request.scale = static_cast<double>(factor);
    return V3_OK;
}

void on_timer(void* self) {
    View& view = view_of(self);
    if (view.window == nullptr) return;
    guarded([&] {
        view.performance->tick();
        view.window->idle();
        return true;
    });
}

struct TimerTable {
    v3_funknown unknown;
    v3_timer_handler timer;
};
struct ScaleTable {
    v3_funknown unknown;
    v3_plugin_view_content_scale scale;
};
struct ViewTable {
    v3_funknown unknown;
    v3_plugin_view view;
};

constexpr TimerTable timer_table{view_unknown, {on_timer}};
constexpr ScaleTable scale_table{view_unknown, {set_scale_factor}};
constexpr ViewTable view_table{view_unknown,
                               {is_type_supported, attached, removed, on_wheel, on_key, on_key, get_size,
                                on_size, on_focus, set_frame, can_resize, check_size}};

}  // namespace

v3_plugin_view** create_plugin_view(Instance& instance) {
    View* view = nullptr;
    const bool made = guarded([&] {
        if (window::display_trouble()) return false;
        view = new View;  // NOLINT(cppcoreguidelines-owning-memory): release_view() ends it
        return true;
    });
    if (!made) return nullptr;
    view->plugin_view = {&view_table, view};
    view->scale_support = {&scale_table, view};
    view->timer_handler = {&timer_table, view};
    view->instance = &instance;
    add_reference(of_instance(*view));
    return reinterpret_cast<v3_plugin_view**>(&view->plugin_view);
}

}  // namespace jawari::host::vst3
