#!/usr/bin/env python3
"""Cost of one string in other people's instruments (Csound, STK, Faust, from Debian's packages) beside this engine's.

    benchmarks/peers/run.py [--build build/release] [--out peers.csv]

CPU seconds per second of sound of one voice at 48 kHz on one core, the least of several runs. What each computes is a column
of its own: none of them but Csound's prepiano knows contact. A peer that is not installed is left out with a note on stderr.
"""
import argparse
import csv
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SECONDS = 20
WAVEGUIDE = "digital waveguide: delay line and filters"
STK = {"Plucked": f"{WAVEGUIDE} (Karplus-Strong)", "StifKarp": f"{WAVEGUIDE}, stiffness by allpasses",
       "Guitar": f"{WAVEGUIDE}, one string", "Sitar": f"{WAVEGUIDE} with a detuned, noisy loop"}
FAUST = {"elecGuitar": "pm.elecGuitar(1.5, 0.2, 1, 0.8, button(\"gate\"))", "guitar": "pm.guitar(1.5, 0.2, 0.8, button(\"gate\"))"}
CSOUND = {"pluck": (WAVEGUIDE + " (Karplus-Strong)", "none"), "wgpluck2": (WAVEGUIDE, "none"),
          "prepiano_bare": ("finite differences, one stiff string, hammer", "hammer"),
          "prepiano": ("finite differences, three stiff strings, hammer", "hammer, one rattle, one rubber (springs)")}


def run(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True, **options).stdout


def csound_rows():
    def cpu_s(name, seconds):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run("csound", f"--omacro:NAME={name}", f"--smacro:NAME={name}", f"--smacro:SECONDS={seconds}", HERE / "csound_strings.csd",
            stdin=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    for name, (what, contact) in CSOUND.items():
        start = min(cpu_s(name, 1) for _ in range(3))
        cost = (min(cpu_s(name, 1 + SECONDS) for _ in range(3)) - start) / SECONDS
        yield {"peer": f"Csound 6.18 `{name}`", "computes": what, "contact": contact, "precision": "double", "cost": cost}


def stk_rows(folder):
    run("g++", "-O3", "-march=native", HERE / "stk_strings.cpp", "-lstk", "-o", folder / "stk")
    for name, what in STK.items():
        cost = float(run(folder / "stk", name, SECONDS).split()[0])
        yield {"peer": f"STK 4.6.2 `{name}`", "computes": what, "contact": "none", "precision": "double", "cost": cost}


def faust_rows(folder):
    for name, expression in FAUST.items():
        (folder / "string.dsp").write_text(f'import("stdfaust.lib");\nprocess = {expression};\n')
        run("faust", "-lang", "cpp", folder / "string.dsp", "-o", folder / "string.h")
        run("g++", "-O3", "-march=native", f'-DFAUST_CLASS="{folder}/string.h"', HERE / "faust_string.cpp", "-o", folder / "faust")
        cost = float(run(folder / "faust", SECONDS).split()[0])
        yield {"peer": f"Faust 2.54 `pm.{name}`", "computes": f"{WAVEGUIDE}, bidirectional", "contact": "none",
               "precision": "float", "cost": cost}


def own_rows(build):
    guitar = json.loads((ROOT / "benchmarks/work_precision/scenes/guitar.json").read_text())
    guitar["strings"] = [string for string in guitar["strings"] if string["name"] == "a2"]
    guitar["output_rate_hz"] = 48000
    guitar["strings"][0]["probes"] = guitar["strings"][0]["probes"][:1]
    modes = guitar["strings"][0]["modes"]["count"]
    frets = guitar["strings"][0]["frets"]["count"]
    with tempfile.TemporaryDirectory() as name:
        path = pathlib.Path(name) / "string.json"
        path.write_text(json.dumps(guitar))
        for rate, seconds, label in ((48000 * 21, 0.1, "first 0.1 s"), (48000 * 21, SECONDS, f"{SECONDS} s"),
                                     (48000 * 42, 0.1, "first 0.1 s"), (48000 * 42, SECONDS, f"{SECONDS} s")):
            stats = json.loads(run(build / "bin/trajectory", "--scene", path, "--contact-rate", rate, "--duration", seconds,
                                   "--repeat", 5))
            yield {"peer": f"Jawari, guitar string A2, {rate / 1e6:.3f} MHz, {label}",
                   "computes": f"{modes} stiff modes, exact scheme", "contact": f"{frets} frets, rigid (Signorini)",
                   "precision": "double", "cost": stats["render_s"] / seconds}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--out", default="-")
    options = parser.parse_args()
    os.environ["OMP_NUM_THREADS"] = "1"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        sources = [("csound", "csound", csound_rows), ("g++ with libstk-dev", "g++", lambda: stk_rows(folder)),
                   ("faust", "faust", lambda: faust_rows(folder))]
        rows = list(own_rows(options.build))
        for what, program, rows_of in sources:
            if shutil.which(program) is None:
                print(f"peers: {what} is missing (scripts/setup.sh --bench installs it)", file=sys.stderr)
                continue
            try:
                rows += list(rows_of())
            except subprocess.CalledProcessError as error:
                print(f"peers: {what} failed: {error.stderr.strip()[-300:]}", file=sys.stderr)
    with open(1 if options.out == "-" else options.out, "w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, ["peer", "computes", "contact", "precision", "cost"], lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({**row, "cost": f"{row['cost']:.3g}"})


if __name__ == "__main__":
    main()
