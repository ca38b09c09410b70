#include "commands/render/ensemble.h"

#include <algorithm>
#include <filesystem>

#include "jawari/denormals.h"

namespace jawari::host {

namespace {

/// The part's events of the block, with offsets in it.
std::span<const InstrumentEvent> take_events(EnsemblePart& part, std::uint64_t begin, std::uint64_t end,
                                             std::vector<InstrumentEvent>& events) {
    events.clear();
    const std::vector<TimedEvent>& all = part.score->events;
    for (; part.next < all.size() && all[part.next].frame < end; ++part.next) {
        events.push_back(all[part.next].event);
        events.back().frame = static_cast<std::size_t>(all[part.next].frame - begin);
    }
    return events;
}

void add(std::vector<double>& sum, const std::vector<double>& signal, double gain) {
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += gain * signal[n];
}

void name_stems(Ensemble& ensemble) {
    for (std::size_t i = 0; i < ensemble.parts.size(); ++i) {
        const LoadedInstrument& instrument = *ensemble.parts[i].instrument;
        const std::string preset = std::filesystem::path(instrument.preset.file).stem().string();
        for (const auto& string : instrument.model.strings)
            ensemble.stem_names.push_back(std::to_string(i + 1) + " " + preset + " " + string.name);
    }
}

void size_block(Ensemble& ensemble, std::size_t frames) {
    ensemble.left.assign(frames, 0.0);
    ensemble.right.assign(frames, 0.0);
    ensemble.part_left.assign(frames, 0.0);
    ensemble.part_right.assign(frames, 0.0);
    for (auto& stem : ensemble.stems) stem.assign(frames, 0.0);
}

}  // namespace

Ensemble make_ensemble(const Score& score, const std::vector<SharedInstrument>& instruments, bool with_stems,
                       double gain) {
    Ensemble ensemble;
    ensemble.gain = gain;
    for (std::size_t i = 0; i < instruments.size(); ++i) {
        ensemble.parts.push_back(
            {instruments[i], make_instrument_state(instruments[i]->model), &score.parts[i], 0});
        set_play_mode(ensemble.parts.back().state, score.parts[i].play);
    }
    name_stems(ensemble);
    if (with_stems) ensemble.stems.resize(ensemble.stem_names.size());
    return ensemble;
}

void render_block(Ensemble& ensemble, std::uint64_t begin, std::size_t frames) {
    const NoDenormals guard;
    size_block(ensemble, frames);
    std::size_t stem = 0;
    for (EnsemblePart& part : ensemble.parts) {
        const InstrumentModel& model = part.instrument->model;
        ensemble.part_strings.clear();
        for (std::size_t s = 0; s < model.strings.size() && !ensemble.stems.empty(); ++s)
            ensemble.part_strings.push_back(ensemble.stems[stem++].data());
        const InstrumentOutput output{ensemble.part_left.data(), ensemble.part_right.data(),
                                      ensemble.part_strings};
        const auto events = take_events(part, begin, begin + frames, ensemble.events);
        render_instrument(model, part.state, events, output, frames);
        add(ensemble.left, ensemble.part_left, ensemble.gain);
        add(ensemble.right, ensemble.part_right, ensemble.gain);
    }
    for (auto& signal : ensemble.stems)
        for (double& sample : signal) sample *= ensemble.gain;
}

}  // namespace jawari::host
