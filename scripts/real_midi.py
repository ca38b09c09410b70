#!/usr/bin/env python3
"""Renders MIDI files that nobody here wrote and checks each: no error, no hang, no stuck note, no clipped sample.

The files are those of Debian's package openttd-openmsx (31 pieces, GPL) unless a folder is given. Programs choose the
presets; what has no strings is silent. A stuck note is one that still sounds 60 s after the end, when a string with a T60
of 40 s has fallen by 90 dB.

usage: real_midi.py [--jawari PROGRAM] [--folder FOLDER] [--seconds LONGEST_RUN]
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
OPENMSX = pathlib.Path("/usr/share/games/openttd/baseset/openmsx")
LONGEST_TAIL_S = 59.9


def render(program, midi, folder, longest_s):
    """Statistics, or the reason why there are none."""
    wav = pathlib.Path(folder) / (midi.stem + ".wav")
    try:
        run = subprocess.run([program, "render", midi, "-o", wav, "--stats", "-", "--limiter", "-1"],
                             capture_output=True, text=True, timeout=longest_s)
    except subprocess.TimeoutExpired:
        return None, f"still running after {longest_s} s"
    finally:
        wav.unlink(missing_ok=True)
    if run.returncode != 0:
        return None, run.stderr.strip()
    return json.loads(run.stdout), None


def problems(stats):
    found = []
    if stats["clipped_samples"]:
        found.append(f"{stats['clipped_samples']} clipped samples")
    if stats["nonfinite_resets"]:
        found.append(f"{stats['nonfinite_resets']} resets")
    if stats["sound_s"] - stats["score_s"] > LONGEST_TAIL_S:
        found.append("a stuck note")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jawari", default=ROOT / "build/release/bin/jawari")
    parser.add_argument("--folder", type=pathlib.Path, default=OPENMSX)
    parser.add_argument("--seconds", type=float, default=3600)
    options = parser.parse_args()
    files = sorted(options.folder.glob("*.mid"))
    if not files:
        sys.exit(f"real_midi.py: no MIDI files in {options.folder} (apt-get install openttd-openmsx)")
    failed = 0
    print(f"{'file':32} {'music s':>8} {'tail s':>7} {'notes':>6} {'silent':>6} {'peak dBFS':>9} {'x real time':>11}")
    with tempfile.TemporaryDirectory() as folder, \
            concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        jobs = [pool.submit(render, options.jawari, midi, folder, options.seconds) for midi in files]
        for midi, job in zip(files, jobs):
            stats, error = job.result()
            found = [error] if error else problems(stats)
            failed += bool(found)
            if stats:
                peak = "-" if stats["peak_dbfs"] is None else f"{stats['peak_dbfs']:.1f}"
                print(f"{midi.stem:32} {stats['score_s']:8.1f} {stats['sound_s'] - stats['score_s']:7.2f} "
                      f"{stats['notes']:6} {stats['silent_notes']:6} {peak:>9} {stats['real_time_factor']:11.1f}"
                      f"{'  ' + ', '.join(found) if found else ''}", flush=True)
            else:
                print(f"{midi.stem:32} {error}", flush=True)
    print(f"{len(files) - failed} of {len(files)} files without a problem")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
