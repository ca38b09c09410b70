"""The recorded sets: which packages have them, which instrument stands beside which preset, and which were used for fitting.

A set that is `held out` was never looked at while a preset was voiced. A set that is `kin` of another shares samples with it, so
that their distance says nothing.
"""
import json
import pathlib
import shutil

import coupling
import soundfont
import sounds

REFERENCE = pathlib.Path(__file__).resolve().parent / "reference.json"

# name: (Debian package, file)
FILES = {
    "fluid": ("fluid-soundfont-gm", "/usr/share/sounds/sf2/FluidR3_GM.sf2"),
    "timgm6mb": ("timgm6mb-soundfont", "/usr/share/sounds/sf2/TimGM6mb.sf2"),
    "musescore": ("musescore-general-soundfont", "/usr/share/sounds/sf3/MuseScore_General.sf3"),
}
FITTED = ["fluid"]
HELD_OUT = ["timgm6mb"]
KIN = ["musescore"]  # made from Fluid, much of it the same samples
# Of reference.json: fitted ones are Fluid's samples without their loops; these are of other hands.
REFERENCE_HELD_OUT = {"guitar-nylon": ["nylon-freepats"], "harpsichord": ["harpsi-JCLive", "harpsi-GeneralUserGS"]}

# General MIDI program (bank) of the same instrument. A clavinet is no clavichord, a koto no biwa: those presets have none.
PROGRAMS = {"guitar-nylon": (24, 0), "guitar-steel": (25, 0), "guitar-electric": (27, 0), "bass-fretted": (33, 0), "bass-fretless": (35, 0),
            "bass-slap": (36, 0), "harpsichord": (6, 0), "dulcimer": (15, 0), "sitar": (104, 0), "prepared": (0, 0)}
# Keys that are compared: those of reference.json where it has spectra; of the prepared piano the plain ones.
KEYS = {"guitar-nylon": [40, 45, 50, 55, 59, 64, 69, 76], "guitar-steel": [40, 45, 50, 55, 59, 64, 69, 76],
        "guitar-12": [40, 45, 50, 55, 59, 64, 69, 76], "guitar-electric": [40, 45, 50, 55, 59, 64, 69, 76],
        "harpsichord": [38, 43, 48, 53, 60, 65, 71, 77, 84], "dulcimer": [50, 55, 60, 67, 72, 79], "sitar": [49, 52, 55, 57, 60, 64, 72],
        "prepared": [50, 54, 57, 62, 67, 72], "tanpura": [36, 43, 48]}
NEAREST_KEYS = 2  # a spectrum of the reference stands for keys up to so many semitones away


# Examples that are a preset's instrument once more.
ALIKE = {"coupled-guitar": "guitar-nylon"}


def playable_keys(preset):
    """Every key that some string has, from the preset file alone."""
    keys, courses = set(), set()
    for string in preset["strings"]:
        course = string.get("course")
        if course is not None:
            if course in courses:
                continue
            courses.add(course)
        frets = string.get("frets", preset.get("frets", {}))
        count = frets.get("count", len(frets.get("height_m", [])))
        steps = frets.get("semitones", range(1, count + 1))
        keys |= {string["open_note"], *(string["open_note"] + s for s in steps)}
    return sorted(keys)


def keys_of(name, preset):
    playable = playable_keys(preset)
    name = ALIKE.get(name, name)
    if name in KEYS:
        return [k for k in KEYS[name] if k in playable]
    count = min(7, len(playable))
    return [playable[round(i * (len(playable) - 1) / max(1, count - 1))] for i in range(count)]


def recorded(cache, name):
    """The sets of a preset that are installed here, and the packages that are not."""
    there, missing = [], []
    name = ALIKE.get(name, name)
    if name not in PROGRAMS:
        return there, missing
    for label, (package, path) in FILES.items():
        if shutil.which("fluidsynth") and pathlib.Path(path).exists():
            program, bank = PROGRAMS[name]
            there.append(sounds.Recorded(cache, label, pathlib.Path(path), program, bank))
        else:
            missing.append(package)
    return there, missing


SHORTEST_HEAD_S = 1.2  # of a recording that has stages


def held_notes(cache, name):
    """What coupling.py finds in the recordings of a preset's instrument before their loops, of each package that is installed and is no other's kin."""
    name = ALIKE.get(name, name)
    if name not in PROGRAMS:
        return []
    found = []
    for label in (*FITTED, *HELD_OUT):
        path = pathlib.Path(FILES[label][1])
        if path.exists():
            identity = sounds.digest("heads", f"{path.name} {path.stat().st_size}", PROGRAMS[name], cache.estimator)
            found += cache.get(identity, lambda path=path: heads_of(path, *PROGRAMS[name]))
    return found


def heads_of(path, program, bank):
    heads = [head for head in soundfont.SoundFont(path).heads(program, bank) if len(head[3]) >= SHORTEST_HEAD_S * head[2]]
    return [coupling.of_held_note(samples, sounds.note_hz(root - cents / 100), rate) for root, cents, rate, samples in heads]


def reference():
    return json.loads(REFERENCE.read_text())


def reference_spectra(facts, name):
    """Sets of reference.json that have third octaves: name -> key -> levels."""
    return {label: {int(k): levels for k, levels in spectra.items()} for label, spectra in facts["third_octave_sets"].get(name, {}).items() if spectra}


def spectrum_near(spectra, key):
    """Of the key nearest to this one, or None where none is near."""
    near = min(spectra, key=lambda k: (abs(k - key), k))
    return spectra[near] if abs(near - key) <= NEAREST_KEYS else None
