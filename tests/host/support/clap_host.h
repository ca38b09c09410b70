// A CLAP host for tests: loads the built plugin as any host does, and keeps what the plugin tells it.
#pragma once

#include <clap/entry.h>
#include <clap/ext/audio-ports.h>
#include <clap/ext/gui.h>
#include <clap/ext/latency.h>
#include <clap/ext/note-ports.h>
#include <clap/ext/params.h>
#include <clap/ext/state.h>
#include <clap/ext/timer-support.h>
#include <clap/plugin-factory.h>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "plugin/clap/extensions.h"
#include "support/plugin_formats.h"
#include "support/small_preset.h"

namespace jawari::test {

/// The file, loaded once.
inline const clap_plugin_entry_t& clap_entry_of_file() {
    static const clap_plugin_entry_t* const entry = [] {
        void* const file = dlopen(JAWARI_CLAP, RTLD_NOW | RTLD_LOCAL);
        if (file == nullptr) throw std::runtime_error(dlerror());
        const auto* found = static_cast<const clap_plugin_entry_t*>(dlsym(file, "clap_entry"));
        if (found == nullptr || !found->init(JAWARI_CLAP)) throw std::runtime_error("no clap_entry");
        return found;
    }();
    return *entry;
}

inline const clap_plugin_factory_t& clap_factory() {
    return *static_cast<const clap_plugin_factory_t*>(
        clap_entry_of_file().get_factory(CLAP_PLUGIN_FACTORY_ID));
}

/// Events of a block, in the order in which they were added.
class ClapEvents {
  public:
    void note(std::uint16_t type, std::uint32_t time, int key, double velocity, std::int32_t id = -1,
              int channel = 0, int port = 0) {
        clap_event_note_t event{};
        event.note_id = id;
        event.port_index = static_cast<std::int16_t>(port);
        event.channel = static_cast<std::int16_t>(channel);
        event.key = static_cast<std::int16_t>(key);
        event.velocity = velocity;
        add(event, type, time);
    }
    void note_on(std::uint32_t time, int key, double velocity, std::int32_t id = -1, int channel = 0) {
        note(CLAP_EVENT_NOTE_ON, time, key, velocity, id, channel);
    }
    void note_off(std::uint32_t time, int key, std::int32_t id = -1, int channel = 0) {
        note(CLAP_EVENT_NOTE_OFF, time, key, 0.5, id, channel);
    }
    void expression(std::uint32_t time, clap_note_expression which, int key, double value,
                    std::int32_t id = -1) {
        clap_event_note_expression_t event{};
        event.expression_id = which;
        event.note_id = id;
        event.port_index = 0;
        event.channel = 0;
        event.key = static_cast<std::int16_t>(key);
        event.value = value;
        add(event, CLAP_EVENT_NOTE_EXPRESSION, time);
    }
    void parameter(std::uint32_t time, clap_id id, double value) {
        clap_event_param_value_t event{};
        event.param_id = id;
        event.note_id = event.port_index = event.channel = event.key = -1;
        event.value = value;
        add(event, CLAP_EVENT_PARAM_VALUE, time);
    }
    void midi(std::uint32_t time, std::uint8_t status, std::uint8_t data1, std::uint8_t data2) {
        clap_event_midi_t event{};
        event.data[0] = status;
        event.data[1] = data1;
        event.data[2] = data2;
        add(event, CLAP_EVENT_MIDI, time);
    }
    /// Any event, as it is but for its size.
    template <class Event>
    void add(Event event, std::uint16_t type, std::uint32_t time,
             std::uint16_t space = CLAP_CORE_EVENT_SPACE_ID, std::uint32_t size = sizeof(Event)) {
        event.header = {size, time, space, type, 0};
        std::vector<std::uint64_t> words((sizeof(Event) + 7) / 8);
        std::memcpy(words.data(), &event, sizeof(Event));
        events_.push_back(std::move(words));
    }
    void clear() { events_.clear(); }

    [[nodiscard]] const clap_input_events_t* list() {
        list_ = {this,
                 [](const clap_input_events_t* list) {
                     return static_cast<std::uint32_t>(static_cast<ClapEvents*>(list->ctx)->events_.size());
                 },
                 [](const clap_input_events_t* list, std::uint32_t index) {
                     return reinterpret_cast<const clap_event_header_t*>(
                         static_cast<ClapEvents*>(list->ctx)->events_[index].data());
                 }};
        return &list_;
    }

  private:
    std::vector<std::vector<std::uint64_t>> events_;  // words: events need their alignment
    clap_input_events_t list_{};
};

/// What the host has for windows that move.
enum class ClapClock { Timers, Files, Neither };

/// One instance in its host. Buffers are as long as the block and no longer: sanitizers see who writes past.
class ClapInstance {
  public:
    static constexpr const char* format = "CLAP";

