#include "commands/render/score.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace jawari::host {

namespace {

constexpr std::size_t silent = static_cast<std::size_t>(-1);

/// An event and, of a note-on, who plays it.
struct Routed {
    TimedEvent timed;
    std::size_t part = silent;
};

class ScoreMaker {
  public:
    ScoreMaker(const ScoreRules& rules, Score& score)
        : rules_(rules), score_(score), interpreter_(make_interpreter(rules.interpreter)) {
        for (std::size_t channel = 0; channel < midi_channel_count; ++channel)
            presets_[channel] = choice(static_cast<int>(channel), 0, 0);
    }

    void take(const MidiEvent& message, std::uint64_t frame) {
        interpret(interpreter_, {message.status, message.data1, message.data2}, actions_);
        if (actions_.program.asked) change_program();
        for (std::size_t i = 0; i < actions_.count; ++i) {
            Routed routed{{frame, actions_.events[i]}};
            if (routed.timed.event.type == InstrumentEventType::NoteOn) routed.part = part_of(routed);
            routed_.push_back(routed);
        }
    }

    /// Notes go to their part; everything else to each part that has notes of the channel.
    void finish() {
        for (ScorePart& part : score_.parts) {
            for (const auto& [parameter, value] : rules_.parameters)
                part.events.push_back({0, set_parameter(0, parameter, value, every_channel)});
        }
        for (const Routed& routed : routed_) {
            if (routed.timed.event.type == InstrumentEventType::NoteOn) {
                if (routed.part != silent) score_.parts[routed.part].events.push_back(routed.timed);
                continue;
            }
            for (ScorePart& part : score_.parts)
                if ((part.channels >> static_cast<unsigned>(routed.timed.event.channel) & 1U) != 0)
                    part.events.push_back(routed.timed);
        }
    }

  private:
    [[nodiscard]] std::optional<std::string> choice(int channel, int bank, int program) const {
        return rules_.choose ? rules_.choose(channel, bank, program) : rules_.preset;
    }

    void change_program() {
        score_.program_changes += 1;
        const ProgramRequest& request = actions_.program;
        presets_[static_cast<std::size_t>(request.channel)] =
            choice(request.channel, request.bank, request.program);
    }

    std::size_t part_of(const Routed& routed) {
        const int channel = routed.timed.event.channel;
        const int leader = rules_.choose ? part_channel(interpreter_, channel) : 0;
        const auto& preset = presets_[static_cast<std::size_t>(leader)];
        const bool guitar = rules_.interpreter.guitar_channel >= 0;
        if (!preset || (guitar && routed.timed.event.string < 0)) {
            score_.silent_notes += 1;
            return silent;
        }
        auto found = std::find_if(score_.parts.begin(), score_.parts.end(), [&](const ScorePart& part) {
            return part.channel == leader && part.preset == *preset;
        });
        if (found == score_.parts.end())
            found = score_.parts.insert(
                found, ScorePart{*preset, leader, 0, 0, guitar ? PlayMode::Guitar : PlayMode::Keyboard, {}});
        found->channels |= 1U << static_cast<unsigned>(channel);
        found->notes += 1;
        return static_cast<std::size_t>(found - score_.parts.begin());
    }

    const ScoreRules& rules_;
    Score& score_;
    MidiInterpreter interpreter_;
    MidiActions actions_;
    std::array<std::optional<std::string>, midi_channel_count> presets_;
    std::vector<Routed> routed_;
};

}  // namespace

Score make_score(const MidiFile& file, std::uint32_t rate_hz, const ScoreRules& rules) {
    Score score;
    ScoreMaker maker(rules, score);
    for (const MidiEvent& message : file.events) maker.take(message, frame_of(file, message.time, rate_hz));
    maker.finish();
    score.end_frame = frame_of(file, file.end_time, rate_hz);
    return score;
}

void end_notes(Score& score) {
    for (ScorePart& part : score.parts) {
        for (int channel = 0; channel < static_cast<int>(midi_channel_count); ++channel) {
            if ((part.channels >> static_cast<unsigned>(channel) & 1U) == 0) continue;
            for (const auto type : {InstrumentEventType::Sustain, InstrumentEventType::AllNotesOff})
                part.events.push_back({score.end_frame, {.type = type, .channel = channel}});
        }
    }
}

}  // namespace jawari::host
