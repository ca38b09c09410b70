// The notes that a host has begun and that it has not yet been told to be over.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>

#include "jawari/realtime.h"
#include "stage/stage.h"

namespace jawari::host {

/// What a host calls a note; in questions -1 stands for any.
struct NoteAddress {
    std::int32_t note_id = -1;
    int port = -1;
    int channel = -1;  ///< 0 to 15
    int key = -1;      ///< 0 to 127
};

/// Keys that sound or are held, by channel.
using SoundingKeys = std::array<std::bitset<midi_key_count>, midi_channel_count>;

/// Of all instruments on the stage, in keys of the instrument. Threads: the stage's; realtime-safe.
SoundingKeys sounding_keys(const Stage& stage) JAWARI_REALTIME;

/// One thread at a time. Never allocates.
class NoteRegister {
  public:
    struct Note {
        NoteAddress address;
        int sounds = 0;      ///< key of the instrument
        bool down = true;    ///< its note-off has not come
        bool ended = false;  ///< reported, but its note-off has not come
    };
    static constexpr std::size_t most_notes = 512;

    /// A note begins. The one that had its key before ends with it. If too many are known, the oldest is
    /// forgotten.
    void begin(const NoteAddress& address, int sounds) JAWARI_REALTIME;

    /// Calls function(note) for all that `which` may mean.
    template <class Function>
    void for_each(const NoteAddress& which, Function function) {
        for (std::size_t i = 0; i < count_; ++i)
            if (is_meant(notes_[i].address, which)) function(notes_[i]);
    }

    /// Ends every note whose key is not among those that sound.
    void end_silent(const SoundingKeys& keys) JAWARI_REALTIME;

    /// Those that have ended since the call before. Holds until the next call of anything else.
    std::span<const NoteAddress> take_ended() JAWARI_REALTIME;

    void clear() JAWARI_REALTIME;

  private:
    static bool is_meant(const NoteAddress& note, const NoteAddress& which) JAWARI_REALTIME;
    void end(Note& note) JAWARI_REALTIME;

    std::array<Note, most_notes> notes_{};
    std::size_t count_ = 0;
    std::array<NoteAddress, 2 * most_notes> ended_{};
    std::size_t ended_count_ = 0;
};

}  // namespace jawari::host
