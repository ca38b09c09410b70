#!/usr/bin/env python3
"""A C8 at 44.1 kHz: whatever is not a partial of the model lies below -90 dB of the loudest partial.

The string is made for the test (wire of a piano's top octave, plucked, no contacts); its partials up to the output's Nyquist rate are where
a stiff string has them, all others would be aliases: partials of 22 to 60 kHz that fold back.

usage: check_aliasing.py PROGRAM
"""
import math
import sys
import tempfile

import numpy as np

import estimate
import play
from preset_model import Motion

RATE_HZ = 44100
LIMIT_DB = -90.0
STRING = {"name": "C8", "open_note": 108, "open_frequency_hz": 440 * 2 ** (39 / 12), "length_m": 0.054, "linear_density_kg_per_m": 0.0039,
          "inharmonicity": 0.002, "damping": {"model": "t60", "points": [{"frequency_hz": 4186, "t60_s": 1.5}, {"frequency_hz": 16000, "t60_s": 0.6}]}}
PRESET = {"schema": "jawari.preset/2", "name": "One high string", "gain": 1.0, "contact_rate_min_hz": 400000, "mode_limit_hz": 60000,
          "exciters": [{"name": "plectrum", "kind": "finger", "position_from_bridge_m": 0.011, "rise_s": 0.002, "release_s": 5e-05,
                        "full_height_m": 0.0005}],
          "pickups": [{"position_from_bridge_m": 0.007}], "strings": [STRING]}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    score = play.score()
    score.note(0, 108, play.beats(0.6), 127)
    with tempfile.TemporaryDirectory() as folder:
        sound = play.render(sys.argv[1], PRESET, score, folder, "c8", rate_hz=RATE_HZ)
    x = sound.mono[int(0.02 * RATE_HZ):int(0.32 * RATE_HZ)]
    window = estimate.blackman_harris(len(x))
    spectrum = np.abs(np.fft.rfft(x * window))
    frequency = np.fft.rfftfreq(len(x), 1 / RATE_HZ)
    motion = Motion(STRING, 0)
    bins = 12 * RATE_HZ / len(x)  # the window's main lobe, widened by the decay
    predicted = np.zeros(len(frequency), bool)
    k, heard = 1, 0
    while motion.partial_hz(k) < RATE_HZ / 2:
        predicted |= np.abs(frequency - motion.partial_hz(k)) < bins
        k, heard = k + 1, heard + 1
    folded = [abs(motion.partial_hz(j) - RATE_HZ * round(motion.partial_hz(j) / RATE_HZ)) for j in range(k, k + 10)]
    worst = 20 * math.log10(spectrum[~predicted].max() / spectrum.max())
    print(f"{heard} partials of {motion.partial_hz(1):.1f} Hz; the next would fold to {', '.join(f'{f:.0f}' for f in folded[:4])} Hz; "
          f"loudest other component {worst:.1f} dB at {frequency[~predicted][spectrum[~predicted].argmax()]:.0f} Hz (at most {LIMIT_DB:g})")
    if not (heard >= 4 and worst <= LIMIT_DB):
        sys.exit("aliases are too loud")


if __name__ == "__main__":
    main()
