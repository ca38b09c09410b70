"""Electric basses: fretted, fretless, slapped."""
import frets
import strings
from parts import finger, from_bridge, hammer, hand, noise, quality, rough, sourced, velocity_pickup, with_sources
from wire import DADDARIO_SOURCE, rounded

JASA = "published (Issanchou, Acary, Perignon, Touze, Le Carrou, JASA 143 (2018) 131)"
LENGTH = strings.BASS_LENGTH_M
GAUGES = ["XLB105", "XLB085", "XLB065"]
CORES = ["0.61", "0.56", "0.51"]

FRETTED_HEIGHTS = [
    -0.00063, -0.00088, -0.00113, -0.00133, -0.00158, -0.00173, -0.00188, -0.00198, -0.00213, -0.00218,
    -0.00223, -0.00233, -0.00233, -0.00233, -0.00233, -0.00233, -0.00233, -0.002335, -0.002335, -0.002335,
]


def sourced_strings(rows, damping):
    return with_sources(
        rows, open_frequency_hz="published: standard tuning, A4 at 440 Hz", length_m=JASA,
        linear_density_kg_per_m=[DADDARIO_SOURCE.format(gauge) for gauge in GAUGES] + [JASA],
        inharmonicity=[f"chosen: B = pi^2 E I/(T L^2) of an assumed steel core of {core} mm" for core in CORES] + [JASA],
        damping=damping)


def plain_finger(position_m, height_m, **given):
    return finger("finger", from_bridge(position_m), 0.012, 0.006, 0.0006, height_m, 1.7, 1.0, given=given, **rough(0.03))


def player(release_t60_s, dead_t60_s=0.04):
    return hand(release_t60_s, palm_t60_s=0.25, dead_t60_s=dead_t60_s, harmonic_t60_s=0.05, harmonic_touch_s=0.15, legato_level=0.3,
                pressure_semitones=0.5, **noise(0.5, 0.06))


def fretted():
    return {
        "name": "Fretted bass",
        "comment": ["A four-string electric bass with 20 frets; the strings strike the frets.",
                    "At velocity 30 no string touches a fret; at velocity 127 every string strikes them hard."],
        **quality(1000000, 80000), "studio": quality(2000000, 120000),
        "frets": sourced({"count": 20, "height_m": FRETTED_HEIGHTS}, height_m=JASA),
        "exciters": [plain_finger(0.16, 0.004, full_height_m="chosen: the published bass is lifted by 3.6 mm")],
        "hand": player(0.12),
        "pickups": [velocity_pickup(0.13, 0.02, 1, "split coil in the middle position")],
        "strings": sourced_strings(strings.bass([11, 10, 9, 8.5], 0.85), "chosen: typical of new round-wound strings, not measured"),
    }


FRETLESS_STOPS = 24
BOARD = {"first_m": 0.0006, "twelfth_m": 0.0019, "relief_m": 0.00015}


def board_height(x_m):
    return rounded(frets.below_line(LENGTH, x_m, **BOARD))


def fretless():
    end_m = frets.fret_position(LENGTH, FRETLESS_STOPS)
    corners = [[rounded(x), board_height(x)] for x in (0.01 + (end_m - 0.01) * i / 12 for i in range(13))]
    surface = "chosen: a board 0.6 mm below the string at the first stop, 1.9 mm at the twelfth, relief 0.15 mm"
    return {
        "name": "Fretless bass",
        "comment": ["The fretted bass without frets: a finger stops the string on the board, and in front of the finger the string grazes the "
                    "board.",
                    "Stops are at equal temperament; slides and vibrato reach the pitches between them by retuning."],
        **quality(500000, 20000), "studio": quality(1000000, 60000),
        "frets": {"count": FRETLESS_STOPS},
        "obstacles": [sourced({"name": "fingerboard", "origin": "nut", "side": "below", "profile_m": corners, "points": 64},
                              profile_m=surface)],
        "exciters": [plain_finger(0.17, 0.0035)],
        "hand": player(0.15),
        "pickups": [velocity_pickup(0.12, 0.02, 1, "single coil near the bridge"),
                    velocity_pickup(0.19, 0.02, 0.6, "second single coil, lower")],
        "strings": sourced_strings(strings.bass([7.0, 6.5, 6.0, 5.5], 0.5),
                                   "chosen: about half of the fretted bass's, as flesh instead of a fret ends the string"),
    }


def slap():
    thumb = hammer("thumb", from_bridge(0.27), 0.015, 0.008, 1e7, 1.5, 0.1, 6.0, 1.3, side="above", string_range=[0, 1],
                   given={"position_from_bridge_m": "chosen: over the last fret", "mass_kg": "chosen: the moving part of a thumb",
                          "full_speed_m_per_s": "chosen: throws the string onto the last frets",
                          "exponent": "chosen: Hertz's contact of bone under skin"})
    pop = finger("pop", from_bridge(0.20), 0.010, 0.008, 0.0003, 0.0075, 1.3, 2.0, string_range=[2, 3],
                 given={"full_height_m": "chosen: pulled away from the board and let go, so that the string strikes the frets"})
    return {
        "name": "Slap bass",
        "comment": ["The fretted bass with newer strings and lower frets. The thumb strikes E and A near the neck's end, D and G are popped.",
                    "Articulation 1 is the thumb, 2 the pop, 3 the finger."],
        **quality(1000000, 80000), "studio": quality(2000000, 120000),
        "frets": sourced({"count": 20, "height_m": frets.fret_heights(LENGTH, 20, 0.0005, 0.0016, 0.0001)},
                         height_m="chosen: a low set-up, 0.5 mm at the first fret, 1.6 mm at the twelfth"),
        "exciters": [thumb, pop, plain_finger(0.16, 0.004)],
        "hand": player(0.09, 0.03),
        "pickups": [velocity_pickup(0.092, 0.02, 1, "bridge single coil"), velocity_pickup(0.165, 0.02, 1, "neck single coil")],
        "strings": sourced_strings(strings.bass([12, 11, 10, 9], 1.4), "chosen: stainless strings, brighter than the fretted bass's"),
    }


INSTRUMENTS = {"bass-fretted": fretted, "bass-fretless": fretless, "bass-slap": slap}
