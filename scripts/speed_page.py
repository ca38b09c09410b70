#!/usr/bin/env python3
"""Fills the tables of docs/benchmarks.md with what the benchmark programs print.

Usage: scripts/speed_page.py BIN_FOLDER
BIN_FOLDER holds speed_tables and kernel_benchmarks, e.g. build/release/bin.
"""
import pathlib
import re
import subprocess
import sys


def printed(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def kernel_table(text):
    """The rows of Google Benchmark's CSV as Markdown."""
    lines = [line.split(",") for line in text.splitlines() if "," in line]
    names = lines[0]
    at = {name.strip('"'): i for i, name in enumerate(names)}
    rows = ["| kernel | ns | ns per mode-step | share of peak |", "|---|---|---|---|"]
    for line in lines[1:]:
        rate = float(line[at["mode_steps"]])
        per_step = f"{1e9 / rate:.3f}" if rate > 0 else ""
        share = 100 * float(line[at["fma_share"]])
        rows.append(f"| {line[0].strip(chr(34))} | {float(line[at['cpu_time']]):.0f} | {per_step} | {share:.0f} % |")
    return "\n".join(rows)


def replace_tables(page, heading_text, tables):
    """Replaces the run of table lines and blank lines that follows `heading_text`."""
    pattern = re.compile(re.escape(heading_text) + r"\n\n(?:[A-Z]+\n|(?:\|.*\n|\n(?=\|))+)")
    page, count = pattern.subn(lambda _: heading_text + "\n\n" + tables.strip() + "\n", page)
    if count != 1:
        sys.exit(f"docs/benchmarks.md: expected one table after '{heading_text}', found {count}")
    return page


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    folder = pathlib.Path(sys.argv[1])
    blocks = printed(folder / "speed_tables").strip().split("\n\n")
    kernels = printed(folder / "kernel_benchmarks", "--benchmark_format=csv")
    path = pathlib.Path(__file__).resolve().parent.parent / "docs" / "benchmarks.md"
    page = path.read_text()
    page = replace_tables(page, "on the same stretch. *Near frames* are those in which a contact might close.", blocks[0])
    page = replace_tables(
        page,
        "CPU time with one skip switched off, relative to all on ([what each is](certificate.md); "
        "`jawari simulate --no-skip` does the same):",
        blocks[1])
    page = replace_tables(page, "Scaling, each table relative to its first row:", "\n\n".join(blocks[2:]))
    page = replace_tables(
        page, "frames: free motion of all modes through 64 steps in registers with p gap rates.", kernel_table(kernels))
    path.write_text(page)


if __name__ == "__main__":
    main()
