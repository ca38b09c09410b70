#!/usr/bin/env python3
"""Time from starting the program to its first sound on disk: wall seconds of whole processes, Markdown to standard output.

    benchmarks/cost/first_sound.py [--build build/release]

`evicted`: the program's pages are dropped from the page cache before each run (posix_fadvise); libraries stay.
"""
import argparse
import os
import pathlib
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
RUNS = 9
# Format 0, 1000 ticks per second, one note of 10 ms.
NOTE = (b"MThd\x00\x00\x00\x06\x00\x00\x00\x01\x01\xf4" + b"MTrk\x00\x00\x00\x0c" +
        b"\x00\x90\x1c\x7f\x0a\x80\x1c\x00" + b"\x00\xff\x2f\x00")


def evict(path):
    handle = os.open(path, os.O_RDONLY)
    os.posix_fadvise(handle, 0, 0, os.POSIX_FADV_DONTNEED)
    os.close(handle)


def least_s(command, program, cold):
    times = []
    for _ in range(RUNS):
        if cold:
            evict(program)
        start = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        times.append(time.perf_counter() - start)
    return min(times), sorted(times)[RUNS // 2]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    options = parser.parse_args()
    program = options.build / "bin/jawari"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "note.mid").write_bytes(NOTE)
        render = [program, "render", folder / "note.mid", "--preset", "bass-fretted", "-o", folder / "note.wav", "--tail", "0"]
        simulate = [program, "simulate", "lab/bass", "--duration", "0.001", "--out", folder / "out.csv"]
        print("| from start to end of the process | cached, least (ms) | cached, median (ms) | evicted, median (ms) |\n|---|---|---|---|")
        for label, command in (("`jawari --version`", [program, "--version"]),
                               ("`jawari simulate lab/bass`, 1 ms of sound", simulate),
                               ("`jawari render`, preset `bass-fretted`, a note of 10 ms", render)):
            least, median = least_s(command, program, False)
            _, cold = least_s(command, program, True)
            print(f"| {label} | {1e3 * least:.0f} | {1e3 * median:.0f} | {1e3 * cold:.0f} |")


if __name__ == "__main__":
    main()