    explicit ClapInstance(ClapClock clock = ClapClock::Timers) : clock_(clock) {
        host_ = {CLAP_VERSION_INIT,
                 this,
                 "tests",
                 "",
                 "",
                 "",
                 get_extension,
                 [](const clap_host_t*) {},
                 [](const clap_host_t*) {},
                 [](const clap_host_t* host) {
                     static_cast<ClapInstance*>(host->host_data)->callbacks.fetch_add(1);
                 }};
        plugin = clap_factory().create_plugin(&clap_factory(), &host_, "jawari.jawari");
        if (plugin == nullptr || !plugin->init(plugin)) throw std::runtime_error("no instance");
    }
    ~ClapInstance() {
        if (active_) deactivate();
        plugin->destroy(plugin);
    }
    ClapInstance(const ClapInstance&) = delete;
    ClapInstance& operator=(const ClapInstance&) = delete;

    template <class Extension>
    const Extension& get(const char* id) const {
        const auto* found = static_cast<const Extension*>(plugin->get_extension(plugin, id));
        if (found == nullptr) throw std::runtime_error(id);
        return *found;
    }
    const clap_plugin_params_t& params() const { return get<clap_plugin_params_t>(CLAP_EXT_PARAMS); }

    [[nodiscard]] bool activate(double rate_hz = 48000, std::uint32_t most = 1024) {
        active_ = plugin->activate(plugin, rate_hz, 1, most) && plugin->start_processing(plugin);
        return active_;
    }
    void deactivate() {
        plugin->stop_processing(plugin);
        plugin->deactivate(plugin);
        active_ = false;
    }

    void reset() { plugin->reset(plugin); }

    /// Takes the events and appends a block to the sound.
    clap_process_status process(std::uint32_t frames, std::int64_t steady_time = -1) {
        std::vector<std::vector<float>> channels(2 + strings_wanted, std::vector<float>(frames, 99.0F));
        std::vector<float*> places;
        for (auto& channel : channels) places.push_back(channel.data());
        std::array<clap_audio_buffer_t, 2> buffers{};
        buffers[0] = {places.data(), nullptr, 2, 0, 0};
        buffers[1] = {places.data() + 2, nullptr, static_cast<std::uint32_t>(strings_wanted), 0, 0};
        clap_output_events_t out{
            this, [](const clap_output_events_t* list, const clap_event_header_t* event) {
                auto* self = static_cast<ClapInstance*>(list->ctx);
                if (event->type >= CLAP_EVENT_PARAM_VALUE && event->type <= CLAP_EVENT_PARAM_GESTURE_END)
                    self->edits.push_back(event->type);
                if (event->type == CLAP_EVENT_NOTE_END)
                    self->ended.push_back(*reinterpret_cast<const clap_event_note_t*>(event));
                return true;
            }};
        clap_process_t block{};
        block.steady_time = steady_time;
        block.frames_count = frames;
        block.audio_outputs = buffers.data();
        block.audio_outputs_count = strings_wanted > 0 ? 2 : 1;
        block.in_events = events.list();
        block.out_events = &out;
        const clap_process_status status = plugin->process(plugin, &block);
        events.clear();
        left.insert(left.end(), channels[0].begin(), channels[0].end());
        right.insert(right.end(), channels[1].begin(), channels[1].end());
        for (std::size_t s = 0; s < strings_wanted; ++s)
            strings[s].insert(strings[s].end(), channels[2 + s].begin(), channels[2 + s].end());
        return status;
    }
    /// `frames` frames in blocks of `block`.
    void render(std::size_t frames, std::uint32_t block = 256) { render_in_blocks(*this, frames, block); }

    [[nodiscard]] double value(clap_id id) const {
        double value = 1e99;
        EXPECT_TRUE(params().get_value(plugin, id, &value));
        return value;
    }

    /// Writes and reads at most `part` bytes at a time.
    std::string save(std::size_t part = 1000000) const {
        struct To {
            std::string text;
            std::size_t part;
        } to{{}, part};
        const clap_ostream_t stream{&to,
                                    [](const clap_ostream_t* from, const void* data, std::uint64_t size) {
                                        auto& self = *static_cast<To*>(from->ctx);
                                        const auto count = std::min<std::size_t>(size, self.part);
                                        self.text.append(static_cast<const char*>(data), count);
                                        return static_cast<std::int64_t>(count);
                                    }};
        EXPECT_TRUE(get<clap_plugin_state_t>(CLAP_EXT_STATE).save(plugin, &stream));
        return to.text;
    }
    bool load(std::string_view text, std::size_t part = 1000000) const {
        struct From {
            std::string_view text;
            std::size_t part;
        } from{text, part};
        const clap_istream_t stream{
            &from, [](const clap_istream_t* in, void* data, std::uint64_t size) {
                auto& self = *static_cast<From*>(in->ctx);
                const auto count = std::min({static_cast<std::size_t>(size), self.part, self.text.size()});
                std::memcpy(data, self.text.data(), count);
                self.text.remove_prefix(count);
                return static_cast<std::int64_t>(count);
            }};
        return get<clap_plugin_state_t>(CLAP_EXT_STATE).load(plugin, &stream);
    }

