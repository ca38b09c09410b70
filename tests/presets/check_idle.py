#!/usr/bin/env python3
"""An instrument that nobody plays costs nothing: CPU time per silent frame, long after its last note has died.

Two renderings differ only in how long they wait after one note; what the longer one costs more is silence.

usage: check_idle.py PROGRAM [--preset NAME]...
"""
import argparse
import sys
import tempfile

import numpy as np

import play
import preset_model as model

RATE_HZ = 48000
WAIT_S = (40.0, 100.0)
LIMIT_NS = 150.0  # of 20833 ns that a frame lasts


def one_note(key):
    score = play.score()
    score.note(0, key, play.beats(0.5), 100)
    score.control(play.beats(1.0), 120, 0)
    return score


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--preset", action="append", choices=model.NAMES)
    arguments = parser.parse_args()
    failed = 0
    for name in arguments.preset or ["bass-fretted", "guitar-steel", "harpsichord", "dulcimer"]:
        key = model.playable_keys(model.load(name))[0]
        with tempfile.TemporaryDirectory() as folder:
            sounds = [play.render(arguments.program, name, one_note(key), folder, f"{name}-{s:g}", tail_s=s) for s in WAIT_S]
        cost_ns = 1e9 * (sounds[1].stats["cpu_render_s"] - sounds[0].stats["cpu_render_s"]) / (RATE_HZ * (WAIT_S[1] - WAIT_S[0]))
        silent = np.abs(sounds[1].mono[int(30 * RATE_HZ):]).max()
        bad = not (cost_ns < LIMIT_NS and silent < 1e-7)
        failed += bad
        print(f"{'FAIL' if bad else 'ok  '} {name:16s} {cost_ns:6.1f} ns a silent frame (at most {LIMIT_NS:g}), loudest sample after 30 s {silent:.1e}")
    if failed:
        sys.exit(f"{failed} presets are not idle when nobody plays")


if __name__ == "__main__":
    main()
