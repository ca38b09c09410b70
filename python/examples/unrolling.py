"""A string on a curved bridge, as the sitar has it: the point where it leaves the bridge moves back and forth in each period.

Usage: unrolling.py [SECONDS]
"""

import sys

import numpy as np

import jawari


def sitar(duration_s, points=60):
    """A parabolic bridge over the first 15 mm, flush with the rest line at its far end."""
    at = np.linspace(2.5e-4, 0.015, points)
    string = {
        "name": "sitar", "length_m": 0.88, "linear_density_kg_per_m": 6.6e-4,
        "modes": {"count": 600, "tension_N": 40,
                  "damping": {"model": "t60", "points": [{"frequency_hz": 100, "t60_s": 5}, {"frequency_hz": 3000, "t60_s": 1}]}},
        "initial": {"pluck": {"position_m": 0.7, "height_m": 0.002}},
        "contacts": [{"position_m": float(x), "height_m": float(-0.4 * (0.015 - x) ** 2 - 0.2 * x**2)} for x in at],
    }  # fmt: skip
    return {"schema": "jawari.scene/1", "duration_s": duration_s, "contact_rate_hz": 480000, "strings": [string]}


def main(duration_s=0.02):
    simulation = jawari.Simulation(sitar(duration_s))
    string = simulation.strings[0]
    times, ends = [], []

    def look(_):
        touching = np.flatnonzero(string.impulse_Ns)
        if len(touching):
            times.append(simulation.time_s)
            ends.append(string.contact_position_m[touching].max())

    simulation.advance(seconds=duration_s, callback=look)
    print(f"{len(times)} of {simulation.frame} frames touch; the last point that touches lies between "
          f"{1e3 * min(ends):.2f} and {1e3 * max(ends):.2f} mm")  # fmt: skip
    return max(ends) - min(ends)


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
