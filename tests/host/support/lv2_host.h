// An LV2 host for tests: loads the built plugin as any host does, and keeps what the plugin tells it.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <lv2/atom/atom.h>
#include <lv2/atom/util.h>
#include <lv2/core/lv2.h>
#include <lv2/log/log.h>
#include <lv2/midi/midi.h>
#include <lv2/state/state.h>
#include <lv2/urid/urid.h>
#include <lv2/worker/worker.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "plugin/lv2/ports.h"
#include "support/plugin_formats.h"

namespace jawari::test {

/// The file, loaded once.
inline const LV2_Descriptor& lv2_plugin() {
    static const LV2_Descriptor* const descriptor = [] {
        void* const file = dlopen(JAWARI_LV2, RTLD_NOW | RTLD_LOCAL);
        if (file == nullptr) throw std::runtime_error(dlerror());
        const auto get = reinterpret_cast<LV2_Descriptor_Function>(dlsym(file, "lv2_descriptor"));
        if (get == nullptr || get(0) == nullptr || get(1) != nullptr) throw std::runtime_error("no plugin");
        return get(0);
    }();
    return *descriptor;
}

inline LV2_URID lv2_urid(const char* uri) {
    static std::mutex mutex;
    static std::map<std::string, LV2_URID> known;
    const std::lock_guard lock(mutex);
    return known.emplace(uri, static_cast<LV2_URID>(known.size() + 1)).first->second;
}

/// What the host hands over in a block: messages with frames; parameters are ports and have none.
class Lv2Events {
  public:
    void note_on(std::uint32_t time, int key, double velocity, std::int32_t /*id*/ = -1, int channel = 0) {
        midi(time, static_cast<std::uint8_t>(0x90 + channel), static_cast<std::uint8_t>(key),
             static_cast<std::uint8_t>(std::lround(127 * velocity)));
    }
    void note_off(std::uint32_t time, int key, std::int32_t /*id*/ = -1, int channel = 0,
                  double velocity = 0.5) {
        midi(time, static_cast<std::uint8_t>(0x80 + channel), static_cast<std::uint8_t>(key),
             static_cast<std::uint8_t>(std::lround(127 * velocity)));
    }
    void parameter(std::uint32_t /*time*/, std::uint32_t id, double value) {
        values[id] = static_cast<float>(value);
    }
    void midi(std::uint32_t time, std::uint8_t status, std::uint8_t data1, std::uint8_t data2) {
        add(time, LV2_MIDI__MidiEvent, {status, data1, data2});
    }
    void add(std::uint32_t time, const char* type, const std::vector<std::uint8_t>& bytes) {
        LV2_Atom_Event event{};
        event.time.frames = time;
        event.body = {static_cast<std::uint32_t>(bytes.size()), lv2_urid(type)};
        const auto* const head = reinterpret_cast<const std::uint8_t*>(&event);
        body_.insert(body_.end(), head, head + sizeof event);
        body_.insert(body_.end(), bytes.begin(), bytes.end());
        while (body_.size() % 8 != 0) body_.push_back(0);
    }
    void clear() { body_.clear(); }

    /// Words: atoms need their alignment.
    std::vector<std::uint64_t> sequence() const {
        LV2_Atom_Sequence head{};
        head.atom = {static_cast<std::uint32_t>(sizeof head.body + body_.size()),
                     lv2_urid(LV2_ATOM__Sequence)};
        std::vector<std::uint64_t> words((sizeof head + body_.size()) / 8);
        std::memcpy(words.data(), &head, sizeof head);
        if (!body_.empty()) std::memcpy(words.data() + sizeof head / 8, body_.data(), body_.size());
        return words;
    }

    std::array<float, parameter_count> values{};  ///< of the ports, until set again

  private:
    std::vector<std::uint8_t> body_;
};

/// One instance in its host. Buffers are as long as the block and no longer: sanitizers see who writes past.
class Lv2Instance {
  public:
    static constexpr const char* format = "LV2";

    explicit Lv2Instance(double rate_hz = 48000, bool with_worker = true) : with_worker_(with_worker) {
        for (const ParameterDeclaration& parameter : parameter_table())
            events.values[static_cast<std::size_t>(parameter.id)] = static_cast<float>(parameter.neutral);
        make(rate_hz);
    }
    ~Lv2Instance() {
        if (active_) deactivate();
        lv2_plugin().cleanup(handle);
    }
    Lv2Instance(const Lv2Instance&) = delete;
    Lv2Instance& operator=(const Lv2Instance&) = delete;

