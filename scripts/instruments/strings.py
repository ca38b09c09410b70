"""The strings of each instrument: pitch, length, linear density, inharmonicity, losses."""
import math

import wire
from wire import note_hz, rounded


def string(name, note, length_m, density, stiffness, t60, **more):
    """One string of a preset. t60: two (Hz, s) points; stiffness: E I in N m^2; more: further keys of the format."""
    frequency_hz = note_hz(note)
    tension_n = wire.tension(density, length_m, frequency_hz)
    return {
        "name": name, "open_note": note, "open_frequency_hz": frequency_hz,
        "length_m": rounded(length_m), "linear_density_kg_per_m": rounded(density, 6),
        "inharmonicity": rounded(wire.inharmonicity(stiffness, tension_n, length_m), 3),
        "damping": {"model": "t60", "points": [{"frequency_hz": rounded(f, 4), "t60_s": rounded(t, 3)} for f, t in t60]},
        **more,
    }


def daddario_string(name, note, length_m, gauge, core_m, t60, **more):
    return string(name, note, length_m, wire.daddario(gauge), wire.bending_stiffness(core_m, wire.STEEL), t60, **more)


def wire_string(name, note, length_m, diameter_m, material, t60, **more):
    return string(name, note, length_m, wire.round_wire_density(diameter_m, material),
                  wire.bending_stiffness(diameter_m, material), t60, **more)


# ------------------------------------------------------------------------------------------------ basses
BASS_LENGTH_M = 0.863  # the published bass of Issanchou et al., JASA 143 (2018)


def bass(t60_low, t60_high):
    """E1 A1 D2 G2. t60_low: one T60 per string at its fundamental; t60_high: at 5 kHz."""
    rows = [("E", 28, "XLB105", 0.61e-3), ("A", 33, "XLB085", 0.56e-3), ("D", 38, "XLB065", 0.51e-3)]
    strings = [daddario_string(name, note, BASS_LENGTH_M, gauge, core, [(note_hz(note), low), (5000, t60_high)])
               for (name, note, gauge, core), low in zip(rows, t60_low)]
    g = string("G", 43, BASS_LENGTH_M, 0.0067, 0.0, [(note_hz(43), t60_low[3]), (5000, t60_high)])
    g["inharmonicity"] = 3.5e-05  # published with the string
    return strings + [g]


# ------------------------------------------------------------------------------------------------ guitars
STEEL_GUITAR_LENGTH_M = 0.645   # 25.4 in, dreadnought
ELECTRIC_GUITAR_LENGTH_M = 0.648  # 25.5 in
CLASSICAL_GUITAR_LENGTH_M = 0.65

# (name, key, gauge, core diameter in m; plain strings are their own core)
STEEL_SET = [("E", 40, "PB053", 0.48e-3), ("A", 45, "PB042", 0.43e-3), ("D", 50, "PB032", 0.38e-3),
             ("G", 55, "PB024", 0.33e-3), ("B", 59, "PL016", 0.406e-3), ("e", 64, "PL012", 0.305e-3)]
ELECTRIC_SET = [("E", 40, "NW046", 0.41e-3), ("A", 45, "NW036", 0.38e-3), ("D", 50, "NW026", 0.36e-3),
                ("G", 55, "PL017", 0.432e-3), ("B", 59, "PL013", 0.330e-3), ("e", 64, "PL010", 0.254e-3)]
# The octave or unison string of each course of the twelve-string.
TWELVE_SET = [(("E", 40, "PB047", 0.46e-3), (12, "PB027", 0.36e-3)), (("A", 45, "PB039", 0.41e-3), (12, "PL018", 0.457e-3)),
              (("D", 50, "PB030", 0.36e-3), (12, "PL012", 0.305e-3)), (("G", 55, "PB023", 0.33e-3), (12, "PL008", 0.203e-3)),
              (("B", 59, "PL014", 0.356e-3), (0, "PL014", 0.356e-3)), (("e", 64, "PL010", 0.254e-3), (0, "PL010", 0.254e-3))]


def guitar(rows, length_m, t60_low, t60_high):
    return [daddario_string(name, note, length_m, gauge, core, [(note_hz(note), low), (5000, t60_high)])
            for (name, note, gauge, core), low in zip(rows, t60_low)]


