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


def with_and_without_bridge(duration_s):
    """Results of the built-in scene as it is, and without its contacts."""
    scene = jawari.Scene("lab/tanpura", duration_s=duration_s)
    with_bridge = jawari.simulate(scene, contacts=False)
    string = scene["strings"][0]
    del string["contacts"]
    string["probes"] = [probe for probe in string["probes"] if probe["quantity"] != "contact_force"]
    return with_bridge, jawari.simulate(scene, contacts=False)


def main(duration_s=0.5):
    with_bridge, without = with_and_without_bridge(duration_s)
    print(f"spectral centroid: {centroid_hz(without):.0f} Hz without the bridge, {centroid_hz(with_bridge):.0f} Hz with it")
    return centroid_hz(with_bridge) / centroid_hz(without)


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
