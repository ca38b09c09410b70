"""Wire: mass per length, bending stiffness and inharmonicity, and where the numbers come from."""
import math

KG_PER_M_OF_LB_PER_IN = 0.45359237 / 0.0254

# Unit weights in lb/in as D'Addario publishes them (A Complete Technical Reference for Fretted Instrument String Tensions,
# tables PL, NW, PB, XLB). PL plain steel, NW nickel-plated round wound, PB phosphor bronze round wound, XLB bass round wound;
# the number is the gauge in thousandths of an inch.
DADDARIO_LB_PER_IN = {
    "PL008": 1.418e-05, "PL010": 2.215e-05, "PL012": 3.190e-05, "PL013": 3.744e-05, "PL014": 4.342e-05,
    "PL016": 5.671e-05, "PL017": 6.402e-05, "PL018": 7.177e-05,
    "NW026": 1.2671e-04, "NW036": 2.3964e-04, "NW046": 3.8216e-04,
    "PB023": 1.0801e-04, "PB024": 1.1682e-04, "PB027": 1.4834e-04, "PB030": 1.8660e-04, "PB032": 2.1018e-04,
    "PB039": 3.1125e-04, "PB042": 3.6722e-04, "PB047": 4.5289e-04, "PB053": 5.6962e-04,
    "XLB065": 7.9569e-04, "XLB085": 1.33702e-03, "XLB105": 1.98395e-03,
}
DADDARIO_SOURCE = "published (D'Addario, A Complete Technical Reference for Fretted Instrument String Tensions: unit weight of {})"

# Density kg/m^3 and Young's modulus Pa: handbook values of the materials.
STEEL = (7850.0, 2.0e11)
IRON = (7870.0, 2.0e11)
PHOSPHOR_BRONZE = (8800.0, 1.1e11)
YELLOW_BRASS = (8500.0, 1.0e11)
RED_BRASS = (8700.0, 1.1e11)
SILK = (1300.0, 1.0e9)  # twisted fibres slide on each other: an effective modulus, chosen


def note_hz(key):
    """Equal temperament, A4 (key 69) at 440 Hz."""
    return 440.0 * 2 ** ((key - 69) / 12)


def daddario(gauge):
    """Linear density in kg/m."""
    return DADDARIO_LB_PER_IN[gauge] * KG_PER_M_OF_LB_PER_IN


def round_wire_density(diameter_m, material):
    """Linear density of a round wire in kg/m."""
    return material[0] * math.pi / 4 * diameter_m ** 2


def bending_stiffness(diameter_m, material):
    """E I of a round wire in N m^2."""
    return material[1] * math.pi * diameter_m ** 4 / 64


def tension(density_kg_per_m, length_m, frequency_hz):
    """Of a flexible string, in N."""
    return density_kg_per_m * (2 * length_m * frequency_hz) ** 2


def inharmonicity(stiffness_n_m2, tension_n, length_m):
    """B = pi^2 E I/(T L^2)."""
    return math.pi ** 2 * stiffness_n_m2 / (tension_n * length_m ** 2)


def rounded(value, digits=4):
    """To significant digits: no preset claims more than is known."""
    return 0.0 if value == 0 else float(f"{value:.{digits - 1}e}")