    /// At another rate than the instance's: a host makes a new one and restores the state.
    [[nodiscard]] bool activate(double rate_hz = 48000, std::uint32_t /*most*/ = 1024) {
        if (rate_hz != rate_hz_) {
            const std::string state = save();
            lv2_plugin().cleanup(handle);
            make(rate_hz);
            if (!load(state)) return false;
        }
        log.clear();
        lv2_plugin().activate(handle);
        active_ = true;
        return log.empty();
    }
    void deactivate() {
        lv2_plugin().deactivate(handle);
        active_ = false;
    }
    /// LV2 has nothing else for it.
    void reset() {
        deactivate();
        EXPECT_TRUE(activate(rate_hz_));
    }

    // A block in three parts, of which the second is all that a host does on its audio thread.
    void prepare(std::uint32_t frames) {
        namespace lv2 = host::lv2;
        frames_ = frames;
        channels_.assign(2 + strings_wanted, std::vector<float>(frames, 99.0F));
        sequence_ = events.sequence();
        const auto connect = [this](std::uint32_t port, const void* place) {
            lv2_plugin().connect_port(handle, port, const_cast<void*>(place));
        };
        for (std::uint32_t port = 0; port < lv2::events_port; ++port)
            connect(port, port < channels_.size() ? channels_[port].data() : nullptr);
        connect(lv2::events_port, sequence_.data());
        connect(lv2::freewheel_port, &freewheel);
        for (std::uint32_t p = 0; p < parameter_count; ++p)
            connect(lv2::first_parameter_port + p, &events.values[p]);
        notices_.assign(64, 0);
        const LV2_Atom room{static_cast<std::uint32_t>(8 * notices_.size() - sizeof(LV2_Atom)),
                            lv2_urid(LV2_ATOM__Chunk)};
        std::memcpy(notices_.data(), &room, sizeof room);
        connect(lv2::notify_port, notices_.data());
    }
    bool call() {
        lv2_plugin().run(handle, frames_);
        return true;
    }
    void gather() {
        events.clear();
        left.insert(left.end(), channels_[0].begin(), channels_[0].end());
        right.insert(right.end(), channels_[1].begin(), channels_[1].end());
        for (std::size_t s = 0; s < strings_wanted; ++s)
            strings[s].insert(strings[s].end(), channels_[2 + s].begin(), channels_[2 + s].end());
        const auto* const notices = reinterpret_cast<const LV2_Atom_Sequence*>(notices_.data());
        ASSERT_EQ(notices->atom.type, lv2_urid(LV2_ATOM__Sequence));
        LV2_ATOM_SEQUENCE_FOREACH(notices, event) {
            ASSERT_EQ(event->body.type, lv2_urid(LV2_ATOM__Object));
            const auto* const object = reinterpret_cast<const LV2_Atom_Object*>(&event->body);
            state_changes += object->body.otype == lv2_urid(LV2_STATE__StateChanged) ? 1 : 0;
        }
        for (const Work& work : works_) worked += do_work(work) ? 1 : 0;
        works_.clear();
    }
    /// Takes the events and appends a block to the sound.
    void process(std::uint32_t frames) {
        prepare(frames);
        call();
        gather();
    }
    void render(std::size_t frames, std::uint32_t block = 256) { render_in_blocks(*this, frames, block); }

    [[nodiscard]] double value(std::uint32_t id) const { return static_cast<double>(events.values[id]); }

