"""Bodies and soundboards as tables of modes: a few named resonances, then as many as a plate of that size has.

The engine drives each mode, an oscillator of 1 kg, with the force on the bridge and hears its velocity. A mode's gain is
therefore its radiation over its modal mass; the tables give it relative to the first resonance.
"""
import json
import math
import pathlib

from wire import rounded

GOLDEN = (math.sqrt(5) - 1) / 2


def scattered(index):
    """Quasi-random in 0..1, the same on every run: fractional parts of multiples of the golden ratio."""
    return (0.5 + index * GOLDEN) % 1.0


def mode(frequency_hz, q, left, right):
    return {"frequency_hz": rounded(frequency_hz), "t60_s": rounded(math.log(1000) * q / (math.pi * frequency_hz), 3),
            "gain_left": rounded(left, 3), "gain_right": rounded(right, 3)}


def heard(index, gain):
    """Gains left and right of a mode: two ears (or microphones) hear each mode by its shape and place, from an angle of its own between
    -20 and 110 degrees. No mode is lost in mono, and the sides are nearly independent: their correlation is the mean of the sine of twice the
    angle, 0.34."""
    angle = math.radians(-20 + 130 * scattered(2 * index + 7))
    return math.sqrt(2) * gain * math.cos(angle), math.sqrt(2) * gain * math.sin(angle)


HIGHEST_HZ = 12000


def plate_modes(low_hz, spacing_hz, widen_hz, loss_factor, gain, knee_hz):
    """Modes of constant density up to widen_hz, then of a spacing that grows with frequency: there they overlap anyway.

    Gains make the mean response flat from low_hz to knee_hz (radiation gains what mobility loses) and let it fall by
    6 dB per octave above, where the bridge's mass takes over.
    """
    modes, place, i = [], low_hz, 0
    while place < HIGHEST_HZ:
        step = spacing_hz * max(1.0, place / widen_hz)
        f = place + step * scattered(i)
        flat = math.sqrt(f / low_hz) * math.sqrt(max(1.0, f / widen_hz))
        g = gain * flat * min(1.0, knee_hz / f)
        sign = 1 if scattered(3 * i + 1) < 0.5 else -1
        modes.append(mode(f, 1 / loss_factor, *heard(i, sign * g)))
        place, i = place + step, i + 1
    return modes


def body(named, plate):
    """named: (Hz, Q, gain) rows; plate: arguments of plate_modes."""
    return [mode(f, q, *heard(-1 - i, g)) for i, (f, q, g) in enumerate(named)] + plate_modes(*plate)


# Radiation by frequency, fitted to recorded sets by scripts/voice.py --fit: a factor in dB at each third octave from 100 Hz to 8 kHz.
FITTED = pathlib.Path(__file__).with_name("fitted.json")
fits = json.loads(FITTED.read_text()) if FITTED.exists() else {}


def radiation_db(name, frequency_hz):
    """Between the third octaves on a straight line over log frequency, beyond them constant."""
    levels = fits[name].get("third_octaves_db", [0.0, 0.0])
    place = min(max(3 * math.log2(frequency_hz / 100), 0.0), len(levels) - 1.0)
    low = min(int(place), len(levels) - 2)
    return levels[low] + (place - low) * (levels[low + 1] - levels[low])


def fitted(name, modes):
    """The modes with the radiation that was fitted for an instrument, if one was."""
    if name not in fits:
        return modes
    turned = 10 ** (fits[name].get("left_over_right_db", 0.0) / 40)
    evened = fits[name].get("modes_db", [0.0] * len(modes))
    factors = [10 ** ((radiation_db(name, row["frequency_hz"]) + change) / 20) for row, change in zip(modes, evened, strict=True)]
    return [{**row, "gain_left": rounded(row["gain_left"] * factor / turned, 3), "gain_right": rounded(row["gain_right"] * factor * turned, 3)}
            for row, factor in zip(modes, factors)]


def source(name, text):
    """Where the body comes from."""
    if "third_octaves_db" not in fits.get(name, {}):
        return text
    fit = fits[name]
    return (f"{text}; radiation by frequency fitted to {fit['to']}, distance {fit['distance_db']:g} dB per third octave after {fit['before_db']:g} "
            "(scripts/voice.py --fit)")


def coloured(name, content):
    """A preset without a body with the coils and the exciter that were fitted to recorded sets, if they were."""
    fit = fits.get(name, {})
    if "pickups" not in fit:
        return content
    text = f"chosen: fitted to {fit['to']}, distance {fit['distance_db']:g} dB per third octave after {fit['before_db']:g} (scripts/voice.py --fit)"

    def changed(row, values):
        return {**row, **values, "provenance": {**row["provenance"], **{key: text for key in values}}}

    values = {key: value for key, value in fit["exciter"].items() if key != "name"}
    return {**content, "pickups": [changed(row, fit["pickups"]) for row in content["pickups"]],
            "exciters": [changed(row, values) if row["name"] == fit["exciter"]["name"] else row for row in content["exciters"]]}


