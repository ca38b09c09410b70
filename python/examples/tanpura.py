"""The tanpura with its bridge and without: the bridge brings up the high partials, and they stay.

Usage: tanpura.py [SECONDS]
"""

import sys

import numpy as np

import jawari


def centroid_hz(result):
    """Mean frequency of the probe's spectrum, of the second half of the sound."""
    u = result[0][len(result.time_s) // 2 :]
    spectrum = np.abs(np.fft.rfft(u * np.hanning(len(u)))) ** 2
    frequency_hz = np.fft.rfftfreq(len(u), 1 / result.output_rate_hz)
    return (frequency_hz * spectrum).sum() / spectrum.sum()


def main(duration_s=0.5):
    scene = jawari.Scene("lab/tanpura", duration_s=duration_s)
    with_bridge = jawari.simulate(scene, contacts=False)
    scene["strings"][0].pop("contacts", None)
    scene["strings"][0].pop("neck", None)
    scene["strings"][0]["probes"] = [p for p in scene["strings"][0]["probes"] if p["quantity"] != "contact_force"]
    without = jawari.simulate(scene, contacts=False)
    print(f"spectral centroid: {centroid_hz(without):.0f} Hz without the bridge, {centroid_hz(with_bridge):.0f} Hz with it")
    return centroid_hz(with_bridge) / centroid_hz(without)


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
