#!/usr/bin/env python3
"""What a contact step costs with 1 to 4096 contacts, touching and not.

    benchmarks/speed/contact_cost.py PROGRAM...      such as build/release/bin/jawari, and the same of another version

Touching: a string at rest on a parabolic obstacle of so many points, all of which carry it. Open: the same obstacle far below
a string that vibrates; with skipping, and with --no-skip all, where each step evaluates every contact. The cost of a step is
the difference of the processor time of two runs of the program that differ in their length; programs take turns, and the
least of the repetitions counts. A run whose solves were truncated is marked. Compiling: processor time of the longer run.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile

RATE = 96000
OUTPUT = 24000
MODES = 256  # or as many as contacts, if those are more
HIGHEST_HZ = RATE / 4  # frequency of the last mode
CASES = {1: 400000, 16: 100000, 52: 20000, 128: 2000, 1024: 100, 4096: 8}  # contacts: steps
OPEN_STEPS = 4  # times as many where nothing touches
REPEATS = 2


def scene(contacts, touching, steps):
    modes = max(MODES, contacts)
    string = {
        "length_m": 1, "linear_density_kg_per_m": 0.001,
        "modes": {"count": modes, "tension_N": 0.001 * (2 * HIGHEST_HZ / modes) ** 2},
        "probes": [{"quantity": "displacement", "position_m": 0.3}],
    }
    rise = 0.01 if touching else -1.0
    height = lambda x: rise if not touching else rise * (0.1 + 4 * x * (1 - x))
    nodes = [(c + 1) / (contacts + 1) for c in range(contacts)]
    string["contacts"] = [{"position_m": x, "height_m": height(x), "restitution": 0} for x in nodes]
    if not touching:
        string["initial"] = {"pluck": {"position_m": 0.3, "height_m": 0.001}}
    return {"schema": "jawari.scene/1", "duration_s": steps / RATE, "output_rate_hz": OUTPUT, "contact_rate_hz": RATE,
            "law": "signorini", "strings": [string]}


def run(program, path, options):
    """Processor seconds and statistics of one run."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    result = subprocess.run([program, "simulate", path, "--stats", "-", *options], capture_output=True, text=True, check=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, json.loads(result.stdout)


def cost(program, folder, contacts, touching, options):
    """Microseconds a step, the number of truncated solves, and processor seconds of compiling."""
    times = []
    steps = CASES[contacts] * (1 if touching else OPEN_STEPS)
    for length in (4, 4 + steps):
        path = os.path.join(folder, "scene.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene(contacts, touching, length), file)
        times.append(run(program, path, options))
    (short, _), (long, stats) = times
    return max(0.0, long - short) * 1e6 / steps, stats["truncated_solves"], stats["cpu_compile_s"]


def main():
    programs = sys.argv[1:]
    if not programs:
        sys.exit("contact_cost.py: name a program, such as build/release/bin/jawari")
    rows = [("touching", True, []), ("open", False, []), ("open, nothing skipped", False, ["--no-skip", "all"])]
    print("| contacts | string |" + "".join(f" {program} [us a step] | compile [s] |" for program in programs))
    print("|---|---|" + "---|---|" * len(programs))
    with tempfile.TemporaryDirectory() as folder:
        for contacts in CASES:
            for name, touching, options in rows:
                best = {program: (float("inf"), 0, 0.0) for program in programs}
                for _ in range(REPEATS if contacts < 1000 else 1):
                    for program in programs:
                        best[program] = min(best[program], cost(program, folder, contacts, touching, options))
                cells = "".join(f" {us:.3g}{' (truncated)' if lost else ''} | {compile_s:.2g} |" for us, lost, compile_s in best.values())
                print(f"| {contacts} | {name} |{cells}", flush=True)


if __name__ == "__main__":
    main()
