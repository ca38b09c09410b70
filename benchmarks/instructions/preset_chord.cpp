#include "preset_chord.h"

#include <algorithm>
#include <stdexcept>

namespace jawari::benchmarks {
namespace {

constexpr std::size_t fingers = 10;
/// Blocks in which the first strokes leave the strings.
constexpr std::size_t blocks_before = 8;

host::SharedInstrument loaded(const std::string& preset) {
    auto instrument = host::load_and_compile(preset, {});
    if (!instrument) throw std::runtime_error(instrument.error().message);
    return instrument.value();
}

}  // namespace

PresetChord::PresetChord(const std::string& preset)
    : instrument_(loaded(preset)),
      state_(make_instrument_state(instrument_->model)),
      left_(block_frames),
      right_(block_frames) {
    const std::vector<int> all = keys();
    std::vector<InstrumentEvent> events{set_sustain_pedal(0, true)};
    for (const int key : all) events.push_back(note_on(0, key, 1));
    for (std::size_t finger = 0; finger < std::min(fingers, all.size()); ++finger) {
        const int key = all[finger * all.size() / std::min(fingers, all.size())];
        chord_.push_back(note_off(0, key));
        chord_.push_back(note_on(0, key, 1));
    }
    render(events);
    for (std::size_t block = 1; block < blocks_before; ++block) render({});
}

void PresetChord::play() {
    render(chord_);
}

/// The lowest of each course.
std::vector<int> PresetChord::keys() const {
    std::vector<int> keys;
    for (const CourseModel& course : instrument_->model.courses)
        keys.push_back(instrument_->model.strings[course.strings.front()].stopped.front().key);
    return keys;
}

void PresetChord::render(const std::vector<InstrumentEvent>& events) {
    render_instrument(instrument_->model, state_, events, InstrumentOutput{left_.data(), right_.data(), {}},
                      block_frames);
}

}  // namespace jawari::benchmarks
