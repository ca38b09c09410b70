"""Motions in closed form, and the scenes whose motion they are. Nothing here shares code with the engine."""
import json

import numpy as np


def shapes(count, length, positions):
    k = np.arange(1, count + 1)
    return np.sqrt(2 / length) * np.sin(np.pi * np.outer(np.atleast_1d(positions), k) / length)


def scene(output_rate, duration, length, density, modes, initial, contacts, positions):
    """A scene file's text with one string and displacement probes."""
    string = {"length_m": length, "linear_density_kg_per_m": density, "modes": modes, "initial": initial,
              "contacts": contacts, "probes": [{"quantity": "displacement", "position_m": float(x)} for x in positions]}
    return json.dumps({"schema": "jawari.scene/1", "duration_s": duration, "output_rate_hz": output_rate, "strings": [string]})


class FreeString:
    """40 damped modes of a plucked string without obstacles; used with one obstacle by SingleImpact."""

    length, density, count, tension, inharmonicity = 0.65, 4e-3, 40, 80.0, 1e-4
    positions = np.array([0.065, 0.1625, 0.325, 0.585])
    output_rate, duration = 16000, 0.02
    pluck = {"position_m": 0.2, "height_m": 2e-3}
    contacts = []

    def __init__(self):
        k = np.arange(1, self.count + 1)
        f0 = np.sqrt(self.tension / self.density) / (2 * self.length)
        self.omega = 2 * np.pi * k * f0 * np.sqrt(1 + self.inharmonicity * k**2)
        self.sigma = 2.0 + 0.05 * k**2
        x, height = self.pluck["position_m"], self.pluck["height_m"]
        self.q0 = height * self.length**3 * shapes(self.count, self.length, x)[0] / (
            np.pi**2 * k**2 * x * (self.length - x))
        self.v0 = np.zeros(self.count)

    def times(self):
        return np.arange(round(self.duration * self.output_rate) + 1) / self.output_rate

    def text(self):
        modes = {"frequency_hz": list(self.omega / (2 * np.pi)), "decay_per_s": list(self.sigma)}
        initial = {"modal_displacement": list(self.q0), "modal_velocity": list(self.v0)}
        return scene(self.output_rate, self.duration, self.length, self.density, modes, initial, self.contacts, self.positions)

    def free(self, q, v, t):
        """Modal displacement and velocity t after (q, v), t x modes."""
        W = np.sqrt(self.omega**2 - self.sigma**2)
        t = np.atleast_1d(t)[:, None]
        decay, c, s = np.exp(-self.sigma * t), np.cos(W * t), np.sin(W * t)
        b = (v + self.sigma * q) / W
        return decay * (q * c + b * s), decay * ((b * W - self.sigma * q) * c - (q * W + self.sigma * b) * s)

    def samples(self):
        return self.free(self.q0, self.v0, self.times())[0] @ shapes(self.count, self.length, self.positions).T


class SingleImpact(FreeString):
    """The same string over one obstacle: free, one impact by Newton's law, free until just before the second.

    The impact's time is the root of the gap in closed form; the impact changes the modal velocities by
    -(1 + e) (S v) S'/(S S'), the jump of N equal masses at a point.
    """

    def __init__(self, restitution, height=-0.5e-3):
        super().__init__()
        self.restitution = restitution
        self.contact_x, self.height = 0.4, height
        self.contacts = [{"position_m": self.contact_x, "height_m": self.height, "restitution": restitution}]
        self.row = shapes(self.count, self.length, self.contact_x)[0]
        self.impact_s = self.first_root(self.q0, self.v0, 0)
        q, v = (a[0] for a in self.free(self.q0, self.v0, self.impact_s))
        self.after = q, v - (1 + restitution) * (self.row @ v) * self.row / (self.row @ self.row)
        second = self.first_root(*self.after, 1e-7)
        self.duration = np.floor(0.98 * (self.impact_s + second) * self.output_rate) / self.output_rate

    def first_root(self, q, v, start):
        def gap(t):
            return self.free(q, v, t)[0] @ self.row - self.height
        t = start + np.arange(0, 0.02, 1e-7)
        sign = np.concatenate([gap(chunk) for chunk in np.array_split(t, 50)]) < 0
        if not sign.any():
            raise ValueError("no impact")
        high = t[np.argmax(sign)]
        low = high - 1e-7
        for _ in range(80):
            middle = (low + high) / 2
            low, high = (low, middle) if gap(middle)[0] < 0 else (middle, high)
        return low

    def samples(self):
        t = self.times()
        before, after = t[t <= self.impact_s], t[t > self.impact_s] - self.impact_s
        q = np.vstack([self.free(self.q0, self.v0, before)[0], self.free(*self.after, after)[0]])
        return q @ shapes(self.count, self.length, self.positions).T


