#!/usr/bin/python3
"""CPU time of a step of Siconos 4.4 (python3-siconos, MoreauJeanBilbaoOSI and Lemke's algorithm) on the full lab/bass.

    benchmarks/rivals/siconos_cost.py [--out siconos.csv]

The first 160 steps at 15 680 Hz are run (10 ms of the string, in which it strikes) and the cost of a second of sound is
extrapolated: CPU seconds per step times the contact rate. At higher rates fewer of the steps have contacts, and those without
are cheap: for them it is an upper estimate. Siconos' trajectory is that of uniform stepping with Newton's law
(tests/peers/compare.py: equal to 2e-12), so its error is not run again.
"""
import argparse
import csv
import os
import pathlib
import sys
import time

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[variable] = "1"

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/peers"))
import jawari_scene  # noqa: E402
import siconos_oracle  # noqa: E402

RATE_HZ, STEPS = 15680, 160


def cpu_s(string, rate, steps):
    start = time.process_time()
    siconos_oracle.simulate(string, 1 / rate, steps)
    return time.process_time() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default="-")
    options = parser.parse_args()
    scene = jawari_scene.read_scene(ROOT / "presets/scenes/lab/bass.json")
    string = jawari_scene.read_string(scene["strings"][0], 0.9)
    with open(1 if options.out == "-" else options.out, "w", newline="", encoding="utf-8") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["scene", "restitution", "rate_hz", "steps", "cpu_s_per_step", "cost"])
        per_step = cpu_s(string, RATE_HZ, STEPS) / STEPS
        for rate in (RATE_HZ, 48000, 125440, 1003520):
            writer.writerow(["bass", 0.9, rate, STEPS, f"{per_step:.4g}", f"{per_step * rate:.4g}"])


if __name__ == "__main__":
    main()