# Woodhouse, Acta Acustica 90 (2004), strings of a classical guitar: linear density kg/m, E I in N m^2, and the loss factors
# of eta = (T (eta_F + eta_A/omega) + E I eta_B (k pi/L)^2)/(T + E I (k pi/L)^2).
NYLON_SET = [("E", 40, 6.24e-3, 57e-6, 2e-5, 1.2, 2.0e-2), ("A", 45, 3.61e-3, 40e-6, 7e-5, 0.9, 2.5e-2),
             ("D", 50, 1.95e-3, 51e-6, 5e-5, 1.2, 2.0e-2), ("G", 55, 0.90e-3, 310e-6, 14e-5, 1.7, 2.0e-2),
             ("B", 59, 0.52e-3, 160e-6, 40e-5, 1.2, 2.0e-2), ("e", 64, 0.38e-3, 130e-6, 40e-5, 1.5, 2.4e-2)]


def nylon_t60(note, density, stiffness, eta_f, eta_a, eta_b, at_hz, length_m):
    """T60 of the string's own losses at a frequency."""
    tension_n = wire.tension(density, length_m, note_hz(note))
    k = at_hz / note_hz(note)
    bending = stiffness * (k * math.pi / length_m) ** 2
    omega = 2 * math.pi * at_hz
    eta = (tension_n * (eta_f + eta_a / omega) + bending * eta_b) / (tension_n + bending)
    return math.log(1000) / (omega * eta / 2)


def nylon(body_t60_s, high_hz=3000.0):
    """Own losses, and at the fundamental what the body takes, as a T60 of its own."""
    strings = []
    for name, note, density, stiffness, *etas in NYLON_SET:
        own = nylon_t60(note, density, stiffness, *etas, note_hz(note), CLASSICAL_GUITAR_LENGTH_M)
        high = nylon_t60(note, density, stiffness, *etas, high_hz, CLASSICAL_GUITAR_LENGTH_M)
        low = 1 / (1 / own + 1 / body_t60_s)
        strings.append(string(name, note, CLASSICAL_GUITAR_LENGTH_M, density, stiffness,
                              [(note_hz(note), low), (high_hz, min(high, 0.8 * low))]))
    return strings


# ------------------------------------------------------------------------------------------------ India, Japan
SITAR_LENGTH_M = 0.88
# (name, key, diameter m, material, speaking length m). Diameters of 1 to 5: india-instruments.com, "Tuning & Strings".
SITAR_SET = [("kharaj", 37, 0.85e-3, wire.YELLOW_BRASS, 0.88), ("pancham", 44, 0.55e-3, wire.PHOSPHOR_BRONZE, 0.88),
             ("jor", 49, 0.40e-3, wire.PHOSPHOR_BRONZE, 0.88), ("baj", 54, 0.30e-3, wire.STEEL, 0.88),
             ("pancham chikari", 56, 0.27e-3, wire.STEEL, 0.80), ("chikari", 61, 0.25e-3, wire.STEEL, 0.66),
             ("high chikari", 73, 0.22e-3, wire.STEEL, 0.46)]

TANPURA_LENGTH_M = 0.9906  # 39 in: goddenmusic.com, male tamboura, with its gauges .022, .020, .020, .028 in
TANPURA_SET = [("Pa", 43, 0.5588e-3, wire.PHOSPHOR_BRONZE), ("Sa", 48, 0.508e-3, wire.STEEL),
               ("Sa'", 48, 0.508e-3, wire.STEEL), ("low Sa", 36, 0.7112e-3, wire.PHOSPHOR_BRONZE)]

BIWA_LENGTH_M = 0.71
BIWA_SET = [("1", 43, 1.55e-3), ("2", 43, 1.55e-3), ("3", 48, 1.25e-3), ("4", 55, 0.80e-3)]


def sitar(t60_low, t60_high):
    return [wire_string(name, note, length, diameter, material, [(note_hz(note), t60_low), (4000, t60_high)])
            for name, note, diameter, material, length in SITAR_SET]


def tanpura(t60_low, t60_high):
    return [wire_string(name, note, TANPURA_LENGTH_M, diameter, material, [(note_hz(note), t60_low), (4000, t60_high)])
            for name, note, diameter, material in TANPURA_SET]


def biwa(t60_low, t60_high):
    return [wire_string(name, note, BIWA_LENGTH_M, diameter, wire.SILK, [(note_hz(note), t60_low), (2000, t60_high)])
            for name, note, diameter in BIWA_SET]


# ------------------------------------------------------------------------------------------------ keyboards
def interpolated(key, table):
    """Log-linear between (key, value) rows: scalings are straight lines on the makers' log paper."""
    rows = sorted(table.items())
    for (k0, v0), (k1, v1) in zip(rows, rows[1:]):
        if k0 <= key <= k1:
            return v0 * (v1 / v0) ** ((key - k0) / (k1 - k0))
    raise ValueError(f"key {key} outside the table")


def stepped(key, table):
    """The value of the highest row at or below the key."""
    return table[max(k for k in table if k <= key)]
