"""Fits a preset to its recorded sets: how its body radiates by frequency or, without a body, how its pickups' coils and its first
exciter colour the sound; and the level of each string.

All are data of the preset: factors of the body's modes in third octaves, `resonance_hz` and `quality_factor` of the pickups, times
and width of the exciter, and the strings' `level`. Sets that are held out are not looked at. What comes out is written to scripts/instruments/fitted.json, from which scripts/make_presets.py makes the preset.
"""
import json
import pathlib
import statistics
import sys
import tempfile

import numpy as np

import compare
import evenness
import properties
import sets
import sounds

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "scripts" / "instruments")]
import body  # noqa: E402
import make_presets  # noqa: E402
import wire  # noqa: E402

ROUNDS = 6
EVEN_ROUNDS, EVEN_STEP = 6, 0.5
STEP = 0.7            # share of what is missing that a round adds: bands overlap
WIDEST_DB = 60.0      # no third octave is lowered by more against the strongest
# Instruments without a set of their own take the radiation of a kindred one.
KINDRED = {"guitar-12": "guitar-steel"}
EVEN = ["harpsichord", "clavichord", "dulcimer", "guitar-nylon", "guitar-steel", "guitar-electric", "bass-fretted", "bass-fretless", "bass-slap"]
# What is tried of presets without a body: the value at which the search begins, and the lowest and highest that an instrument has.
COIL = {"resonance_hz": (2500.0, 400.0, 8000.0), "quality_factor": (1.0, 0.4, 3.0)}
EXCITER = {"release_s": (0.0005, 0.0001, 0.002), "width_m": (0.008, 0.002, 0.015)}
FACTORS = [2.0, 2.0 ** 0.5, 2.0 ** 0.25]  # by which a value is moved either way, from coarse to fine
NAMES = {"fluid": "Fluid R3 (fluid-soundfont-gm)"}


def smooth(values):
    padded = [values[0], *values, values[-1]]
    return [(a + 2 * b + c) / 4 for a, b, c in zip(padded, padded[1:], padded[2:])]


def bounded(levels):
    top = max(levels)
    return [round(max(x - top, -WIDEST_DB), 1) for x in levels]


def missing_db(mine, targets):
    """Median over keys and sets of what each third octave lacks."""
    rows = [[b - a for a, b in zip(levels, near)] for key, levels in mine.items() for spectra in targets.values()
            if (near := sets.spectrum_near(spectra, key)) is not None]
    return [statistics.median(column) for column in zip(*rows)]


class Trial:
    """The preset as make_presets would write it with the fits of the moment."""

    def __init__(self, cache, program, name, folder):
        self.cache, self.program, self.name, self.path = cache, program, name, pathlib.Path(folder) / f"{name}.json"

    def written(self):
        self.path.write_text(make_presets.preset(self.name))
        return sounds.Preset(self.cache, self.program, self.path), json.loads(self.path.read_text())

    def spectra(self, keys):
        preset, _ = self.written()
        return preset.colours(keys)


def distance_to(mine, targets):
    return statistics.fmean(compare.distance(mine, spectra)[0] for spectra in targets.values())


def fit_radiation(trial, keys, targets, found):
    found["before_db"] = round(distance_to(trial.spectra(keys), targets), 1)
    found.update(to=" and ".join(NAMES[label] for label in targets), distance_db=0.0, third_octaves_db=[0.0] * len(properties.CENTRES_HZ))
    best = None
    for _ in range(ROUNDS):
        mine, levels = trial.spectra(keys), found["third_octaves_db"]
        now = distance_to(mine, targets)
        if best is None or now < best[0]:
            best = now, levels
        found["third_octaves_db"] = bounded([a + STEP * b for a, b in zip(levels, smooth(missing_db(mine, targets)))])
    middle = statistics.median(best[1])  # the instrument's gain is not part of the fit
    found["distance_db"], found["third_octaves_db"] = round(best[0], 1), [round(level - middle, 1) for level in best[1]]


