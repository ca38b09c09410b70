// What the two ways to solve a frame of a moving bridge share: the body's shapes, and Cholesky's method.
#pragma once

#include <cmath>
#include <cstddef>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

inline const double* shape_under(const BridgeModel& bridge, std::size_t s) {
    return bridge.shape.data() + s * bridge.stride;
}

inline double product(std::size_t n, const double* x, const double* y) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += x[j] * y[j];
    return sum;
}

/// Adds the voice's pull to modal forces.
inline void add_pull(const BridgeModel& bridge, const VoiceOnBridge& voice, double force_N, double* modal) {
    const double* shape = shape_under(bridge, voice.string);
    const double scaled = voice.weight * force_N;
    for (std::size_t j = 0; j < bridge.count; ++j) modal[j] += scaled * shape[j];
}

/// Cholesky's factor L of the matrix, row by row; the diagonal holds 1/L_ii. The matrix is positive definite:
/// 2/y_held > 0, and no voice's stiffness is negative.
inline void factorise(const BridgeModel& bridge, BridgeState& state, std::size_t order) {
    for (std::size_t i = 0; i < order; ++i) {
        const double* from = state.matrix.data() + i * bridge.stride;
        double* row = state.factor.data() + i * bridge.stride;
        for (std::size_t j = 0; j < i; ++j) {
            const double* above = state.factor.data() + j * bridge.stride;
            row[j] = (from[j] - product(j, row, above)) * above[j];
        }
        row[i] = 1 / std::sqrt(from[i] - product(i, row, row));
    }
}

/// x <- the solution for the right side x.
inline void solve(const BridgeModel& bridge, const BridgeState& state, std::size_t order, double* x) {
    for (std::size_t i = 0; i < order; ++i) {
        const double* row = state.factor.data() + i * bridge.stride;
        x[i] = (x[i] - product(i, row, x)) * row[i];
    }
    for (std::size_t i = order; i-- > 0;) {
        const double* row = state.factor.data() + i * bridge.stride;
        x[i] *= row[i];
        for (std::size_t j = 0; j < i; ++j) x[j] -= row[j] * x[i];
    }
}

/// Solves for the displacement in as many unknowns as the body has modes; sets zeta_m, pull and the exciters'
/// forces of all voices.
void solve_by_modes(const InstrumentModel& model, InstrumentState& instrument) JAWARI_REALTIME;

/// The same in as many unknowns as there are voices.
void solve_by_voices(const InstrumentModel& model, InstrumentState& instrument) JAWARI_REALTIME;

}  // namespace jawari
