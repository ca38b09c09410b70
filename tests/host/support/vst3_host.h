// A VST 3 host for tests: loads the built plugin as any host does, and keeps what the plugin tells it.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <travesty/audio_processor.h>
#include <travesty/component.h>
#include <travesty/edit_controller.h>
#include <travesty/factory.h>
#include <travesty/unit.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "jawari/parameters.h"
#include "plugin/vst3/extensions.h"
#include "support/plugin_formats.h"

namespace jawari::test {

/// The file, loaded once.
inline v3_plugin_factory_3** vst3_factory() {
    static v3_plugin_factory_3** const factory = [] {
        void* const file = dlopen(JAWARI_VST3, RTLD_NOW | RTLD_LOCAL);
        if (file == nullptr) throw std::runtime_error(dlerror());
        const auto enter = reinterpret_cast<bool (*)(void*)>(dlsym(file, "ModuleEntry"));
        const auto get = reinterpret_cast<const void* (*)()>(dlsym(file, "GetPluginFactory"));
        if (enter == nullptr || get == nullptr || !enter(file)) throw std::runtime_error("no VST 3 module");
        v3_plugin_factory_3** found = nullptr;
        auto** const first = static_cast<v3_funknown**>(const_cast<void*>(get()));
        if (v3_cpp_obj_query_interface(first, v3_plugin_factory_3_iid, &found) != V3_OK)
            throw std::runtime_error("no factory");
        return found;
    }();
    return factory;
}

/// An object of the host's: what the plugin holds is its address, the table comes first.
template <class Table>
struct HostObject {
    const Table* table = nullptr;
    void* owner = nullptr;

    static v3_result query(void* /*self*/, const v3_tuid /*iid*/, void** object) {
        *object = nullptr;
        return V3_NO_INTERFACE;
    }
    static std::uint32_t count(void* /*self*/) { return 1; }
    static constexpr v3_funknown unknown{query, count, count};

    template <class Interface>
    Interface** as() {
        return reinterpret_cast<Interface**>(this);
    }
};

template <class Owner>
Owner& owner_of(void* self) {
    return *static_cast<Owner*>(static_cast<HostObject<v3_funknown>*>(self)->owner);
}

/// What the host hands over in a block.
class Vst3Events {
  public:
    void note_on(std::uint32_t time, int key, double velocity, std::int32_t id = -1, int channel = 0) {
        v3_event& event = add(time, V3_EVENT_NOTE_ON);
        event.note_on = {static_cast<std::int16_t>(channel),
                         static_cast<std::int16_t>(key),
                         0,
                         static_cast<float>(velocity),
                         0,
                         id};
    }
    void note_off(std::uint32_t time, int key, std::int32_t id = -1, int channel = 0, double velocity = 0.5) {
        v3_event& event = add(time, V3_EVENT_NOTE_OFF);
        event.note_off = {static_cast<std::int16_t>(channel), static_cast<std::int16_t>(key),
                          static_cast<float>(velocity), id, 0};
    }
    void expression(std::uint32_t time, std::uint32_t type, std::int32_t id, double value) {
        add(time, V3_EVENT_NOTE_EXP_VALUE).note_exp_value = {type, id, value};
    }
    void poly_pressure(std::uint32_t time, int key, double value, std::int32_t id = -1, int channel = 0) {
        add(time, V3_EVENT_POLY_PRESSURE).poly_pressure = {static_cast<std::int16_t>(channel),
                                                           static_cast<std::int16_t>(key),
                                                           static_cast<float>(value), id};
    }
    /// 0 to 1.
    void point(std::uint32_t time, v3_param_id id, double value) {
        queues_[id].points.push_back({static_cast<std::int32_t>(time), value});
    }
    /// In the parameter's unit.
    void parameter(std::uint32_t time, std::uint32_t id, double value) {
        point(time, id, parameter_travel(parameter_table()[id], value));
    }
    /// A channel message, as a host translates it.
    void midi(std::uint32_t time, std::uint8_t status, std::uint8_t data1, std::uint8_t data2) {
        const int channel = status & 0x0F;
        const auto controller = [channel](int number) {
            return v3_param_id{10000} + static_cast<v3_param_id>(channel * 130 + number);
        };
        switch (status & 0xF0) {
            case 0x80:
                note_off(time, data1, -1, channel, data2 / 127.0);
                break;
            case 0x90:
                if (data2 > 0)
                    note_on(time, data1, data2 / 127.0, -1, channel);
                else
                    note_off(time, data1, -1, channel);
                break;
            case 0xA0:
                poly_pressure(time, data1, data2 / 127.0, -1, channel);
                break;
            case 0xB0:
                point(time, controller(data1), data2 / 127.0);
                break;
            case 0xD0:
                point(time, controller(128), data1 / 127.0);
                break;
            case 0xE0:
                point(time, controller(129), (data1 + 128 * data2) / 16383.0);
                break;
            default:
                break;
        }
    }
    v3_event& add(std::uint32_t time, std::uint16_t type) {
        v3_event event{};
        event.sample_offset = static_cast<std::int32_t>(time);
        event.type = type;
        events_.push_back(event);
        return events_.back();
    }
    void clear() {
        events_.clear();
        queues_.clear();
    }

