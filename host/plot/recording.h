// What a plot of a simulated scene needs. Recorded only when a plot is asked for; nothing here grows with the
// contact rate.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jawari/scene/description.h"

namespace jawari::host {

/// The string's shape u(x, t) at one time.
struct Snapshot {
    double time_s = 0;
    std::vector<double> displacement_m;  ///< at StringRecording::grid_m
};

/// A point contact as the scene has it, in the order of the string's contacts.
struct ObstaclePoint {
    double position_m = 0;
    double height_m = 0;  ///< negative: below the rest line
    Side side = Side::Below;
};

/// Impulse > 0 that one contact gave the string during one interval of SceneRecording::interval_s.
struct ContactEvent {
    double time_s = 0;        ///< end of the interval
    std::size_t contact = 0;  ///< index into StringRecording::obstacles
    double impulse_Ns = 0;    ///< sum over the interval, > 0
};

struct ProbeSignal {
    std::string name;  ///< as in the CSV header
    std::string unit;  ///< "m", "m/s", ...
    Quantity quantity = Quantity::Displacement;
    std::vector<double> values;  ///< at SceneRecording::times_s
};

struct StringRecording {
    std::string name;
    bool is_string = true;  ///< else it has no shape to draw, and places may be numbers of contacts
    double length_m = 0;
    std::vector<double> grid_m;            ///< from 0 to length_m, both included; empty if it is no string
    std::vector<Snapshot> snapshots;       ///< in order of time, the first at t = 0
    std::vector<ObstaclePoint> obstacles;  ///< may be empty
    std::vector<ContactEvent> events;      ///< in order of time; may be empty
    std::vector<ProbeSignal> probes;       ///< may be empty
};

struct SceneRecording {
    std::string title;      ///< name of the scene, for the picture's heading
    double duration_s = 0;  ///< time of the last row
    double interval_s = 0;  ///< over which contact events are summed: one row, or several in long recordings
    /// Times of the probe values, not decreasing. In recordings of more than recording_rows rows the values
    /// of several rows are replaced by their minimum and maximum, so that lines drawn through them show the
    /// envelope.
    std::vector<double> times_s;
    std::vector<StringRecording> strings;
};

/// Rows that a recording keeps as they are.
inline constexpr std::size_t recording_rows = 200000;

}  // namespace jawari::host
