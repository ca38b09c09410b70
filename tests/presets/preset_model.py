"""What a preset file promises: which notes it has, at which pitch, how fast each partial dies. Read from the file alone.

The formulas are those of docs/formats/preset.md, written here once more and independently of the engine.
"""
import copy
import json
import math
import pathlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDER = ROOT / "presets" / "instruments"
NAMES = sorted(path.stem for path in FOLDER.glob("*.json"))
MOVING = {"coupled-guitar": ROOT / "docs" / "examples" / "render" / "coupled-guitar.json"}  # an example on a moving bridge


def load(name):
    return json.loads(MOVING.get(name, FOLDER / f"{name}.json").read_text())


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


class MotionOnBridge(Motion):
    """The same on a bridge that moves (docs/formats/preset.md, "bridge"): partials of string and body together, the other strings still. The
    tension is the one at which the first partial is the note; of the losses the program takes away the body's mean over a third octave."""

    HIGHEST_HZ = 20000.0

    def __init__(self, preset, string, fret):
        super().__init__(string, fret)
        moving = [mode for mode in preset["body"] if "mass_kg" in mode]
        place = next(i for i, other in enumerate(preset["strings"]) if other["name"] == string["name"])
        shape = np.array([mode["shape"][place] if "shape" in mode else 1.0 for mode in moving]) * string.get("level", 1.0)
        self.strength = shape ** 2 / np.array([mode["mass_kg"] for mode in moving])
        self.body_rate = math.log(1000) / np.array([mode["t60_s"] for mode in moving])
        self.body_omega = 2 * math.pi * np.array([mode["frequency_hz"] for mode in moving])
        self.note_hz, self.stiffness_share = self.first_hz, self.inharmonicity / (1 + self.inharmonicity)
        stiffness = self.stiffness_share * (2 * self.length_m * self.first_hz) ** 2 * self.density  # E I pi^2/L^2 [N]
        rigid = Motion(string, fret)
        count = int(self.HIGHEST_HZ / self.first_hz)
        self.body_mean = [self.mean_loss(2 * math.pi * rigid.partial_hz(k)) for k in range(1, count + 1)]
        self.sigma = np.array([max(rigid.decay_per_s(k) - lost, 0.1 * rigid.decay_per_s(k)) for k, lost in enumerate(self.body_mean, 1)])
        self.k = np.arange(1, count + 1)
        tuned_hz = self.note_hz
        for _ in range(80):
            whole = (2 * self.length_m * tuned_hz) ** 2 * self.density  # T + E I pi^2/L^2 [N]
            self.tension = whole - stiffness
            b = stiffness / self.tension
            self.omega = 2 * math.pi * tuned_hz * self.k * np.sqrt((1 + b * self.k ** 2) / (1 + b))
            self.roots = {}
            found = self.root(1).imag / (2 * math.pi)
            if abs(found / self.note_hz - 1) < 1e-7:
                break
            tuned_hz *= self.note_hz / found
        else:
            raise ValueError(f"{string['name']}, fret {fret}: a resonance of the body keeps the first partial off its note")

    def receptance(self, s):
        return (self.strength / (s * s + 2 * self.body_rate * s + self.body_omega ** 2)).sum()

    def mean_loss(self, omega):
        tension = (2 * self.length_m * self.first_hz) ** 2 * self.density * (1 - self.stiffness_share)
        places = 1j * omega * 2.0 ** (np.linspace(-0.5, 0.5, 17) / 3)
        return tension / self.length_m * np.mean([(s * self.receptance(s)).real for s in places])

    def root(self, k):
        """s of partial k: 1/receptance is what the string's end answers, -kappa + sum of b^2/(mu (s^2 + 2 sigma s + omega^2))."""
        if k not in self.roots:
            pull = 2 / self.length_m * (self.length_m / (self.k * math.pi)) ** 2 * self.density * self.omega ** 4
            # sum over all modes of b a, in closed form but for stiffness: those above the highest stand still
            kappa = self.tension / self.length_m + (pull / self.omega ** 2).sum()
            own = self.k == k

            def error(s):
                others = (pull[~own] / (s * s + 2 * self.sigma[~own] * s + self.omega[~own] ** 2)).sum() - kappa
                body = self.receptance(s)
                at = k - 1
                return s * s + 2 * self.sigma[at] * s + self.omega[at] ** 2 - pull[at] * body / (1 - body * others)

            s = complex(-self.sigma[k - 1], self.omega[k - 1])
            for _ in range(60):
                slope = (error(s * (1 + 1e-7)) - error(s * (1 - 1e-7))) / (2e-7 * s)
                change = error(s) / slope
                s -= change * min(1.0, 0.02 * abs(s) / abs(change))
                if abs(change) < 1e-11 * abs(s):
                    break
            self.roots[k] = s
        return self.roots[k]

    def partial_hz(self, k):
        return self.root(k).imag / (2 * math.pi)

    def decay_per_s(self, k):
        return -self.root(k).real


def motion_of(preset, string, fret):
    return MotionOnBridge(preset, string, fret) if "bridge" in preset else Motion(string, fret)


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
