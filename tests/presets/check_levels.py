#!/usr/bin/env python3
"""Levels of the presets: a chord at velocity 127 peaks between -12 and -1 dBFS, nothing clips, no DC, both sides alike.

usage: check_levels.py PROGRAM [--preset NAME]...
"""
import argparse
import concurrent.futures
import pathlib
import sys
import tempfile

import numpy as np

import play
import preset_model as model

# One note per string where the strings allow it: the loudest chord that a player would play.
CHORDS = {
    "bass-fretted": [28, 35, 40, 44], "bass-fretless": [28, 35, 40, 44], "bass-slap": [28, 35, 40, 44],
    "guitar-steel": [40, 47, 52, 56, 59, 64], "guitar-nylon": [40, 47, 52, 56, 59, 64], "guitar-electric": [40, 47, 52, 56, 59, 64],
    "guitar-12": [40, 47, 52, 56, 59, 64], "sitar": [37, 44, 49, 54, 56, 61, 73], "tanpura": [36, 43, 48, 48],
    "biwa": [43, 43, 48, 55], "harpsichord": [36, 43, 48, 52, 55, 60, 64, 67], "clavichord": [36, 48, 55, 60, 64, 67],
    "dulcimer": [50, 57, 62, 66, 69, 74], "prepared": [48, 52, 55, 60, 64, 67, 72],
}
LOWEST_DB, HIGHEST_DB = -12.0, -1.0
DC_LIMIT_DB = -80.0
BALANCE_LIMIT_DB = 3.0


def decibels(x):
    return 20 * np.log10(max(abs(x), 1e-12))


def measure(program, name):
    preset = model.load(name)
    model.strip_provenance(preset)
    score = play.score()
    for key in CHORDS[name]:
        score.note(0, key, play.beats(2.0), 127)
    with tempfile.TemporaryDirectory() as folder:
        sound = play.render(program, preset, score, folder, name, tail_s=4.0)
    stereo = sound.stereo if sound.stereo.shape[1] == 2 else np.repeat(sound.stereo, 2, axis=1)
    rms = np.sqrt(np.mean(stereo ** 2, axis=0))
    return {"name": name, "gain": preset["gain"], "peak_db": decibels(np.abs(stereo).max()), "dc_db": decibels(np.abs(stereo.mean(axis=0)).max()),
            "balance_db": decibels(rms[0]) - decibels(rms[1]), "stats": sound.stats}


def problems_of(row):
    if not LOWEST_DB <= row["peak_db"] <= HIGHEST_DB:
        yield f"{row['name']}: peak {row['peak_db']:.1f} dBFS, allowed {LOWEST_DB} to {HIGHEST_DB}"
    if not row["dc_db"] < DC_LIMIT_DB:
        yield f"{row['name']}: DC {row['dc_db']:.1f} dBFS, allowed below {DC_LIMIT_DB}"
    if not abs(row["balance_db"]) < BALANCE_LIMIT_DB:
        yield f"{row['name']}: left {row['balance_db']:+.1f} dB over right, allowed {BALANCE_LIMIT_DB} dB"
    if row["stats"]["clipped_samples"] or row["stats"]["nonfinite_resets"] or row["stats"]["ignored_notes"]:
        yield f"{row['name']}: clipped {row['stats']['clipped_samples']}, resets {row['stats']['nonfinite_resets']}, ignored " \
              f"{row['stats']['ignored_notes']}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--preset", action="append", choices=model.NAMES)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", help="also write the figures as a Markdown table")
    arguments = parser.parse_args()
    problems = []
    table = ["| preset | peak (dBFS) | DC (dBFS) | left over right (dB) | impulses |", "|---|---|---|---|---|"]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for row in pool.map(lambda n: measure(arguments.program, n), arguments.preset or model.NAMES):
            stats = row["stats"]
            print(f"{row['name']:16s} peak {row['peak_db']:6.1f} dBFS  DC {row['dc_db']:6.1f} dBFS  left-right {row['balance_db']:+5.2f} dB  "
                  f"{stats['impulses']} impulses, {stats['real_time_factor']:.1f} times real time, compile {stats['cpu_compile_s']:.2f} s")
            table.append(f"| {row['name']} | {row['peak_db']:.1f} | {row['dc_db']:.0f} | {row['balance_db']:+.1f} | {stats['impulses']} |")
            problems += list(problems_of(row))
    if arguments.table:
        pathlib.Path(arguments.table).write_text("\n".join(table) + "\n")
    for problem in problems:
        print(problem, file=sys.stderr)
    if problems:
        sys.exit(f"{len(problems)} levels are out of bounds")


if __name__ == "__main__":
    main()
