"""Sitar, tanpura and biwa: strings that graze a surface all the time."""
import body
import strings
from parts import SOFTER, finger, from_bridge, hand, noise, panned, quality, rough, share, sourced, with_sources

BODY = {"body": "chosen (scripts/instruments/body.py)"}
SOLID = "chosen: B = pi^2 E I/(T L^2) of a solid wire"
INDIA = "published (india-instruments.com, Tuning & Strings)"
GODDEN = "published (goddenmusic.com, Tamboura Tuning: male tamboura)"


def player(release_t60_s, **more):
    return hand(release_t60_s, palm_t60_s=0.2, dead_t60_s=0.03, harmonic_t60_s=0.04, harmonic_touch_s=0.15, legato_level=0.3, **more)


def sitar():
    rows = with_sources(strings.sitar(8.0, 1.5), open_frequency_hz=INDIA + ": kharaj pancham, tonic C sharp", inharmonicity=SOLID,
                        linear_density_kg_per_m=[INDIA + f": {gauge}" for gauge in ("0.85 mm brass", "0.55 mm bronze", "0.40 mm bronze",
                                                                                    "0.30 mm steel", "0.27 mm steel")] + ["chosen: 0.25 mm steel",
                                                                                                                         "chosen: 0.22 mm steel"],
                        length_m=["chosen"] * 4 + ["chosen: the peg stands along the neck"] * 3)
    return {
        "name": "Sitar",
        "comment": ["Kharaj-pancham stringing with C sharp as tonic. Baj (F sharp 3) and jor (C sharp 3) are stopped at semitones, the other "
                    "strings are open. No sympathetic strings: strings do not drive each other through the bridge yet.",
                    "The bridge is a parabola that starts at the end of the string. A loud note wraps over much of it; as the note decays the "
                    "string unrolls, and the partials that this excites change."],
        **quality(400000, 22000), "studio": quality(1000000, 60000), "provenance": BODY,
        "frets": {"count": 0},
        "obstacles": [sourced({"name": "jawari bridge", "origin": "bridge", "side": "below",
                               "parabola": {"length_m": 0.020, "drop_m": 0.00015, "height_m": 0.0}, "points": 12},
                              parabola="chosen: the published shape (buckinghammusic.com, sitar tutorial: 'a parabola', 'curved down about one "
                                       "millimetre' over 25 mm), made flatter until a long note keeps buzzing")],
        "exciters": [finger("mizrab", from_bridge(0.09), 0.002, 0.003, 0.0001, 0.003, 1.3, 0.3, **SOFTER, **rough(0.04))],
        "hand": player(0.15, pressure_semitones=3, **noise(0.015, 0.06)), "body": body.SITAR,
        "strings": panned([{**row, **({"frets": {"count": 24}} if row["name"] in ("baj", "jor") else {})} for row in rows], 0.2),
    }


def tanpura():
    rows = with_sources(strings.tanpura(10.0, 3.5), length_m=GODDEN + ": 39 in", inharmonicity=SOLID,
                        open_frequency_hz="chosen: Sa at C within the page's range of A sharp to D",
                        linear_density_kg_per_m=[GODDEN + f": {gauge}" for gauge in (".022 in phosphor bronze", ".020 in steel", ".020 in steel",
                                                                                     ".028 in phosphor bronze")])
    return {
        "name": "Tanpura",
        "comment": ["Four open strings, Pa Sa Sa low Sa with C as tonic: keys 43, 48, 48 and 36. Note-off does not damp.",
                    "A two-point bridge. The string ends at the back of the bridge. A cotton thread (jiva), 4 mm before the end, damps the part "
                    "behind the crest. The string just grazes the crest, 10 mm before the end."],
        **quality(300000, 20000), "studio": quality(1000000, 60000), "provenance": BODY,
        "frets": {"count": 0},
        "obstacles": [sourced({"name": "bridge", "origin": "bridge", "side": "below",
                               "profile_m": [[0.010, 0.0], [0.012, -1.2e-05], [0.014, -5e-05], [0.016, -0.00011]], "points": 0},
                              profile_m="published two-point bridge (Issanchou, Bilbao, Le Carrou, Touze, Doare, JSV 393 (2017): a point near the "
                                        "string's end at rest height); the fall in front of it is chosen")],
        "soft_touches": [sourced({"name": "jiva thread", **from_bridge(0.004), "width_m": 0.0005, "damping_kg_per_s": 0.012})],
        "exciters": [finger("finger", share(0.45), 0.012, 0.02, 0.001, 0.005, 1.3, 0.5, **SOFTER, **rough(0.02))],
        "hand": player(0.5, damps=False), "body": body.TANPURA, "strings": panned(rows, 0.2),
    }


def biwa():
    rows = with_sources(strings.biwa(2.8, 0.5), open_frequency_hz="published (funade-en.jimdo.com, About Satsuma Biwa: G, G, c, g)",
                        length_m="chosen", linear_density_kg_per_m="chosen: round silk of 1300 kg/m^3, diameter for about 50 N",
                        inharmonicity="chosen: B of a solid string with an effective modulus of 1 GPa", damping="chosen: silk dies fast")
    return {
        "name": "Biwa",
        "comment": ["Satsuma biwa with silk strings G G c g. The sawari is the broad top of the nut and of each fret, shaved until the string "
                    "grazes it: the same surface in front of the nut or fret that stops the string.",
                    "Stops are at semitones: each pitch that a player reaches between the high frets by pressing has its own speaking length."],
        **quality(400000, 20000), "studio": quality(1000000, 50000), "provenance": BODY,
        "frets": {"count": 12},
        "obstacles": [sourced({"name": "sawari", "origin": "stop", "side": "below",
                               "parabola": {"length_m": 0.008, "drop_m": 0.00006, "height_m": 0.0}, "points": 8},
                              parabola="chosen size and curve for a published mechanism (Taguti, Acoust. Sci. Tech. 29 (2008) 203: a surface of very "
                                       "small size that the vibrating string touches)")],
        "exciters": [finger("bachi", from_bridge(0.06), 0.003, 0.004, 0.0002, 0.004, 1.2, 0.5, **SOFTER, **rough(0.05))],
        "hand": player(0.15, pressure_semitones=4, **noise(0.12, 0.06)), "body": body.BIWA, "strings": panned(rows, 0.2),
    }


INSTRUMENTS = {"sitar": sitar, "tanpura": tanpura, "biwa": biwa}
