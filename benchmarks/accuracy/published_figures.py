#!/usr/bin/python3
"""The published convergence of the bass over its frets, beside this engine's on the same tables.

    published_figures.py --jawari build/release/bin/jawari [--finest 256901120]     prints Markdown tables
    published_figures.py --jawari ... --check                                       AGREE or DISAGREE, up to 502 kHz

Published: siconos-tutorials, examples/mechanics/Music/convergence_study.ipynb (F. Perignon, V. Acary, C. Issanchou; Apache-2.0),
figures "Convergence, x=0.501" and "x=0.854", the campaign bass_2018 of Issanchou et al., JASA 143 (2018). The notebook gives no
numbers: benchmarks/reference/published_bass.csv has them as read from the positions of the figures' markers, to 2 %. Both sides:
862 modes, 20 frets, 0.4 s, Newton's law, relative L2 error of the displacement at 15 680 rows per second against the run at
257 MHz.
"""

import argparse
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
OUTPUT_RATE_HZ = 15680
DURATION_S = 0.4
HIGHEST_CHECKED_HZ = 501760
SKIPPED = 77


def published():
    """{(position, restitution): {rate: error}}"""
    table = {}
    with open(os.path.join(ROOT, "benchmarks/reference/published_bass.csv")) as file:
        for row in csv.DictReader(file):
            case = table.setdefault((float(row["position_m"]), float(row["restitution"])), {})
            case[int(row["contact_rate_hz"])] = float(row["error"])
    return table


def published_scene(path, positions):
    with open(path) as file:
        scene = json.load(file)
    string = scene["strings"][0]
    if "frequency_hz" not in string["modes"] or len(string["modes"]["frequency_hz"]) != 862:
        print(f"{path} has no table of the published 862 modes")
        sys.exit(SKIPPED)
    string["probes"] = [{"quantity": "displacement", "position_m": x} for x in positions]
    scene.update(duration_s=DURATION_S, output_rate_hz=OUTPUT_RATE_HZ, law="newton")
    return scene


def displacements(jawari, scene, rate, restitution):
    """Rows of a run, one column for each probe."""
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, "scene.json"), os.path.join(folder, "out.csv")
        with open(path, "w") as file:
            json.dump(dict(scene, contact_rate_hz=rate), file)
        command = [jawari, "simulate", path, "--restitution", str(restitution), "--start", "backward", "--out", out]
        # Rates that are far too low are the point here: no warnings.
        subprocess.run(command, check=True, capture_output=True)
        with open(out) as file:
            return [[float(cell) for cell in row[1:]] for row in list(csv.reader(file))[1:]]


def relative_error(rows, finest, probe):
    difference = sum((a[probe] - b[probe]) ** 2 for a, b in zip(rows, finest))
    return math.sqrt(difference / sum(b[probe] ** 2 for b in finest))


def ours(jawari, scene, positions, rates, restitution, finest_rate):
    finest = displacements(jawari, scene, finest_rate, restitution)
    runs = {rate: displacements(jawari, scene, rate, restitution) for rate in rates if rate < finest_rate}
    return {(x, restitution): {rate: relative_error(rows, finest, probe) for rate, rows in runs.items()}
            for probe, x in enumerate(positions)}


def percent(error):
    return f"{100 * error:.0f} %" if error >= 0.0995 else f"{100 * error:.2g} %"


def in_hertz(rate):
    return f"{rate / 1e6:.4g} MHz" if rate >= 1e6 else f"{rate / 1e3:.4g} kHz"


def print_table(theirs, own, position):
    cases = sorted(case for case in theirs if case[0] == position)
    print(f"x = {position:g} m:\n")
    print("| contact rate | " + " | ".join(f"e = {e:g}, published | ours" for _, e in cases) + " |")
    print("|---" * (1 + 2 * len(cases)) + "|")
    for rate in sorted(own[cases[0]]):
        cells = [f"{percent(theirs[case][rate])} | {percent(own[case][rate])}" for case in cases]
        print(f"| {in_hertz(rate)} | " + " | ".join(cells) + " |")


def verdict(theirs, own):
    """Errors that are far from one another for e = 0.9 and 1; e = 0 follows another path where steps are coarse."""
    bad = []
    for (x, e), errors in own.items():
        factor = 1.4 if e > 0 else 2.5
        for rate, error in errors.items():
            ratio = error / theirs[x, e][rate]
            if not 1 / factor < ratio < factor:
                bad.append(f"x = {x:g}, e = {e:g}, {rate} Hz: {error:.3g} for {theirs[x, e][rate]:.3g}")
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jawari", required=True, help="the program")
    parser.add_argument("--scene", default=os.path.join(ROOT, "presets/scenes/lab/bass.json"), help="with the published tables")
    parser.add_argument("--finest", type=int, default=256901120, help="contact rate of the reference; default: as published")
    parser.add_argument("--check", action="store_true", help="only the verdict, against a reference at 16 MHz")
    options = parser.parse_args()
    theirs = published()
    positions = sorted({x for x, _ in theirs})
    scene = published_scene(options.scene, positions)
    finest = 16056320 if options.check else options.finest
    rates = [rate for rate in theirs[positions[0], 0.0] if not options.check or rate <= HIGHEST_CHECKED_HZ]
    own = {}
    for restitution in sorted({e for _, e in theirs}):
        own.update(ours(options.jawari, scene, positions, rates, restitution, finest))
    if not options.check:
        for position in positions:
            print_table(theirs, own, position)
            print()
        return 0
    bad = verdict(theirs, own)
    print("DISAGREE " + "; ".join(bad) if bad else "AGREE")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
