#!/usr/bin/env python3
"""Counts instructions of the engine's kernels under callgrind and compares them with the table in the tree.

    benchmarks/instructions/count.py [--build build/release]            prints the change; exit code 1 if any rose by over 10 %
    benchmarks/instructions/count.py [--build build/release] --update   writes table.csv instead

Counts do not depend on load or clock, only on compiler and instruction set (valgrind offers AVX2 at best). Where the
instruction set is another than the table's, changes are printed and nothing fails. Exit code 77 if valgrind cannot run a program here:
some virtual machines hide an instruction (rdtscp) that Highway's library uses all the same when it is loaded.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = pathlib.Path(__file__).resolve().parent / "table.csv"
ALLOWED_RISE = 0.10


def valgrind(*command):
    done = subprocess.run(["valgrind", "--error-exitcode=9", *command], capture_output=True, text=True, check=False,
                          cwd=ROOT)
    if done.returncode != 0:
        sys.exit(f"count.py: {' '.join(map(str, command))}: {done.stderr.strip().splitlines()[-1:]}")
    return done


def instruction_set(program):
    """That valgrind offers the program."""
    done = subprocess.run(["valgrind", "--tool=none", "-q", program, "--isa"], capture_output=True, text=True, check=False)
    if done.returncode < 0 and "SIGILL" in done.stderr and "libhwy" in done.stderr:
        print("SKIPPED: valgrind refuses an instruction of libhwy's start on this machine")
        sys.exit(77)
    if done.returncode != 0:
        sys.exit(f"count.py: {program} --isa: {done.stderr.strip().splitlines()[-1:]}")
    return done.stdout.strip()


def instructions(program, name):
    with tempfile.TemporaryDirectory() as folder:
        done = valgrind("--tool=callgrind", "--instr-atstart=no", "--collect-atstart=no",
                        f"--callgrind-out-file={folder}/out", program, name)
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    program = options.build.resolve() / "bin/kernel_loop"
    names = subprocess.run([program, "--list"], check=True, capture_output=True, text=True).stdout.splitlines()
    isa = instruction_set(program)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        counts = dict(zip(names, pool.map(lambda name: instructions(program, name), names)))

    if options.update:
        with TABLE.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["what", "instructions", "instruction_set"])
            writer.writerows([name, count, isa] for name, count in counts.items())
        return
    table = {row["what"]: row for row in csv.DictReader(TABLE.open(encoding="utf-8"))}
    failed = []
    print(f"| what | instructions ({isa}) | change against the table |\n|---|---|---|")
    for name, count in counts.items():
        before = table.get(name)
        if before is None:
            failed.append(f"{name} is not in the table")
            print(f"| {name} | {count} | new |")
            continue
        change = count / int(before["instructions"]) - 1
        print(f"| {name} | {count} | {100 * change:+.1f} % |")
        if change > ALLOWED_RISE and before["instruction_set"] == isa:
            failed.append(f"{name}: {before['instructions']} instructions became {count}, {100 * change:+.1f} %")
    failed += [f"{name} is in the table but not in the program" for name in table if name not in counts]
    for line in failed:
        print(f"count.py: {line} (allowed: a rise of 10 %, or an updated table: count.py --update)", file=sys.stderr)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
