// What the audio thread tells about itself.
#include <algorithm>
#include <cmath>

#include "player/audio_thread.h"

namespace jawari::host {

namespace {

constexpr auto relaxed = std::memory_order_relaxed;
constexpr double mean_load_s = 0.5;

/// One writer raises, a reader sets back to 0; that one of both may be lost does no harm.
void raise(std::atomic<double>& meter, double value) {
    if (value > meter.load(relaxed)) meter.store(value, relaxed);
}

double largest(const double* x, std::size_t count) {
    double most = 0;
    for (std::size_t n = 0; n < count; ++n) most = std::max(most, std::abs(x[n]));
    return most;
}

}  // namespace

void AudioThread::measure_level(const double* left, const double* right, std::size_t frames) JAWARI_REALTIME {
    raise(links_.meters.peak_left, largest(left, frames));
    raise(links_.meters.peak_right, largest(right, frames));
    if (limiter_) links_.meters.limiter_gain.store(limiter_->least_gain, relaxed);
}

void AudioThread::measure_instruments() JAWARI_REALTIME {
    InstrumentCounters counters = retired_counters_;
    std::uint64_t nonfinite = retired_nonfinite_;
    std::size_t held = 0;
    std::size_t voices = 0;
    for (const StagedInstrument* instrument : stage_.sounding()) {
        counters += instrument->state.counters;
        nonfinite += instrument->nonfinite_resets;
        held += held_notes(instrument->state);
        voices += sounding_voices(instrument->state);
    }
    if (nonfinite != nonfinite_resets_)
        notify(LiveNotice::Kind::NonfiniteReset, static_cast<double>(nonfinite));
    nonfinite_resets_ = nonfinite;
    LiveMeters& meters = links_.meters;
    meters.instruments.store(stage_.sounding().size(), relaxed);
    meters.held_notes.store(held, relaxed);
    meters.voices.store(voices, relaxed);
    meters.notes.store(counters.notes, relaxed);
    meters.ignored_notes.store(counters.ignored_notes, relaxed);
    meters.stolen_notes.store(counters.stolen_notes, relaxed);
    meters.faded_voices.store(counters.faded_voices, relaxed);
    meters.nonfinite_resets.store(nonfinite, relaxed);
}

/// Surveys one string of each instrument per block: measuring all at once would cost too much.
void AudioThread::survey_strings() JAWARI_REALTIME {
    const auto sounding = stage_.sounding();
    if (sounding.empty()) return;
    for (StagedInstrument* instrument : sounding) survey_string(*instrument);
    links_.meters.energy_J.store(sounding[0]->energy_J, relaxed);
}

void AudioThread::survey_string(StagedInstrument& instrument) JAWARI_REALTIME {
    InstrumentState& state = instrument.state;
    const InstrumentModel& model = instrument.loaded->model;
    instrument.energy_sum_J += string_energy(model, state, instrument.surveyed);
    instrument.nonfinite_sum += nonfinite_resets(state, instrument.surveyed);
    instrument.surveyed += 1;
    if (instrument.surveyed < model.strings.size()) return;
    instrument.surveyed = 0;
    instrument.energy_J = instrument.energy_sum_J;
    instrument.energy_sum_J = 0;
    instrument.nonfinite_resets =
        std::max(instrument.nonfinite_resets, instrument.nonfinite_sum + finished_nonfinite_resets(state));
    instrument.nonfinite_sum = 0;
}

void AudioThread::measure(std::size_t frames, std::int64_t started_ns) JAWARI_REALTIME {
    LiveMeters& meters = links_.meters;
    if (frames == 0) return;
    const double available_s = static_cast<double>(frames) / settings_.rate_hz;
    const double load = 1e-9 * static_cast<double>(settings_.clock() - started_ns) / available_s;
    mean_load_ += std::min(1.0, available_s / mean_load_s) * (load - mean_load_);
    meters.blocks.fetch_add(1, relaxed);
    meters.frames.store(stage_.frame(), relaxed);
    meters.load.store(load, relaxed);
    meters.mean_load.store(mean_load_, relaxed);
    raise(meters.worst_load, load);
    if (load > 1) meters.late_blocks.fetch_add(1, relaxed);
    learn_note_cost(governor_, note_work_, load, available_s);
    if (govern(governor_, load, available_s)) tell_level();
}

void AudioThread::tell_level() JAWARI_REALTIME {
    const int level = static_cast<int>(governor_.level);
    links_.meters.overload_level.store(level, relaxed);
    links_.meters.overload_changes.fetch_add(1, relaxed);
    notify(LiveNotice::Kind::OverloadLevel, level);
}

void AudioThread::notify(LiveNotice::Kind kind, double value) JAWARI_REALTIME {
    links_.notices.push({kind, stage_.frame(), value});  // if nobody reads them, later ones are left out
}

}  // namespace jawari::host
