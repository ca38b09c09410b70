"""scripts/voicing/evenness.py knows which mode makes a key loud, and evens keys that single modes lift."""
import pathlib
import sys
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "voicing"))

import evenness  # noqa: E402
import properties  # noqa: E402

RATE_HZ = 48000
KEYS_HZ = [110 * 2 ** (k / 12) for k in range(37)]


def body(changes_db=None):
    """Modes 25 Hz apart, of unequal gain."""
    random = np.random.default_rng(5)
    rows = [{"frequency_hz": f, "t60_s": 0.2, "gain_left": g, "gain_right": 0.5 * g} for f, g in
            zip(np.arange(90, 2200, 25.0), 10 ** (random.uniform(-15, 15, 85) / 20))]
    for row, change in zip(rows, changes_db if changes_db is not None else np.zeros(len(rows))):
        row["gain_left"] *= 10 ** (change / 20)
        row["gain_right"] *= 10 ** (change / 20)
    return rows


def radiated(rows, frequency_hz):
    """Power at a frequency by the modes' own formula, with independent phases."""
    total = 0.0
    for row in rows:
        loss = np.log(1000) / row["t60_s"] / np.pi
        total += (row["gain_left"] ** 2 + row["gain_right"] ** 2) / abs(row["frequency_hz"] ** 2 / frequency_hz - frequency_hz + 1j * loss) ** 2
    return total


def powers(rows):
    """What keys of six partials each give, A-weighted, in the module's bins."""
    table = np.zeros((len(KEYS_HZ), int(evenness.HIGHEST_HZ / evenness.BIN_HZ)))
    for row, first in zip(table, KEYS_HZ):
        for k in range(1, 7):
            row[int(k * first / evenness.BIN_HZ)] += radiated(rows, k * first) * properties.a_weighting(k * first) / k ** 2
    return table


class EvennessTest(unittest.TestCase):
    def test_shares_of_a_key_add_up_to_one_and_go_to_the_nearest_modes(self):
        weights = evenness.shares(body(), powers(body()))
        np.testing.assert_allclose(weights.sum(axis=1), 1)
        alone = np.zeros((1, int(evenness.HIGHEST_HZ / evenness.BIN_HZ)))
        alone[0, int(500 / evenness.BIN_HZ)] = 1
        rows = [{"frequency_hz": f, "t60_s": 0.5, "gain_left": 1, "gain_right": 1} for f in (300.0, 500.0, 900.0)]
        self.assertGreater(evenness.shares(rows, alone)[0, 1], 0.99)

    def test_a_heavy_mode_radiates_less(self):
        flat = np.ones((1, int(evenness.HIGHEST_HZ / evenness.BIN_HZ)))
        rows = [{"frequency_hz": 500.0, "t60_s": 0.5, "gain_left": 1, "gain_right": 0, "mass_kg": m} for m in (1.0, 2.0)]
        light, heavy = evenness.shares(rows, flat)[0]
        self.assertAlmostEqual(light / heavy, 4)

    def test_keys_become_even_within_the_bounds_of_the_modes(self):
        changed = np.zeros(len(body()))
        spread = []
        for _ in range(8):
            spectra = powers(body(changed))
            levels = 10 * np.log10(spectra.sum(axis=1))
            spread.append((np.abs(np.diff(levels)).max(), np.ptp(levels)))
            changed = changed + 0.5 * evenness.changes_db(evenness.shares(body(changed), spectra), levels, changed)
        self.assertGreater(spread[0][0], 4)
        self.assertLess(spread[-1][0], 0.6 * spread[0][0])
        self.assertLess(spread[-1][1], 0.7 * spread[0][1])
        self.assertLessEqual(np.abs(changed).max(), evenness.LARGEST_DB)

    def test_bins_hold_the_a_weighted_power_of_a_tone(self):
        t = np.arange(RATE_HZ) / RATE_HZ
        low, high = (evenness.a_weighted_bins(np.sin(2 * np.pi * f * t), RATE_HZ).sum() for f in (100, 1000))
        self.assertAlmostEqual(10 * np.log10(high / low), 19.1, delta=0.2)  # IEC 61672-1, table 3


if __name__ == "__main__":
    unittest.main()
