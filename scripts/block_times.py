#!/usr/bin/env python3
"""Fills the table of docs/player/player.md with the block times of all factory presets, the worst one first.

usage: block_times.py PROGRAM [--before PROGRAM] [--print]

PROGRAM is jawari. Each preset is played by `jawari bench-latency`, once on all courses at once and once by two hands, in blocks
of 64, 32 and 16 frames: three passes through all passages of the adversary. Shown is the most that a block took of its time,
by the least of its passes. --before: another build of the program, for two more columns. --print: to standard output alone.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "player" / "player.md"
PASSES = 3
PERFORMANCE_FRAMES = 64000  # five passages of a quarter of a second, and the beginning of the first again
SIZES = (64, 32, 16)


def most_of_minima(program, preset, frames, two_hands):
    """Share of its time that the longest block took, by the least of the passes, and the processor."""
    command = [program, "bench-latency", "--preset", preset, "--frames", str(frames), "--passes", str(PASSES),
               "--blocks", str(PASSES * PERFORMANCE_FRAMES // frames), "--json", "-"]
    done = subprocess.run(command + (["--two-hands"] if two_hands else []), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"block_times.py: {' '.join(map(str, command))}: {done.stderr.strip()}")
    report = json.loads(done.stdout)
    return report["presets"][0]["block_share_of_deadline"][0]["minimum"]["max"], report["processor"]


def measured(program, sizes):
    """{(preset, two hands): a share for each size}, and the processor."""
    shares, processor = {}, ""
    for path in sorted((ROOT / "presets" / "instruments").glob("*.json")):
        for two_hands in (False, True):
            row = shares.setdefault((path.stem, two_hands), [])
            for frames in sizes:
                share, processor = most_of_minima(program, path.stem, frames, two_hands)
                row.append(share)
    return shares, processor


def table(now, before):
    earlier = " before |" if before else ""
    head = "".join(f"{earlier} {' | '.join(str(size) for size in SIZES)} |" for _ in range(2))
    columns = 2 * (len(SIZES) + (1 if before else 0))
    rows = [f"| preset |{head}", "|---|" + "---|" * columns]
    presets = sorted({preset for preset, _ in now}, key=lambda preset: -now[preset, False][0])
    for preset in presets:
        cells = []
        for two_hands in (False, True):
            cells += before[preset, two_hands] if before else []
            cells += now[preset, two_hands]
        rows.append(f"| `{preset}` | " + " | ".join(f"{100 * cell:.0f} %" for cell in cells) + " |")
    return "\n".join(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--before")
    parser.add_argument("--print", action="store_true", dest="only_print")
    options = parser.parse_args()
    before = measured(options.before, SIZES[:1])[0] if options.before else None
    now, processor = measured(options.program, SIZES)
    text = f"Processor: {processor}.\n\n{table(now, before)}\n"
    if options.only_print:
        print(text)
        return
    page = PAGE.read_text(encoding="utf-8")
    pattern = re.compile(r"(<!-- block-times -->\n).*?(<!-- /block-times -->)", re.S)
    page, count = pattern.subn(lambda match: match.group(1) + "\n" + text + "\n" + match.group(2), page)
    if count != 1:
        sys.exit(f"block_times.py: {PAGE} has {count} places for the table")
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
