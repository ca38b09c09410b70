#!/usr/bin/env python3
"""Runs the work-precision diagrams: every method on every scene at rising rates, error against CPU time.

    benchmarks/work_precision/run.py [--build build/release] [--scene bass] [--jobs 2] [--out work_precision.csv]

One CSV row per run and restitution. `cost` is CPU seconds per second of sound over the first 0.1 s, `error` the relative L2
error over the scene's positions against benchmarks/reference, `spectrum_dB` the distance of the onset's spectrum.
Rivals stop at the rate whose run would take longer than --limit CPU seconds.
"""
import argparse
import concurrent.futures
import csv
import itertools
import math
import os
import sys

import methods

FIELDS = ["scene", "method", "law", "start", "restitution", "parameter", "rate_hz", "unknowns", "cost", "compile_s", "error",
          "spectrum_dB", "error_to_own_finest", "error_first_position"]
SOUND_S = 0.1
GIVE_UP_CPU_S = 5  # of a rival's run of 0.1 s: fifty times slower than real time
STARTS = ("exact", "backward")
FINITE_DIFFERENCES = ("ieq", "sav")
# Each rival's stiffness is swept and its best run counts.
STIFFNESS = {"penalty": (1.0, 10.0, 100.0, 1000.0), "ieq-modal": (0.3, 1.0, 10.0, 30.0), "ieq": (1.0, 10.0, 100.0),
             "sav": (0.03, 0.1, 0.3, 1.0)}
# Where a coarse error is good enough, fewer modes are: for ours and for the rivals that have modes. Their contact rates rise
# in smaller steps, up to where the missing modes decide.
FEWER_MODES = (25, 50, 100, 200, 400, 600)
FEWER_MODES_OF_RIVALS = (50, 200)
FEWER_MODES_RATES_HZ = [methods.OUTPUT_RATE_HZ * n for n in (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 35, 40)]
FEWER_MODES_LIMIT_S = 0.1


def series(scene):
    """Every series of runs: (method, law, start, restitution or None if it does not matter, parameter, options)."""
    for start in STARTS:
        yield "exact", "signorini", start, None, "", {"law": "signorini", "start": start}
    for law, start, e in itertools.product(("newton", "passive", "paoli-schatzman"), STARTS, methods.RESTITUTIONS):
        yield "exact", law, start, e, "", {"law": law, "start": start, "restitution": e}
    yield "uniform", "signorini", "exact", None, "", {"method": "uniform", "law": "signorini"}
    for e in methods.RESTITUTIONS:
        # Siconos' scheme step by step; its backward start lends the error to Siconos' row.
        yield "uniform", "newton", "backward", e, "", {"method": "uniform", "law": "newton", "start": "backward",
                                                       "restitution": e}
        for theta in (0.5, 1.0):
            yield "theta", "newton", "exact", e, f"theta={theta}", {"method": "theta", "theta": theta, "restitution": e}
        for stiffness in STIFFNESS["penalty"]:
            yield "penalty", "hunt-crossley", "exact", e, f"K={stiffness:g}", {
                "method": "penalty", "stiffness": stiffness, "restitution": e}
        yield "penalty", "hunt-crossley", "exact", e, "K=10 alpha=1.5", {
            "method": "penalty", "stiffness": 10.0, "exponent": 1.5, "restitution": e}
    for method in ("ieq-modal", "ieq", "sav"):
        for stiffness in STIFFNESS[method]:
            yield method, "power law", "exact", None, f"K={stiffness:g}", {"method": method, "stiffness": stiffness}


def series_of_fewer_modes():
    """The same with fewer modes."""
    for modes in FEWER_MODES:
        yield "exact", "signorini", "backward", None, f"N={modes}", {"law": "signorini", "start": "backward", "modes": modes}
    for modes in FEWER_MODES_OF_RIVALS:
        count = f"N={modes}"
        yield "uniform", "signorini", "exact", None, count, {"method": "uniform", "law": "signorini", "modes": modes}
        for stiffness in (1.0, 10.0):
            yield "ieq-modal", "power law", "exact", None, f"K={stiffness:g} {count}", {
                "method": "ieq-modal", "stiffness": stiffness, "modes": modes}
        for e in methods.RESTITUTIONS:
            yield "theta", "newton", "exact", e, f"theta=0.5 {count}", {
                "method": "theta", "theta": 0.5, "restitution": e, "modes": modes}
            yield "penalty", "hunt-crossley", "exact", e, f"K=10 {count}", {
                "method": "penalty", "stiffness": 10.0, "restitution": e, "modes": modes}


