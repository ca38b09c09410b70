"""Reads a jawari.scene/1 file into plain numpy arrays, from the definitions and without any code of the engine.

Every string becomes a `String`: modes (omega, sigma), contact rows and heights, initial modal state, probes.
"""

import json
from dataclasses import dataclass, field

import numpy as np


@dataclass
class String:
    length: float  # L [m]
    density: float  # mu [kg/m]
    omega: np.ndarray  # undamped angular frequencies [rad/s]
    sigma: np.ndarray  # decay rates [1/s]
    q0: np.ndarray  # modal displacement [m^(3/2)]
    v0: np.ndarray  # modal velocity
    rows: np.ndarray  # contacts x modes: gap = rows q - bias
    bias: np.ndarray  # [m]
    restitution: np.ndarray
    probe_rows: np.ndarray = None  # probes x modes, displacement and velocity probes only
    probe_quantities: list = field(default_factory=list)


def mode_shapes(count, length, positions):
    """phi_k(x) = sqrt(2/L) sin(k pi x/L), positions x modes."""
    k = np.arange(1, count + 1)
    x = np.atleast_1d(np.asarray(positions, dtype=float))
    return np.sqrt(2 / length) * np.sin(np.pi * np.outer(x, k) / length)


def _valette(damping, k, f0, f, tension, density, length, inharmonicity):
    eta, rho = damping["air_viscosity_Pa_s"], damping["air_density_kg_per_m3"]
    d, delta = damping["diameter_m"], damping["viscoelastic_loss_angle_rad"]
    resistance = 2 * np.pi * eta + 2 * np.pi * d * np.sqrt(np.pi * eta * rho * f)
    f0k = k * f0
    inverse_q = (
        resistance / (2 * np.pi * density) * f0k / f**2
        + 4 * length**2 * inharmonicity * density * delta / tension * f0k**3 / f
        + damping["inverse_quality"]
    )
    return np.pi * f * inverse_q


def _wave_index(frequency, f0, inharmonicity, law):
    """The (real) mode number k at which the string sounds `frequency`."""
    ratio = frequency / f0
    if inharmonicity == 0:
        return ratio
    if law == "square_root":  # ratio^2 = k^2 + B k^4
        return np.sqrt((np.sqrt(1 + 4 * inharmonicity * ratio**2) - 1) / (2 * inharmonicity))
    roots = np.roots([inharmonicity / 2, 0, 1, -ratio])  # ratio = k + B k^3/2, increasing: one real root
    return roots[np.argmin(np.abs(roots.imag))].real


def _t60(damping, k, f0, inharmonicity, law):
    """sigma = s0 + s1 k^2 through ln(1000)/T60 at the two points given."""
    points = damping["points"]
    index = [_wave_index(p["frequency_hz"], f0, inharmonicity, law) for p in points]
    target = [np.log(1000) / p["t60_s"] for p in points]
    s1 = (target[1] - target[0]) / (index[1] ** 2 - index[0] ** 2)
    return target[0] + s1 * (k**2 - index[0] ** 2)


def _modes(modes, length, density):
    if "frequency_hz" in modes:
        return 2 * np.pi * np.array(modes["frequency_hz"]), np.array(modes["decay_per_s"], dtype=float)
    k = np.arange(1, modes["count"] + 1)
    tension, b = modes["tension_N"], modes.get("inharmonicity", 0.0)
    f0 = np.sqrt(tension / density) / (2 * length)
    law = modes.get("inharmonicity_law", "square_root")
    f = k * f0 * (np.sqrt(1 + b * k**2) if law == "square_root" else 1 + b * k**2 / 2)
    damping = modes.get("damping", {"model": "none"})
    if damping["model"] == "none":
        sigma = np.zeros_like(f)
    elif damping["model"] == "valette":
        sigma = _valette(damping, k, f0, f, tension, density, length, b)
    else:
        sigma = _t60(damping, k, f0, b, law)
    return 2 * np.pi * f, sigma


def _initial(initial, count, length):
    if "pluck" in initial:
        x, height = initial["pluck"]["position_m"], initial["pluck"]["height_m"]
        k = np.arange(1, count + 1)
        # projection of the triangle: integral of phi_k over both straight flanks
        q0 = height * length**3 * np.sqrt(2 / length) * np.sin(k * np.pi * x / length)
        return q0 / (np.pi**2 * k**2 * x * (length - x)), np.zeros(count)
    q0 = np.array(initial.get("modal_displacement", np.zeros(count)), dtype=float)
    v0 = np.array(initial.get("modal_velocity", np.zeros(count)), dtype=float)
    return q0, v0


def _contacts(string):
    contacts = [dict(c) for c in string.get("contacts", [])]
    if "neck" in string:
        neck = string["neck"]
        n = neck["grid_points"]
        x = np.arange(1, n + 1) * string["length_m"] / (n + 1)
        profile = np.array(neck["profile_m"])
        for position, height in zip(x, np.interp(x, profile[:, 0], profile[:, 1])):
            contacts.append({"position_m": position, "height_m": height, "restitution": neck["restitution"]})
    return contacts


def read_string(string, restitution=None):
    """One string of a scene. `restitution` replaces that of every contact."""
    length, density = string["length_m"], string["linear_density_kg_per_m"]
    omega, sigma = _modes(string["modes"], length, density)
    q0, v0 = _initial(string.get("initial", {}), len(omega), length)
    contacts = _contacts(string)
    side = np.array([1.0 if c.get("side", "below") == "below" else -1.0 for c in contacts])
    rows = side[:, None] * mode_shapes(len(omega), length, [c["position_m"] for c in contacts])
    bias = side * np.array([c["height_m"] for c in contacts])
    e = np.array([c.get("restitution", 0.0) if restitution is None else restitution for c in contacts])
    probes = [p for p in string.get("probes", []) if p["quantity"] in ("displacement", "velocity")]
    probe_rows = mode_shapes(len(omega), length, [p["position_m"] for p in probes])
    return String(length, density, omega, sigma, q0, v0, rows, bias, e, probe_rows, [p["quantity"] for p in probes])


def read_scene(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)
