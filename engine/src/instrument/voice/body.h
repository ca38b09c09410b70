// The body: resonances driven by the force of all strings on the bridge.
#pragma once

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

BodyModel body_model(const InstrumentDescription& instrument, double output_rate_hz);

BodyState make_body_state(const BodyModel& body);

/// The body is still, and nothing has been counted.
void reset_body(BodyState& state) JAWARI_REALTIME;

struct StereoSample {
    double left = 0;
    double right = 0;
};

/// Advances the body by one frame in which the force goes linearly from the last one to force_N.
StereoSample advance_body(const BodyModel& body, BodyState& state, double force_N) JAWARI_REALTIME;

}  // namespace jawari