    v3_event_list** events() {
        static constexpr v3_event_list_cpp table{
            HostObject<v3_funknown>::unknown,
            {[](void* self) { return static_cast<std::uint32_t>(owner_of<Vst3Events>(self).events_.size()); },
             [](void* self, std::int32_t index, v3_event* event) -> v3_result {
                 *event = owner_of<Vst3Events>(self).events_[static_cast<std::size_t>(index)];
                 return V3_OK;
             },
             [](void*, v3_event*) -> v3_result { return V3_NOT_IMPLEMENTED; }}};
        list_ = {&table, this};
        return list_.as<v3_event_list>();
    }

    v3_param_changes** changes() {
        static constexpr v3_param_value_queue_cpp queue_table{
            HostObject<v3_funknown>::unknown,
            {[](void* self) { return owner_of<Queue>(self).id; },
             [](void* self) { return static_cast<std::int32_t>(owner_of<Queue>(self).points.size()); },
             [](void* self, std::int32_t index, std::int32_t* offset, double* value) -> v3_result {
                 const Point& point = owner_of<Queue>(self).points[static_cast<std::size_t>(index)];
                 *offset = point.offset;
                 *value = point.value;
                 return V3_OK;
             },
             [](void*, std::int32_t, double, std::int32_t*) -> v3_result { return V3_NOT_IMPLEMENTED; }}};
        static constexpr v3_param_changes_cpp table{
            HostObject<v3_funknown>::unknown,
            {[](void* self) { return static_cast<std::int32_t>(owner_of<Vst3Events>(self).queues_.size()); },
             [](void* self, std::int32_t index) {
                 auto queue = owner_of<Vst3Events>(self).queues_.begin();
                 std::advance(queue, index);
                 return queue->second.object.as<v3_param_value_queue>();
             },
             [](void*, v3_param_id*, std::int32_t*) -> v3_param_value_queue** { return nullptr; }}};
        for (auto& [id, queue] : queues_) {
            queue.id = id;
            queue.object = {&queue_table, &queue};
        }
        changes_ = {&table, this};
        return changes_.as<v3_param_changes>();
    }

  private:
    struct Point {
        std::int32_t offset;
        double value;
    };
    struct Queue {
        v3_param_id id = 0;
        std::vector<Point> points;
        HostObject<v3_param_value_queue_cpp> object;
    };

    std::vector<v3_event> events_;
    std::map<v3_param_id, Queue> queues_;
    HostObject<v3_event_list_cpp> list_;
    HostObject<v3_param_changes_cpp> changes_;
};

/// A stream that gives and takes at most `part` bytes at a time.
struct Vst3Stream {
    std::string text;
    std::size_t part = 1000000;
    std::size_t place = 0;
    HostObject<v3_funknown> object{};

    struct Table : v3_funknown {
        v3_bstream stream;
    };

