"""A plate that a hammer drives onto a stop: how much longer than by itself it rings high, by the height of the stop.

The stop is moved away and left out by editing the scene, a dict. Usage: plate.py [SECONDS]
"""

import sys

import numpy as np

import jawari


def brightness(result):
    """Share of the power of the plate's velocity above 2 kHz."""
    velocity = result.probes[:, 0]
    power = np.abs(np.fft.rfft(velocity * np.hanning(len(velocity)))) ** 2
    return power[np.fft.rfftfreq(len(velocity), 1 / result.output_rate_hz) > 2000].sum() / power.sum()


def with_stop(height_m, duration_s):
    """The built-in scene, its stop at another height; None: without it."""
    scene = jawari.Scene("lab/plate", duration_s=duration_s)
    plate = scene["strings"][0]
    if height_m is None:
        del plate["contacts"]
        plate["probes"] = [probe for probe in plate["probes"] if probe["quantity"] != "contact_force"]
    else:
        plate["contacts"][0]["height_m"] = height_m
    return scene


def main(duration_s=0.1):
    shares = {}
    for height_m in (None, -2e-4, -2e-5, -2e-6):
        result = jawari.simulate(with_stop(height_m, duration_s), contacts=False)
        shares[height_m] = brightness(result)
        where = "no stop" if height_m is None else f"stop {-1e6 * height_m:.0f} um below"
        energy = result["energy_J"]
        print(f"{where:18s} {100 * shares[height_m]:5.2f} % of the power above 2 kHz, {energy[-1] / energy[0]:.3f} of the energy left")
    return shares[-2e-6] / shares[None]


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
