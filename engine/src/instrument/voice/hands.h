// The damping hand, the palm, and the hand that stops strings: touches of a voice, in terms of decay times.
#pragma once

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Damping [kg/s] at x at which, in first order, the first partial falls by 60 dB in t60_s: sigma = c
/// phi_1(x)^2/(2 mu). At most the one that absorbs best, about the wave impedance over sin(pi x/L).
double damping_for(const StoppedStringModel& stopped, double x, double t60_s) JAWARI_REALTIME;

/// Distance from the start of the speaking length, kept inside it.
double place_on(const StoppedStringModel& stopped, const StringPlace& place, double factor) JAWARI_REALTIME;

/// Lays the hand on the string's release places; the two share the damping. release_velocity: 0 to 1.
void lay_damping_hand(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                      double release_velocity, double time_factor) JAWARI_REALTIME;
void lift_damping_hand(Voice& voice) JAWARI_REALTIME;

/// Palm mute from 0 (off) to 1; a palm that lies keeps its place.
void press_palm(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice, double mute,
                double position_factor) JAWARI_REALTIME;

/// The stopping hand: a dead note (0 to 1), or the light touch at 1/number of the string.
void deaden(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
            double firmness) JAWARI_REALTIME;
void touch_node(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                int number) JAWARI_REALTIME;

/// What always lies on the string.
void lay_soft_touches(const InstrumentStringModel& string, Voice& voice) JAWARI_REALTIME;

}  // namespace jawari
