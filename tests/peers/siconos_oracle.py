"""Runs one string of a scene in Siconos (python3-siconos 4.4).

Siconos is given unit modal mass, so its impulses are lambda/mu; they are returned multiplied by mu [N s].
"""

import contextlib
import os
import sys

import numpy as np
import siconos.kernel as sk
import siconos.numerics as sn


@contextlib.contextmanager
def quiet_stdout():
    """Siconos greets from C++; what it prints is no part of the result."""
    sys.stdout.flush()
    saved = os.dup(1)
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    try:
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)
        os.close(null)


def simulate(string, step, steps, scheme="exact", theta=0.5):
    """Rows 0..steps of modal displacement q, velocity v, impulse lambda and LCP residual.

    scheme "exact": MoreauJeanBilbaoOSI; "theta": MoreauJeanOSI(theta). Row n of lambda is the impulse between
    rows n-1 and n.
    """
    with quiet_stdout():
        return _simulate(string, step, steps, scheme, theta)


def _simulate(string, step, steps, scheme, theta):
    ds = sk.LagrangianLinearDiagonalDS(string.q0, string.v0, string.omega**2, 2 * string.sigma)
    model = sk.NonSmoothDynamicalSystem(0.0, (steps + 2) * step)
    model.insertDynamicalSystem(ds)
    interactions = []
    for row, bias, e in zip(string.rows, string.bias, string.restitution):
        relation = sk.LagrangianLinearTIR(row.reshape(1, -1).copy(), [-bias])
        interaction = sk.Interaction(sk.NewtonImpactNSL(float(e)), relation)
        model.link(interaction, ds)
        interactions.append(interaction)

    osi = sk.MoreauJeanBilbaoOSI() if scheme == "exact" else sk.MoreauJeanOSI(theta)
    problem = sk.LCP(sn.SICONOS_LCP_LEMKE)
    simulation = sk.TimeStepping(model, sk.TimeDiscretisation(0.0, step), osi, problem)

    modes, contacts = len(string.omega), len(interactions)
    q = np.zeros((steps + 1, modes))
    v = np.zeros((steps + 1, modes))
    impulse = np.zeros((steps + 1, contacts))
    residual = np.zeros(steps + 1)
    q[0], v[0] = ds.q(), ds.velocity()
    for n in range(1, steps + 1):
        simulation.computeOneStep()
        q[n], v[n] = ds.q(), ds.velocity()
        # A contact that is no candidate keeps the multiplier of an earlier step: the index set says who took part.
        active = _active(simulation, interactions)
        for c in active:
            impulse[n, c] = interactions[c].lambda_(1)[0]
        if active:
            w, z = np.array(problem.w()), np.array(problem.z())
            residual[n] = np.max(np.abs(np.minimum(w, z))) if len(z) else 0.0
        simulation.nextStep()
    return {"q": q, "v": v, "impulse": string.density * impulse, "residual": residual}


def _active(simulation, interactions):
    members = {i.number() for i in simulation.indexSet(1).interactions()}
    return [c for c, interaction in enumerate(interactions) if interaction.number() in members]
