// What makes a string sound: fingers (and plectra), hammers, tangents.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/detail/touches.h"
#include "jawari/instrument/description.h"
#include "jawari/realtime.h"

namespace jawari {

/// The string at the exciter over the coming frame, in terms of w = phi . (q - h v/2).
struct StringAtExciter {
    double frame_s = 0;
    double displacement_m = 0;  ///< w at the frame's start
    double rise_m = 0;          ///< change of w without the exciter's force
    double give_m_per_N = 0;    ///< and with it, per newton held over the frame
};

/// The force over the coming frame [N]; moves the exciter on. A hammer's force solves
///     z+ - w+ = xi+,   F = (V(xi+) - V(xi))/(xi+ - xi) + K xi^p loss (xi+ - xi)/T,   V = K xi^(p+1)/(p+1)
/// so that string, hammer and felt together lose only what the loss takes; it never pulls.
double exciter_force(const StringAtExciter& at, ExciterState& exciter) JAWARI_REALTIME;

/// The share of a finger's peak force in frame n, averaged over it, for half-cosine flanks.
double finger_shape(std::uint64_t n, std::uint64_t rise_frames, std::uint64_t release_frames) JAWARI_REALTIME;

/// What two noises share, but for their seeds: a random function of time with rms 1, independent of the
/// output rate. Samples of a 24 kHz grid, straight between them: falls by 3 dB at 8 kHz and by 8 at 12 kHz.
double noise_at(std::uint64_t seed, double time_s) JAWARI_REALTIME;

/// The seed of the next noise on a string.
std::uint64_t next_noise(const StringModel& model, TouchState& touches) JAWARI_REALTIME;

/// Frames that a time takes, at least 1.
std::uint64_t frames_of(double seconds, double rate_hz) JAWARI_REALTIME;

void begin_finger(const StringModel& model, ExciterState& exciter, double x, double width_m, double peak_N,
                  std::uint64_t rise_frames, std::uint64_t release_frames) JAWARI_REALTIME;
void begin_hammer(const StringModel& model, const StringState& string, ExciterState& exciter, double x,
                  double width_m, const HammerDescription& hammer, double speed_m_per_s,
                  double hardness) JAWARI_REALTIME;
void begin_tangent(const StringModel& model, ExciterState& exciter, double height_m,
                   std::uint64_t rise_frames) JAWARI_REALTIME;

}  // namespace jawari