def fit_coil(trial, keys, targets, found):
    """Moves one value after another as long as the distance falls."""
    description = trial.written()[1]
    exciter = next(e for e in description["exciters"] if e["kind"] == "finger")
    places = [("pickups", key) for key in COIL] + [("exciter", key) for key in EXCITER]
    limits = {("pickups", key): bounds[1:] for key, bounds in COIL.items()} | {("exciter", key): bounds[1:] for key, bounds in EXCITER.items()}
    found["before_db"] = round(distance_to(trial.spectra(keys), targets), 1)
    found.update(to=" and ".join(NAMES[label] for label in targets), distance_db=0.0, pickups={key: row[0] for key, row in COIL.items()},
                 exciter={"name": exciter["name"], **{key: exciter.get(key, row[0]) for key, row in EXCITER.items()}})
    best = distance_to(trial.spectra(keys), targets)
    for factor in FACTORS:
        moved = True
        while moved:
            moved = False
            for section, key in places:
                for turn in (factor, 1 / factor):
                    before = found[section][key]
                    low, high = limits[section, key]
                    found[section][key] = wire.rounded(min(max(before * turn, low), high), 3)
                    now = distance_to(trial.spectra(keys), targets) if found[section][key] != before else best
                    if now < best - 0.02:
                        best, moved = now, True
                        break
                    found[section][key] = before
    found["distance_db"] = round(best, 1)


def keys_of_string(string, description, keys):
    """Those that it plays when nothing else sounds: no other string has them at a lower fret."""
    openings = {s["open_note"] for s in description["strings"] if s is not string and s.get("course") is None} | {string["open_note"]}
    return [key for key in keys if max(o for o in openings if o <= key) == string["open_note"]] if string.get("course") is None else [string["open_note"]]


def fit_levels(trial, found):
    """Strings equally loud, A-weighted, by the median of their keys."""
    levels = found["string_levels_db"] = {}
    for _ in range(2):
        preset, description = trial.written()
        loud = preset.compass(sets.playable_keys(description))
        middle = statistics.median(loud.values())
        for string in description["strings"]:
            lacks = statistics.median(middle - loud[str(key)] for key in keys_of_string(string, description, [int(key) for key in loud]))
            levels[string["name"]] = round(levels.get(string["name"], 0.0) + lacks, 1)


def fit_evenness(trial, found):
    """Modes louder or softer, so that keys are equally loud."""
    best = None
    changed = np.zeros(len(trial.written()[1]["body"]))
    for _ in range(EVEN_ROUNDS):
        found["modes_db"] = [round(float(x), 1) for x in changed]
        preset, description = trial.written()
        keys = sets.playable_keys(description)
        powers = preset.powers(keys)
        spectra = np.array([powers[str(key)] for key in keys])
        levels = 10 * np.log10(spectra.sum(axis=1))
        steps = np.abs(np.diff(levels)).max() + 0.2 * np.ptp(levels)
        if best is None or steps < best[0]:
            best = steps, found["modes_db"]
        changed = changed + EVEN_STEP * evenness.changes_db(evenness.shares(description["body"], spectra), levels, changed)
        changed = evenness.without_colour(changed, [mode["frequency_hz"] for mode in description["body"]])
    found["modes_db"] = best[1]


def fit_balance(trial, found):
    """Both sides equally loud: few modes carry most of a note, and where they stand is chance."""
    found["left_over_right_db"] = 0.0
    preset, description = trial.written()
    found["left_over_right_db"] = preset.phrase(sets.playable_keys(description))["left_over_right_db"]


def fit(cache, program, name, even=False):
    """Fits, writes, and returns a line that says how far it went. `even`: also the gains of single modes, so that keys are equally loud."""
    if name in KINDRED:
        other = body.fits[KINDRED[name]]
        body.fits[name] = {key: value for key, value in other.items() if key != "string_levels_db"}
        body.fits[name]["to"] += f" as {KINDRED[name]}"
    else:
        found = body.fits[name] = {}
        with tempfile.TemporaryDirectory() as folder:
            trial = Trial(cache, program, name, folder)
            keys = sets.keys_of(name, trial.written()[1])
            recorded, _ = sets.recorded(cache, name)
            targets = {r.name: r.colours(keys) for r in recorded if r.name in sets.FITTED}
            has_body = "body" in trial.written()[1]
            if targets:
                (fit_radiation if has_body else fit_coil)(trial, keys, targets, found)
            if name in EVEN:
                fit_levels(trial, found)
            if has_body and even:
                fit_evenness(trial, found)
                fit_levels(trial, found)
            if has_body:
                fit_balance(trial, found)
    lines = [f"{json.dumps(key)}: {json.dumps(body.fits[key])}" for key in sorted(body.fits)]
    body.FITTED.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    found = body.fits[name]
    return f"{name}: {found['before_db']:g} dB to {found['distance_db']:g} dB" if "to" in found else f"{name}: levels of {len(found['string_levels_db'])} strings"
