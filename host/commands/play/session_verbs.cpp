// What each command does to a session.

#include "base/suggestion.h"
#include "base/text.h"
#include "commands/play/device_list.h"
#include "commands/play/monitor_text.h"
#include "commands/play/session.h"
#include "formats/words/parameter_words.h"
#include "instrument/preset_library.h"
#include "midi/ignored.h"

namespace jawari::host {

namespace {

constexpr double longest_note_s = 600;
constexpr double longest_wait_s = 3600;

Outcome<VerbReply> reply_to(const MaybeError& error, VerbReply reply = {}) {
    if (error) return *error;
    return reply;
}

std::string with_unit(const ParameterDeclaration& parameter, double value) {
    return std::string(parameter.key) + " = " + shortest(value) +
           (parameter.unit == "1" ? "" : " " + std::string(parameter.unit));
}

VerbReply list_presets() {
    VerbReply reply;
    for (const NamedPreset& preset : named_presets())
        reply.lines.push_back(preset.name + (preset.origin == PresetOrigin::BuiltIn
                                                 ? ""
                                                 : "  (" + origin_text(preset.origin) + ")"));
    return reply;
}

VerbReply help(const VerbCall& call) {
    VerbReply reply;
    const std::string wanted = call.arguments.empty() ? std::string() : text_of(call, 0);
    for (const Verb& verb : verb_table())
        if (wanted.empty() || verb.name == wanted)
            reply.lines.push_back(
                formatted("%-42s %s", usage_of(verb).c_str(), std::string(verb.help).c_str()));
    if (reply.lines.empty())
        reply.lines.push_back("no command " + in_quotes(wanted) + did_you_mean(wanted, verb_names()));
    return reply;
}

Error unknown_parameter(const std::string& verb, const std::string& key) {
    const std::vector<std::string> keys = parameter_keys();
    return usage_error(verb, in_quotes(key) + did_you_mean(key, keys), join(keys));
}

}  // namespace

Outcome<VerbReply> Session::execute(const VerbCall& call) {
    switch (call.verb->id) {
        case VerbId::Preset:
            return reply_to(control_->play_preset(text_of(call, 0)));
        case VerbId::Presets:
            return list_presets();
        case VerbId::Set:
            return set(call);
        case VerbId::Get:
            return get(call);
        case VerbId::Gain:
            if (number_of(call, 0) < -120 || number_of(call, 0) > 60)
                return usage_error("gain", shortest(number_of(call, 0)), "-120 to 60 dB");
            return reply_to(control_->set_gain(number_of(call, 0)));
        case VerbId::Note:
            return note(call);
        case VerbId::Panic:
            return reply_to(control_->panic());
        case VerbId::Record:
            return record(call);
        case VerbId::Stats:
            return stats();
        case VerbId::Monitor:
            monitor_ = text_of(call, 0) == "on";
            control_->player().set_monitor(monitor_);
            return VerbReply{};
        case VerbId::Devices:
            return VerbReply{devices_text(survey_devices()), {}};
        case VerbId::Wait: {
            const double seconds = number_of(call, 0);
            if (seconds < 0 || seconds > longest_wait_s)
                return usage_error("wait", shortest(seconds),
                                   "0 to " + shortest(longest_wait_s) + " seconds");
            return VerbReply{{}, {}, seconds};
        }
        case VerbId::Help:
            return help(call);
        case VerbId::Quit:
            quit_ = true;
            break;
    }
    return VerbReply{};
}

Outcome<VerbReply> Session::set(const VerbCall& call) {
    const ParameterDeclaration* parameter = find_parameter(text_of(call, 0));
    if (parameter == nullptr) return unknown_parameter("set", text_of(call, 0));
    const double value = number_of(call, 1);
    if (value < parameter->low || value > parameter->high)
        return usage_error("set " + std::string(parameter->key), shortest(value),
                           parameter_range(*parameter));
    return reply_to(control_->set_parameter(parameter->id, value));
}

Outcome<VerbReply> Session::get(const VerbCall& call) const {
    VerbReply reply;
    for (const ParameterDeclaration& parameter : parameter_table()) {
        if (!call.arguments.empty() && parameter.key != text_of(call, 0)) continue;
        const double value = control_->player().parameter(parameter.id);
        reply.lines.push_back(with_unit(parameter, value));
        reply.values.emplace_back(parameter.key, value);
    }
    if (reply.lines.empty()) return unknown_parameter("get", text_of(call, 0));
    return reply;
}

Outcome<VerbReply> Session::note(const VerbCall& call) {
    const double seconds = number_of(call, 2);
    if (seconds <= 0 || seconds > longest_note_s)
        return usage_error("note: SECONDS", shortest(seconds), "above 0, to " + shortest(longest_note_s));
    control_->note(static_cast<int>(number_of(call, 0)), static_cast<int>(number_of(call, 1)), seconds,
                   steady_clock_ns());
    return VerbReply{};
}

/// What meant something, but not here: `controller 91 (reverb)`, with its count.
std::vector<std::pair<std::string, std::uint64_t>> Session::ignored() const {
    std::vector<std::pair<std::string, std::uint64_t>> kinds;
    const auto add = [&kinds](const std::string& what, std::uint64_t count) {
        if (count > 0) kinds.emplace_back(what, count);
    };
    const LiveIgnored& live = latest_.ignored;
    for (std::size_t controller = 0; controller < live.controllers.size(); ++controller)
        add(controller_kind(static_cast<int>(controller)), live.controllers[controller]);
    add("RPN and NRPN data", live.data);
    add("notes moved beyond the keys 0 to 127", live.moved_notes);
    add("notes of channels without a string", live.unplayed_notes);
    if (midi_)
        for (const auto& [name, count] : midi_->ignored_exclusives()) add("system exclusive: " + name, count);
    return kinds;
}

VerbReply Session::stats() {
    sample_statistics();
    const LiveStatistics& live = latest_;
    const AudioFacts& facts = audio_.facts();
    const AudioCounters* counters = audio_.counters();
    const double clipped = counters == nullptr ? 0 : static_cast<double>(counters->clipped.load());
    const double deadline_ms = 1000.0 * facts.frames / facts.rate_hz;
    VerbReply reply;
    reply.lines = {
        formatted("load %.1f %% on average, worst block %.1f %% of %.2f ms, %llu blocks late",
                  100 * live.mean_load, 100 * worst_load_, deadline_ms,
                  static_cast<unsigned long long>(live.late_blocks)),
        formatted("xruns %llu, clipped samples %.0f, overload step %d (%llu changes)",
                  static_cast<unsigned long long>(live.xruns), clipped, live.overload_level,
                  static_cast<unsigned long long>(live.overload_changes)),
        formatted("held notes %zu, voices %zu, instruments %zu, energy %.3g J", live.held_notes, live.voices,
                  live.instruments, live.energy_J),
        formatted("notes %llu, ignored %llu, stolen %llu, faded %llu",
                  static_cast<unsigned long long>(live.notes),
                  static_cast<unsigned long long>(live.ignored_notes),
                  static_cast<unsigned long long>(live.stolen_notes),
                  static_cast<unsigned long long>(live.faded_voices)),
        formatted("MIDI messages %llu, lost %llu; resets of strings %llu",
                  static_cast<unsigned long long>(live.messages),
                  static_cast<unsigned long long>(live.dropped_messages),
                  static_cast<unsigned long long>(live.nonfinite_resets)),
    };
    const auto kinds = ignored();
    std::uint64_t ignored_messages = 0;
    for (const auto& [what, count] : kinds) {
        reply.lines.push_back("ignored: " + std::to_string(count) + " " + printable(what));
        ignored_messages += count;
    }
    reply.values = {{"load", live.mean_load},
                    {"worst_load", worst_load_},
                    {"late_blocks", static_cast<double>(live.late_blocks)},
                    {"xruns", static_cast<double>(live.xruns)},
                    {"clipped_samples", clipped},
                    {"overload_level", live.overload_level},
                    {"held_notes", static_cast<double>(live.held_notes)},
                    {"voices", static_cast<double>(live.voices)},
                    {"energy_J", live.energy_J},
                    {"notes", static_cast<double>(live.notes)},
                    {"ignored_notes", static_cast<double>(live.ignored_notes)},
                    {"messages", static_cast<double>(live.messages)},
                    {"ignored_messages", static_cast<double>(ignored_messages)},
                    {"lost_messages", static_cast<double>(live.dropped_messages)}};
    return reply;
}

}  // namespace jawari::host
