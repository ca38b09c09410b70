// Playing that asks as much of an instrument as MIDI can: for benchmarks and tests of live playing. The same
// seed plays the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "jawari/instrument/model.h"
#include "midi/channel_message.h"
#include "midi/midi_map.h"

namespace jawari::host {

struct AdversaryMessage {
    std::size_t offset = 0;  ///< frame of the block
    ChannelMessage message;
};

/// Controllers 20 to 31 and 102 to 117 move the parameters in their order, so that all can be played with.
MidiMap adversary_map();
/// The same as the text of a map file.
std::string adversary_map_text();

/// What plays at once.
enum class AdversaryReach {
    AllCourses,  ///< a sequencer: chords on all courses, in one frame
    TwoHands     ///< ten keys in one frame, under a pedal that keeps all struck before ringing
};

/// Goes through these for a quarter of a second each, without a pause: chords on all courses with all keys
/// down, struck again and again with neutral parameters; runs over the whole compass as fast as a MIDI cable
/// carries them; bends, pressure and vibrato on a held chord; palm mutes and every other parameter in motion;
/// legato with the pedal down. Chords are struck in one frame, as from a sequencer; all else comes at a
/// cable's rate.
///
/// Two hands play the same with ten fingers: chords have ten keys, of the courses in turn, in an order drawn
/// anew each time round, and the pedal is down but for the runs, so that each passage rings on all courses
/// that were struck. Where it comes up, all of them are damped in one frame.
class Adversary {
  public:
    Adversary(const InstrumentModel& model, std::uint32_t seed,
              AdversaryReach reach = AdversaryReach::AllCourses);

    /// Of the next `frames` frames, in order.
    const std::vector<AdversaryMessage>& next(std::size_t frames);

  private:
    enum class Passage { Chords, Runs, Bends, Parameters, Legato, Count };

    void chord(std::size_t offset);
    void chord_of_ten(std::size_t offset);
    void strike(std::size_t offset, std::size_t course);
    void neutral_parameters(std::size_t offset);
    void release_all(std::size_t offset);
    void one_message(std::size_t offset);
    void begin_passage(std::size_t offset);
    void add(std::size_t offset, int status, int data1, int data2);
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

    double rate_hz_;
    AdversaryReach reach_;
    std::vector<std::vector<int>> keys_;  // by course, low to high
    std::mt19937 random_;
    std::vector<AdversaryMessage> messages_;
    std::vector<int> down_;             // keys
    std::vector<std::size_t> in_turn_;  // two hands: courses of this time round
    std::size_t struck_;                // of those
    std::uint64_t frame_ = 0;
    double next_message_ = 0;  // frame
    std::uint64_t next_chord_ = 0, next_passage_ = 0;
    std::size_t passage_ = static_cast<std::size_t>(Passage::Count) - 1;
};

}  // namespace jawari::host