    v3_bstream** get() {
        static constexpr Table table{
            HostObject<v3_funknown>::unknown,
            {[](void* self, void* to, std::int32_t size, std::int32_t* read) -> v3_result {
                 auto& stream = owner_of<Vst3Stream>(self);
                 const std::size_t count = std::min(
                     {static_cast<std::size_t>(size), stream.part, stream.text.size() - stream.place});
                 std::memcpy(to, stream.text.data() + stream.place, count);
                 stream.place += count;
                 *read = static_cast<std::int32_t>(count);
                 return V3_OK;
             },
             [](void* self, void* from, std::int32_t size, std::int32_t* written) -> v3_result {
                 auto& stream = owner_of<Vst3Stream>(self);
                 const std::size_t count = std::min(static_cast<std::size_t>(size), stream.part);
                 stream.text.append(static_cast<const char*>(from), count);
                 *written = static_cast<std::int32_t>(count);
                 return V3_OK;
             },
             [](void*, std::int64_t, std::int32_t, std::int64_t*) -> v3_result { return V3_NOT_IMPLEMENTED; },
             [](void*, std::int64_t*) -> v3_result { return V3_NOT_IMPLEMENTED; }}};
        object = {&table, this};
        return object.as<v3_bstream>();
    }
};

/// One instance in its host. Buffers are as long as the block and no longer: sanitizers see who writes past.
class Vst3Instance {
  public:
    static constexpr const char* format = "VST 3";

    Vst3Instance() {
        v3_class_info info{};
        v3_plugin_factory_3** const factory = vst3_factory();
        const auto* const first = *reinterpret_cast<const v3_plugin_factory_cpp* const*>(factory);
        if (first->v1.get_class_info(factory, 0, &info) != V3_OK) throw std::runtime_error("no class");
        if (first->v1.create_instance(factory, info.class_id, v3_component_iid,
                                      reinterpret_cast<void**>(&component)) != V3_OK)
            throw std::runtime_error("no component");
        v3_cpp_obj_initialize(component, nullptr);
        ask(v3_audio_processor_iid, processor);
        ask(v3_edit_controller_iid, controller);
        static constexpr HandlerTable table{HostObject<v3_funknown>::unknown,
                                            {[](void* self, v3_param_id) -> v3_result {
                                                 owner_of<Vst3Instance>(self).edits += 'b';
                                                 return V3_OK;
                                             },
                                             [](void* self, v3_param_id, double) -> v3_result {
                                                 owner_of<Vst3Instance>(self).edits += 'v';
                                                 return V3_OK;
                                             },
                                             [](void* self, v3_param_id) -> v3_result {
                                                 owner_of<Vst3Instance>(self).edits += 'e';
                                                 return V3_OK;
                                             },
                                             [](void* self, std::int32_t flags) -> v3_result {
                                                 owner_of<Vst3Instance>(self).restarts.push_back(flags);
                                                 return V3_OK;
                                             }}};
        handler_ = {&table, this};
        v3_cpp_obj(controller)->set_component_handler(controller, handler_.as<v3_component_handler>());
    }
    ~Vst3Instance() {
        if (active_) deactivate();
        v3_cpp_obj(controller)->set_component_handler(controller, nullptr);
        v3_cpp_obj_unref(controller);
        v3_cpp_obj_unref(processor);
        v3_cpp_obj_terminate(component);
        left_references = v3_cpp_obj_unref(component);
        EXPECT_EQ(left_references, 0U);
    }
    Vst3Instance(const Vst3Instance&) = delete;
    Vst3Instance& operator=(const Vst3Instance&) = delete;

    template <class Interface>
    void ask(const v3_tuid iid, Interface**& place) {
        if (v3_cpp_obj_query_interface(component, iid, &place) != V3_OK)
            throw std::runtime_error("no interface");
    }

    bool setup(double rate_hz, std::uint32_t most, bool offline = false) {
        v3_process_setup setup{offline ? V3_OFFLINE : V3_REALTIME, V3_SAMPLE_32,
                               static_cast<std::int32_t>(most), rate_hz};
        return v3_cpp_obj(processor)->setup_processing(processor, &setup) == V3_OK;
    }
    [[nodiscard]] bool activate(double rate_hz = 48000, std::uint32_t most = 1024, bool offline = false) {
        active_ = setup(rate_hz, most, offline) && v3_cpp_obj(component)->set_active(component, 1) == V3_OK &&
                  v3_cpp_obj(processor)->set_processing(processor, 1) == V3_OK;
        return active_;
    }
    void deactivate() {
        v3_cpp_obj(processor)->set_processing(processor, 0);
        v3_cpp_obj(component)->set_active(component, 0);
        active_ = false;
    }
    void reset() {
        v3_cpp_obj(processor)->set_processing(processor, 0);
        v3_cpp_obj(processor)->set_processing(processor, 1);
    }

