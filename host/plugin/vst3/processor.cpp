// Blocks of a VST 3 host.
#include <travesty/audio_processor.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "plugin/vst3/events.h"
#include "plugin/vst3/instance.h"

namespace jawari::host::vst3 {

namespace {

constexpr v3_speaker_arrangement stereo = V3_SPEAKER_L | V3_SPEAKER_R;
constexpr v3_speaker_arrangement mono = V3_SPEAKER_M;
constexpr std::int32_t string_buses = static_cast<std::int32_t>(plugin_string_channels);

/// What there is is all there is.
// NOLINTBEGIN(readability-non-const-parameter): the signature is that of VST 3
v3_result set_bus_arrangements(void* /*self*/, v3_speaker_arrangement* /*inputs*/, std::int32_t input_count,
                               v3_speaker_arrangement* outputs, std::int32_t output_count) {
    if (input_count != 0 || output_count < 1 || output_count > 1 + string_buses) return V3_FALSE;
    for (std::int32_t bus = 0; bus < output_count; ++bus)
        if (outputs[bus] != (bus == 0 ? stereo : mono)) return V3_FALSE;
    return V3_OK;
}
// NOLINTEND(readability-non-const-parameter)

v3_result get_bus_arrangement(void* /*self*/, std::int32_t direction, std::int32_t bus,
                              v3_speaker_arrangement* arrangement) {
    if (direction != V3_OUTPUT || bus < 0 || bus > string_buses) return V3_INVALID_ARG;
    *arrangement = bus == 0 ? stereo : mono;
    return V3_OK;
}

v3_result can_process_sample_size(void* /*self*/, std::int32_t size) {
    return size == V3_SAMPLE_32 || size == V3_SAMPLE_64 ? V3_OK : V3_FALSE;
}

std::uint32_t get_latency_samples(void* /*self*/) {
    return 0;
}

v3_result setup_processing(void* self, v3_process_setup* setup) {
    Instance& instance = instance_of(self);
    if (!(setup->sample_rate > 0) || can_process_sample_size(self, setup->symbolic_sample_size) != V3_OK)
        return V3_INVALID_ARG;
    instance.rate_hz = setup->sample_rate;
    const bool offline = setup->process_mode == V3_OFFLINE;
    return guarded([&] { return !instance.core.set_offline(offline); }) ? V3_OK : V3_INTERNAL_ERR;
}

/// Hosts stop and start processing to silence an instance. Threads: the audio thread or, while it does not
/// process, the main thread.
v3_result set_processing(void* self, v3_bool state) {
    Instance& instance = instance_of(self);
    if (!instance.active) return V3_NOT_INITIALIZED;
    if (state != 0 && instance.has_processed) {
        instance.core.reset();
        instance.has_processed = false;
    }
    return V3_OK;
}

/// The sample at which a channel of a bus begins, or null where the host has none.
template <class Sample>
Sample* channel_of(const v3_process_data& data, std::int32_t bus, std::int32_t channel) {
    if (data.outputs == nullptr || bus >= data.num_output_buses) return nullptr;
    const v3_audio_bus_buffers& buffers = data.outputs[bus];
    if (channel >= buffers.num_channels) return nullptr;
    Sample* const* const channels = [&] {
        if constexpr (std::is_same_v<Sample, float>)
            return buffers.channel_buffers_32;
        else
            return buffers.channel_buffers_64;
    }();
    return channels == nullptr ? nullptr : channels[channel];
}

template <class Sample, std::size_t sides, std::size_t strings>
void take_channels(const v3_process_data& data, std::array<Sample*, sides>& main,
                   std::array<Sample*, strings>& of_strings) {
    for (std::size_t side = 0; side < sides; ++side)
        main[side] = channel_of<Sample>(data, 0, static_cast<std::int32_t>(side));
    for (std::size_t s = 0; s < strings; ++s)
        of_strings[s] = channel_of<Sample>(data, static_cast<std::int32_t>(s) + 1, 0);
}

PluginOutput output_of(const v3_process_data& data) {
    PluginOutput output;
    if (data.symbolic_sample_size == V3_SAMPLE_64)
        take_channels(data, output.main_64, output.strings_64);
    else
        take_channels(data, output.main, output.strings);
    return output;
}

void flag_silence(const v3_process_data& data, bool silent) {
    if (data.outputs == nullptr) return;
    for (std::int32_t bus = 0; bus < data.num_output_buses; ++bus) {
        v3_audio_bus_buffers& buffers = data.outputs[bus];
        const auto channels = static_cast<unsigned>(std::clamp(buffers.num_channels, 0, 63));
        buffers.channel_silence_bitset = silent ? (std::uint64_t{1} << channels) - 1 : 0;
    }
}

v3_result process(void* self, v3_process_data* data) {
    Instance& instance = instance_of(self);
    if (!instance.active || data->nframes < 0) return V3_NOT_INITIALIZED;
    PluginCore& core = instance.core;
    const bool rested = core.rests();
    core.begin_block(output_of(*data), static_cast<std::size_t>(data->nframes), 0);
    take_changes(core, instance.changes, *data);
    core.end_block();  // what it gives back is freed with the next preset or state
    core.ended_notes();
    instance.has_processed = true;
    flag_silence(*data, rested && core.rests());
    return V3_OK;
}

std::uint32_t get_tail_samples(void* self) {
    return static_cast<std::uint32_t>(std::ceil(plugin_tail_s * instance_of(self).rate_hz));
}

/// Of the host's transport nothing is asked.
std::uint32_t get_context_requirements(void* /*self*/) {
    return 0;
}

}  // namespace

const void* processor_table() {
    static constexpr v3_audio_processor_cpp table{
        unknown_table,
        {set_bus_arrangements, get_bus_arrangement, can_process_sample_size, get_latency_samples,
         setup_processing, set_processing, process, get_tail_samples}};
    return &table;
}

const void* context_requirements_table() {
    static constexpr v3_process_context_requirements_cpp table{unknown_table, {get_context_requirements}};
    return &table;
}

}  // namespace jawari::host::vst3