    std::string save(std::size_t /*part*/ = 0) const {
        std::string text;
        const auto store = [](LV2_State_Handle to, std::uint32_t key, const void* data, std::size_t size,
                              std::uint32_t type, std::uint32_t flags) {
            EXPECT_EQ(key, lv2_urid(host::lv2::state_uri));
            EXPECT_EQ(type, lv2_urid(LV2_ATOM__Chunk));
            EXPECT_EQ(flags, std::uint32_t{LV2_STATE_IS_POD | LV2_STATE_IS_PORTABLE});
            const auto* const bytes = static_cast<const char*>(data);
            *static_cast<std::string*>(to) = std::string(bytes, size);
            return LV2_STATE_SUCCESS;
        };
        EXPECT_EQ(state().save(handle, store, &text, 0, nullptr), LV2_STATE_SUCCESS);
        return text;
    }
    bool load(std::string_view text, std::size_t /*part*/ = 0) const {
        return load_as(text, LV2_ATOM__Chunk) == LV2_STATE_SUCCESS;
    }
    LV2_State_Status load_as(std::string_view text, const char* type) const {
        struct Property {
            std::string text;
            LV2_URID type;
        } property{std::string(text), lv2_urid(type)};
        const auto retrieve = [](LV2_State_Handle from, std::uint32_t key, std::size_t* size,
                                 std::uint32_t* kind, std::uint32_t* flags) -> const void* {
            if (key != lv2_urid(host::lv2::state_uri)) return nullptr;
            const auto& kept = *static_cast<const Property*>(from);
            *size = kept.text.size();
            *kind = kept.type;
            *flags = LV2_STATE_IS_POD | LV2_STATE_IS_PORTABLE;
            return kept.text.data();
        };
        return state().restore(handle, retrieve, &property, 0, nullptr);
    }

    LV2_Handle handle = nullptr;
    Lv2Events events;  ///< of the next block
    std::size_t strings_wanted = 0;
    float freewheel = 0;
    std::vector<float> left, right;
    std::array<std::vector<float>, 16> strings;
    std::string log;
    int state_changes = 0;  ///< that the plugin has told
    int worked = 0;         ///< pieces of work that the host's worker has done

  private:
    struct Work {
        std::uint32_t size;
        std::array<char, 16> bytes;
    };

    static const LV2_State_Interface& state() {
        return *static_cast<const LV2_State_Interface*>(lv2_plugin().extension_data(LV2_STATE__interface));
    }

    bool do_work(const Work& work) {
        const auto& worker =
            *static_cast<const LV2_Worker_Interface*>(lv2_plugin().extension_data(LV2_WORKER__interface));
        return worker.work(handle, nullptr, nullptr, work.size, work.bytes.data()) == LV2_WORKER_SUCCESS;
    }

    void make(double rate_hz) {
        rate_hz_ = rate_hz;
        map_ = {nullptr, [](LV2_URID_Map_Handle, const char* uri) { return lv2_urid(uri); }};
        works_.reserve(1000);
        worker_ = {this, [](LV2_Worker_Schedule_Handle self, std::uint32_t size, const void* data) {
                       auto& works = static_cast<Lv2Instance*>(self)->works_;
                       if (works.size() == works.capacity()) return LV2_WORKER_ERR_NO_SPACE;
                       works.push_back({size, {}});
                       std::memcpy(works.back().bytes.data(), data, std::min<std::size_t>(size, 16));
                       return LV2_WORKER_SUCCESS;
                   }};
        log_ = {this, print, print_list};
        const std::array<LV2_Feature, 3> features{
            {{LV2_URID__map, &map_}, {LV2_LOG__log, &log_}, {LV2_WORKER__schedule, &worker_}}};
        const std::array<const LV2_Feature*, 4> list{&features[0], &features[1],
                                                     with_worker_ ? &features[2] : nullptr, nullptr};
        handle = lv2_plugin().instantiate(&lv2_plugin(), rate_hz, "", list.data());
        if (handle == nullptr) throw std::runtime_error("no instance");
    }

    static int print_list(LV2_Log_Handle self, LV2_URID /*type*/, const char* format, std::va_list list) {
        std::array<char, 1000> text{};
        const int count = std::vsnprintf(text.data(), text.size(), format, list);
        static_cast<Lv2Instance*>(self)->log += text.data();
        return count;
    }
    static int print(LV2_Log_Handle self, LV2_URID type, const char* format, ...) {
        std::va_list list;
        va_start(list, format);
        const int count = print_list(self, type, format, list);
        va_end(list);
        return count;
    }

    LV2_URID_Map map_{};
    LV2_Worker_Schedule worker_{};
    LV2_Log_Log log_{};
    double rate_hz_ = 48000;
    bool with_worker_;
    bool active_ = false;
    std::vector<Work> works_;
    std::uint32_t frames_ = 0;
    std::vector<std::vector<float>> channels_;
    std::vector<std::uint64_t> sequence_, notices_;
};

}  // namespace jawari::test
