#include "jawari/instrument/qualities.h"

#include <string>
#include <utility>

#include "jawari/instrument/compile.h"

namespace jawari {
namespace {

bool have_same_contacts(const InstrumentStringModel& a, const InstrumentStringModel& b) {
    for (std::size_t fret = 0; fret < a.stopped.size(); ++fret) {
        if (a.stopped[fret].string.shape->contact_position != b.stopped[fret].string.shape->contact_position)
            return false;
    }
    return true;
}

}  // namespace

std::optional<Failure> add_qualities(InstrumentModel& model, const InstrumentDescription& instrument,
                                     std::span<const QualityDescription> lower) {
    for (const QualityDescription& quality : lower) {
        InstrumentDescription lowered = instrument;
        lowered.quality = quality;
        auto compiled = compile_instrument(lowered, model.output_rate_hz);
        if (!compiled) return compiled.failure();
        for (std::size_t s = 0; s < model.strings.size(); ++s) {
            if (!have_same_contacts(model.strings[s], compiled.value().strings[s]))
                return Failure{"strings[" + std::to_string(s) + "]", "other contacts at a lower quality",
                               "contacts that every quality has"};
        }
        model.lower.push_back(std::move(compiled.value().strings));
    }
    return {};
}

}  // namespace jawari