class PersistentContact(FreeString):
    """A lossless string of 40 modes that rests on an obstacle above its rest line and vibrates without ever leaving it.

    The motion is that of the modes under the constraint S q = b: the eigenvectors of the stiffness on the constraint's null
    space. The reaction stays positive (checked here).
    """

    def __init__(self):
        super().__init__()
        self.sigma = np.zeros(self.count)
        self.contact_x, self.height = 0.4, 1e-3
        self.contacts = [{"position_m": self.contact_x, "height_m": self.height, "restitution": 0.5}]
        row = shapes(self.count, self.length, self.contact_x)[0]
        static = row / self.omega**2
        static *= self.height / (row @ static)
        _, _, right = np.linalg.svd(row[None, :])
        free = right[1:].T
        square, vectors = np.linalg.eigh(free.T @ (self.omega[:, None] ** 2 * free))
        self.basis, self.frequency = free @ vectors, np.sqrt(square)
        self.static = static
        self.amplitude = 0.02 * (self.basis.T @ self.q0)
        self.amplitude[15:] = 0
        self.q0 = static + self.basis @ self.amplitude
        motion = np.cos(np.outer(np.arange(0, self.duration, 1e-5), self.frequency)) * self.amplitude
        q = static + motion @ self.basis.T
        reaction = (q * self.omega**2) @ row  # mu S diag(omega^2) q, up to a positive factor
        if reaction.min() <= 0.1 * reaction.mean():
            raise ValueError("the string leaves the obstacle")

    def samples(self):
        motion = np.cos(np.outer(self.times(), self.frequency)) * self.amplitude
        return (self.static + motion @ self.basis.T) @ shapes(self.count, self.length, self.positions).T


class UnitString:
    """Length, density and tension 1: waves travel at 1, the period is 2. Starts as a triangle of height 1.

    `count` modes, without loss or stiffness; the initial shape passes through the triangle at count + 1 intervals.
    """

    def __init__(self, count, positions, contacts, output_rate, duration):
        self.count, self.positions, self.contacts = count, np.array(positions), contacts
        self.output_rate, self.duration = output_rate, duration
        nodes = np.arange(1, count + 1) / (count + 1)
        triangle = 2 * np.minimum(nodes, 1 - nodes)
        self.q0 = shapes(count, 1, nodes).T @ triangle / (count + 1)

    def times(self):
        return np.arange(round(self.duration * self.output_rate) + 1) / self.output_rate

    def text(self):
        modes = {"frequency_hz": list(0.5 * np.arange(1, self.count + 1)), "decay_per_s": [0.0] * self.count}
        return scene(self.output_rate, self.duration, 1, 1, modes, {"modal_displacement": list(self.q0)}, self.contacts,
                     self.positions)


class CabannesString(UnitString):
    """Point obstacle at the middle, at rest height (H. Cabannes, "Cordes vibrantes avec obstacles", Acustica 55, 1984).

    The triangle falls flat within 1/2; both halves swing below the obstacle for 1/2, pinned at it; then the whole string
    rises to the triangle within 1/2: period 3/2. No impact works on a string at a point, so restitution does not matter.
    """

    def __init__(self, count, output_rate=64, restitution=0.0):
        contacts = [{"position_m": 0.5, "height_m": 0, "restitution": restitution}]
        super().__init__(count, [0.1, 0.25, 0.45, 0.9], contacts, output_rate, 3.0)

    def samples(self):
        t = self.times()[:, None] % 1.5
        x = self.positions[None, :]
        half = x % 0.5
        falls = np.minimum(2 * np.minimum(x, 1 - x), 1 - 2 * t)
        tau = t - 0.5
        below = -2 * np.minimum(np.minimum(half, 0.5 - half), np.minimum(tau, 0.5 - tau))
        rises = 2 * np.minimum(np.minimum(x, 1 - x), t - 1)
        return np.where(t <= 0.5, falls, np.where(t <= 1, below, rises))


class FlatObstacleString(UnitString):
    """Flat obstacle along the whole rest line, a contact at every node: the triangle lands on it all at once, at t = 1/2.

    With restitution e the string is thrown back with e times its velocity (L. Amerio and G. Prouse, "Study of the motion of a
    string vibrating against an obstacle", Rend. Mat. 8, 1975, for e = 1): u = e^n |free motion| after n landings.
    """

    def __init__(self, count, restitution):
        nodes = np.arange(1, count + 1) / (count + 1)
        contacts = [{"position_m": float(x), "height_m": 0, "restitution": restitution} for x in nodes]
        places = nodes[[(count + 1) // 8 - 1, (count + 1) // 4 - 1, (count + 1) // 2 - 1, 7 * (count + 1) // 8 - 1]]
        self.restitution = restitution
        super().__init__(count, places, contacts, count + 1, 3.0)

    def samples(self):
        t = self.times()[:, None]
        phase = (t + 0.5) % 1 - 0.5  # since the last return to the triangle
        x = self.positions[None, :]
        shape = np.minimum(2 * np.minimum(x, 1 - x), 1 - 2 * np.abs(phase))
        return shape * np.power(float(self.restitution), np.floor(t + 0.5))


class ThetaMode(FreeString):
    """What the theta scheme makes of one lossless mode of 1 kHz, which is not the mode's own motion.

    theta = 1/2 is the trapezoidal rule: the phase advances by 2 atan(omega h/2) a step instead of omega h, at full amplitude;
    theta = 1 is backward Euler: a factor 1/(1 - i omega h) a step (E. Hairer and G. Wanner, "Solving Ordinary Differential
    Equations II", section IV.3).
    """

    count = 1

    def __init__(self, theta, rate):
        super().__init__()
        self.count, self.duration = 1, 0.01
        self.omega, self.sigma, self.q0, self.v0 = np.array([2000 * np.pi]), np.zeros(1), np.array([1e-3]), np.zeros(1)
        phase = self.omega[0] / rate
        self.factor = np.exp(2j * np.arctan(phase / 2)) if theta == 0.5 else 1 / (1 - 1j * phase)
        self.rate = rate

    def samples(self):
        steps = np.round(self.times() * self.rate)
        return (1e-3 * np.real(self.factor**steps))[:, None] * shapes(1, self.length, self.positions).T