    // A block in three parts, of which the second is all that a host does on its audio thread.
    void prepare(std::uint32_t frames) {
        channels_.assign(2 + strings_wanted, std::vector<float>(frames, 99.0F));
        places_.clear();
        for (auto& channel : channels_) places_.push_back(channel.data());
        buses_.assign(1 + strings_wanted, {});
        buses_[0].num_channels = 2;
        buses_[0].channel_buffers_32 = places_.data();
        for (std::size_t s = 0; s < strings_wanted; ++s) {
            buses_[1 + s].num_channels = 1;
            buses_[1 + s].channel_buffers_32 = places_.data() + 2 + s;
        }
        block_ = {};
        block_.symbolic_sample_size = V3_SAMPLE_32;
        block_.nframes = static_cast<std::int32_t>(frames);
        block_.num_output_buses = static_cast<std::int32_t>(buses_.size());
        block_.outputs = buses_.data();
        block_.input_params = events.changes();
        block_.input_events = events.events();
    }
    bool call() { return v3_cpp_obj(processor)->process(processor, &block_) == V3_OK; }
    void gather() {
        events.clear();
        silence = buses_[0].channel_silence_bitset;
        left.insert(left.end(), channels_[0].begin(), channels_[0].end());
        right.insert(right.end(), channels_[1].begin(), channels_[1].end());
        for (std::size_t s = 0; s < strings_wanted; ++s)
            strings[s].insert(strings[s].end(), channels_[2 + s].begin(), channels_[2 + s].end());
    }
    /// Takes the events and appends a block to the sound.
    void process(std::uint32_t frames) {
        prepare(frames);
        EXPECT_TRUE(call());
        gather();
    }
    void render(std::size_t frames, std::uint32_t block = 256) { render_in_blocks(*this, frames, block); }

    /// As the controls show it, in the parameter's unit.
    [[nodiscard]] double value(std::uint32_t id) const {
        auto* const table = v3_cpp_obj(controller);
        return table->normalised_parameter_to_plain(controller, id,
                                                    table->get_parameter_normalised(controller, id));
    }
    v3_result set(v3_param_id id, double value) const {
        return v3_cpp_obj(controller)->set_parameter_normalised(controller, id, value);
    }
    /// A factory preset by its name for people.
    bool choose_preset(const std::string& name) const {
        std::array<std::int16_t, 128> text{};
        for (std::size_t i = 0; i < name.size() && i < 127; ++i) text[i] = name[i];
        double value = 0;
        return v3_cpp_obj(controller)
                       ->get_parameter_value_for_string(controller, 1000, text.data(), &value) == V3_OK &&
               set(1000, value) == V3_OK;
    }

    /// Writes and reads at most `part` bytes at a time.
    std::string save(std::size_t part = 1000000) const {
        Vst3Stream stream{{}, part};
        EXPECT_EQ(v3_cpp_obj(component)->get_state(component, stream.get()), V3_OK);
        return stream.text;
    }
    bool load(std::string_view text, std::size_t part = 1000000) const {
        Vst3Stream stream{std::string(text), part};
        return v3_cpp_obj(component)->set_state(component, stream.get()) == V3_OK;
    }

    v3_component** component = nullptr;
    v3_audio_processor** processor = nullptr;
    v3_edit_controller** controller = nullptr;
    Vst3Events events;  ///< of the next block
    std::size_t strings_wanted = 0;
    std::vector<float> left, right;
    std::array<std::vector<float>, 16> strings;
    std::vector<std::int32_t> restarts;  ///< flags of each
    std::string edits;  ///< of the plugin's window: b for each begin, v for each value, e for each end
    std::uint64_t silence = 0;  ///< of the latest block's main channels
    std::uint32_t left_references = 0;

  private:
    struct HandlerTable : v3_funknown {
        v3_component_handler handler;
    };
    HostObject<HandlerTable> handler_;
    bool active_ = false;
    std::vector<std::vector<float>> channels_;
    std::vector<float*> places_;
    std::vector<v3_audio_bus_buffers> buses_;
    v3_process_data block_{};
};

}  // namespace jawari::test
