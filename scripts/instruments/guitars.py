"""Guitars: steel, nylon, electric, twelve strings."""
import body
import frets
import strings
from parts import (SOFTER, SOFTER_PLECTRUM, finger, from_bridge, hand, noise, panned, quality, rough, sourced, velocity_pickup,
                   with_sources)
from wire import DADDARIO_SOURCE

TUNING = "published: standard tuning, A4 at 440 Hz"
CORE = "chosen: B = pi^2 E I/(T L^2) of the plain wire, or of an assumed steel core of about 0.4 of the gauge under windings"
BODY = {"body": "chosen: first resonances in the order that is measured on many guitars (Christensen and Vistisen, JASA 68 (1980) 758), above "
                "them a plate's constant density of modes (scripts/instruments/body.py)"}
WOODHOUSE = "published (Woodhouse, Acta Acustica united with Acustica 90 (2004) 945: strings of a classical guitar)"


BRIGHTENING = {key: "chosen: level from 5 to 10 kHz and centroid, soft and loud, near those of the recorded sets (docs/voicing.md)"
               for key in ("width_m", "release_s", "full_height_m", "time_exponent", "roughness")}


def plectrum(from_bridge_m, height_m, release_s):
    return finger("plectrum", from_bridge(from_bridge_m), 0.002, 0.004, release_s, height_m, 1.4, 0.5, **SOFTER_PLECTRUM, **rough(0.04))


def player(release_t60_s=0.12, **more):
    return hand(release_t60_s, palm_m=0.02, palm_t60_s=0.15, dead_t60_s=0.03, harmonic_t60_s=0.03, harmonic_touch_s=0.12, legato_level=0.3,
                pressure_semitones=1, **noise(0.045, 0.06), **more)


def fret_board(length_m, count, first_m, twelfth_m, relief_m):
    return sourced({"count": count, "height_m": frets.fret_heights(length_m, count, first_m, twelfth_m, relief_m)},
                   height_m=f"chosen: a usual set-up, {1000 * first_m:.2f} mm at the first fret, {1000 * twelfth_m:.1f} mm at the twelfth, relief "
                            f"{1000 * relief_m:.2f} mm")


def daddario_sources(rows, gauges, length, damping, tuning=TUNING):
    return with_sources(rows, open_frequency_hz=tuning, length_m=length, inharmonicity=CORE, damping=damping,
                        linear_density_kg_per_m=[DADDARIO_SOURCE.format(gauge) for gauge in gauges])


def steel():
    length = strings.STEEL_GUITAR_LENGTH_M
    rows = strings.guitar(strings.STEEL_SET, length, [6.5, 6, 5.5, 4.5, 4, 3.5], 0.7)
    return {
        "name": "Steel-string guitar",
        "comment": ["A dreadnought with light phosphor-bronze strings and a hard plectrum; the action is low enough to buzz at velocity 127.",
                    "Articulation 1 is the plectrum, 2 the finger."],
        **quality(192000, 20000), "studio": quality(2000000, 80000), "provenance": BODY,
        "frets": fret_board(length, 20, 0.00055, 0.0022, 0.00015),
        "exciters": [plectrum(0.13, 0.0025, 0.0001), finger("finger", from_bridge(0.15), 0.008, 0.006, 0.0004, 0.0025, 1.4, 0.8, **SOFTER, **rough(0.02))],
        "hand": player(), "body": body.STEEL_GUITAR,
        "strings": panned(daddario_sources(rows, [row[2] for row in strings.STEEL_SET], "chosen: 25.4 in, usual for dreadnoughts",
                                           "chosen: string and body together, not measured"), 0.25),
    }


