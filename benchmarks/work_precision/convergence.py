#!/usr/bin/env python3
"""Errors against closed forms as the contact rate rises, with the observed order.

    benchmarks/work_precision/convergence.py [--build build/release] [--out convergence.csv]

One CSV row per rate. `order` is log2 of the error's fall per doubling of the rate since the row before. The error of a single
impact depends on where in a step it falls: its rows are root mean squares over eight obstacle heights.
"""
import argparse
import csv
import pathlib
import sys
import tempfile

import numpy as np

import closed_forms
import methods

FIELDS = ["case", "method", "restitution", "modes", "rate_hz", "error", "order"]
ENGINE = [("exact, signorini", {"law": "signorini"}), ("exact, newton", {"law": "newton"}),
          ("exact, passive", {"law": "passive"}), ("exact, paoli-schatzman", {"law": "paoli-schatzman"})]
THETA = [("theta 0.5", {"method": "theta", "theta": 0.5}), ("theta 1", {"method": "theta", "theta": 1.0})]


def error_of(build, motions, rate, options):
    """Root mean square of the relative errors of several motions."""
    return float(np.sqrt(np.mean([error_of_one(build, motion, rate, options) ** 2 for motion in motions])))


def error_of_one(build, motion, rate, options):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "scene.json"
        path.write_text(motion.text())
        _, samples = methods.simulate(build, str(path), repeat=1, contact_rate=float(rate), **options)
    truth = motion.samples()
    return float(np.linalg.norm(samples - truth) / np.linalg.norm(truth))


def ladder(build, case, method, options, motions):
    """Rows of one method; `motions`: (rate, closed form or several, restitution)."""
    rows = []
    for rate, motion, restitution in motions:
        several = motion if isinstance(motion, list) else [motion]
        error = error_of(build, several, rate, options)
        order = ""
        if rows and rows[-1]["error"] > 1e-12 and error > 1e-12:  # else rounding
            order = np.log(rows[-1]["error"] / error) / np.log(rate / rows[-1]["rate_hz"])
        rows.append({"case": case, "method": method, "restitution": restitution, "modes": several[0].count, "rate_hz": rate,
                     "error": error, "order": order})
    return rows


def all_ladders(build):
    rates = [16000 * 4**n for n in range(1, 6)]  # 64 kHz to 16.4 MHz
    yield from single_string(build, rates, 8)
    yield from unit_string(build, 1024, 128)


def single_string(build, rates, heights):
    free = closed_forms.FreeString()
    for method, options in [("exact", {})] + THETA:
        yield ladder(build, "free motion", method, options, [(r, free, "") for r in rates])
    for method, options in THETA:
        yield ladder(build, "theta scheme against its own closed form", method, options,
                     [(r, closed_forms.ThetaMode(options["theta"], r), "") for r in rates[:3]])
    for e in (0.5, 1.0):
        impact = [closed_forms.SingleImpact(e, -0.5e-3 - 1e-5 * n) for n in range(heights)]
        for method, options in ENGINE[1:] + THETA:
            yield ladder(build, "single impact", method, options, [(r, impact, e) for r in rates])
    persistent = closed_forms.PersistentContact()
    for method, options in ENGINE + THETA:
        yield ladder(build, "persistent contact", method, options, [(r, persistent, 0.5) for r in rates])


def unit_string(build, most_intervals, most_contacts):
    """Modes and rate rise together: 32 steps per interval of the modes' grid."""
    intervals = [n for n in (64, 128, 256, 512, 1024) if n <= most_intervals]
    for e in (0.0, 1.0):
        for method, options in ENGINE if e else ENGINE[:2]:
            yield ladder(build, "point obstacle (Cabannes)", method, options,
                         [(32 * n, closed_forms.CabannesString(n - 1, restitution=e), e) for n in intervals])
    for e in (0.0, 0.5, 1.0):
        for method, options in ENGINE[:2] if e == 0 else ENGINE[1:]:
            yield ladder(build, "flat obstacle", method, options,
                         [(32 * n, closed_forms.FlatObstacleString(n - 1, e), e) for n in (32, 64, 128) if n <= most_contacts])


def check(build):
    """Failures of what the orders and errors must be, as lines of text."""
    failures = []
    for rows in [*single_string(build, [64000, 1024000], 1), *unit_string(build, 256, 32)]:
        case, method, last = rows[-1]["case"], rows[-1]["method"], rows[-1]
        exact_scheme = method.startswith("exact")
        if case == "free motion" and exact_scheme or case == "flat obstacle" and method != "exact, paoli-schatzman":
            good = last["error"] < 1e-12
        elif case.startswith("theta scheme"):
            good = last["error"] < 1e-11
        elif case == "persistent contact" and method == "exact, paoli-schatzman":
            good = last["error"] < 1e-7 and last["order"] > 1.8
        elif case == "persistent contact" and exact_scheme or case == "free motion" and method == "theta 0.5":
            good = 1.8 < last["order"] < 2.1
        elif case == "point obstacle (Cabannes)":
            good = last["error"] < 0.015 and (method != "exact, signorini" or 0.9 < last["order"] < 1.1)
        elif case == "single impact" and exact_scheme:
            good = last["error"] < 2e-5
        else:
            good = last["error"] < 0.03
        if not good:
            failures.append(str(last))
    return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=methods.ROOT / "build/release")
    parser.add_argument("--out", default="-")
    parser.add_argument("--check", action="store_true", help="a short run that fails if a closed form is missed")
    options = parser.parse_args()
    if options.check:
        failures = check(options.build)
        print("\n".join(failures) if failures else "all closed forms are met")
        sys.exit(1 if failures else 0)
    out = sys.stdout if options.out == "-" else open(options.out, "w", newline="", encoding="utf-8")
    writer = csv.DictWriter(out, FIELDS, lineterminator="\n")
    writer.writeheader()
    for rows in all_ladders(options.build):
        for row in rows:
            writer.writerow({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()})
        out.flush()


if __name__ == "__main__":
    main()