def levelled(name, rows):
    """The strings with the levels that make an instrument even, if they were fitted: a factor of each string's signals."""
    levels = fits.get(name, {}).get("string_levels_db", {})
    return [{**row, "level": rounded(10 ** (levels[row["name"]] / 20), 3)} if row["name"] in levels else row for row in rows]


# Where a bridge moves: the highest mode that moves it [Hz]. Above, the bridge's mass takes over, and modes only listen.
MOVING_HZ = 2500


def moving(modes, named_kg, plate_kg, strings, tilts):
    """The modes up to MOVING_HZ with masses at the bridge and shapes along it. A mode's gain is its radiation per force on 1 kg; on its own
    mass it moves less, and radiates as much. The named ones move the bridge as a whole and tilt it by `tilts`; those of the plate have a
    tilt of their own."""
    moved = []
    for index, row in enumerate(modes):
        if row["frequency_hz"] > MOVING_HZ:
            moved.append(row)
            continue
        mass = named_kg[index] if index < len(named_kg) else plate_kg
        tilt = tilts[index] if index < len(tilts) else 1.6 * (scattered(5 * index + 3) - 0.5)
        shape = [rounded(1 + tilt * (2 * s / (strings - 1) - 1), 3) for s in range(strings)]
        moved.append({**row, "gain_left": rounded(row["gain_left"] * mass, 3), "gain_right": rounded(row["gain_right"] * mass, 3),
                      "mass_kg": mass, "shape": shape})
    return moved


# Classical guitar: first resonances in the order measured on many instruments (air near 100 Hz, first top plate near
# 190 Hz: Christensen and Vistisen, JASA 68 (1980); Wright, thesis, Cardiff (1996)); these very numbers are chosen.
CLASSICAL_GUITAR = body([(98, 15, 1.0), (187, 18, 1.3), (232, 25, 0.5), (290, 30, 0.35), (385, 30, 0.5), (475, 30, 0.3)],
                        (520, 52, 2500, 0.030, 0.16, 2500))
# Dreadnought, X-braced: larger and stiffer; chosen likewise.
STEEL_GUITAR = body([(102, 18, 1.0), (193, 22, 1.3), (234, 28, 0.5), (330, 32, 0.4), (392, 35, 0.5), (480, 35, 0.3)],
                    (520, 48, 2500, 0.024, 0.16, 3500))
# Masses at the bridge, chosen: with the strings' levels, 0.7 to 1.9, by which each string acts on the bridge, those of the named modes make
# their peaks of the mobility, level^2 Q/(m omega), at most 0.07 s/kg, so that no note dies at once on one; those of the air and of the first
# top plate are heavier, else the notes on them would be two, beside their pitch (wolves). Those of the plate make its mean above 500 Hz
# level^2/(4 m df), df the modes' spacing.
GUITAR_KG = [4, 1.5, 0.85, 0.8, 0.6, 0.5]
GUITAR_TILTS = [0, 0.1, 0.9, 0.3, -0.5, 0.4]
# Gourd and thin wooden face (sitar, tanpura): chosen.
SITAR = body([(108, 12, 0.5), (196, 16, 1.0), (287, 20, 0.8), (420, 22, 0.7)], (480, 62, 2500, 0.030, 0.25, 4500))
TANPURA = body([(92, 12, 0.7), (168, 16, 1.0), (243, 20, 0.8), (360, 22, 0.7)], (420, 58, 2500, 0.028, 0.25, 4500))
# Shallow lute body of hard wood: chosen.
BIWA = body([(190, 12, 0.6), (310, 15, 1.0), (445, 18, 0.9), (610, 20, 0.6)], (700, 70, 2500, 0.035, 0.30, 4000))
# Harpsichord: Savage, Kottick, Hendrickson and Marshall, JASA 91 (1992), counted 36 soundboard modes up to 600 Hz, with a
# sound output "reasonably flat" from 50 to 2000 Hz: that density and flatness; loss factor and positions are chosen.
HARPSICHORD = body([(52, 20, 0.6), (76, 22, 0.8)], (88, 16.7, 1000, 0.025, 0.20, 3500))
CLAVICHORD = body([(110, 18, 0.7), (205, 20, 1.0), (310, 22, 0.8)], (360, 45, 2500, 0.028, 0.25, 3500))
DULCIMER = body([(96, 18, 0.7), (158, 20, 1.0), (225, 22, 0.8), (305, 25, 0.8)], (340, 50, 2500, 0.022, 0.25, 4500))
PIANO = body([(49, 20, 0.8), (83, 22, 1.0)], (95, 24, 1200, 0.020, 0.25, 2000))
