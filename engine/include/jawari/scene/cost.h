// What an output frame costs, known before it is rendered: hosts can refuse a scene or lower its quality in
// time.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/realtime.h"

namespace jawari {

/// Multiply-adds of one output frame of one string, counted from the loops that do them; a lone addition or
/// product counts as one. benchmarks/speed/adversarial.cpp measures a machine's rate for them.
struct FrameCost {
    double flight = 0;  ///< multiply-adds of a frame of free flight without a test of the gaps
    /// Multiply-adds of a frame in which all contacts are pressed on at every step, the same contacts active
    /// throughout: a string that lies on its frets.
    double permanent_contact = 0;
    /// Multiply-adds that no frame exceeds: every contact is found near in a round of its own, every solve
    /// runs into its bound.
    double bound = 0;
};

/// Cost of one output frame of one string. Threads: any; realtime-safe.
FrameCost frame_cost(const StringModel& model) JAWARI_REALTIME;

/// Sum of FrameCost::permanent_contact over the scene's strings [multiply-adds per output frame]. Threads:
/// any; realtime-safe.
double worst_frame_cost(const SceneModel& model) JAWARI_REALTIME;

}  // namespace jawari
