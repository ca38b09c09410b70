#include "commands/bench_latency/adversary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace jawari::host {

namespace {

/// 31250 bits a second, ten for each of three bytes: "MIDI 1.0 Detailed Specification", Hardware.
constexpr double cable_messages_per_s = 31250.0 / 30;
constexpr double passage_s = 0.25;
constexpr double chord_s = 0.025;
constexpr std::size_t fingers = 10;

constexpr int note_on = 0x90, note_off = 0x80, control = 0xB0, channel_pressure = 0xD0, bend = 0xE0;
constexpr int sustain = 64, legato = 68, vibrato = 1;

/// Not reserved by MIDI: general purpose and undefined controllers.
int controller_of(std::size_t parameter) {
    return static_cast<int>(parameter < 12 ? 20 + parameter : 102 + parameter - 12);
}

/// By course, low to high.
std::vector<std::vector<int>> keys_of_courses(const InstrumentModel& model) {
    std::vector<std::vector<int>> all;
    for (const CourseModel& course : model.courses) {
        std::vector<int> keys;
        for (const StoppedStringModel& stopped : model.strings[course.strings.front()].stopped) {
            if (stopped.key >= 0) keys.push_back(stopped.key);
        }
        if (!keys.empty()) all.push_back(std::move(keys));
    }
    return all;
}

}  // namespace

MidiMap adversary_map() {
    MidiMap map = default_midi_map();
    for (const ParameterDeclaration& parameter : parameter_table())
        map.bindings[map.count++] = whole_range(
            MidiSource::Controller, controller_of(static_cast<std::size_t>(parameter.id)), parameter.id);
    return map;
}

std::string adversary_map_text() {
    std::string bindings;
    for (const ParameterDeclaration& parameter : parameter_table()) {
        const int controller = controller_of(static_cast<std::size_t>(parameter.id));
        bindings += (bindings.empty() ? "" : ", ") + std::string(R"({"controller": )") +
                    std::to_string(controller) + R"(, "parameter": ")" + std::string(parameter.key) + "\"}";
    }
    return R"({"schema": "jawari.midi-map/1", "bindings": [)" + bindings + "]}";
}

Adversary::Adversary(const InstrumentModel& model, std::uint32_t seed, AdversaryReach reach)
    : rate_hz_(model.output_rate_hz),
      reach_(reach),
      keys_(keys_of_courses(model)),
      random_(seed),
      in_turn_(keys_.size()),
      struck_(keys_.size()) {
    std::iota(in_turn_.begin(), in_turn_.end(), std::size_t{0});
}

const std::vector<AdversaryMessage>& Adversary::next(std::size_t frames) {
    messages_.clear();
    for (std::size_t n = 0; n < frames && !keys_.empty(); ++n, ++frame_) {
        if (frame_ >= next_passage_) begin_passage(n);
        if (static_cast<Passage>(passage_) == Passage::Chords) {
            if (frame_ < next_chord_) continue;
            chord(n);
            next_chord_ = frame_ + static_cast<std::uint64_t>(std::lround(chord_s * rate_hz_));
        } else if (static_cast<double>(frame_) >= next_message_) {
            one_message(n);
            next_message_ = static_cast<double>(frame_) + rate_hz_ / cable_messages_per_s;
        }
    }
    return messages_;
}

void Adversary::begin_passage(std::size_t offset) {
    passage_ = (passage_ + 1) % static_cast<std::size_t>(Passage::Count);
    next_passage_ = frame_ + static_cast<std::uint64_t>(std::lround(passage_s * rate_hz_));
    next_chord_ = frame_;
    const bool pedal = reach_ == AdversaryReach::TwoHands && static_cast<Passage>(passage_) != Passage::Runs;
    add(offset, control, sustain, pedal ? 127 : 0);
    add(offset, control, legato, 0);
    switch (static_cast<Passage>(passage_)) {
        case Passage::Chords:
            neutral_parameters(offset);
            break;
        case Passage::Bends:
        case Passage::Parameters:
            chord(offset);
            break;
        case Passage::Legato:
            release_all(offset);
            add(offset, control, sustain, 127);
            add(offset, control, legato, 127);
            break;
        default:
            break;
    }
}

/// As nearly as seven bits can say it.
void Adversary::neutral_parameters(std::size_t offset) {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        const double travel = parameter_travel(parameter, parameter.neutral);
        const double value = travel <= 0.5 ? 128 * travel : 64 + 126 * (travel - 0.5);
        add(offset, control, controller_of(static_cast<std::size_t>(parameter.id)),
            static_cast<int>(std::lround(value)));
    }
    add(offset, bend, 0, 64);
    add(offset, channel_pressure, 0, 0);
}

/// Every course is played anew, most with a key other than the one before.
void Adversary::chord(std::size_t offset) {
    release_all(offset);
    if (reach_ == AdversaryReach::TwoHands) {
        chord_of_ten(offset);
        return;
    }
    for (std::size_t course = 0; course < keys_.size(); ++course) strike(offset, course);
}

void Adversary::chord_of_ten(std::size_t offset) {
    for (std::size_t finger = 0; finger < std::min(fingers, keys_.size()); ++finger) {
        if (struck_ == in_turn_.size()) {
            for (std::size_t i = in_turn_.size(); i > 1; --i) std::swap(in_turn_[i - 1], in_turn_[below(i)]);
            struck_ = 0;
        }
        strike(offset, in_turn_[struck_++]);
    }
}

/// A stop in the lower half: long strings with many frets before them.
void Adversary::strike(std::size_t offset, std::size_t course) {
    const std::vector<int>& keys = keys_[course];
    const int key = keys[below((keys.size() + 1) / 2)];
    add(offset, note_on, key, 127);
    down_.push_back(key);
}

void Adversary::release_all(std::size_t offset) {
    for (const int key : down_) add(offset, note_off, key, 64);
    down_.clear();
}

void Adversary::one_message(std::size_t offset) {
    const int value = static_cast<int>(below(128));
    switch (static_cast<Passage>(passage_)) {
        case Passage::Bends:
            switch (below(4)) {
                case 0:
                    add(offset, channel_pressure, value, 0);
                    break;
                case 1:
                    add(offset, control, vibrato, value);
                    break;
                default:
                    add(offset, bend, static_cast<int>(below(128)), value);
                    break;
            }
            return;
        case Passage::Parameters:
            add(offset, control, controller_of(below(parameter_count)), value);
            return;
        default: {
            if (down_.size() >= 2 * keys_.size() || (!down_.empty() && below(3) == 0)) {
                const std::size_t which = below(down_.size());
                add(offset, note_off, down_[which], value);

                down_.erase(down_.begin() + static_cast<std::ptrdiff_t>(which));
                return;
            }
            const std::vector<int>& keys = keys_[below(keys_.size())];
            const int key = keys[below(keys.size())];
            add(offset, note_on, key, std::max(1, value));
            down_.push_back(key);
            return;
        }
    }
}

void Adversary::add(std::size_t offset, int status, int data1, int data2) {
    messages_.push_back({offset,
                         {static_cast<std::uint8_t>(status), static_cast<std::uint8_t>(data1),
                          static_cast<std::uint8_t>(data2)}});
}

}  // namespace jawari::host