def rates_and_limit(entry, options):
    """The contact rates of a series, and the CPU seconds of a run after which it ends."""
    method, _, start, _, _, arguments = entry
    if "modes" in arguments:
        return FEWER_MODES_RATES_HZ, FEWER_MODES_LIMIT_S
    if method == "exact":  # with the exact start all the way
        return methods.RATES_HZ, math.inf if start == "exact" else options.backward_limit
    return methods.RATES_HZ, options.limit


def run_series(scene, entry, options):
    method, law, start, restitution, parameter, arguments = entry
    rows, trajectories = [], []
    last_s = 0
    rates, limit_s = rates_and_limit(entry, options)
    for rate in rates:
        if 2 * last_s > limit_s:
            break
        try:
            stats, samples = methods.simulate(options.build, scene, repeat=options.repeat, enough_s=0.3, contact_rate=rate,
                                              cpu_limit_s=None if method == "exact" else GIVE_UP_CPU_S, **arguments)
        except methods.GivenUp:
            break
        except RuntimeError as error:
            print(f"{scene} {method} {parameter} at {rate} Hz: {error}", file=sys.stderr)
            continue
        last_s = stats["render_s"]
        trajectories.append(samples)
        for e in methods.RESTITUTIONS if restitution is None else (restitution,):
            reference = methods.load_reference(scene, e)
            rows.append({"scene": scene, "method": method, "law": law, "start": start, "restitution": e,
                         "parameter": parameter, "rate_hz": rate, "unknowns": stats["unknowns"],
                         "cost": stats["render_s"] / SOUND_S, "compile_s": stats["compile_s"],
                         "error": methods.relative_error(samples, reference),
                         "spectrum_dB": methods.spectrum_distance_db(samples, reference),
                         "error_first_position": methods.error_at(samples, reference, 0)})
    by_rate = {row["rate_hz"]: row for row in rows}
    for rate, samples in zip(by_rate, trajectories):
        for row in rows:
            if row["rate_hz"] == rate:
                row["error_to_own_finest"] = methods.relative_error(samples, trajectories[-1])
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=methods.ROOT / "build/release")
    parser.add_argument("--scene", choices=methods.SCENES, action="append")
    parser.add_argument("--method", action="append", help="only these")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--repeat", type=int, default=3, help="runs at most, of which the least CPU time counts")
    parser.add_argument("--limit", type=float, default=1.5, help="CPU seconds of a rival's longest run")
    parser.add_argument("--backward-limit", type=float, default=0.8, help="the same of our longest run with the backward start")
    parser.add_argument("--out", default="-")
    options = parser.parse_args()
    work = [(scene, entry) for scene in options.scene or methods.SCENES for entry in itertools.chain(series(scene), series_of_fewer_modes())
            if (not options.method or entry[0] in options.method)
            and not (entry[0] in FINITE_DIFFERENCES and scene in methods.TABLES)]
    out = sys.stdout if options.out == "-" else open(options.out, "w", newline="", encoding="utf-8")
    writer = csv.DictWriter(out, FIELDS, lineterminator="\n")
    writer.writeheader()
    pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
    done = [pool.submit(run_series, scene, entry, options) for scene, entry in work]
    try:
        for number, future in enumerate(done, 1):
            for row in future.result():
                writer.writerow({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()})
            out.flush()
            if sys.stderr.isatty():
                print(f"\rwork-precision: {number} of {len(done)} series", end="", file=sys.stderr, flush=True)
    except KeyboardInterrupt:
        pool.shutdown(cancel_futures=True)
        sys.exit(130)
    finally:
        if sys.stderr.isatty():
            print(file=sys.stderr)


if __name__ == "__main__":
    main()
