#!/usr/bin/env python3
"""Fills the tables of docs/benchmarks.md with what the benchmark programs print.

Usage: scripts/speed_page.py BIN_FOLDER
BIN_FOLDER holds speed_tables, exactness, resolution_errors, adversarial and kernel_benchmarks, e.g. build/release/bin.
"""
import os
import pathlib
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor


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


EXACTNESS_RUNS = [("lab/bass", "0.05", "8064000"), ("lab/one-contact", "0.05", "8064000"), ("lab/fretless", "0.05", "1008000"),
                  ("lab/fretless", "0.002", "8064000")]


def exactness_row(folder, scene, sound_s, highest_rate_hz):
    """One row over all rows that the program prints."""
    run = subprocess.run([folder / "exactness", scene, sound_s, highest_rate_hz], capture_output=True, text=True)
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in run.stdout.splitlines() if line.endswith(("yes |", "NO |"))]
    if run.returncode not in (0, 1) or not rows:
        sys.exit(f"exactness {scene}: {run.stderr.strip()}")
    calm = [float(row[3]) for row in rows if float(row[4]) < 1e-9]
    disagree = sum(row[7] == "NO" for row in rows)
    return f"| `{scene}` | {sound_s} | {len(rows)} | {max(calm):.1e} (of {len(calm)} rows) | {disagree} |"


def replace_tables(page, heading_text, tables):
    """Replaces the run of table lines and blank lines that follows `heading_text`."""
    pattern = re.compile(re.escape(heading_text) + r"\n\n(?:[A-Z]+\n|(?:\|.*\n|\n(?=\|))+)")
    page, count = pattern.subn(lambda _: heading_text + "\n\n" + tables.strip() + "\n", page)
    if count != 1:
        sys.exit(f"docs/benchmarks.md: expected one table after '{heading_text}', found {count}")
    return page


def replace_section(page, before, content):
    """Replaces what stands between `before` and the next heading or paragraph that begins with `A string`."""
    begin = page.index(before) + len(before)
    end = re.compile(r"\n(?=## |A string that lies)").search(page, begin).start()
    return page[:begin] + content.strip() + "\n" + page[end:]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    folder = pathlib.Path(sys.argv[1])
    blocks = printed(folder / "speed_tables").strip().split("\n\n")
    with ThreadPoolExecutor(os.cpu_count()) as rows:  # nothing is timed in these
        exactness = "\n".join(rows.map(lambda run: exactness_row(folder, *run), EXACTNESS_RUNS))
    resolution = printed(folder / "resolution_errors")
    held = printed(folder / "adversarial")
    kernels = printed(folder / "kernel_benchmarks", "--benchmark_format=csv")
    path = pathlib.Path(__file__).resolve().parent.parent / "docs" / "benchmarks.md"
    page = path.read_text()
    page = replace_tables(page, "over the same time. *Near frames* are those in which a contact might close.", blocks[0])
    page = replace_tables(
        page,
        "CPU time with one skip switched off, relative to all on ([definitions](engine/certificate.md#glossary); "
        "`jawari simulate --no-skip` does the same):",
        blocks[1])
    page = replace_tables(page, "Scaling, each table relative to its first row:", "\n\n".join(blocks[2:]))
    page = replace_tables(
        page, "is the inner loop of near frames: free motion of all modes through 64 steps in registers with p gap rates.", kernel_table(kernels))
    page = replace_section(page, "| scene | sound (s) | rows | largest difference where uniform runs agree to 1e-9 | rows that disagree |\n"
                                 "|---|---|---|---|---|\n", exactness)
    page = replace_section(page, "It is far more sensitive, and the error of a quality there exceeds its target.\n\n", resolution)
    page = replace_section(page, "a host can use it to convert the model's number into time.\n\n", held)
    path.write_text(page)


if __name__ == "__main__":
    main()
