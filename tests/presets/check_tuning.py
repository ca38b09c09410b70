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

SETTLED_S, MEASURED_S, PAUSE_S = 0.20, 0.52, 0.18
BODY_SETTLED_S, BODY_HZ = 0.9, 300  # the lowest body modes ring on between the partials of low notes
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
    return [alone_on_bridge(preset, strings) for strings in variants.values()]


def alone_on_bridge(preset, strings):
    """With these strings alone, each with its own bridge point; on a bridge that moves the others are damped."""
    if "bridge" not in preset:
        return {**preset, "strings": strings}
    places = [[other["name"] for other in preset["strings"]].index(string["name"]) for string in strings]
    body = [{**mode, "shape": [mode["shape"][i] for i in places]} if "shape" in mode else mode for mode in preset["body"]]
    return {**preset, "strings": strings, "body": body, "bridge": {**preset["bridge"], "open_strings": 0}}


def expected_motion(preset, key):
    """Of the strings that have the key, the allocator takes the one with the lowest fret."""
    string = max((s for s, k in model.keys_of_course(preset) if k == key), key=lambda s: s["open_note"])
    return string, model.motion_of(preset, string, key - string["open_note"])


def schedule(preset, keys):
    """(key, start, beginning of the measured passage) in s."""
    now, plan = 0.0, []
    for key in keys:
        low = "body" in preset and expected_motion(preset, key)[1].first_hz < BODY_HZ
        settled = BODY_SETTLED_S if low else SETTLED_S
        plan.append((key, now, now + settled))
        now += settled + MEASURED_S + PAUSE_S
    return plan


def scale(plan, velocity):
    score = play.score()
    for key, start, begin in plan:
        end = begin + MEASURED_S
        score.note(play.beats(start), key, play.beats(end - start), velocity)
        score.control(play.beats(end + 0.08), 120, 0)
    return score


def measure_note(sound, begin_s, motion):
    """Cents of the first partial and (partial, T60 expected, T60 measured) of those that are strong enough."""
    passage = sound[int(begin_s * play.RATE_HZ):int((begin_s + MEASURED_S) * play.RATE_HZ)]
    cents, decays, first_level = None, [], 0.0
    for k in PARTIALS:
        expected_hz = motion.partial_hz(k)
        if expected_hz > HIGHEST_HZ:
            break
        sigma = motion.decay_per_s(k)
        # a window no longer than the partial lives: what follows is its neighbours' side lobes
        lives = int(play.RATE_HZ * min(MEASURED_S, max(5.0 / sigma, estimate.WINDOW_PERIODS / motion.first_hz + 0.1)))
        partial = estimate.measure(passage[:max(lives, int(0.12 * play.RATE_HZ))], expected_hz, motion.first_hz, play.RATE_HZ)
        if k == 1:
            cents, first_level = estimate.cents(partial.frequency_hz, expected_hz), partial.level
        elif partial.level < QUIETEST * first_level:
            continue
        decays.append((k, np.log(1000) / sigma, partial.t60_s))
    return cents, decays, first_level


def louder_side(sound, begin_s):
    """Left or right: a body that radiates differently to both may nearly cancel in their mean."""
    passage = sound.stereo[int(begin_s * play.RATE_HZ):int((begin_s + MEASURED_S) * play.RATE_HZ)]
    return sound.stereo[:, (passage ** 2).sum(axis=0).argmax()]


def check_preset(program, name, contacts):
    """Rows (string, key, cents, decays, level, impulses) of all notes."""
    rows = []
    written = model.load(name)
    source = written if contacts else model.without_contacts(written)
    variants = members(source)
    with tempfile.TemporaryDirectory() as folder:
        for number, preset in enumerate(variants):
            plan = schedule(preset, model.playable_keys(preset))
            sound = play.render(program, preset, scale(plan, PLAYED if contacts else SOFT), folder, f"{name}-{number}")
            assert sound.stats["ignored_notes"] == 0, (name, sound.stats)
            if not contacts:
                assert sound.stats["impulses"] == 0, f"{name}: contacts are off, yet there were impulses"
            for key, _, begin_s in plan:
                string, motion = expected_motion(preset, key)
                rows.append((string["name"], key, *measure_note(louder_side(sound, begin_s), begin_s, motion)))
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
    parser.add_argument("--preset", action="append", choices=[*model.NAMES, *model.MOVING])
    parser.add_argument("--contacts", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", help="also write the summary as a Markdown table")
    arguments = parser.parse_args()
    problems, table = [], []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for name, rows in pool.map(lambda n: check_preset(arguments.program, n, arguments.contacts), arguments.preset or [*model.NAMES, *model.MOVING]):
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
