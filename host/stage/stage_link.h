// What a window and a stage tell each other, without locks: pictures of the strings, impacts, and levels come
// from the audio thread while a window is open; events go to it.
#pragma once

#include <array>
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>

#include "jawari/instrument/description.h"
#include "jawari/instrument/events.h"
#include "jawari/instrument/motion.h"
#include "jawari/realtime.h"

namespace jawari::host {

/// A string as it was at one moment.
struct StringPicture {
    bool moves = false;                          ///< the fields below hold
    bool held = false;                           ///< a key or the pedal holds its note
    std::uint8_t fret = 0;                       ///< at which it is stopped, 0 is open
    std::uint8_t key = 0;                        ///< MIDI note number that it sounds
    float length_m = 0;                          ///< from there to the bridge [m]
    float frequency_hz = 0;                      ///< of its first partial [Hz]
    std::array<float, shape_points> height_m{};  ///< as string_shape() has it
};

/// A note that a course holds.
struct HeldPicture {
    std::int8_t channel = 0;  ///< 0 to 15
    std::uint8_t key = 0;     ///< MIDI note number
    std::uint8_t string = 0;  ///< the first of the course
};

/// Notes of a StagePicture; more are left out.
inline constexpr std::size_t most_pictured_notes = 64;

struct StagePicture {
    std::uint64_t frame = 0;       ///< since the stage began
    const void* model = nullptr;   ///< the InstrumentModel that plays, to be compared alone
    std::size_t string_count = 0;  ///< of the instrument that plays
    std::size_t moving = 0;        ///< of them
    std::array<StringPicture, limits::instrument_strings> strings{};
    std::array<HeldPicture, most_pictured_notes> notes{};
    std::size_t note_count = 0;
    float peak_left = 0, peak_right = 0;  ///< largest magnitudes since the picture before
    float load = 0;                       ///< of the blocks since then: time taken over time available
    float worst_load = 0;                 ///< of a block since then
};

/// What one string gave to its obstacles at one place since the picture before.
struct Impact {
    std::uint64_t frame = 0;  ///< since the stage began: of the picture
    std::uint8_t string = 0;  ///< index
    std::uint8_t place = 0;   ///< of impact_places, from the bridge
    float impulse_Ns = 0;     ///< above 0 [N s]
};

/// One thread writes, one reads: the latest value, whole. Neither waits.
template <class T>
class LatestValue {
  public:
    /// Of the writer: where the next value is made. It holds what was written three values ago.
    T& back() { return values_[back_]; }
    void publish() {
        back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | fresh), std::memory_order_acq_rel) & 3U;
    }

    /// Of the reader: null if nothing has come since. Valid until the next call.
    const T* take() {
        if ((middle_.load(std::memory_order_relaxed) & fresh) == 0) return nullptr;
        front_ = middle_.exchange(front_, std::memory_order_acq_rel) & 3U;
        return &values_[front_];
    }

  private:
    static constexpr std::uint8_t fresh = 4;
    std::array<T, 3> values_{};
    std::uint8_t back_ = 0;
    std::atomic<std::uint8_t> middle_{1};
    std::uint8_t front_ = 2;
};

/// Outlives the stage that it is given to. One window at a time.
class StageLink {
  public:
    // ---- the window's thread

    /// From the next block on pictures are made, or no longer.
    void set_open(bool open) { open_.store(open, std::memory_order_release); }
    /// The latest picture, null if there is no newer one. Valid until the next call.
    const StagePicture* picture() { return pictures_.take(); }
    bool next_impact(Impact& impact) { return impacts_.pop(impact); }
    /// At the start of the next block. False if too many wait.
    bool send(const InstrumentEvent& event) { return events_.push(event); }

    // ---- the stage's thread

    [[nodiscard]] bool is_open() const JAWARI_REALTIME { return open_.load(std::memory_order_acquire); }
    LatestValue<StagePicture>& pictures() JAWARI_REALTIME { return pictures_; }
    /// One that has no room is left out.
    void add(const Impact& impact) JAWARI_REALTIME { impacts_.push(impact); }
    bool next_event(InstrumentEvent& event) JAWARI_REALTIME { return events_.pop(event); }
    [[nodiscard]] bool has_events() const JAWARI_REALTIME { return events_.read_available() > 0; }

  private:
    std::atomic<bool> open_{false};
    LatestValue<StagePicture> pictures_;
    boost::lockfree::spsc_queue<Impact, boost::lockfree::capacity<8192>> impacts_;
    boost::lockfree::spsc_queue<InstrumentEvent, boost::lockfree::capacity<256>> events_;
};

}  // namespace jawari::host
