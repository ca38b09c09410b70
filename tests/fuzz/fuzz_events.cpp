// Arbitrary bytes as a performance on a small instrument: what is not allowed is ignored, the sound is finite
// and below its bound, no energy comes from nowhere, and the same performance in other blocks is the same
// sound bit for bit. In some performances motions are overwritten with what is no number: the sound is finite
// again at once.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

#include "check.h"
#include "event_bytes.h"
#include "instrument_watch.h"
#include "jawari/denormals.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"
#include "sound.h"
#include "support/injure.h"
#include "support/small_instrument.h"

namespace {

using namespace jawari;
using stress::Sound;

constexpr double output_rate_hz = 48000;

struct Fuzzed {
    InstrumentDescription description;
    InstrumentModel model;
};

Fuzzed make_fuzzed(ImpactLaw law) {
    Fuzzed fuzzed;
    InstrumentDescription& description = fuzzed.description;
    description = test::small_instrument();
    description.law = law;
    description.quality = {.contact_rate_min_hz = 96000, .mode_limit_hz = 1500};
    for (auto& exciter : description.exciters) exciter.width_m = 0.01;
    auto compiled = compile_instrument(description, output_rate_hz);
    fuzz::require(compiled.ok(), "the instrument compiles");
    fuzzed.model = std::move(compiled.value());
    const std::array<QualityDescription, 2> lower{
        QualityDescription{.contact_rate_min_hz = 48000, .mode_limit_hz = 1500},
        QualityDescription{.contact_rate_min_hz = 48000, .mode_limit_hz = 700}};
    fuzz::require(!add_qualities(fuzzed.model, description, lower), "its qualities compile");
    return fuzzed;
}

/// Compiled on first use, for all inputs.
const Fuzzed& instrument_of(std::uint8_t byte) {
    static constexpr std::array<ImpactLaw, 4> laws{ImpactLaw::Signorini, ImpactLaw::Passive,
                                                   ImpactLaw::PaoliSchatzman, ImpactLaw::Newton};
    static std::array<std::optional<Fuzzed>, laws.size()> all;
    const std::size_t i = byte % laws.size();
    if (!all[i]) all[i] = make_fuzzed(laws[i]);
    return *all[i];
}

void act_between(const fuzz::EventBlock& block, const InstrumentModel& model, InstrumentState& state) {
    const std::size_t s = block.string % model.strings.size();
    switch (block.before) {
        case fuzz::Between::Nothing:
            break;
        case fuzz::Between::ChangeQuality:
            change_quality(model, state, s, block.what % (model.lower.size() + 1));
            break;
        case fuzz::Between::FadeOldest:
            fade_oldest_released(state);
            break;
        case fuzz::Between::Injure:
            test::injure(state.strings[s], block.what, block.where);
            break;
    }
}

/// The events of a block that fall into `frames` frames after `done`; at its end also those that come later.
std::vector<InstrumentEvent> events_of(const fuzz::EventBlock& block, std::size_t done, std::size_t frames) {
    std::vector<InstrumentEvent> chosen;
    const bool last = done + frames == block.frames;
    for (const InstrumentEvent& event : block.events) {
        if (event.frame < done || (event.frame >= done + frames && !last)) continue;
        chosen.push_back(event);
        chosen.back().frame -= done;
    }
    return chosen;
}

void require_upheld(const stress::Judge& judge) {
    for (const stress::Violation& violation : judge.violations())
        std::fprintf(stderr, "fuzzing: %s, %s: %.17g, allowed %.17g\n", name_of(violation.invariant),
                     violation.where.c_str(), violation.found, violation.allowed);
    fuzz::require(judge.violations().empty(), "invariants of a performance");
}

/// Block by block as it is written, or frame by frame, with every check.
void play_checked(const fuzz::Performance& performance, const Fuzzed& fuzzed, InstrumentState& state,
                  Sound& sound) {
    stress::Judge judge;
    stress::InstrumentWatch watch(fuzzed.model, fuzzed.description, performance.frame_by_frame);
    for (const fuzz::EventBlock& block : performance.blocks) {
        watch.begin_piece(state);
        act_between(block, fuzzed.model, state);
        std::size_t done = 0;
        do {
            const std::size_t frames =
                performance.frame_by_frame ? std::min<std::size_t>(1, block.frames) : block.frames;
            if (done > 0) watch.begin_piece(state);
            render_instrument(fuzzed.model, state, events_of(block, done, frames), sound.append(frames),
                              frames);
            if (!performance.injured) watch.end_piece(state, sound.tail(frames), judge);
            done += frames;
        } while (done < block.frames);
    }
    require_upheld(judge);
}

/// The same; what lies between two acts of the host is joined and cut anew, by lengths that follow from
/// nothing but a count.
void play_recut(const fuzz::Performance& performance, const InstrumentModel& model, InstrumentState& state,
                Sound& sound) {
    fuzz::EventBlock joined;
    std::size_t cut = 0;
    const auto render_joined = [&] {
        std::size_t done = 0;
        do {
            const std::size_t frames = std::min(joined.frames - done, 1 + cut++ * 37 % 89);
            render_instrument(model, state, events_of(joined, done, frames), sound.append(frames), frames);
            done += frames;
        } while (done < joined.frames);
        joined = {};
    };
    for (const fuzz::EventBlock& block : performance.blocks) {
        if (block.before != fuzz::Between::Nothing) {
            render_joined();
            act_between(block, model, state);
        }
        for (InstrumentEvent event : block.events) {
            event.frame = joined.frames + std::min(event.frame, block.frames);
            joined.events.push_back(event);
        }
        joined.frames += block.frames;
    }
    render_joined();
}

void require_finite(const std::vector<double>& samples) {
    for (const double sample : samples) fuzz::require(std::isfinite(sample), "the sound is finite");
}

void require_same(const std::vector<double>& a, const std::vector<double>& b) {
    fuzz::require(a.size() == b.size() &&
                      (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0),
                  "other blocks, the same bits");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::Performance performance = fuzz::performance_of({data, size});
    const Fuzzed& fuzzed = instrument_of(performance.instrument);
    std::optional<NoDenormals> guard;  // as jawari plays and renders; embedders may not
    if (!performance.denormals) guard.emplace();
    InstrumentState state = make_instrument_state(fuzzed.model);
    if (performance.guitar) state.play = PlayMode::Guitar;
    InstrumentState again = state;
    Sound sound, recut;
    play_checked(performance, fuzzed, state, sound);
    play_recut(performance, fuzzed.model, again, recut);
    require_finite(sound.left);
    require_finite(sound.right);
    require_same(sound.left, recut.left);
    require_same(sound.right, recut.right);
    return 0;
}
