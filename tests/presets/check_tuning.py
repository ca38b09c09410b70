#!/usr/bin/env python3
"""Every note of every preset: first partial within a cent of its target, decay times within 5 % of the preset's T60.

Plucked softly with contacts switched off, measured from the WAV (estimate.py). With --contacts the same figures with all
contacts on and at velocity 90: reported, not judged.

usage: check_tuning.py PROGRAM [--preset NAME]... [--contacts] [--jobs N] [--table FILE]
"""
import argparse
import concurrent.futures
import sys
import tempfile

import numpy as np

import estimate
import play
import preset_model as model

NOTE_S, STEP_S, SETTLED_S = 0.72, 0.90, 0.20
SOFT, PLAYED = 24, 90
CENT_LIMIT, DECAY_LIMIT = 1.0, 0.05
PARTIALS = (1, 2, 3, 5)
QUIETEST = 1e-3   # of the first partial: weaker ones (a node at the plectrum or pickup) are not judged
HIGHEST_HZ = 12000


def members(preset):
    """One preset for each place within a course: strings of a course beat and must be heard alone."""
    by_course, variants = {}, {}
    for string in preset["strings"]:
        course = string.get("course")
        place = 0 if course is None else by_course.get(course, 0)
        by_course[course] = place + 1
        alone = {key: value for key, value in string.items() if key != "course"}
        variants.setdefault(place, []).append(alone)
    return [{**preset, "strings": strings} for strings in variants.values()]


def expected_motion(preset, key):
    """Of the strings that have the key, the allocator takes the one with the lowest fret."""
    string = max((s for s, k in model.keys_of_course(preset) if k == key), key=lambda s: s["open_note"])
    return string, model.Motion(string, key - string["open_note"])


def scale(keys, velocity):
    score = play.score()
    for i, key in enumerate(keys):
        score.note(play.beats(i * STEP_S), key, play.beats(NOTE_S), velocity)
        score.control(play.beats(i * STEP_S + NOTE_S + 0.08), 120, 0)
    return score


def touches_of(preset, string):
    index = preset["strings"].index(string)
    return [t for t in preset.get("soft_touches", []) if not t.get("strings") or index in t["strings"]]


def measure_note(sound, begin_s, preset, string, motion):
    """Cents of the first partial and (partial, T60 expected, T60 measured) of those that are strong enough."""
    begin, end = int((begin_s + SETTLED_S) * play.RATE_HZ), int((begin_s + NOTE_S) * play.RATE_HZ)
    passage = sound[begin:end]
    cents, decays, first_level = None, [], 0.0
    for k in PARTIALS:
        expected_hz = motion.partial_hz(k)
        if expected_hz > HIGHEST_HZ:
            break
        sigma = motion.decay_per_s(k) + sum(motion.touch_decay_per_s(k, t) for t in touches_of(preset, string))
        # a window no longer than the partial lives: what follows is its neighbours' side lobes
        lives = int(play.RATE_HZ * min(NOTE_S - SETTLED_S, max(5.0 / sigma, estimate.WINDOW_PERIODS / motion.first_hz + 0.1)))
        partial = estimate.measure(passage[:max(lives, int(0.12 * play.RATE_HZ))], expected_hz, motion.first_hz, play.RATE_HZ)
        if k == 1:
            cents, first_level = estimate.cents(partial.frequency_hz, expected_hz), partial.level
        elif partial.level < QUIETEST * first_level:
            continue
        decays.append((k, np.log(1000) / sigma, partial.t60_s))
    return cents, decays, first_level


def check_preset(program, name, contacts):
    """Rows (string, key, cents, decays, level, impulses) of all notes."""
    rows = []
    written = model.load(name)
    source = written if contacts else model.without_contacts(written)
    variants = members(source)
    with tempfile.TemporaryDirectory() as folder:
        for number, preset in enumerate(variants):
            keys = model.playable_keys(preset)
            sound = play.render(program, preset, scale(keys, PLAYED if contacts else SOFT), folder, f"{name}-{number}")
            assert sound.stats["ignored_notes"] == 0, (name, sound.stats)
            if not contacts:
                assert sound.stats["impulses"] == 0, f"{name}: contacts are off, yet there were impulses"
            for i, key in enumerate(keys):
                string, motion = expected_motion(preset, key)
                rows.append((string["name"], key, *measure_note(sound.mono, i * STEP_S, preset, string, motion)))
    return name, rows


def summary(name, rows):
    cents = [abs(row[2]) for row in rows]
    errors = [abs(measured / expected - 1) for row in rows for _, expected, measured in row[3]]
    return (name, len(rows), max(cents), float(np.median(cents)), len(errors), max(errors), float(np.median(errors)))


def failures(name, rows):
    for string, key, cents, decays, level in rows:
        if not level > 1e-7:
            yield f"{name} {string} key {key}: silent"
        if not abs(cents) <= CENT_LIMIT:
            yield f"{name} {string} key {key}: {cents:+.2f} cents"
        for k, expected, measured in decays:
            if not abs(measured / expected - 1) <= DECAY_LIMIT:
                yield f"{name} {string} key {key} partial {k}: T60 {measured:.3f} s instead of {expected:.3f} s"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--preset", action="append", choices=model.NAMES)
    parser.add_argument("--contacts", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", help="also write the summary as a Markdown table")
    arguments = parser.parse_args()
    problems, table = [], []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for name, rows in pool.map(lambda n: check_preset(arguments.program, n, arguments.contacts), arguments.preset or model.NAMES):
            row = summary(name, rows)
            table.append("| {} | {} | {:.3f} | {:.3f} | {} | {:.1f} % | {:.2f} % |".format(*row[:5], 100 * row[5], 100 * row[6]))
            print("{:16s} {:3d} notes: worst {:.3f} cents (median {:.3f}); {} decays, worst {:.2f} % (median {:.2f} %)".format(
                *row[:5], 100 * row[5], 100 * row[6]))
            if not arguments.contacts:
                problems += list(failures(name, rows))
    if arguments.table:
        with open(arguments.table, "w") as file:
            file.write("| preset | notes | worst cents | median | decay times | worst error | median |\n|---|---|---|---|---|---|---|\n")
            file.write("\n".join(table) + "\n")
    for problem in problems[:60]:
        print(problem, file=sys.stderr)
    if problems:
        sys.exit(f"{len(problems)} notes or partials are out of bounds")


if __name__ == "__main__":
    main()
