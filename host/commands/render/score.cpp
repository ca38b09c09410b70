#include "commands/render/score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>

#include "commands/render/chased_state.h"
#include "midi/ignored.h"
#include "midi/system_message.h"

namespace jawari::host {

namespace {

constexpr std::size_t silent = static_cast<std::size_t>(-1);

/// An event and, of a note-on, who plays it.
struct Routed {
    TimedEvent timed;
    int port = 0;
    std::size_t part = silent;
};

/// Sixteen channels, as one cable has them.
struct Port {
    MidiInterpreter interpreter;
    std::array<std::optional<std::string>, midi_channel_count> presets;
    ChasedState chased;
};

class ScoreMaker {
  public:
    ScoreMaker(const ScoreRules& rules, const MidiFile& file, Score& score)
        : rules_(rules), file_(file), score_(score) {}

    /// In order of time; `frame` of the whole piece.
    void take(const MidiEvent& event, std::uint64_t frame) {
        if (frame >= rules_.excerpt.end) return;
        if (chasing_ && frame >= rules_.excerpt.begin) begin_excerpt();
        const std::uint64_t heard = chasing_ ? 0 : frame - rules_.excerpt.begin;
        if (event.status != exclusive_status) {
            const ChannelMessage message{event.status, event.data1, event.data2};
            apply(message, event.port, heard);
            if (actions_.ignored) ignore(ignored_kind(port_at(event.port).interpreter, message));
            return;
        }
        const DecodedExclusive decoded = decode_exclusive(file_.exclusives[event.exclusive]);
        for (const ChannelMessage& message : decoded.messages) apply(message, event.port, heard);
        if (decoded.messages.empty()) ignore("system exclusive: " + decoded.name);
    }

    /// Notes go to their part; everything else to each part that has notes of the channel.
    void finish() {
        if (chasing_) begin_excerpt();
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
                if (part.port == routed.port &&
                    (part.channels >> static_cast<unsigned>(routed.timed.event.channel) & 1U) != 0)
                    part.events.push_back(routed.timed);
        }
        if (file_.escapes > 0) ignored_["bytes for other devices (F7)"] += file_.escapes;
        for (const auto& [what, count] : ignored_) score_.ignored.push_back({what, count});
    }

  private:
    [[nodiscard]] std::optional<std::string> choice(int bank, int program) const {
        return rules_.choose ? rules_.choose(bank, program) : rules_.preset;
    }

    Port& port_at(int number) {
        auto& port = ports_[number];
        if (!port) {
            port = std::make_unique<Port>(Port{make_interpreter(rules_.interpreter), {}, {}});
            port->presets.fill(choice(0, 0));
        }
        return *port;
    }

    void ignore(const std::string& what) {
        if (!chasing_) ignored_[what] += 1;
    }

    /// What was set before is set at once; what is down stays silent.
    void begin_excerpt() {
        chasing_ = false;
        for (const auto& [number, port] : ports_) {
            for (const InstrumentEvent& event : port->chased.events())
                routed_.push_back({{0, event}, number, silent});
            score_.cut_notes += open_notes(port->interpreter);
        }
    }

    void apply(const ChannelMessage& message, int number, std::uint64_t frame) {
        Port& port = port_at(number);
        interpret(port.interpreter, message, actions_);
        if (actions_.program.asked) change_program(port);
        if (actions_.programs_reset) port.presets.fill(choice(0, 0));
        if (chasing_) {
            for (std::size_t i = 0; i < actions_.count; ++i) port.chased.add(actions_.events[i]);
            return;
        }
        for (std::size_t i = 0; i < actions_.count; ++i) {
            Routed routed{{frame, actions_.events[i]}, number, silent};
            if (routed.timed.event.type == InstrumentEventType::NoteOn) routed.part = part_of(port, routed);
            routed_.push_back(routed);
        }
    }

    void change_program(Port& port) {
        score_.program_changes += chasing_ ? 0 : 1;
        const ProgramRequest& request = actions_.program;
        port.presets[static_cast<std::size_t>(request.channel)] = choice(request.bank, request.program);
    }

    /// Drums have no preset; with one preset for all, everything is played.
    [[nodiscard]] bool is_silent(const Port& port, const Routed& routed, int leader) const {
        const auto channel = static_cast<std::size_t>(routed.timed.event.channel);
        if (!port.presets[static_cast<std::size_t>(leader)]) return true;
        if (rules_.interpreter.guitar_channel >= 0 && routed.timed.event.string < 0) return true;
        return rules_.choose && port.interpreter.channels[channel].unpitched;
    }

    std::string player_of(const std::string& preset, const Routed& routed) {
        if (!rules_.choose_for_key) return preset;
        std::string player = rules_.choose_for_key(preset, routed.timed.event.key);
        if (player == preset) return player;
        auto& lent = score_.lent_notes;
        auto found = std::find_if(lent.begin(), lent.end(), [&](const LentNotes& each) {
            return each.preset == preset && each.player == player;
        });
        if (found == lent.end()) found = lent.insert(found, LentNotes{preset, player, 0});
        found->count += 1;
        return player;
    }

    std::size_t part_of(const Port& port, const Routed& routed) {
        const int channel = routed.timed.event.channel;
        if ((rules_.muted >> static_cast<unsigned>(channel) & 1U) != 0) {
            score_.muted_notes += 1;
            return silent;
        }
        const int leader = rules_.choose ? part_channel(port.interpreter, channel) : 0;
        if (is_silent(port, routed, leader)) {
            score_.silent_notes += 1;
            return silent;
        }
        const std::string preset = player_of(*port.presets[static_cast<std::size_t>(leader)], routed);
        auto found = std::find_if(score_.parts.begin(), score_.parts.end(), [&](const ScorePart& part) {
            return part.port == routed.port && part.channel == leader && part.preset == preset;
        });
        if (found == score_.parts.end()) {
            const bool guitar = rules_.interpreter.guitar_channel >= 0;
            found = score_.parts.insert(
                found,
                ScorePart{
                    preset, routed.port, leader, 0, 0, guitar ? PlayMode::Guitar : PlayMode::Keyboard, {}});
        }
        found->channels |= 1U << static_cast<unsigned>(channel);
        found->notes += 1;
        return static_cast<std::size_t>(found - score_.parts.begin());
    }

    const ScoreRules& rules_;
    const MidiFile& file_;
    Score& score_;
    bool chasing_ = true;  ///< before the excerpt
    MidiActions actions_;
    std::map<int, std::unique_ptr<Port>> ports_;
    std::vector<Routed> routed_;
    std::map<std::string, std::uint64_t> ignored_;
};

/// At another tempo than that of the file.
std::uint64_t played_frame(const MidiFile& file, std::uint64_t time, std::uint32_t rate_hz, double tempo) {
    const std::uint64_t frame = frame_of(file, time, rate_hz);
    return tempo == 1 ? frame : static_cast<std::uint64_t>(std::llround(static_cast<double>(frame) / tempo));
}

}  // namespace

Score make_score(const MidiFile& file, std::uint32_t rate_hz, const ScoreRules& rules) {
    Score score;
    ScoreMaker maker(rules, file, score);
    for (const MidiEvent& event : file.events)
        maker.take(event, played_frame(file, event.time, rate_hz, rules.tempo));
    maker.finish();
    score.whole_frames = played_frame(file, file.end_time, rate_hz, rules.tempo);
    const Excerpt& excerpt = rules.excerpt;
    score.end_frame = std::max(std::min(score.whole_frames, excerpt.end), excerpt.begin) - excerpt.begin;
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
