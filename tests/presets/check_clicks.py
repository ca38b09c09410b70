#!/usr/bin/env python3
"""No gesture clicks: the output's second difference around it stays below twice that of the same passage without it.

A note-on may be as sharp as its own attack later is: there the first milliseconds, in which the finger only begins to push,
are compared with the passage without the note. A hammer-on or pull-off excites the string at once: its first 5 ms may also be
as sharp as its own sound from then to 60 ms is, which no click is. The noises of attack and release, which are no clicks either, are left
out of the presets (tests of their own: Noise.*).

usage: check_clicks.py PROGRAM [--preset NAME]...
"""
import argparse
import concurrent.futures
import itertools
import pathlib
import sys
import tempfile

import numpy as np

import play
import preset_model as model
from estimate import second_difference

PRESETS = ["bass-fretted", "bass-fretless", "guitar-steel", "guitar-electric", "guitar-12", "sitar", "biwa", "harpsichord", "clavichord", "dulcimer"]
EVENT_S = 0.6
LIMIT = 2.0
LEAST_EFFECT_DB = -50
ATTACK_S = 0.005  # hammer-ons and pull-offs
SLIDE_S = 0.1


def pair_of_keys(name):
    """A ringing key, another on another string or course, a third on the ringing string if it has frets."""
    preset = model.load(name)
    places = model.keys_of_course(preset)
    first, key = places[0]
    first_fret = key + 2 if model.fret_count(preset, first) >= 2 else None
    other = next(k for s, k in places if s is not first and k - s["open_note"] in (0, 2) and k > key + 4)
    return key, other, first_fret


def base(key):
    score = play.score()
    score.note(0, key, play.beats(1.2), 100)
    return score


def held(key):
    """As base, but the key is held beyond the passage."""
    score = play.score()
    score.note(0, key, play.beats(2.4), 100)
    return score


def gestures(name):
    """(label, score with, score without, window in s after the event)."""
    key, other, stopped = pair_of_keys(name)
    at = play.beats(EVENT_S)

    def with_event(change):
        score = held(key)
        change(score)
        return score

    damps = model.load(name).get("hand", {}).get("damps", True)
    released = play.score()
    released.note(0, key, at, 100, release=100)
    if damps:
        yield "note-off", released, held(key), 0.05
    yield "another note's start", with_event(lambda s: s.note(at, other, 1, 100)), held(key), None
    if stopped is not None:
        yield "steal of the string", with_event(lambda s: s.note(at, stopped, 1, 100, channel=1)), held(key), None
    yield "all sound off", with_event(lambda s: s.control(at, 120, 0)), held(key), 0.02

    def bend(score):
        score.bend_range(2)
        score.bend(at, 1.0)
    yield "bend in one step", with_event(bend), held(key), 0.1

    def vibrato(score):
        score.control(at, 1, 127)
    yield "modulation in one step", with_event(vibrato), held(key), 0.3
    sustained = play.score()
    sustained.note(0, key, at - play.beats(0.1), 100)
    sustained.control(play.beats(0.1), 64, 127)
    sustained.control(at, 64, 0)
    if damps:
        yield "pedal up", sustained, held(key), 0.05


def legato_gestures(name):
    """Hammer-on, pull-off and slide by two frets, beside the first of the keys held on."""
    key, _, stopped = pair_of_keys(name)
    at = play.beats(EVENT_S)
    if stopped is None:
        return
    for label, first, then in (("hammer-on", key, stopped), ("pull-off", stopped, key), ("slide", key, stopped)):
        changed, unchanged = play.score(), play.score()
        for score in (changed, unchanged):
            score.control(0, 68, 127)
            if label == "pull-off":
                score.note(0, then, play.beats(2.4), 100)
        begin = play.beats(0.05) if label == "pull-off" else 0
        changed.note(begin, first, at - begin + (play.beats(1) if label != "pull-off" else 0), 100)
        unchanged.note(begin, first, play.beats(2.4), 100)
        if label != "pull-off":
            changed.note(at, then, play.beats(1), 100)
        yield label, changed, unchanged, SLIDE_S + 0.05 if label == "slide" else ATTACK_S


