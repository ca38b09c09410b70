// Looks at the strings for a window, in the audio thread: each string at moments that follow its own period,
// so that pictures show it slowed down as a stroboscope does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "jawari/realtime.h"
#include "stage/stage_link.h"
#include "stage/staged_instrument.h"

namespace jawari::host {

/// Pictures a second.
inline constexpr double picture_rate_hz = 60;
/// A string seems to move this often a second.
inline constexpr double stroboscope_hz = 1.25;
/// Looks at single strings a second, of all strings together.
inline constexpr double most_looks_per_s = 1000;

/// Time between looks at a string of that frequency while `moving` strings move [s]: whole periods and the
/// small part of one that makes it seem to move at stroboscope_hz.
double look_interval_s(double frequency_hz, std::size_t moving) JAWARI_REALTIME;

/// One thread at a time may use it.
class StageWatch {
  public:
    explicit StageWatch(double rate_hz) : rate_hz_(rate_hz) {}

    /// Frames that may pass until look() is due, at least 1.
    [[nodiscard]] std::size_t frames_to_look(std::uint64_t frame) const JAWARI_REALTIME;
    /// Of the instrument that plays: those strings whose moment has come.
    void look(StagedInstrument& instrument, std::uint64_t frame) JAWARI_REALTIME;
    /// Of what was rendered.
    void hear(const double* left, const double* right, std::size_t frames) JAWARI_REALTIME;
    /// A block of `frames` frames has taken that long.
    void add_load(std::size_t frames, double taken_s) JAWARI_REALTIME;
    /// A picture, if it is due.
    void publish(StageLink& link, StagedInstrument& instrument, std::uint64_t frame) JAWARI_REALTIME;
    /// Nobody looks any more.
    void close(StagedInstrument* instrument) JAWARI_REALTIME;

  private:
    struct Look {
        double at_frame = 0;  ///< the next one
        bool due = false;     ///< there is a next one
    };

    void look_at(const StagedInstrument& instrument, std::size_t string, std::uint64_t frame) JAWARI_REALTIME;
    void follow(const StagedInstrument& instrument, std::uint64_t frame) JAWARI_REALTIME;
    void report_impacts(StageLink& link, StagedInstrument& instrument, std::uint64_t frame) JAWARI_REALTIME;
    void draw(StagePicture& picture, const StagedInstrument& instrument, std::uint64_t frame) JAWARI_REALTIME;

    const double rate_hz_;
    const void* model_ = nullptr;  ///< of the strings below
    std::size_t strings_ = 0;
    std::size_t moving_ = 0;
    double picture_at_ = 0;  ///< frame of the next picture
    std::array<Look, limits::instrument_strings> looks_{};
    std::array<StringPicture, limits::instrument_strings> seen_{};
    float peak_left_ = 0, peak_right_ = 0, worst_load_ = 0;
    double taken_s_ = 0, available_s_ = 0;
};

}  // namespace jawari::host
