// Instruments on a bridge that moves, and the balance of their energy.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "instrument/voice/voice.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/render.h"
#include "jawari/scene/energy.h"
#include "support/small_instrument.h"

namespace jawari::test {

/// Frets, a thread, cotton, pickups, and a body of which the last mode listens.
inline InstrumentDescription bridged_instrument() {
    InstrumentDescription instrument = small_instrument();
    for (std::size_t j = 0; j < instrument.body.size(); ++j) {
        instrument.body[j].mass_kg = 0.2;
        instrument.body[j].shape = {1, j == 0 ? 0.9 : -0.7, 0.8};
    }
    BodyModeDescription listens = instrument.body.back();
    listens.mass_kg = 0;
    listens.shape.clear();
    instrument.body.push_back(listens);
    instrument.soft_touches.clear();
    instrument.bridge = BridgeDescription{};
    return instrument;
}

/// Everything that players do, on strings that strike frets, threads and rattles.
inline InstrumentDescription played_instrument(double body_kg) {
    InstrumentDescription instrument = small_instrument();
    for (std::size_t j = 0; j < instrument.body.size(); ++j) {
        instrument.body[j].mass_kg = body_kg;
        instrument.body[j].shape = {1, j == 0 ? 0.9 : -0.7, 0.8};
    }
    instrument.bridge = BridgeDescription{};
    return instrument;
}

/// Something that a player does, on the first strings and stops.
inline std::vector<InstrumentEvent> random_event(std::mt19937_64& random, const InstrumentModel& model) {
    const auto chance = [&](double below) { return below * static_cast<double>(random() >> 11) * 0x1p-53; };
    const int channel = static_cast<int>(chance(3));
    const auto& string = model.strings[static_cast<std::size_t>(chance(3))];
    const int key = string.stopped[static_cast<std::size_t>(chance(8))].key;
    switch (static_cast<int>(chance(9))) {
        case 0:
        case 1:
        case 2:
            return {note_on(0, key, 0.05 + chance(0.95), channel)};
        case 3:
            return {note_off(0, key, chance(1), channel)};
        case 4:
            return {bend_channel(0, chance(8) - 4, channel)};
        case 5:
            return {all_notes_off(0, channel)};
        case 6:
            return {set_parameter(0, ParameterId::PalmMute, chance(1), channel)};
        case 7:
            return {set_parameter(0, ParameterId::Articulation, std::floor(chance(4)), channel)};
        default:
            return {set_sustain_pedal(0, chance(2) < 1, channel)};
    }
}

/// At 48 kHz.
inline InstrumentModel compiled(const InstrumentDescription& instrument) {
    auto model = compile_instrument(instrument, 48000);
    EXPECT_TRUE(model.ok());
    return std::move(model.value());
}

inline std::size_t voices_in_runs(const InstrumentState& state) {
    std::size_t count = 0;
    for (const InstrumentStringState& string : state.strings) {
        for (const Voice& voice : string.voices) count += voice.run.frames > 0 ? 1 : 0;
    }
    return count;
}

/// Of strings, body and bridge together [J].
inline double whole_energy(const InstrumentModel& model, InstrumentState& state) {
    double sum = bridge_energy(model, state);
    for (std::size_t s = 0; s < model.strings.size(); ++s) sum += string_energy(model, state, s);
    return sum;
}

/// That players did, the parametric kind with it [J].
inline double work_of(const PlayerWork& work) {
    return work.exciters_J + work.touches_J + work.bends_J + work.transfers_J + work.quality_changes_J +
           work.noises_J + work.couplings_J;
}

/// The energy of all, less what was given, must not rise from frame to frame. Where a voice takes over from
/// another, which still fades, both count: transfers_J is the new one's energy less the old one's.
class Balance {
  public:
    Balance(const InstrumentModel& model, InstrumentState& state) : model_(model), state_(state) {}

    void look() {
        const double energy = whole_energy(model_, state_);
        const double now = energy - work_of(state_.work);
        largest_ = std::max(largest_, energy);
        if (state_.counters.legato_notes == transfers_) worst_ = std::max(worst_, now - before_);
        transfers_ = state_.counters.legato_notes;
        before_ = now;
    }
    [[nodiscard]] double worst() const { return worst_ / largest_; }

  private:
    const InstrumentModel& model_;
    InstrumentState& state_;
    std::uint64_t transfers_ = 0;
    double before_ = 0, largest_ = 0, worst_ = 0;
};

/// The events, then frames one by one.
inline void play_balanced(const InstrumentModel& model, InstrumentState& state, Balance& balance,
                          const std::vector<InstrumentEvent>& events, std::size_t frames) {
    double left = 0, right = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        render_instrument(model, state, n == 0 ? events : std::vector<InstrumentEvent>(), {&left, &right, {}},
                          1);
        ASSERT_TRUE(std::isfinite(left + right));
        balance.look();
    }
}

}  // namespace jawari::test
