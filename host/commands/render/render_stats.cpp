#include "commands/render/render_stats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "jawari/version.h"

namespace jawari::host {

namespace {

using Json = nlohmann::ordered_json;

double sound_s(const RenderStats& stats) {
    return static_cast<double>(stats.score.frames) / stats.output_rate_hz;
}

Json or_null(std::optional<double> value) {
    return value ? Json(*value) : Json(nullptr);
}

unsigned long long count(std::uint64_t value) {
    return value;
}

InstrumentCounters all_notes(const RenderStats& stats) {
    InstrumentCounters sum;
    for (const PartStats& part : stats.parts) {
        sum.notes += part.notes.notes;
        sum.ignored_notes += part.notes.ignored_notes;
        sum.stolen_notes += part.notes.stolen_notes;
        sum.delayed_notes += part.notes.delayed_notes;
        sum.faded_voices += part.notes.faded_voices;
        sum.legato_notes += part.notes.legato_notes;
    }
    return sum;
}

Counters all_contacts(const RenderStats& stats) {
    Counters sum;
    for (const PartStats& part : stats.parts) sum += part.contacts;
    return sum;
}

Json parts_json(const RenderStats& stats) {
    Json parts = Json::array();
    for (const PartStats& part : stats.parts) {
        parts.push_back({{"preset", part.preset},
                         {"port", part.port},
                         {"channel", part.channel},
                         {"contact_rate_hz", part.contact_rate_hz},
                         {"notes", part.played},
                         {"ignored_notes", part.notes.ignored_notes},
                         {"stolen_notes", part.notes.stolen_notes},
                         {"impulses", part.contacts.impulses}});
    }
    return parts;
}

Json ignored_json(const RenderStats& stats) {
    Json kinds = Json::array();
    for (const IgnoredKind& kind : stats.ignored)
        kinds.push_back({{"what", kind.what}, {"messages", kind.count}});
    return kinds;
}

Json lent_json(const RenderStats& stats) {
    Json kinds = Json::array();
    for (const LentNotes& lent : stats.lent_notes)
        kinds.push_back({{"preset", lent.preset}, {"player", lent.player}, {"notes", lent.count}});
    return kinds;
}

Json repairs_json(const RenderStats& stats) {
    Json repairs = Json::array();
    for (const MidiRepair& repair : stats.repairs)
        repairs.push_back({{"place", repair.place},
                           {"what", repair.what},
                           {"assumed", repair.assumed},
                           {"count", repair.count}});
    return repairs;
}

std::uint64_t played_notes(const RenderStats& stats) {
    std::uint64_t sum = 0;
    for (const PartStats& part : stats.parts) sum += part.played;
    return sum;
}

std::string parts_line(const RenderStats& stats) {
    std::string text = "parts    ";
    for (const PartStats& part : stats.parts)
        text +=
            " " + printable(part.preset) + (stats.parts.size() > 1 ? "/" + std::to_string(part.channel) : "");
    return text + (stats.parts.empty() ? " none" : "") + "\n";
}

}  // namespace

void describe_job(const std::string& midi, const RenderOptions& options, const Score& score,
                  const Ensemble& ensemble, RenderStats& stats) {
    stats.midi = midi;
    stats.preset = options.preset;
    stats.quality = name_of(options.instrument.quality.value_or(Quality::Live));
    stats.output_rate_hz = options.rate_hz;
    stats.score_s = static_cast<double>(score.end_frame) / options.rate_hz;
    stats.silent_notes = score.silent_notes;
    stats.ignored = score.ignored;
    stats.lent_notes = score.lent_notes;
    for (const EnsemblePart& part : ensemble.parts)
        stats.parts.push_back(
            {part.score->preset, part.score->port + 1, part.score->channel + 1,
             part.score->notes - std::min(part.score->notes, part.state.counters.ignored_notes),
             part.instrument->model.contact_rate_hz, part.state.counters, contact_counters(part.state)});
}

std::optional<double> real_time_factor(const RenderStats& stats) {
    if (stats.score.render_cpu_s <= 0 || stats.score.frames == 0) return std::nullopt;
    return sound_s(stats) / stats.score.render_cpu_s;
}

std::optional<double> peak_dbfs(const RenderStats& stats) {
    if (stats.score.peak <= 0) return std::nullopt;
    return 20 * std::log10(stats.score.peak);
}

std::string stats_json(const RenderStats& stats) {
    const InstrumentCounters notes = all_notes(stats);
    const Counters contacts = all_contacts(stats);
    const Json json{{"schema", "jawari.render-stats/2"},
                    {"jawari_version", JAWARI_VERSION},
                    {"midi", stats.midi},
                    {"preset", stats.preset},
                    {"quality", stats.quality},
                    {"output_rate_hz", stats.output_rate_hz},
                    {"frames", stats.score.frames},
                    {"sound_s", sound_s(stats)},
                    {"score_s", stats.score_s},
                    {"cpu_compile_s", stats.cpu_compile_s},
                    {"cpu_render_s", stats.score.render_cpu_s},
                    {"cpu_output_s", stats.cpu_output_s},
                    {"real_time_factor", or_null(real_time_factor(stats))},
                    {"peak_dbfs", or_null(peak_dbfs(stats))},
                    {"clipped_samples", stats.score.clipped},
                    {"limited_frames", stats.score.limited_frames},
                    {"limiter_reduction_db", -20 * std::log10(stats.score.least_gain) + 0.0},
                    {"notes", played_notes(stats)},
                    {"strokes", notes.notes},
                    {"silent_notes", stats.silent_notes},
                    {"ignored_notes", notes.ignored_notes},
                    {"stolen_notes", notes.stolen_notes},
                    {"delayed_notes", notes.delayed_notes},
                    {"faded_voices", notes.faded_voices},
                    {"legato_notes", notes.legato_notes},
                    {"steps", contacts.steps},
                    {"candidates", contacts.candidates},
                    {"impulses", contacts.impulses},
                    {"solves", contacts.solves},
                    {"truncated_solves", contacts.truncated_solves},
                    {"nonfinite_resets", contacts.nonfinite_resets},
                    {"lcp_residual_max_m", contacts.worst_residual_m},
                    {"worst_penetration_m", contacts.worst_penetration_m},
                    {"lent_notes", lent_json(stats)},
                    {"ignored", ignored_json(stats)},
                    {"repairs", repairs_json(stats)},
                    {"parts", parts_json(stats)}};
    // Names of files may hold any bytes; those that are no UTF-8 become replacement characters.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string stats_summary(const RenderStats& stats) {
    const InstrumentCounters notes = all_notes(stats);
    const Counters contacts = all_contacts(stats);
    std::string text = formatted("sound     %g s at %g Hz", sound_s(stats), stats.output_rate_hz);
    if (const auto peak = peak_dbfs(stats)) text += formatted(", peak %.1f dBFS", *peak);
    text += "\n" + parts_line(stats);
    text += formatted("notes     %llu played, %llu ignored, %llu taken from their string by another\n",
                      count(played_notes(stats)), count(notes.ignored_notes), count(notes.stolen_notes));
    text += formatted("contact   %llu impulses in %llu steps, worst penetration %.3g m\n",
                      count(contacts.impulses), count(contacts.steps), contacts.worst_penetration_m);
    if (contacts.truncated_solves + contacts.nonfinite_resets > 0) {
        text += formatted("caution   %llu truncated solves, %llu resets of a state that was not finite\n",
                          count(contacts.truncated_solves), count(contacts.nonfinite_resets));
    }
    text +=
        formatted("CPU       %.3g s compile, %.3g s render", stats.cpu_compile_s, stats.score.render_cpu_s);
    if (const auto factor = real_time_factor(stats)) text += formatted(", %.3g times real time", *factor);
    return text + "\n";
}

}  // namespace jawari::host
