#include "commands/render/score_notices.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>

#include "base/text.h"
#include "jawari/instrument/model.h"

namespace jawari::host {

namespace {

bool has_key(const InstrumentModel& model, int key) {
    return std::any_of(model.courses.begin(), model.courses.end(), [&](const auto& course) {
        const auto& stopped = model.strings[course.strings.front()].stopped;
        return std::any_of(stopped.begin(), stopped.end(), [&](const auto& stop) { return stop.key == key; });
    });
}

/// Keys that the part plays and no string has, as `38, 40`.
std::string keys_of_no_string(const EnsemblePart& part) {
    std::set<int> keys;
    for (const TimedEvent& timed : part.score->events) {
        if (timed.event.type == InstrumentEventType::NoteOn &&
            !has_key(part.instrument->model, timed.event.key))
            keys.insert(timed.event.key);
    }
    std::string list;
    for (auto key = keys.begin(); key != keys.end();) {
        auto end = std::next(key);
        while (end != keys.end() && *end == *std::prev(end) + 1) ++end;
        const auto last = std::prev(end);
        list += (list.empty() ? "" : ", ") + std::to_string(*key);
        if (last != key) list += (std::next(key) == last ? ", " : " to ") + std::to_string(*last);
        key = end;
    }
    return list;
}

/// `1 note is`, `2 notes are`.
std::string counted(std::uint64_t count, const char* one, const char* more) {
    return std::to_string(count) + " " + (count == 1 ? one : more);
}

}  // namespace

std::vector<std::string> score_notices(const Score& score, const Ensemble& ensemble, bool programs_choose) {
    std::vector<std::string> lines;
    for (const EnsemblePart& part : ensemble.parts) {
        const InstrumentDescription& instrument = part.instrument->preset.instrument;
        if (instrument.law == ImpactLaw::Signorini && instrument.frets.restitution > 0)
            lines.push_back(printable(part.instrument->preset.file) +
                            ": the law signorini ignores the restitution of the frets");
        if (const std::string keys = keys_of_no_string(part); !keys.empty())
            lines.push_back(formatted("%s: no string has the keys %s; their notes are not played",
                                      printable(part.score->preset).c_str(), keys.c_str()));
    }
    if (score.cut_notes > 0)
        lines.push_back(counted(score.cut_notes, "note began before --start and is not played",
                                "notes began before --start and are not played"));
    if (score.silent_notes > 0)
        lines.push_back(counted(score.silent_notes, "note is silent", "notes are silent") +
                        ": drums, or programs without strings");
    for (const LentNotes& lent : score.lent_notes)
        lines.push_back(counted(lent.count, "note is", "notes are") + " beyond the keys of " +
                        printable(lent.preset) + "; " + printable(lent.player) + " plays " +
                        (lent.count == 1 ? "it" : "them"));
    for (const IgnoredKind& kind : score.ignored)
        lines.push_back(counted(kind.count, "message does nothing: ", "messages do nothing: ") +
                        printable(kind.what));
    if (score.program_changes > 0 && !programs_choose)
        lines.emplace_back("program changes do nothing; --preset auto follows them");
    return lines;
}

}  // namespace jawari::host
