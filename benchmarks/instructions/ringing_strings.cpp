#include "ringing_strings.h"

#include <stdexcept>
#include <utility>

namespace jawari::benchmarks {
namespace {

constexpr std::size_t block_frames = 64;
constexpr std::size_t blocks_before = 375, blocks_counted = 75;
constexpr double velocity = 0.6;

host::SharedInstrument loaded(const std::string& name, bool moves) {
    auto preset = host::load_with(name, {});
    if (!preset) throw std::runtime_error(preset.error().message);
    if (!moves) preset.value().instrument.bridge.reset();
    auto instrument = host::compile_preset(std::move(preset.value()), {});
    if (!instrument) throw std::runtime_error(instrument.error().message);
    return instrument.value();
}

}  // namespace

RingingStrings::RingingStrings(const std::string& preset, bool moves)
    : instrument_(loaded(preset, moves)),
      state_(make_instrument_state(instrument_->model)),
      left_(block_frames),
      right_(block_frames) {
    std::vector<InstrumentEvent> events{set_sustain_pedal(0, true)};
    for (const CourseModel& course : instrument_->model.courses) {
        const int key = instrument_->model.strings[course.strings.front()].stopped.front().key;
        if (key >= 0) events.push_back(note_on(0, key, velocity));
    }
    render(events, 1);
    render({}, blocks_before - 1);
}

void RingingStrings::play() {
    render({}, blocks_counted);
}

void RingingStrings::render(const std::vector<InstrumentEvent>& events, std::size_t blocks) {
    for (std::size_t block = 0; block < blocks; ++block) {
        render_instrument(instrument_->model, state_, block == 0 ? events : std::vector<InstrumentEvent>(),
                          InstrumentOutput{left_.data(), right_.data(), {}}, block_frames);
    }
}

}  // namespace jawari::benchmarks
