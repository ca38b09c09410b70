// Arbitrary bytes as a preset file: refused properly, or an instrument whose notes are finite numbers.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "check.h"
#include "formats/preset/read_preset.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/render.h"

namespace {

using namespace jawari;

constexpr double output_rate_hz = 48000;
constexpr double largest_cost = 5000;  // modes x frets^2, so that an input takes milliseconds

bool cheap(const InstrumentDescription& instrument) {
    const double frets = static_cast<double>(instrument.frets.count) + 1;
    double total = 0;
    for (const InstrumentStringDescription& string : instrument.strings) {
        total += instrument.quality.mode_limit_hz / string.open_frequency_hz * frets * frets;
    }
    return total >= 0 && total <= largest_cost && instrument.quality.contact_rate_min_hz <= 2e6;
}

void play(const InstrumentModel& model, int key) {
    InstrumentState state = make_instrument_state(model);
    const std::array<InstrumentEvent, 3> events{note_on(1, key, 1), note_on(5, key + 1, 0.5),
                                                note_off(9, key, 0)};
    std::array<double, 16> output{};
    render_instrument(model, state, events, output.data(), output.size());
    for (const double sample : output) {
        fuzz::require(std::isfinite(sample) || contact_counters(state).nonfinite_resets > 0,
                      "output is finite");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    const auto preset = host::read_preset(text, "fuzz.json");
    if (!preset) {
        fuzz::require_proper_refusal(preset.error(), "fuzz.json");
        return 0;
    }
    const InstrumentDescription& instrument = preset.value().instrument;
    if (!cheap(instrument)) return 0;
    const auto model = compile_instrument(instrument, output_rate_hz);
    if (model) {
        play(model.value(), instrument.strings.front().open_note);
    } else {
        fuzz::require_proper_failure(model.failure());
    }
    return 0;
}
