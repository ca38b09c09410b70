"""The time step as the model's documentation writes it, in numpy: slow, plain, and independent of the engine.

It covers what Siconos does not (the impact laws passive, signorini and paoli-schatzman) and checks the Siconos script on
what both can do. Coefficients come from their definitions in 50-digit arithmetic (mpmath), complementarity problems are
solved by Murty's least-index pivoting, with every linear system solved from scratch.
"""

import mpmath as mp
import numpy as np

mp.mp.dps = 50


def exact_coefficients(omega, sigma, step):
    """e, d and w of every mode from q(t+h) = A q(t) - e q(t-h), A = z1 + z2, e = z1 z2, z = exp of the characteristic roots."""
    d, e, w = (np.empty(len(omega)) for _ in range(3))
    h = mp.mpf(float(step))
    for k, (o, s) in enumerate(zip(omega, sigma)):
        o, s = mp.mpf(float(o)), mp.mpf(float(s))
        root = mp.sqrt(mp.mpc(s * s - o * o))
        z1, z2 = mp.exp((-s + root) * h), mp.exp((-s - root) * h)
        dk = mp.re(1 + z1 * z2 - z1 - z2)
        d[k], e[k], w[k] = float(dk), float(mp.re(z1 * z2)), float(dk / (o * h) ** 2)
    return d, e, w


def solve_lcp(matrix, offset):
    """lambda of 0 <= r + A lambda perp lambda >= 0: Murty's least-index pivoting, exact up to rounding, A positive definite."""
    n = len(offset)
    active = np.zeros(n, dtype=bool)
    scale = np.max(np.abs(offset), initial=0.0)
    for _ in range(200 * n + 10):
        lam = np.zeros(n)
        if active.any():
            lam[active] = np.linalg.solve(matrix[np.ix_(active, active)], -offset[active])
        slack = offset + matrix @ lam
        wrong = (active & (lam < 0)) | (~active & (slack < -1e-14 * scale))
        if not wrong.any():
            return lam
        first = np.argmax(wrong)
        active[first] = ~active[first]
    raise RuntimeError("complementarity problem not solved")


def simulate(string, step, steps, scheme="exact", theta=0.5, law="newton"):
    """Rows 0..steps of q, v and impulse; start 'backward' (the velocity taken literally)."""
    h, mu = step, string.density
    if scheme == "exact":
        d, e, w = exact_coefficients(string.omega, string.sigma, h)
        theta = 1.0
        velocity_change, restoring = e - 1, -d / h
    else:
        w = 1 / (1 + 2 * theta * string.sigma * h + (theta * string.omega * h) ** 2)
        velocity_change = -w * (h**2 * theta * string.omega**2 + 2 * string.sigma * h)
        restoring = -w * h * string.omega**2
    S = string.rows
    compliance = h * theta * (S * (w / mu)) @ S.T

    q, v = string.q0.copy(), string.v0.copy()
    gap = S @ q - string.bias
    gap_before = gap - h * (S @ v)
    rows_q, rows_v, rows_lambda = [q.copy()], [v.copy()], [np.zeros(len(gap))]
    for _ in range(steps):
        v_free = v + velocity_change * v + restoring * q
        rate = S @ v
        gap_free = gap + h * (S @ (theta * v_free + (1 - theta) * v))
        if law in ("newton", "passive"):
            speed = rate if scheme == "theta" else (gap - gap_before) / h
            candidates = np.flatnonzero(gap + h / 2 * speed <= 0)
        else:
            candidates = np.arange(len(gap))
        target = _target(law, scheme, theta, string.restitution, gap, gap_before, h * rate)
        impulse = np.zeros(len(gap))
        if len(candidates):
            block = compliance[np.ix_(candidates, candidates)]
            impulse[candidates] = solve_lcp(block, (gap_free - target)[candidates])
        v_new = v_free + (w / mu) * (S.T @ impulse)
        q = q + h * (theta * v_new + (1 - theta) * v)
        v = v_new
        gap_before, gap = gap, S @ q - string.bias
        rows_q.append(q.copy())
        rows_v.append(v.copy())
        rows_lambda.append(impulse)
    return {"q": np.array(rows_q), "v": np.array(rows_v), "impulse": np.array(rows_lambda)}


def _target(law, scheme, theta, e, gap, gap_before, approach):
    if scheme == "theta":
        return gap + ((1 - theta) - theta * e) * approach
    newton = gap - e * (gap - gap_before)
    if law == "newton":
        return newton
    if law == "passive":
        return np.where(gap <= gap_before, newton, gap_before)
    if law == "signorini":
        return np.zeros_like(gap)
    return -e * gap_before
