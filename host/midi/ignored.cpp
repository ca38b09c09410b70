#include "midi/ignored.h"

#include <array>
#include <string_view>
#include <utility>

namespace jawari::host {

namespace {

/// Names of the MIDI 1.0 Detailed Specification and of RP-021 and RP-023.
constexpr std::array<std::pair<int, std::string_view>, 31> controllers{
    {{2, "breath"},           {3, "undefined"},      {4, "foot"},           {5, "portamento time"},
     {8, "balance"},          {9, "undefined"},      {12, "effect 1"},      {13, "effect 2"},
     {65, "portamento"},      {66, "sostenuto"},     {69, "hold 2"},        {70, "sound variation"},
     {71, "resonance"},       {72, "release time"},  {73, "attack time"},   {75, "decay time"},
     {76, "vibrato rate"},    {77, "vibrato depth"}, {78, "vibrato delay"}, {79, "sound 10"},
     {80, "general 5"},       {81, "general 6"},     {82, "general 7"},     {83, "general 8"},
     {84, "portamento from"}, {91, "reverb"},        {92, "tremolo"},       {93, "chorus"},
     {94, "detune"},          {95, "phaser"},        {7, "volume"}}};

std::string data_kind(const MidiChannel& channel) {
    const std::string number = std::to_string(channel.number_msb) + "/" + std::to_string(channel.number_lsb);
    return channel.target == DataTarget::Registered ? "RPN " + number : "NRPN " + number;
}

}  // namespace

std::string controller_kind(int controller) {
    std::string_view name;
    for (const auto& [number, known] : controllers)
        if (number == controller) name = known;
    if (controller > 32 && controller < 64) name = "fine half";
    std::string text = "controller " + std::to_string(controller);
    if (!name.empty()) text.append(" (").append(name).append(")");
    return text;
}

std::string ignored_kind(const MidiInterpreter& interpreter, const ChannelMessage& message) {
    if (kind_of(message) == MessageKind::NoteOn) return "notes moved beyond the keys 0 to 127";
    if (kind_of(message) != MessageKind::ControlChange) return "messages";
    const int controller = message.data1;
    if (is_data_entry(controller))
        return data_kind(interpreter.channels[static_cast<std::size_t>(channel_of(message))]);
    return controller_kind(controller);
}

}  // namespace jawari::host
