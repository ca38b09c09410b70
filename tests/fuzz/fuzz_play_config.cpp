// Arbitrary bytes as the configuration file of `jawari play`: refused properly, or options that are each in
// the range that the command line allows.
#include <cstdint>
#include <string>

#include "check.h"
#include "commands/play/options.h"
#include "commands/render/options.h"

namespace {

using namespace jawari;

template <class T>
void require_range(const std::optional<T>& value, T lowest, T highest, const char* what) {
    if (value) fuzz::require(*value >= lowest && *value <= highest, what);
}

void require_name(const std::optional<std::string>& name, const char* what) {
    if (name) fuzz::require(!name->empty(), what);
}

void check_options(const host::PlayOptions& options) {
    require_range(options.rate_hz, host::lowest_render_rate_hz, host::highest_render_rate_hz, "rate_hz");
    require_range(options.frames, host::lowest_play_frames, host::highest_play_frames, "frames");
    require_range(options.instrument.gain_db, -120.0, 60.0, "gain_db");
    require_range(options.instrument.limiter_dbfs, -40.0, 0.0, "limiter_dbfs");
    require_range(options.instrument.guitar_channel, 1, 16, "guitar_channel");
    if (options.osc_port) fuzz::require(*options.osc_port > 0, "osc_port");
    for (const auto* name : {&options.preset, &options.audio, &options.audio_device, &options.midi,
                             &options.midi_in, &options.instrument.tuning, &options.instrument.keyboard_map,
                             &options.instrument.midi_map, &options.osc_host})
        require_name(*name, "a name is not empty");
    for (const auto& [id, value] : options.instrument.parameters) {
        const ParameterDeclaration& declared = declaration_of(id);
        fuzz::require(value >= declared.low && value <= declared.high, "parameter");
    }
    fuzz::require(options.record.empty() && options.record_midi.empty() && !options.overwrite,
                  "what belongs to one performance is not in the file");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto options = host::read_play_config(std::string(data, data + size), "fuzz.json");
    if (!options) {
        fuzz::require_proper_refusal(options.error(), "fuzz.json");
        return 0;
    }
    check_options(options.value());
    const host::PlayOptions merged = host::merge({}, options.value());
    fuzz::require(merged.frames == options.value().frames &&
                      merged.instrument.parameters == options.value().instrument.parameters,
                  "options under an empty command line stay");
    return 0;
}