def program_change(program, folder):
    """Largest difference of a program change and a note after it from the two notes alone, in steps of a 24-bit sample.

    What sounds rings on untouched and the other instrument's note is added: then there is nothing that could click.
    """
    at = play.beats(EVENT_S)

    def sound(name, first, change, second):
        score = play.score()
        score.add(0, 0, 0xC0, 33)  # a bass
        if first:
            score.note(0, 40, play.beats(1.2), 100)
        if change:
            score.add(at, 0, 0xC0, 25)  # a guitar with steel strings
        if second:
            score.note(at, 52, play.beats(0.6), 100)
        return play.render(program, "auto", score, folder, f"program-{name}", tail_s=1.0).stereo

    both, first, alone = (sound(name, *what) for name, what in {"both": (1, 1, 1), "first": (1, 1, 0), "second": (0, 1, 1)}.items())
    unchanged = sound("unchanged", True, False, False)
    length = min(map(len, (both, first, alone, unchanged)))
    begin = int(EVENT_S * play.RATE_HZ)
    assert np.abs(alone[begin:]).max() > 0.01 and np.abs(first[begin:begin + 4800]).max() > 0.01
    apart = np.abs(both[:length] - first[:length] - alone[:length]).max()
    return 2**23 * max(apart, np.abs(first[:length] - unchanged[:length]).max())


def onset_s(preset):
    """How long an exciter only begins to push: a quarter of the finger's rise; a hammer or tangent has no such time."""
    fingers = [e["rise_s"] for e in preset["exciters"] if e["kind"] == "finger"]
    return 0.25 * min(fingers) if len(fingers) == len(preset["exciters"]) else 0.0


def effect_db(changed, unchanged):
    """What the gesture changed after all: one that does nothing passes any test of clicks."""
    length = min(len(changed.mono), len(unchanged.mono))
    begin = int(EVENT_S * play.RATE_HZ)
    change = np.abs(changed.mono[begin:length] - unchanged.mono[begin:length]).max()
    return 20 * np.log10(change / np.abs(unchanged.mono).max() + 1e-12)


def check(program, name):
    preset = model.without_noises(model.load(name))
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for label, changed, unchanged, window_s in itertools.chain(gestures(name), legato_gestures(name)):
            window_s = onset_s(preset) if window_s is None else window_s
            if window_s == 0:
                continue
            tag = label.replace(" ", "-").replace("'", "")
            arguments = ("--set", f"slide_time={SLIDE_S}") if label == "slide" else ()
            sounds = [play.render(program, preset, score, folder, f"{name}-{tag}-{i}", arguments=arguments) for i, score in enumerate((changed, unchanged))]
            begin, end = int((EVENT_S - 0.002) * play.RATE_HZ), int((EVENT_S + window_s) * play.RATE_HZ)
            # the neighbourhood is as long as a few periods: a ringing string's second difference has bursts
            neighbourhood = int((EVENT_S - 0.05) * play.RATE_HZ), int((EVENT_S + max(window_s, 0.05)) * play.RATE_HZ)
            worst = second_difference(sounds[0].mono)[begin:end].max()
            allowed = second_difference(sounds[1].mono)[slice(*neighbourhood)].max()
            if label in ("hammer-on", "pull-off"):
                allowed = max(allowed, second_difference(sounds[0].mono)[end:int((EVENT_S + 0.06) * play.RATE_HZ)].max())
            rows.append((name, label, worst / allowed, effect_db(*sounds)))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--preset", action="append", choices=PRESETS)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", help="also write the worst ratio of each gesture as a Markdown table")
    arguments = parser.parse_args()
    failed, worst = 0, {}
    with tempfile.TemporaryDirectory() as folder:
        steps = program_change(arguments.program, folder)
    failed += steps > 2
    print(f"{'FAIL' if steps > 2 else 'ok  '} program change: the sum of both instruments to {steps:.2f} steps of 24 bits (at most 2)")
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for rows in pool.map(lambda n: check(arguments.program, n), arguments.preset or PRESETS):
            for name, label, ratio, effect in rows:
                bad = not (ratio <= LIMIT and effect > LEAST_EFFECT_DB)
                failed += bad
                worst[label] = max(worst.get(label, (0, "")), (ratio, name))
                print(f"{'FAIL' if bad else 'ok  '} {name:16s} {label:24s} {ratio:6.2f} times the passage without it (at most {LIMIT:g}); "
                      f"changes the sound by {effect:.0f} dB")
    if arguments.table:
        rows = ["| gesture | second difference over the passage without it, worst preset |", "|---|---|"]
        rows += [f"| {label} | {ratio:.2f} ({name}) |" for label, (ratio, name) in worst.items()]
        pathlib.Path(arguments.table).write_text("\n".join(rows) + "\n")
    if failed:
        sys.exit(f"{failed} gestures click")


if __name__ == "__main__":
    main()
