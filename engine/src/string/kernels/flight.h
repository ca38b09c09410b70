// Free flight over output frames, and what is read of the string on the way.
#pragma once

#include <cstddef>
#include <span>

#include "jawari/detail/string_model.h"
#include "jawari/scene/reading.h"

namespace jawari::kernels {

/// (q_out, v_out) <- (q, v) + F (q, v) over n modes. Returns false if a result is not finite.
bool fly(std::size_t n, const FlightModel& flight, const double* q, const double* v, double* q_out,
         double* v_out) noexcept;

/// The same under modal forces `held` over the frame, on the first `forced` modes (padded).
bool fly_forced(std::size_t n, std::size_t forced, const FlightModel& flight, const double* held,
                const double* q, const double* v, double* q_out, double* v_out) noexcept;

/// `frames` frames of fly() in place, the state in registers: the same bits. The readings go to
/// out[first], out[first + 1], ... Returns false if the end is not finite.
struct FlightRun {
    std::size_t modes = 0;  ///< padded
    std::size_t frames = 0;
    const FlightModel* flight = nullptr;
    double* q = nullptr;
    double* v = nullptr;
    std::span<const Reading> readings;
    ReadAt when = ReadAt::Start;
    std::size_t first = 0;
};
bool fly_frames(const FlightRun& run) noexcept;

/// The readings of one moment, to out[at]: the same bits as from fly_frames().
void read(std::size_t modes, std::span<const Reading> readings, const double* q, const double* v,
          std::size_t at) noexcept;

/// Sums of a run that are kept at a time: frames times readings.
inline constexpr std::size_t flight_sums = 256;

}  // namespace jawari::kernels
