#include "formats/midi_file/midi_times.h"

#include <algorithm>
#include <string>

namespace jawari::host {
namespace {

constexpr std::uint32_t default_tempo_us = 500000;
constexpr std::uint64_t us_per_s = 1000000;

std::string longest_text() {
    return "within the first " + std::to_string(max_midi_duration_s / 3600) + " hours";
}

/// Walks ticks forwards through the tempo map in exact integer time.
class Clock {
  public:
    Clock(TimeBase base, const std::vector<MidiTempo>& tempos) : base_(base), tempos_(tempos) {}

    /// Ticks must not decrease from call to call. Nothing if the time is past the longest music accepted.
    std::optional<std::uint64_t> time_at(std::uint64_t tick) {
        while (next_ < tempos_.size() && tempos_[next_].tick <= tick) {
            if (!advance(tempos_[next_].tick)) return std::nullopt;
            tempo_ = tempos_[next_].us_per_quarter;
            ++next_;
        }
        if (!advance(tick)) return std::nullopt;
        return time_;
    }

  private:
    bool advance(std::uint64_t tick) {
        const std::uint64_t units = base_.units_per_tick != 0 ? base_.units_per_tick : tempo_;
        const std::uint64_t longest = max_midi_duration_s * base_.units_per_s;
        if (tick - tick_ > (longest - time_) / units) return false;
        time_ += (tick - tick_) * units;
        tick_ = tick;
        return true;
    }

    TimeBase base_;
    const std::vector<MidiTempo>& tempos_;
    std::size_t next_ = 0;
    std::uint64_t tick_ = 0;
    std::uint64_t time_ = 0;
    std::uint32_t tempo_ = default_tempo_us;
};

bool is_note_on(const MidiEvent& event) {
    return (event.status & 0xF0) == 0x90 && event.data2 > 0;
}

/// Of events at one tick, in the order of their tracks: what comes before each track's first note-on goes
/// before the notes of all.
void put_notes_last(std::vector<MidiEvent>::iterator begin, std::vector<MidiEvent>::iterator end) {
    if (begin->track == (end - 1)->track) return;
    bool notes = false;
    std::uint16_t track = begin->track;
    std::vector<MidiEvent> first, last;
    for (auto event = begin; event != end; ++event) {
        if (event->track != track) notes = false;
        track = event->track;
        notes = notes || is_note_on(*event);
        (notes ? last : first).push_back(*event);
    }
    std::copy(last.begin(), last.end(), std::copy(first.begin(), first.end(), begin));
}

void put_in_order(MidiFile& file) {
    const auto earlier = [](const auto& a, const auto& b) { return a.tick < b.tick; };
    std::stable_sort(file.tempos.begin(), file.tempos.end(), earlier);
    std::stable_sort(file.events.begin(), file.events.end(), earlier);
    for (auto begin = file.events.begin(); begin != file.events.end();) {
        const auto end = std::find_if(begin, file.events.end(),
                                      [begin](const MidiEvent& event) { return event.tick != begin->tick; });
        put_notes_last(begin, end);
        begin = end;
    }
}

/// Of notes and pedals (64, 66, 69); of all messages if there is none of these.
std::uint64_t last_played(const MidiFile& file) {
    const auto plays = [](const MidiEvent& event) {
        const bool pedal = event.data1 == 64 || event.data1 == 66 || event.data1 == 69;
        return (event.status & 0xE0) == 0x80 || ((event.status & 0xF0) == 0xB0 && pedal);
    };
    const auto last = std::find_if(file.events.rbegin(), file.events.rend(), plays);
    if (last != file.events.rend()) return last->time;
    return file.events.empty() ? 0 : file.events.back().time;
}

std::optional<Failure> set_end(MidiFile& file, Clock& clock, std::uint64_t end_tick, MidiNotes& notes) {
    const auto end = clock.time_at(end_tick);
    const std::uint64_t last = last_played(file);
    const std::uint64_t silent_end = longest_silent_end_s * file.time_units_per_s;
    if (end && (notes.strict() || *end - last <= silent_end || file.events.empty())) {
        file.end_time = *end;
        return std::nullopt;
    }
    if (notes.strict()) return Failure{"end of track", "tick " + std::to_string(end_tick), longest_text()};
    file.end_time = last;
    std::erase_if(file.events, [last](const MidiEvent& event) { return event.time > last; });
    const std::string late =
        end ? std::to_string((*end - last) / file.time_units_per_s) + " s after" : "long after";
    notes.repairs().push_back({"end of track", late + " the last note", "the music ends with that note", 1});
    return std::nullopt;
}

}  // namespace

std::optional<TimeBase> time_base(std::uint16_t division, bool any_rate) {
    if ((division & 0x8000) == 0) {
        if (division == 0) return std::nullopt;
        return TimeBase{division * us_per_s, 0};
    }
    const unsigned frames_per_s = 256U - (division >> 8);
    const unsigned ticks_per_frame = division & 0xFF;
    if (ticks_per_frame == 0) return std::nullopt;
    switch (frames_per_s) {
        case 24:
        case 25:
        case 30:
            return TimeBase{std::uint64_t{frames_per_s} * ticks_per_frame, 1};
        case 29:  // "30 drop frame" counts frames of 1001/30000 s
            return TimeBase{std::uint64_t{30000} * ticks_per_frame, 1001};
        default:
            if (any_rate) return TimeBase{std::uint64_t{frames_per_s} * ticks_per_frame, 1};
            return std::nullopt;
    }
}

std::optional<Failure> assign_times(MidiFile& file, TimeBase base, std::uint64_t end_tick, MidiNotes& notes) {
    put_in_order(file);
    file.time_units_per_s = base.units_per_s;
    Clock clock(base, file.tempos);
    for (MidiEvent& event : file.events) {
        const auto time = clock.time_at(event.tick);
        if (!time) {
            return Failure{"track " + std::to_string(event.track + 1),
                           "an event at tick " + std::to_string(event.tick), "events " + longest_text()};
        }
        event.time = *time;
    }
    return set_end(file, clock, end_tick, notes);
}

std::uint64_t frame_of(const MidiFile& file, std::uint64_t time, std::uint32_t rate_hz) {
    const std::uint64_t seconds = time / file.time_units_per_s;
    const std::uint64_t rest = time % file.time_units_per_s;
    return seconds * rate_hz + (rest * rate_hz + file.time_units_per_s / 2) / file.time_units_per_s;
}

}  // namespace jawari::host
