#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "commands/simulate/stats.h"
#include "formats/scene/words.h"
#include "jawari/version.h"

namespace jawari::host {

namespace {

using Json = nlohmann::ordered_json;

Json or_null(std::optional<double> value) {
    return value ? Json(*value) : Json(nullptr);
}

std::string metering_word(Metering metering) {
    switch (metering) {
        case Metering::Off:
            return "off";
        case Metering::Frame:
            return "frame";
        case Metering::Step:
            return "step";
    }
    return {};
}

Json settings_json(const SimulationStats& stats) {
    Json settings{{"output_rate_hz", stats.settings.output_rate_hz},
                  {"contact_rate_hz", stats.settings.contact_rate_hz},
                  {"duration_s", stats.duration_s},
                  {"scheme", word(stats.settings.scheme)}};
    if (stats.settings.scheme == Scheme::Theta) settings["theta"] = stats.settings.theta;
    settings["law"] = word(stats.settings.law);
    settings["metering"] = metering_word(stats.metering);
    return settings;
}

void add_counters(Json& json, const Counters& counters) {
    json["steps"] = counters.steps;
    json["candidates"] = counters.candidates;
    json["impulses"] = counters.impulses;
    json["solves"] = counters.solves;
    json["truncated_solves"] = counters.truncated_solves;
    json["flown_frames"] = counters.flown_frames;
    json["near_frames"] = counters.near_frames;
    json["asleep_frames"] = counters.asleep_frames;
    json["nonfinite_resets"] = counters.nonfinite_resets;
    json["lcp_residual_max_m"] = counters.worst_residual_m;
    json["worst_penetration_m"] = counters.worst_penetration_m;
}

Json string_json(const StringStats& string) {
    Json json{{"name", string.name},
              {"start", word(string.start)},
              {"modes", string.modes},
              {"contacts", string.contacts}};
    add_counters(json, string.counters);
    json["energy_max_over_initial"] = or_null(energy_max_over_initial(string));
    json["initial_energy_J"] = string.initial_energy_J;
    json["final_energy_J"] = string.final_energy_J;
    return json;
}

void add_totals(Json& json, const SimulationStats& stats) {
    std::size_t modes = 0;
    std::size_t contacts = 0;
    double initial = 0;
    double last = 0;
    for (const StringStats& string : stats.strings) {
        modes += string.modes;
        contacts += string.contacts;
        initial += string.initial_energy_J;
        last += string.final_energy_J;
    }
    json["modes"] = modes;
    json["contacts"] = contacts;
    add_counters(json, total_counters(stats));
    json["energy_max_over_initial"] = or_null(energy_max_over_initial(stats));
    json["initial_energy_J"] = initial;
    json["final_energy_J"] = last;
}

std::string scheme_text(const SimulationStats& stats) {
    if (stats.settings.scheme == Scheme::Exact) return "exact scheme";
    return formatted("theta scheme with theta = %g", stats.settings.theta);
}

}  // namespace

std::string stats_json(const SimulationStats& stats) {
    Json json{{"schema", "jawari.stats/1"},
              {"jawari_version", JAWARI_VERSION},
              {"scene", stats.scene},
              {"settings", settings_json(stats)},
              {"rows", stats.rows},
              {"sound_s", stats.sound_s},
              {"cpu_compile_s", stats.cpu_compile_s},
              {"cpu_render_s", stats.cpu_render_s},
              {"cpu_output_s", stats.cpu_output_s},
              {"real_time_factor", or_null(real_time_factor(stats))},
              {"worst_frame_multiply_adds", stats.worst_frame_multiply_adds}};
    add_totals(json, stats);
    for (const StringStats& string : stats.strings) json["strings"].push_back(string_json(string));
    // A scene's name may hold any bytes; those that are no UTF-8 become replacement characters.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string stats_summary(const SimulationStats& stats) {
    const Counters total = total_counters(stats);
    std::string text;
    for (const StringStats& string : stats.strings)
        text += formatted("string    %.200s: %zu modes, %zu contacts\n", string.name.c_str(), string.modes,
                          string.contacts);
    text += formatted("settings  %s, %s law, contact rate %.12g Hz, output rate %.12g Hz\n",
                      scheme_text(stats).c_str(), word(stats.settings.law).c_str(),
                      stats.settings.contact_rate_hz, stats.settings.output_rate_hz);
    text += formatted("sound     %g s in %llu rows\n", stats.sound_s,
                      static_cast<unsigned long long>(stats.rows));
    text += formatted(
        "contact   %llu impulses in %llu steps, worst penetration %.3g m, worst residual %.3g m\n",
        static_cast<unsigned long long>(total.impulses), static_cast<unsigned long long>(total.steps),
        total.worst_penetration_m, total.worst_residual_m);
    if (total.truncated_solves + total.nonfinite_resets > 0)
        text += formatted("caution   %llu truncated solves, %llu resets of a state that was not finite\n",
                          static_cast<unsigned long long>(total.truncated_solves),
                          static_cast<unsigned long long>(total.nonfinite_resets));
    for (const StringStats& string : stats.strings)
        text += formatted("energy    %.200s: %.6g J at first, %.6g J at last, %.6g J at most\n",
                          string.name.c_str(), string.initial_energy_J, string.final_energy_J,
                          string.highest_energy_J);
    text += formatted("CPU       %.3g s compile, %.3g s render", stats.cpu_compile_s, stats.cpu_render_s);
    if (const auto factor = real_time_factor(stats)) text += formatted(", %.3g times real time", *factor);
    return text + "\n";
}

}  // namespace jawari::host
