"""What a preset file promises: which notes it has, at which pitch, how fast each partial dies. Read from the file alone.

The formulas are those of docs/formats/preset.md, written here once more and independently of the engine.
"""
import copy
import json
import math
import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDER = ROOT / "presets" / "instruments"
NAMES = sorted(path.stem for path in FOLDER.glob("*.json"))


def load(name):
    return json.loads((FOLDER / f"{name}.json").read_text())


def frets_of(preset, string):
    return string.get("frets", preset.get("frets", {"count": 0}))


def fret_count(preset, string):
    frets = frets_of(preset, string)
    return frets.get("count", len(frets.get("height_m", [])))


def keys_of_course(preset):
    """(string, key) of every place at which a note can start: strings that lead a course, open and stopped."""
    led, places = set(), []
    for string in preset["strings"]:
        course = string.get("course")
        if course is not None and course in led:
            continue
        led.add(course)
        places += [(string, string["open_note"] + fret) for fret in range(fret_count(preset, string) + 1)]
    return places


def playable_keys(preset):
    return sorted({key for _, key in keys_of_course(preset)})


class Motion:
    """A string at one speaking length: frequency and decay of its partials."""

    def __init__(self, string, fret):
        ratio = 2 ** (fret / 12)
        self.first_hz = string["open_frequency_hz"] * ratio
        open_b = string.get("inharmonicity", 0)
        # E I belongs to the string: B/(1+B) = E I pi^2/(4 mu L^4 f^2) grows with ratio^4/ratio^2.
        share = open_b / (1 + open_b) * ratio ** 2
        self.inharmonicity = share / (1 - share)
        self.length_m = string["length_m"] / ratio
        self.density = string["linear_density_kg_per_m"]
        self.damping = string["damping"]

    def partial_hz(self, k):
        b = self.inharmonicity
        return self.first_hz * k * math.sqrt((1 + b * k * k) / (1 + b))

    def mode_number(self, frequency_hz):
        low, high = 0.0, frequency_hz / self.first_hz * math.sqrt(1 + self.inharmonicity) + 1
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if self.partial_hz(middle) < frequency_hz else (low, middle)
        return high

    def decay_per_s(self, k):
        """Through two T60 points: sigma = s0 + s1 k^2."""
        (k1, s1), (k2, s2) = [(self.mode_number(p["frequency_hz"]), math.log(1000) / p["t60_s"]) for p in self.damping["points"]]
        slope = (s2 - s1) / (k2 * k2 - k1 * k1)
        return s1 + slope * (k * k - k1 * k1)


def strings_of_key(preset, key):
    """For every string that may play the key, its motion; all strings of its course with it."""
    sounding = []
    for leader, played in keys_of_course(preset):
        if played != key:
            continue
        fret = key - leader["open_note"]
        course = leader.get("course")
        members = [s for s in preset["strings"] if s is leader or (course is not None and s.get("course") == course)]
        sounding.append([(s, Motion(s, fret)) for s in members])
    return sounding


def without_contacts(preset):
    """The same instrument, its strings touching nothing, its pickups linear: what it is then is known in closed form."""
    free = copy.deepcopy(preset)
    for owner in [free] + free["strings"]:
        frets = owner.get("frets")
        if frets and "height_m" in frets:
            owner["frets"] = {"count": frets.get("count", len(frets["height_m"]))}
    free.pop("obstacles", None)
    free.pop("soft_touches", None)
    for pickup in free.get("pickups", []):
        pickup.pop("magnet_distance_m", None)
    strip_provenance(free)
    return free


def without_noises(preset):
    """The preset without the noises of attack and release: what a gesture adds beside them."""
    plain = copy.deepcopy(preset)
    strip_provenance(plain)
    plain.get("hand", {}).pop("release_noise_N", None)
    for exciter in plain["exciters"]:
        exciter.pop("roughness", None)
    return plain


def strip_provenance(value):
    if isinstance(value, dict):
        value.pop("provenance", None)
        for child in value.values():
            strip_provenance(child)
    elif isinstance(value, list):
        for child in value:
            strip_provenance(child)
