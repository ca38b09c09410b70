// A voice on a moving bridge that nothing else touches flies through a run of frames at once: what its end
// does is known in advance but for what the bridge adds, frame by frame (docs/engine/model.md, "Runs").
#pragma once

#include <cmath>
#include <cstddef>

#include "instrument/touch/bridge_end.h"
#include "instrument/voice/pickups.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Room for strings of up to `stride` modes; none unless the bridge moves.
EndRun make_end_run(const InstrumentModel& model, std::size_t stride);

/// A voice that is about to fly.
struct EndFlyer {
    const InstrumentModel& model;
    const StoppedStringModel& stopped;
    const StringModel& string;
    const BridgeEndModel& end;
};

/// Whether the voice is in a run.
bool goes_on_in_run(Voice& voice) JAWARI_REALTIME;

/// Begins a run of `frames` frames if nothing but the bridge acts on the voice and nothing can strike it.
bool begin_end_run(const EndFlyer& flyer, Voice& voice, std::size_t frames) JAWARI_REALTIME;

/// The voice's force on the bridge in the coming frame of its run, as long as the bridge rests.
inline void set_force_in_run(const EndRun& run, double rest_N, BridgeEndFrame& frame) JAWARI_REALTIME {
    const double start_N = run.readings[run.passed], end_N = run.readings[run.passed + 1];
    frame.start_N = start_N - rest_N;
    frame.force_N = frame.start_N + (end_N - start_N) / 2;
}

/// What the voice answers to the bridge in the coming frame of its run.
inline void answer_in_run(const EndRun& run, const BridgeEndModel& end,
                          BridgeEndFrame& frame) JAWARI_REALTIME {
    set_force_in_run(run, end.rest_N, frame);
    frame.active.count = frame.active.touches = 0;
    frame.active.excited = false;
    frame.stiffness_N_per_m = end.stiffness_N_per_m - run.responses[0] / 2;
    frame.by_exciter = 0;
    frame.exciter_N = 0;
}

/// Where the end was in the frame that has passed last [m].
inline double last_zeta(const EndRun& run) {
    return run.passed == 0 ? run.still_m : run.zeta_m[run.passed - 1];
}

/// Whether the coming frame may pass with the bridge at zeta_m in its mean: it brings no string to an
/// obstacle.
inline bool may_pass_in_run(const EndRun& run, double zeta_m) {
    return run.travel_m + std::abs(zeta_m - last_zeta(run)) <= run.most_travel_m;
}

/// The frame passes so.
void pass_in_run(const StringModel& string, Voice& voice, double zeta_m) JAWARI_REALTIME;

/// The run ends before a frame that may not pass.
void give_up_run(const StringModel& string, Voice& voice, double zeta_m) JAWARI_REALTIME;

/// What the outputs read at the ends of `frames` frames, as frames 0, 1, ...; `first`: how many had passed at
/// the first of these ends.
void read_run(const EndRun& run, std::size_t first, std::size_t frames,
              OutputReadings& readings) JAWARI_REALTIME;

/// Where the end was in a frame that passed without a run.
void note_end(EndRun& run, double zeta_m) JAWARI_REALTIME;

/// Ends the run, if there is one: displacement and velocity are those of now.
void settle_run(const StringModel& string, Voice& voice) JAWARI_REALTIME;

/// Displacement and velocity become those of now, and the run goes on in the next frame.
void show_run(const StringModel& string, Voice& voice) JAWARI_REALTIME;

/// Forgets a run of which displacement and velocity are those of now.
void forget_run(Voice& voice) JAWARI_REALTIME;

}  // namespace jawari
