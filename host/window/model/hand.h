// The hand that the mouse is: what it does to strings, as events for the stage. It plays on the last channel,
// whose other parameters are those of all, so that where it plucks changes nothing for other notes.
#pragma once

#include <array>
#include <optional>

#include "jawari/instrument/description.h"
#include "window/performance.h"

namespace jawari::host::window {

inline constexpr int hand_channel = 15;

class Hand {
  public:
    explicit Hand(Performance& performance) : performance_(&performance) {}

    /// Plucks a string as it lies open, `factor` times as far from the bridge as the preset does. velocity:
    /// above 0, to 1. The string rings until mute(), or until it rests.
    void pluck(std::size_t string, int key, double factor, double velocity);

    /// Stops the string at a fret and plucks it.
    void press(std::size_t string, int key, double velocity);
    /// The finger moves along to another fret.
    void slide(int key);
    /// The finger that press() put down leaves the string.
    void lift();
    [[nodiscard]] bool presses() const { return pressed_.has_value(); }

    /// Lets go whatever holds the string, its own and others' notes.
    void mute(std::size_t string, const StagePicture* picture);
    /// Lays the palm on all strings, or takes it away.
    void lay_palm(bool down);

    /// Strings that have come to rest are let go.
    void follow(const StagePicture& picture);
    /// Everything is let go.
    void let_go();

  private:
    struct Pressed {
        std::size_t string = 0;
        int key = 0;
    };

    void send(const InstrumentEvent& event);
    void set(ParameterId parameter, double value);
    void restore(ParameterId parameter);
    void release(std::size_t string);

    Performance* performance_;
    std::array<int, limits::instrument_strings> ringing_ = make_ringing();  ///< key of a plucked string; -1
    std::array<int, limits::instrument_strings> waited_{};  ///< pictures since it was plucked, to a few
    std::optional<Pressed> pressed_;
    bool palm_ = false;

    static std::array<int, limits::instrument_strings> make_ringing() {
        std::array<int, limits::instrument_strings> keys{};
        keys.fill(-1);
        return keys;
    }
};

}  // namespace jawari::host::window