def nylon():
    length = strings.CLASSICAL_GUITAR_LENGTH_M
    rows = with_sources(strings.nylon(4.0), open_frequency_hz=TUNING, length_m=WOODHOUSE, linear_density_kg_per_m=WOODHOUSE,
                        inharmonicity=WOODHOUSE + ": B = pi^2 E I/(T L^2)",
                        damping=WOODHOUSE + ": T60 at 3 kHz from the three loss factors; at the fundamental joined with a chosen 4 s that the "
                                            "body takes")
    return {
        "name": "Classical guitar",
        "comment": ["Nylon strings plucked by a fingertip. High action: it touches the frets only when plucked hard.",
                    "Articulation 1 is the fingertip, 2 the nail near the bridge."],
        **quality(300000, 16000), "studio": quality(1000000, 40000), "provenance": BODY,
        "frets": fret_board(length, 19, 0.0009, 0.0038, 0.0001),
        "exciters": [finger("fingertip", from_bridge(0.11), 0.002, 0.006, 0.0001, 0.0018, 1.3, 0.5, **rough(0.005), time_exponent=1,
                            given=BRIGHTENING),
                     finger("nail", from_bridge(0.07), 0.003, 0.005, 0.00015, 0.002, 1.3, 0.5, **SOFTER, **rough(0.03))],
        "hand": player(), "body": body.CLASSICAL_GUITAR, "strings": panned(rows, 0.25),
    }


def coupled():
    """The classical guitar on a bridge that moves: an example, no preset."""
    return {**nylon(), "name": "Classical guitar on a moving bridge",
            "comment": ["The classical guitar with the body's modes up to 2.5 kHz on the bridge: strings drive each other, open ones ring along."],
            "bridge": {"open_strings": 0.9}, "masses": (body.GUITAR_KG, 0.45), "tilts": body.GUITAR_TILTS}


def electric():
    length = strings.ELECTRIC_GUITAR_LENGTH_M
    rows = strings.guitar(strings.ELECTRIC_SET, length, [10, 10, 9, 8, 7, 6], 1.0)
    return {
        "name": "Electric guitar",
        "comment": "Solid body, nickel-wound strings, single coils at the bridge and at the neck; no amplifier. The pickup mix goes from one "
                   "to the other.",
        **quality(500000, 40000), "studio": quality(2000000, 80000),
        "frets": fret_board(length, 22, 0.0004, 0.0017, 0.00015),
        "exciters": [plectrum(0.10, 0.002, 0.0002)],
        "hand": player(0.1),
        "pickups": [velocity_pickup(0.045, 0.012, 1, "bridge single coil", magnet_distance_m=0.012),
                    velocity_pickup(0.16, 0.012, 0.8, "neck single coil", magnet_distance_m=0.012)],
        "strings": daddario_sources(rows, [row[2] for row in strings.ELECTRIC_SET], "chosen: 25.5 in",
                                    "chosen: a rigid body takes little; not measured"),
    }


def twelve():
    length = strings.STEEL_GUITAR_LENGTH_M
    rows, gauges, tunings = [], [], []
    for course, ((name, note, gauge, core), (up, other_gauge, other_core)) in enumerate(strings.TWELVE_SET):
        low = [6.0, 5.5, 5.0, 4.5, 4.0, 3.5][course]
        first = strings.daddario_string(name, note, length, gauge, core, [(strings.note_hz(note), low), (5000, 0.7)])
        second = strings.daddario_string(name + "'", note + up, length, other_gauge, other_core,
                                         [(strings.note_hz(note + up), 0.8 * low), (5000, 0.7)])
        pan = 0.3 * (course / 2.5 - 1)
        rows += [{**first, "course": course, "pan": round(pan - 0.1, 3)}, {**second, "course": course, "pan": round(pan + 0.1, 3), "excitation": 0.8}]
        gauges += [gauge, other_gauge]
        tunings += [TUNING, TUNING]
        if up == 0:
            rows[-1]["open_frequency_hz"] *= 2 ** (1.2 / 1200)
            tunings[-1] = "chosen: 1.2 cents above its partner, as no unison tuned by hand is one"
    return {
        "name": "Twelve-string guitar",
        "comment": "The steel-string guitar with six courses: octaves on E, A, D, G, unisons on B and e. The plectrum crosses a course in 4 ms.",
        **quality(400000, 30000), "studio": quality(1000000, 60000), "provenance": BODY,
        "frets": fret_board(length, 20, 0.0006, 0.0024, 0.00015),
        "exciters": [plectrum(0.13, 0.0022, 0.0001)],
        "hand": player(course_delay_s=0.004), "body": body.STEEL_GUITAR,
        "strings": daddario_sources(rows, gauges, "chosen: 25.4 in", "chosen: string and body together, not measured", tunings),
    }


INSTRUMENTS = {"guitar-steel": steel, "guitar-nylon": nylon, "guitar-electric": electric, "guitar-12": twelve}
