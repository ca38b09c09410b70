// What an output frame costs, known before it is rendered: for hosts that refuse or lower the quality in
// time.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/realtime.h"

namespace jawari {

/// Multiply-adds of one output frame of one string, counted from the loops that do them; a lone addition or
/// product counts as one. A machine's rate for them is its own: benchmarks/speed/adversarial.cpp measures it.
struct FrameCost {
    double flight = 0;  ///< free flight without a look at the obstacles
    /// All contacts pressed on at every step, the same contacts active throughout: a string that lies on its
    /// frets.
    double permanent_contact = 0;
    /// No frame can cost more: every contact is found near in a round of its own, every solve runs into its
    /// bound.
    double bound = 0;
};

FrameCost frame_cost(const StringModel& model) JAWARI_REALTIME;

/// Sum over strings of FrameCost::permanent_contact.
double worst_frame_cost(const SceneModel& model) JAWARI_REALTIME;

}  // namespace jawari
