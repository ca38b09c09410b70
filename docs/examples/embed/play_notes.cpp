// A two-string bass played by events, as a plugin or a live host would: public headers only.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "jawari/instrument/compile.h"
#include "jawari/instrument/render.h"

namespace {

constexpr double output_rate_hz = 48000;
constexpr std::size_t block = 256;

jawari::InstrumentStringDescription bass_string(const char* name, int open_note, double density_kg_per_m) {
    jawari::InstrumentStringDescription string;
    string.name = name;
    string.open_note = open_note;
    string.open_frequency_hz = 440 * std::exp2((open_note - 69) / 12.0);
    string.length_m = 0.863;
    string.linear_density_kg_per_m = density_kg_per_m;
    string.inharmonicity = 3e-5;
    string.damping = jawari::DecayTimePoints{{{{50, 8.0}, {5000, 1.0}}}};
    return string;
}

jawari::InstrumentDescription bass() {
    jawari::InstrumentDescription instrument;
    instrument.name = "two-string bass";
    instrument.gain = 0.1;
    instrument.quality = {.contact_rate_min_hz = 500000, .mode_limit_hz = 8000};
    instrument.exciters.push_back({.name = "finger",
                                   .place = {.from_bridge_m = 0.12},
                                   .body = jawari::FingerDescription{.full_height_m = 4e-3}});
    for (int fret = 0; fret < 12; ++fret) instrument.frets.height_m.push_back(-0.8e-3 - fret * 5e-5);
    instrument.frets.count = instrument.frets.height_m.size();
    instrument.pickups.push_back({.place = {.from_bridge_m = 0.1}, .width_m = 0.01});
    instrument.strings.push_back(bass_string("D", 38, 0.0053));
    instrument.strings.push_back(bass_string("G", 43, 0.0028));
    return instrument;
}

// Events carry their frame inside the block. Here: A2 (fret 7 of D) 100 frames into the first block, a hard
// G2 40 frames into block 50, and both keys up in block 150.
std::vector<jawari::InstrumentEvent> events_of(std::size_t index) {
    if (index == 0) return {jawari::note_on(100, 45, 0.5)};
    if (index == 50) return {jawari::note_on(40, 43, 1)};
    if (index == 150) return {jawari::note_off(0, 45), jawari::note_off(0, 43)};
    return {};
}

double peak(std::span<const double> samples) {
    double highest = 0;
    for (const double sample : samples) highest = std::max(highest, std::abs(sample));
    return highest;
}

}  // namespace

int main() {
    const auto compiled = jawari::compile_instrument(bass(), output_rate_hz);
    if (!compiled) {
        std::fprintf(stderr, "%s\n", compiled.failure().line().c_str());
        return 1;
    }
    const jawari::InstrumentModel& model = compiled.value();
    jawari::InstrumentState state = jawari::make_instrument_state(model);

    constexpr std::size_t blocks = 250;
    std::vector<double> sound(blocks * block);
    for (std::size_t index = 0; index < blocks; ++index) {
        const std::vector<jawari::InstrumentEvent> events = events_of(index);
        jawari::render_instrument(model, state, events, &sound[index * block], block);
    }

    const auto first = std::find_if(sound.begin(), sound.end(), [](double sample) { return sample != 0; });
    const std::span<const double> samples(sound);
    const jawari::Counters contacts = jawari::contact_counters(state);
    std::printf("first_sound_frame %td\n", first - sound.begin());
    std::printf("notes %llu\n", static_cast<unsigned long long>(state.counters.notes));
    std::printf("impulses %llu\n", static_cast<unsigned long long>(contacts.impulses));
    std::printf("peak_soft_note %.6f\n", peak(samples.first(50 * block)));
    std::printf("peak_hard_note %.6f\n", peak(samples.subspan(50 * block, 100 * block)));
    std::printf("peak_last_block %.9f\n", peak(samples.last(block)));

    // The same description at an impossible rate is refused with a reason.
    const auto refused = jawari::compile_instrument(bass(), -1);
    std::printf("refused %s\n", refused.ok() ? "NOTHING" : refused.failure().line().c_str());
    return 0;
}