    const clap_plugin_t* plugin = nullptr;
    ClapEvents events;  ///< of the next block
    std::size_t strings_wanted = 0;
    std::vector<float> left, right;
    std::array<std::vector<float>, 16> strings;
    std::vector<clap_event_note_t> ended;
    std::vector<std::uint16_t> edits;  ///< types of what the plugin's window did to parameters
    clap_id timer = CLAP_INVALID_ID;   ///< that runs
    int file = -1;                     ///< that the host waits for
    std::atomic<int> callbacks{0};
    int closed_windows = 0;  ///< by the user
    int value_rescans = 0, other_rescans = 0, dirty_marks = 0, loaded_presets = 0, preset_errors = 0;
    std::string log;

  private:
    static ClapInstance& self(const clap_host_t* host) {
        return *static_cast<ClapInstance*>(host->host_data);
    }

    static const void* get_extension(const clap_host_t* asked, const char* id) {
        static const clap_host_params_t params{
            [](const clap_host_t* host, clap_param_rescan_flags flags) {
                (flags == CLAP_PARAM_RESCAN_VALUES ? self(host).value_rescans : self(host).other_rescans)++;
            },
            [](const clap_host_t*, clap_id, clap_param_clear_flags) {}, [](const clap_host_t*) {}};
        static const clap_host_state_t state{[](const clap_host_t* host) { self(host).dirty_marks++; }};
        static const host::clap::HostLog log{
            [](const clap_host_t* host, std::int32_t, const char* message) { self(host).log = message; }};
        static const host::clap::HostPresetLoad preset_load{
            [](const clap_host_t* host, std::uint32_t, const char*, const char*, std::int32_t,
               const char* message) {
                self(host).preset_errors++;
                self(host).log = message;
            },
            [](const clap_host_t* host, std::uint32_t, const char*, const char*) {
                self(host).loaded_presets++;
            }};
        static const clap_host_timer_support_t timers{
            [](const clap_host_t* host, std::uint32_t, clap_id* timer) {
                *timer = self(host).timer = 7;
                return true;
            },
            [](const clap_host_t* host, clap_id timer) {
                const bool ran = self(host).timer == timer;
                self(host).timer = CLAP_INVALID_ID;
                return ran;
            }};
        static const host::clap::HostFiles files{[](const clap_host_t* host, int file, std::uint32_t wanted) {
                                                     EXPECT_EQ(wanted, host::clap::file_can_be_read);
                                                     self(host).file = file;
                                                     return true;
                                                 },
                                                 [](const clap_host_t*, int, std::uint32_t) { return false; },
                                                 [](const clap_host_t* host, int file) {
                                                     const bool ran = self(host).file == file;
                                                     self(host).file = -1;
                                                     return ran;
                                                 }};
        static const clap_host_gui_t gui{
            [](const clap_host_t*) {}, [](const clap_host_t*, std::uint32_t, std::uint32_t) { return true; },
            [](const clap_host_t*) { return true; }, [](const clap_host_t*) { return true; },
            [](const clap_host_t* host, bool destroyed) { self(host).closed_windows += destroyed ? 0 : 1; }};
        if (std::strcmp(id, CLAP_EXT_GUI) == 0) return &gui;
        const ClapClock clock = self(asked).clock_;
        if (std::strcmp(id, CLAP_EXT_TIMER_SUPPORT) == 0)
            return clock == ClapClock::Timers ? &timers : nullptr;
        if (std::strcmp(id, host::clap::files_id) == 0) return clock == ClapClock::Files ? &files : nullptr;
        if (std::strcmp(id, CLAP_EXT_PARAMS) == 0) return &params;
        if (std::strcmp(id, CLAP_EXT_STATE) == 0) return &state;
        if (std::strcmp(id, host::clap::log_id) == 0) return &log;
        if (std::strcmp(id, host::clap::preset_load_id) == 0) return &preset_load;
        return nullptr;
    }

    clap_host_t host_{};
    ClapClock clock_;
    bool active_ = false;
};

}  // namespace jawari::test
