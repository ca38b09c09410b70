#!/usr/bin/env python3
"""Compares what the program computes, bit by bit, with tests/bits/hashes.csv: the demo pieces on their presets, and the
built-in scenes under each impact law.

    tests/bits/check_bits.py PROGRAM            the processor's best instruction set, and AVX2
    tests/bits/check_bits.py PROGRAM --all      every instruction set that the processor has
    tests/bits/check_bits.py PROGRAM --update   writes the rows of this system (all sets) into the table

PROGRAM is jawari_bits. Sums differ by rounding between instruction sets, and sines and powers between C libraries, so rows are
for both. Rows that the table lacks are counted; exit code 77 (skipped) if it has none of this system. The table pins the numbers
against changes by accident. That they are right is the business of the other tests: a change that moves bits on purpose
updates the table and says why.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import platform
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = pathlib.Path(__file__).resolve().parent / "hashes.csv"
FIELDS = ["what", "instruction_set", "c_library", "hash"]
LAWS = ["newton", "passive", "signorini", "paoli-schatzman"]  # in the order of ImpactLaw


def things():
    """Name and arguments of everything that is computed."""
    listed = subprocess.run([sys.executable, ROOT / "scripts/make_demo_midi.py", "--list"], check=True, capture_output=True, text=True)
    pieces = [line.split() for line in listed.stdout.splitlines()]
    result = {f"{piece} on {preset}": ["piece", str(ROOT / f"presets/demo/{piece}.mid"), preset] for piece, preset in pieces}
    for scene in ("lab/bass", "lab/fretless", "lab/one-contact", "lab/tanpura", "smooth/bass"):
        for number, law in enumerate(LAWS):
            result[f"{scene} {law}"] = ["scene", scene, str(number)]
    return result


def hash_of(program, arguments, instruction_set):
    done = subprocess.run([program, *arguments, instruction_set], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"check_bits.py: {' '.join(arguments)}: {done.stderr.strip()}")
    return done.stdout.splitlines()[-1].removeprefix("hash ")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()

    library = " ".join(platform.libc_ver()) + " " + platform.machine()
    sets = subprocess.run([options.program, "sets"], check=True, capture_output=True, text=True).stdout.split()
    if not (options.all or options.update):
        sets = [name for place, name in enumerate(sets) if place == 0 or name == "AVX2"]
    with TABLE.open(encoding="utf-8") as file:
        table = {(row["what"], row["instruction_set"], row["c_library"]): row["hash"] for row in csv.DictReader(file)}
    keys = [(what, name) for what in things() for name in sets]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        hashes = dict(zip(keys, pool.map(lambda key: hash_of(options.program, things()[key[0]], key[1]), keys)))

    if options.update:
        table.update({(what, name, library): value for (what, name), value in hashes.items()})
        with TABLE.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(FIELDS)
            writer.writerows([*key, value] for key, value in sorted(table.items()))
        print(f"{len(hashes)} rows written for {library}: {', '.join(sets)}")
        return
    unknown = [key for key in keys if (*key, library) not in table]
    changed = [key for key in keys if table.get((*key, library), hashes[key]) != hashes[key]]
    for what, name in changed:
        print(f"CHANGED {what} ({name}, {library}): {hashes[what, name]}, table {table[what, name, library]}")
    print(f"{len(keys) - len(unknown) - len(changed)} equal, {len(changed)} changed, {len(unknown)} not in the table "
          f"({', '.join(sets)}; {library})")
    if changed:
        sys.exit(1)
    if len(unknown) == len(keys):
        print(f"skipped: tests/bits/hashes.csv has no row for {library}; check_bits.py --update adds them")
        sys.exit(77)


if __name__ == "__main__":
    main()
