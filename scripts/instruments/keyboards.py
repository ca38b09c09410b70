"""One string or course per key: harpsichord, clavichord, dulcimer, prepared piano."""
import body
import strings
import wire
from parts import finger, hammer, hand, noise, quality, rough, share, sourced
from strings import interpolated, stepped
from wire import note_hz, rounded

def player(release_t60_s, **more):
    return hand(release_t60_s, places=(0.38, 0.47), legato_level=0.0, **more)


def name_of(key):
    return "C C# D D# E F F# G G# A A# B".split()[key % 12] + str(key // 12 - 1)


def pan_of(key, low, high, width):
    return round(width * (2 * (key - low) / (high - low) - 1), 3)


# ------------------------------------------------------------------------------------------------ harpsichord
# Keys F1 to F6 (29 to 89). Lengths in m: 354 mm at c'' (jackrail.space, a copy of the Taskin of 1769 in Edinburgh), octaves
# doubled around it, shortened in the bass to a case of 2.3 m.
HARPSICHORD_LENGTH = {29: 1.79, 36: 1.53, 48: 1.10, 60: 0.68, 72: 0.354, 84: 0.178, 89: 0.134}
# Gauge numbers stamped by Taskin on the Goermans of 1764 (Russell Collection, Edinburgh, HD5-JG1763.29), 8-foot strings; mm of
# each number: trasuntino.blogspot.com, "Stringing practice" (1 to 10), 0 and 00 continued by the ratio 19/17.
HARPSICHORD_GAUGE = {29: "00", 31: "0", 33: "1", 36: "2", 41: "3", 43: "4", 45: "5", 53: "6", 57: "7", 67: "8", 79: "9"}
GAUGE_MM = {"00": 0.65, "0": 0.58, "1": 0.52, "2": 0.46, "3": 0.40, "4": 0.36, "5": 0.33, "6": 0.30, "7": 0.27, "8": 0.25, "9": 0.23}
HARPSICHORD_METAL = {29: wire.RED_BRASS, 40: wire.YELLOW_BRASS, 48: wire.IRON}
HARPSICHORD_PLUCK = {29: 0.10, 36: 0.11, 48: 0.14, 60: 0.19, 72: 0.30, 84: 0.42, 89: 0.46}  # share of the length from the nut
HARPSICHORD_T60 = {29: 9.0, 48: 7.0, 60: 5.5, 72: 3.5, 89: 1.6}
GROUPS = [(29, 32), (33, 36), (37, 40), (41, 44), (45, 48), (49, 52), (53, 56), (57, 60), (61, 64), (65, 68), (69, 72), (73, 76),
          (77, 80), (81, 84), (85, 89)]


def quill(low, high):
    from_nut = interpolated((low + high) / 2, HARPSICHORD_PLUCK)
    return finger(f"quill {name_of(low)} to {name_of(high)}", share(rounded(1 - from_nut, 3)), 0.002, 0.006, 0.00008, 0.0012, 0.3, 0.1, **rough(0.03),
                  string_range=[low - 29, high - 29], given={"position_share": "chosen: a front 8-foot register's usual share"})


def harpsichord():
    rows = []
    for key in range(29, 90):
        length = interpolated(key, HARPSICHORD_LENGTH)
        rows.append(strings.wire_string(name_of(key), key, length, GAUGE_MM[stepped(key, HARPSICHORD_GAUGE)] / 1000,
                                        stepped(key, HARPSICHORD_METAL),
                                        [(note_hz(key), interpolated(key, HARPSICHORD_T60)), (6000, 0.5)],
                                        pan=pan_of(key, 29, 89, 0.4), excitation=rounded(length ** 0.6, 3)))
    return {
        "name": "Harpsichord",
        "comment": ["One 8-foot choir of a French double after Taskin, F1 to F6, at A4 = 440 Hz. The force of the quill limits "
                    "the lift of the string, so velocity has little effect. The jack's felt damps at note-off.",
                    "Exciters are quills for groups of keys, because the plucking point moves from 1/10 of the string in the bass to nearly 1/2."],
        **quality(192000, 22000),
        "provenance": {
            "strings": "published: c'' 354 mm (jackrail.space, Wrong scaling?: a copy of the Taskin of 1769 in Edinburgh); gauge numbers and metals of the "
                       "Goermans/Taskin of 1764/83 (music.ed.ac.uk, Russell Collection HD5-JG1763.29); diameters of the numbers (trasuntino.blogspot.com, "
                       "Stringing practice). Chosen: bass lengths for a case of 2.3 m, damping, excitation, pan. Inharmonicity: B of a solid wire",
            "body": "published density of modes (Savage, Kottick, Hendrickson, Marshall, JASA 91 (1992): 36 up to 600 Hz); the rest is chosen"},
        "frets": {"count": 0},
        "exciters": [quill(low, high) for low, high in GROUPS],
        "hand": player(0.25, **noise(0.003, 0.12)), "body": body.HARPSICHORD, "strings": rows,
    }


# ------------------------------------------------------------------------------------------------ clavichord
# Keys C2 to D6 (36 to 86): 51 notes, unfretted, as on the instrument that d'Alessandro measured. C2 1194 mm: Hubert 1789.
CLAVICHORD_LENGTH = {36: 1.194, 48: 0.86, 60: 0.49, 72: 0.252, 84: 0.128, 86: 0.114}
CLAVICHORD_MM = {36: 0.60, 40: 0.52, 44: 0.46, 48: 0.40, 54: 0.36, 60: 0.33, 66: 0.30, 72: 0.28, 78: 0.25}
CLAVICHORD_METAL = {36: wire.RED_BRASS, 48: wire.YELLOW_BRASS}
CLAVICHORD_T60 = {36: 5.0, 48: 4.0, 60: 3.0, 72: 2.0, 86: 1.0}


def clavichord():
    rows = []
    for key in range(36, 87):
        length = interpolated(key, CLAVICHORD_LENGTH)
        rows.append(strings.wire_string(name_of(key), key, length, stepped(key, CLAVICHORD_MM) / 1000, stepped(key, CLAVICHORD_METAL),
                                        [(note_hz(key), interpolated(key, CLAVICHORD_T60)), (5000, 0.35)],
                                        pan=pan_of(key, 36, 86, 0.3), excitation=rounded((length / 0.49) ** 0.5, 3)))
    return {
        "name": "Clavichord",
        "comment": ["One string per key, C2 to D6. The tangent strikes the string and stays in contact: it is the end of the string and excites it by "
                    "moving. Pressing "
                    "the key raises the pitch (Bebung: channel or key pressure).",
                    "After note-off the cloth beside the tangent damps the whole string."],
        **quality(192000, 20000),
        "provenance": {
            "strings": "published: C2 1194 mm (Bavington, HPSCHD-L, 6 Feb 2017, from Vermeij's Hubert Clavichord Data Book: Hubert 1789). Chosen: other "
                       "lengths, diameters of red brass and from C3 yellow brass, damping, excitation, pan. Inharmonicity: B of a solid wire",
            "body": "chosen (scripts/instruments/body.py)"},
        "frets": {"count": 0},
        "exciters": [sourced({"name": "tangent", "kind": "tangent", "rise_s": 0.0025, "full_height_m": 0.0012, "height_exponent": 0.6,
                              "time_exponent": 0.7}, "chosen: peak velocities up to about 1 m/s")],
        "hand": player(0.3, release_spread=1.5, pressure_semitones=0.6, **noise(0.0003, 0.1)), "body": body.CLAVICHORD,
        "strings": rows,
    }


# ------------------------------------------------------------------------------------------------ dulcimer
# Keys D3 to D6 (50 to 86), chromatic, two strings a course. Music wire gauges 5 to 8 are 0.014, 0.016, 0.018, 0.020 in.
DULCIMER_LENGTH = {50: 0.95, 60: 0.66, 67: 0.46, 74: 0.32, 86: 0.165}
DULCIMER_INCH = {50: 0.028, 54: 0.024, 57: 0.022, 60: 0.020, 67: 0.018, 74: 0.016, 81: 0.014}
DULCIMER_METAL = {50: wire.PHOSPHOR_BRONZE, 60: wire.STEEL}
DULCIMER_T60 = {50: 7.0, 62: 5.5, 74: 4.0, 86: 2.2}


def dulcimer():
    rows = []
    for key in range(50, 87):
        length = interpolated(key, DULCIMER_LENGTH)
        for second in (False, True):
            row = strings.wire_string(name_of(key) + ("'" if second else ""), key, length, stepped(key, DULCIMER_INCH) * 0.0254,
                                      stepped(key, DULCIMER_METAL), [(note_hz(key), interpolated(key, DULCIMER_T60)), (6000, 0.6)],
                                      course=key - 50, pan=pan_of(key, 50, 86, 0.4))
            if second:
                row["open_frequency_hz"] *= 2 ** (0.8 / 1200)
            rows.append(row)
    return {
        "name": "Hammered dulcimer",
        "comment": "Chromatic from D3 to D6, two strings per course, bare wooden hammers. There are no dampers: notes continue after note-off.",
        **quality(192000, 22000),
        "provenance": {
            "strings": "published: music wire gauges 8 to 5 upwards from C4, as in makers' lists (R. Davis, A Dulcimer Builder's Do-It-Yourself Guidebook, "
                       "ch. 14). Chosen: bass of phosphor bronze, lengths, damping, pan, the second string 0.8 cents sharp. Inharmonicity: B of a "
                       "solid wire",
            "body": "chosen (scripts/instruments/body.py)"},
        "frets": {"count": 0},
        "exciters": [hammer("wooden hammer", share(0.15), 0.003, 0.002, 2e8, 1.5, 0.05, 3.0, 1.2, given={"exponent": "chosen: Hertz's contact"}),
                     hammer("leather hammer", share(0.15), 0.005, 0.0025, 1e9, 2.3, 0.2, 3.0, 1.2)],
        "hand": player(0.3, damps=False), "body": body.DULCIMER, "strings": rows,
    }


# ------------------------------------------------------------------------------------------------ prepared piano
# Keys C3 to C5 (48 to 72), one string a key. C4: Chaigne and Askenfelt, JASA 95 (1994) 1631: 0.62 m, 3.93 g, 2.97 g hammer.
PIANO_LENGTH = {48: 1.12, 60: 0.62, 72: 0.33}
PIANO_DENSITY = {48: 0.0078, 60: 0.00634, 72: 0.0055}
PIANO_T60 = {48: 5.0, 60: 4.0, 72: 3.0}  # of the recorded sets: partials 1 to 3 die in 3.1 to 3.9 s
BOLTS = [0, 3, 5, 7, 10, 12, 15, 17, 20, 22]       # strings with a bolt: a rattle on both sides
RUBBERS = [1, 4, 8, 13, 18, 23]                     # strings with a rubber wedge


def bolt(string, length_m):
    where = rounded(0.23 * length_m, 3)
    gap = [0.00025, 0.00012, 0.0004][string % 3]
    source = "chosen: a bolt near 0.23 of the string, loose by a fraction of a millimetre"
    return [sourced({"name": f"bolt {string} {side}", "origin": "bridge", "side": side, "profile_m": [[where, height]], "points": 0,
                     "strings": [string]}, profile_m=source) for side, height in (("below", -gap), ("above", gap))]


def prepared():
    rows = []
    for key in range(48, 73):
        length, density = interpolated(key, PIANO_LENGTH), interpolated(key, PIANO_DENSITY)
        rows.append(strings.string(name_of(key), key, length, density, wire.bending_stiffness(1.0e-3, wire.STEEL),
                                   [(note_hz(key), interpolated(key, PIANO_T60)), (5000, 0.6)], pan=pan_of(key, 48, 72, 0.35)))
    chaigne = "published for C4 (Chaigne and Askenfelt, JASA 95 (1994) 1631)"
    return {
        "name": "Prepared piano",
        "comment": ["Two octaves of a piano, C3 to C5, one string per key. Ten strings rattle in loose bolts, rubber wedges damp six, the rest "
                    "are plain: C F G A# are bolts in both octaves, C# E G# rubber."],
        **quality(400000, 20000), "studio": quality(1000000, 50000),
        "provenance": {"strings": chaigne + ": length and density of C4. Chosen: the other keys around it, damping, pan. Inharmonicity: B of a steel "
                                            "core of 1.0 mm",
                       "body": "chosen (scripts/instruments/body.py)"},
        "frets": {"count": 0},
        "obstacles": [row for string in BOLTS for row in bolt(string, rows[string]["length_m"])],
        "soft_touches": [sourced({"name": "rubber wedge", **share(0.18), "width_m": 0.006, "damping_kg_per_s": 1.5, "strings": RUBBERS})],
        "exciters": [hammer("felt hammer", share(0.88), 0.008, 0.00297, 4.5e9, 2.5, 0.1, 5.0, 1.3,
                            given={"position_share": chaigne, "mass_kg": chaigne, "stiffness_N_per_m_p": chaigne, "exponent": chaigne})],
        "hand": player(0.15, **noise(0.12, 0.1)), "body": body.PIANO, "strings": rows,
    }


INSTRUMENTS = {"harpsichord": harpsichord, "clavichord": clavichord, "dulcimer": dulcimer, "prepared": prepared}
