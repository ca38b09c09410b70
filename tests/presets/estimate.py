"""Frequency and decay of single partials, measured from samples alone: nothing here knows a preset or the engine.

A four-term Blackman-Harris window (side lobes at -92 dB) that spans enough periods separates a partial from its neighbours.
The window is moved along the sound; the partial's phase gives its frequency, the logarithm of its magnitude its decay.
"""
import numpy as np

WINDOW_PERIODS = 6.0    # of the first partial: neighbours lie 6 bins away, beyond the main lobe's 4
SHORTEST_WINDOW_S = 0.08


def blackman_harris(length):
    p = 2 * np.pi * np.arange(length) / (length - 1)
    return 0.35875 - 0.48829 * np.cos(p) + 0.14128 * np.cos(2 * p) - 0.01168 * np.cos(3 * p)


def heterodyned(x, begin, window, frequency_hz, rate_hz):
    """sum x[n] w[n-begin] exp(-i 2 pi f n/rate), n counted from the start of x so that phases of windows compare."""
    n = np.arange(begin, begin + len(window))
    return np.sum(x[begin:begin + len(window)] * window * np.exp(-2j * np.pi * frequency_hz / rate_hz * n))


class Partial:
    """frequency_hz, decay_per_s (of the amplitude) and level (amplitude at the middle of the passage)."""

    def __init__(self, frequency_hz, decay_per_s, level):
        self.frequency_hz = frequency_hz
        self.decay_per_s = decay_per_s
        self.level = level

    @property
    def t60_s(self):
        return np.log(1000.0) / self.decay_per_s


def measure(x, expected_hz, spacing_hz, rate_hz, windows=9):
    """The partial near expected_hz of the passage x, whose neighbours are spacing_hz away.

    Hops grow from 1 ms (unambiguous within 500 Hz) to the whole passage; each estimate resolves the next one's ambiguity.
    """
    length = int(rate_hz * max(SHORTEST_WINDOW_S, WINDOW_PERIODS / spacing_hz))
    longest_hop = len(x) - length
    if longest_hop < 4 * rate_hz / 1000:
        raise ValueError(f"{len(x) / rate_hz:.3f} s are too short for a window of {length / rate_hz:.3f} s")
    window = blackman_harris(length)
    first = heterodyned(x, 0, window, expected_hz, rate_hz)
    offset_hz = 0.0
    hop = rate_hz / 1000
    while True:
        step = int(min(hop, longest_hop))
        turns = np.angle(heterodyned(x, step, window, expected_hz, rate_hz) / first) / (2 * np.pi)
        turns += np.round(offset_hz * step / rate_hz - turns)
        offset_hz = turns * rate_hz / step
        if step == longest_hop:
            break
        hop *= 4
    frequency_hz = expected_hz + offset_hz
    begins = np.linspace(0, longest_hop, windows).astype(int)
    levels = np.array([abs(heterodyned(x, b, window, frequency_hz, rate_hz)) for b in begins])
    slope, intercept = np.polyfit(begins / rate_hz, np.log(levels), 1)
    middle = np.exp(intercept + slope * begins.mean() / rate_hz)
    return Partial(frequency_hz, -slope, 2 * middle / window.sum())


def cents(frequency_hz, reference_hz):
    return 1200 * np.log2(frequency_hz / reference_hz)


def second_difference(x):
    """|x[n-1] - 2 x[n] + x[n+1]| with zeros at the ends, as long as x: what a click is made of."""
    d = np.zeros(len(x))
    d[1:-1] = np.abs(x[:-2] - 2 * x[1:-1] + x[2:])
    return d


def spectrum_level_db(x, low_hz, high_hz, rate_hz):
    """Energy of x between two frequencies, dB relative to full scale squared times seconds."""
    spectrum = np.abs(np.fft.rfft(x * np.hanning(len(x)))) ** 2
    frequency = np.fft.rfftfreq(len(x), 1 / rate_hz)
    return 10 * np.log10(spectrum[(frequency >= low_hz) & (frequency < high_hz)].sum() / len(x) / rate_hz + 1e-30)


def spectral_centroid_hz(x, rate_hz):
    spectrum = np.abs(np.fft.rfft(x * np.hanning(len(x)))) ** 2
    frequency = np.fft.rfftfreq(len(x), 1 / rate_hz)
    return float((spectrum * frequency).sum() / max(spectrum.sum(), 1e-300))
