#include "commands/play/device_list.h"

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "devices/midi_receiver.h"

namespace jawari::host {

namespace {

using Json = nlohmann::ordered_json;

std::string rates_text(const AudioDevice& device) {
    std::vector<std::string> rates;
    for (const unsigned int rate : device.rates_hz) rates.push_back(std::to_string(rate));
    return rates.empty() ? "rates unknown" : join(rates) + " Hz";
}

AudioSystemSurvey survey_audio(const std::string& system) {
    AudioSystemSurvey survey{system, "", {}};
    auto devices = audio_devices(system);
    if (!devices)
        survey.problem = devices.error().message;
    else if (devices.value().empty())
        survey.problem = system == "jack" ? "no server" : "no device";
    else
        survey.devices = std::move(devices.value());
    return survey;
}

MidiSystemSurvey survey_midi(const std::string& system) {
    MidiSystemSurvey survey{system, "", {}};
    const auto lister = MidiLister::create(system);
    if (lister)
        survey.inputs = lister.value()->names();
    else
        survey.problem = lister.error().message;
    return survey;
}

}  // namespace

DeviceSurvey survey_devices() {
    DeviceSurvey survey;
    for (const std::string& system : audio_systems()) survey.audio.push_back(survey_audio(system));
    for (const std::string& system : midi_systems()) survey.midi.push_back(survey_midi(system));
    return survey;
}

std::vector<std::string> devices_text(const DeviceSurvey& survey) {
    std::vector<std::string> lines;
    for (const AudioSystemSurvey& each : survey.audio) {
        lines.push_back("audio " + each.system + (each.problem.empty() ? ":" : ": " + each.problem));
        for (std::size_t i = 0; i < each.devices.size(); ++i) {
            const AudioDevice& device = each.devices[i];
            lines.push_back("  " + std::to_string(i) + "  " + printable(device.name) + ", " +
                            std::to_string(device.output_channels) + " channels, " + rates_text(device) +
                            (device.is_default ? ", default" : ""));
        }
    }
    for (const MidiSystemSurvey& each : survey.midi) {
        const bool none = each.problem.empty() && each.inputs.empty();
        lines.push_back("midi " + each.system + ":" +
                        (none                   ? " no inputs"
                         : each.problem.empty() ? ""
                                                : " " + each.problem));
        for (std::size_t i = 0; i < each.inputs.size(); ++i)
            lines.push_back("  " + std::to_string(i) + "  " + printable(each.inputs[i]));
    }
    return lines;
}

std::string devices_json(const DeviceSurvey& survey) {
    Json json{{"schema", "jawari.devices/1"}, {"audio", Json::array()}, {"midi", Json::array()}};
    for (const AudioSystemSurvey& each : survey.audio) {
        Json devices = Json::array();
        for (const AudioDevice& device : each.devices)
            devices.push_back(Json{{"name", device.name},
                                   {"output_channels", device.output_channels},
                                   {"default", device.is_default},
                                   {"rates_hz", device.rates_hz},
                                   {"preferred_rate_hz", device.preferred_rate_hz}});
        Json system{{"system", each.system}, {"devices", devices}};
        if (!each.problem.empty()) system["problem"] = each.problem;
        json["audio"].push_back(system);
    }
    for (const MidiSystemSurvey& each : survey.midi) {
        Json system{{"system", each.system}, {"inputs", each.inputs}};
        if (!each.problem.empty()) system["problem"] = each.problem;
        json["midi"].push_back(system);
    }
    // Names come from devices: bytes that are no UTF-8 are replaced.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace jawari::host
