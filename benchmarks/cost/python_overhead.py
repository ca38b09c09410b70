#!/usr/bin/env python3
"""What a run costs from Python beyond the work of the engine, and beside a run of the program.

Usage: PYTHONPATH=build/release/python benchmarks/cost/python_overhead.py build/release/bin/jawari

The overhead is the CPU time of jawari.simulate() less that of compile() and render() within it: reading, arrays, statistics. With contacts
recorded at each row, looking at them is work that the program does for HDF5 as well: there the whole CPU time stands beside that of the
program's process. All are medians over runs that take turns, so that a busy machine slows all.
"""

import os
import resource
import statistics
import subprocess
import tempfile
import sys
import time

import jawari

PROGRAM = sys.argv[1]
RUNS = 30


def scene(contacts):
    """A string that takes next to no time, so that what surrounds it shows."""
    string = {
        "length_m": 0.65, "linear_density_kg_per_m": 0.001, "modes": {"count": 40, "tension_N": 70},
        "initial": {"pluck": {"position_m": 0.1, "height_m": 0.002}},
        "contacts": [{"position_m": 0.3 + 0.01 * c, "height_m": -0.001} for c in range(contacts)],
        "probes": [{"quantity": "displacement", "position_m": 0.2}],
    }  # fmt: skip
    return jawari.Scene({"schema": "jawari.scene/1", "duration_s": 0.02, "strings": [string]})


def children_s():
    """CPU time of the processes that were waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    folder = tempfile.mkdtemp()
    file = os.path.join(folder, "overhead.json")
    over, python, program, recorded, hdf5 = [], [], [], [], []
    small = scene(4)
    small.save(file)
    for _ in range(RUNS):
        begun, cpu = time.perf_counter(), time.thread_time()
        result = jawari.simulate(small, contacts=False)  # as the program does for CSV
        cpu = time.thread_time() - cpu
        python.append(time.perf_counter() - begun)
        over.append(cpu - result.stats["cpu_compile_s"] - result.stats["cpu_render_s"])
        begun = time.perf_counter()
        subprocess.run([PROGRAM, "simulate", file, "--out", "-"], stdout=subprocess.DEVNULL, check=True)
        program.append(time.perf_counter() - begun)
        cpu = time.thread_time()
        jawari.simulate(small)
        recorded.append(time.thread_time() - cpu)
        before = children_s()
        subprocess.run([PROGRAM, "simulate", file, "--out", os.path.join(folder, "overhead.h5")], check=True)
        hdf5.append(children_s() - before)
    milliseconds = 1e3 * statistics.median(over)
    print(f"overhead of jawari.simulate: {milliseconds:.3f} ms a run (CPU, median of {RUNS})")
    print(f"wall time of a run: {1e3 * statistics.median(python):.2f} ms from Python, "
          f"{1e3 * statistics.median(program):.2f} ms of the program")  # fmt: skip
    print(f"with contacts recorded: {1e3 * statistics.median(recorded):.2f} ms of CPU from Python, "
          f"{1e3 * statistics.median(hdf5):.2f} ms of the program that writes HDF5")  # fmt: skip


if __name__ == "__main__":
    main()
