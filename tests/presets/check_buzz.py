#!/usr/bin/env python3
"""Sitar, tanpura and biwa buzz as published: each is compared with the same string touching nothing.

- tanpura: a band of overtones that the contact feeds and that decreases in frequency as the string decays (van Walstijn and
  Chatziioannou, ISMA 2014, Le Mans: "a band of overtones which decrease in frequency as the string vibrations decay").
- sitar: high harmonics are fed from low ones and revive with time (Chauhan, Singru, Vathsan, J. Vibroeng. 2021, of the curved
  bridge of the veena: "energy redistribution among the higher harmonics, as well as revival of higher harmonics with time").
- biwa: the sawari makes the 6th to 20th partials stronger and longer (Taguti and Tohnai, Acoust. Sci. Tech. 22 (2001)).
- basses and guitars: a hard pluck strikes the frets, a soft one does not.

usage: check_buzz.py PROGRAM [--table FILE]
"""
import argparse
import sys
import tempfile

import numpy as np

import estimate
import play
import preset_model as model

HOLD_S = 4.0
# preset: (key, velocity)
GRAZING = {"sitar": (54, 110), "tanpura": (48, 110), "biwa": (55, 110)}
LATE_S = (1.0, 2.0)


def one_note(program, preset, key, velocity, folder, name):
    score = play.score()
    score.note(0, key, play.beats(HOLD_S), velocity)
    return play.render(program, preset, score, folder, name, tail_s=0.1)


def passage(sound, begin_s, end_s):
    return sound.mono[int(begin_s * play.RATE_HZ):int(end_s * play.RATE_HZ)]


def high_share_db(sound, low_hz, begin_s, end_s):
    """Energy above low_hz relative to all of it."""
    x = passage(sound, begin_s, end_s)
    return estimate.spectrum_level_db(x, low_hz, 16000, play.RATE_HZ) - estimate.spectrum_level_db(x, 20, 16000, play.RATE_HZ)


def band_centroid_hz(sound, first_hz, begin_s, end_s):
    """Of what lies above the sixth partial: where the band of fed overtones is."""
    x = passage(sound, begin_s, end_s)
    spectrum = np.abs(np.fft.rfft(x * np.hanning(len(x)))) ** 2
    frequency = np.fft.rfftfreq(len(x), 1 / play.RATE_HZ)
    band = (frequency > 6.5 * first_hz) & (frequency < 12000)
    return float((spectrum[band] * frequency[band]).sum() / spectrum[band].sum())


def partial_levels_db(sound, first_hz, partials, begin_s, end_s):
    x = passage(sound, begin_s, end_s)
    window = estimate.blackman_harris(len(x))
    spectrum = np.abs(np.fft.rfft(x * window)) / window.sum() * 2
    bin_hz = play.RATE_HZ / len(x)
    levels = []
    for k in partials:
        centre = int(round(k * first_hz / bin_hz))
        reach = max(4, int(0.3 * first_hz / bin_hz))
        levels.append(20 * np.log10(spectrum[centre - reach:centre + reach].max() + 1e-12))
    return np.array(levels)


def graze(program, name, folder):
    key, velocity = GRAZING[name]
    preset = model.load(name)
    model.strip_provenance(preset)
    with_contact = one_note(program, preset, key, velocity, folder, name)
    without = one_note(program, model.without_contacts(preset), key, velocity, folder, name + "-free")
    first_hz = model.strings_of_key(preset, key)[0][0][1].first_hz
    return with_contact, without, first_hz


def check(program, problems):
    rows = []

    def require(condition, text):
        rows.append(text)
        print(("ok   " if condition else "FAIL ") + text)
        if not condition:
            problems.append(text)

    with tempfile.TemporaryDirectory() as folder:
        for name in GRAZING:
            buzz, free, first_hz = graze(program, name, folder)
            require(buzz.stats["impulses"] > 1000 and free.stats["impulses"] == 0, f"{name}: {buzz.stats['impulses']} impulses, none without contacts")
            late = high_share_db(buzz, 10.5 * first_hz, *LATE_S) - high_share_db(free, 10.5 * first_hz, *LATE_S)
            require(late > 10, f"{name}: share of partials above the 10th in the second second: {late:+.1f} dB against the free string (above 10)")
            if name == "tanpura":
                early = band_centroid_hz(buzz, first_hz, 0.2, 0.7)
                later = band_centroid_hz(buzz, first_hz, 2.5, 3.5)
                require(later < 0.9 * early, f"tanpura: the fed band sinks from {early:.0f} to {later:.0f} Hz (by more than a tenth)")
            if name == "sitar":
                times = np.arange(0.1, 3.0, 0.1)
                bands = np.array([partial_levels_db(buzz, first_hz, range(8, 25), t, t + 0.1) for t in times])
                revival = max((bands[i + 1:, p] - np.minimum.accumulate(bands[:, p])[i]).max() for p in range(bands.shape[1])
                              for i in range(len(times) - 1))
                require(revival > 6, f"sitar: a partial between the 8th and the 24th revives by {revival:.1f} dB (above 6)")
            if name == "biwa":
                gain = partial_levels_db(buzz, first_hz, range(6, 21), 0.1, 0.4) - partial_levels_db(free, first_hz, range(6, 21), 0.1, 0.4)
                longer = partial_levels_db(buzz, first_hz, range(6, 21), 0.7, 1.0) - partial_levels_db(free, first_hz, range(6, 21), 0.7, 1.0)
                require(np.mean(gain > 0) > 0.7, f"biwa: {np.sum(gain > 0)} of 15 partials from the 6th to the 20th are stronger with the sawari (over 10)")
                require(np.mean(longer) > np.mean(gain), f"biwa: they last longer: {np.mean(gain):+.1f} dB at 0.25 s, {np.mean(longer):+.1f} dB at 0.85 s")
        for name, key in (("bass-fretted", 28), ("bass-slap", 28), ("bass-fretless", 33), ("guitar-steel", 45), ("guitar-electric", 45), ("prepared", 48)):
            preset = model.load(name)
            hard = one_note(program, name, key, 127, folder, name).stats["impulses"]
            soft = one_note(program, name, key, 20, folder, name).stats["impulses"]
            quiet = soft == 0 or name == "bass-slap" and 20 * soft < hard  # even a soft thumb lays the string on the last fret
            require(hard > 50 and quiet, f"{preset['name']}: {hard} impulses at velocity 127, {soft} at 20")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--table")
    arguments = parser.parse_args()
    problems = []
    rows = check(arguments.program, problems)
    if arguments.table:
        with open(arguments.table, "w") as file:
            file.write("\n".join(f"- {row}" for row in rows) + "\n")
    if problems:
        sys.exit(f"{len(problems)} of {len(rows)} checks failed")


if __name__ == "__main__":
    main()
