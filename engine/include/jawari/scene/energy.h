// The discrete energy of a string, and its balance over one step.
#pragma once

#include "jawari/realtime.h"

namespace jawari {

struct StringModel;
struct StringState;

/// Which energies rendering measures.
enum class Metering {
    Off,    ///< none
    Frame,  ///< H at the end of each output frame in which it may have risen
    Step    ///< the whole balance at each contact step; costs about as much as the step itself
};

/// Energies of one string [J], measured since its reset() as Metering says.
struct EnergyMeter {
    double initial = 0;          ///< H at reset() [J]
    double highest = 0;          ///< largest H seen: at each step with Metering::Step, else at each frame [J]
    double dissipated = 0;       ///< loss in the string itself, >= 0 [J]; Metering::Step only
    double contact_work = 0;     ///< sum lambda (y+ - y_before)/(2h): work of impacts on the string [J]
    double player_work = 0;      ///< sum lambda (b+ - b_before)/(2h): work of moving obstacles [J]
    double worst_imbalance = 0;  ///< largest |H+ - H + losses - works| of one step [J]
    double worst_rise = 0;       ///< largest H+ - H - player's work of one step [J]
};

/// Energy of the string at the state's time [J], >= 0.
///
/// Exact scheme: H = 1/2 mu sum_k [(1+e)/(2w) v^2 + omega^2 q (q - h v)], q and v at the end of a step,
/// evaluated as 1/2 mu sum_k omega^2 [h^2 (1+e+A)/(4d) v^2 + (q - h v/2)^2], where nothing cancels.
/// Theta scheme: H = 1/2 mu sum_k (v^2 + omega^2 q^2). A mode with w = 0 counts its potential energy only.
double energy(const StringModel& model, const StringState& state) JAWARI_REALTIME;

}  // namespace jawari
