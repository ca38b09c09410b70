"""The estimator finds what was put in, and says so when it was something else."""
import unittest

import numpy as np

import estimate

RATE_HZ = 48000


def string_sound(first_hz, t60_s, seconds, inharmonicity=1e-4):
    """Twenty partials; that of number k decays in t60/(1 + k/10)."""
    t = np.arange(int(seconds * RATE_HZ)) / RATE_HZ
    x = np.zeros(len(t))
    for k in range(1, 21):
        decay = np.log(1000) / t60_s * (1 + k / 10)
        x += np.exp(-decay * t) * np.sin(2 * np.pi * first_hz * k * np.sqrt(1 + inharmonicity * k * k) * t + k) / k
    return x


class EstimatorTest(unittest.TestCase):
    def test_frequency_and_decay_of_partials(self):
        for first_hz, t60_s in [(41.2, 12.0), (82.4, 5.0), (330.0, 2.0), (1400.0, 0.5)]:
            x = string_sound(first_hz, t60_s, 0.6)
            for k in (1, 2, 5):
                true_hz = first_hz * k * np.sqrt(1 + 1e-4 * k * k)
                partial = estimate.measure(x, true_hz * 1.004, first_hz, RATE_HZ)
                self.assertAlmostEqual(estimate.cents(partial.frequency_hz, true_hz), 0, delta=0.02)
                self.assertAlmostEqual(partial.t60_s * (1 + k / 10) / t60_s, 1, delta=0.01)

    def test_a_cent_is_seen(self):
        x = string_sound(98.0 * 2 ** (1 / 1200), 9.0, 0.6, inharmonicity=0)
        self.assertAlmostEqual(estimate.cents(estimate.measure(x, 98.0, 98.0, RATE_HZ).frequency_hz, 98.0), 1, delta=0.02)

    def test_five_percent_of_decay_are_seen(self):
        x = string_sound(98.0, 9.0 * 1.05, 0.6)
        self.assertAlmostEqual(estimate.measure(x, 98.0, 98.0, RATE_HZ).t60_s * 1.1 / 9.0, 1.05, delta=0.01)

    def test_a_step_is_a_click(self):
        x = np.sin(2 * np.pi * 100 * np.arange(4800) / RATE_HZ)
        smooth = estimate.second_difference(x).max()
        x[2400:] += 0.01
        self.assertGreater(estimate.second_difference(x).max(), 20 * smooth)


if __name__ == "__main__":
    unittest.main()
