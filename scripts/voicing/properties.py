"""Properties of a recorded or rendered note, from samples alone: one estimator for presets and for recorded sets.

Sounds are arrays (frames, channels) that begin at the note's onset. Spectra are sums of the channels' powers, so that what
is out of phase between left and right counts. Levels are in dB; a level that is not there is FLOOR_DB.
"""
import numpy as np

FLOOR_DB = -120.0
CENTRES_HZ = [round(100 * 2 ** (i / 3), 1) for i in range(20)]  # third octaves from 100 Hz to 8 kHz
SPECTRUM_S = 0.5        # what the ear takes for the colour of a note
ATTACK_S = 0.1
WHOLE_HZ = (60.0, 12000.0)
HIGH_HZ = (5000.0, 10000.0)
THUMP_SHARE = 0.75      # of the first partial
GROUPS = {"1-3": range(1, 4), "4-8": range(4, 9), "9-16": range(9, 17)}
STILL_DB = -30.0        # decays are followed down to here below their start
HOP_S = 0.03


def decibels(power):
    return float(10 * np.log10(power)) if power > 10 ** (FLOOR_DB / 10) else FLOOR_DB


def two_channels(sound):
    sound = np.asarray(sound, float)
    return sound.reshape(len(sound), -1)


def falling(sound, seconds, rate_hz):
    """The first `seconds` under the falling half of a Hann window: no jump at the end, the onset whole."""
    length = min(len(sound), int(seconds * rate_hz))
    window = 0.5 * (1 + np.cos(np.pi * np.arange(length) / length))
    return two_channels(sound)[:length] * window[:, None]


def power_spectrum(windowed, rate_hz, longest_s=1.0):
    length = max(len(windowed), int(longest_s * rate_hz))
    return np.fft.rfftfreq(length, 1 / rate_hz), (np.abs(np.fft.rfft(windowed, length, axis=0)) ** 2).sum(axis=1)


def band(frequency, power, low_hz, high_hz):
    return power[(frequency >= low_hz) & (frequency < high_hz)].sum()


def relative_db(part, whole):
    return decibels(part / whole) if whole > 0 else FLOOR_DB


# ------------------------------------------------------------------------------------------------ colour
def third_octaves(sound, rate_hz):
    """Levels of the third octaves of the first half second, relative to 60 to 12000 Hz."""
    frequency, power = power_spectrum(falling(sound, SPECTRUM_S, rate_hz), rate_hz)
    whole = band(frequency, power, *WHOLE_HZ)
    return [relative_db(band(frequency, power, f * 2 ** (-1 / 6), f * 2 ** (1 / 6)), whole) for f in CENTRES_HZ]


def high_level(sound, rate_hz):
    """Level from 5 to 10 kHz of the first half second, relative to all."""
    frequency, power = power_spectrum(falling(sound, SPECTRUM_S, rate_hz), rate_hz)
    return relative_db(band(frequency, power, *HIGH_HZ), power.sum())


def centroid_hz(sound, rate_hz):
    """Power-weighted mean frequency of the first half second."""
    frequency, power = power_spectrum(falling(sound, SPECTRUM_S, rate_hz), rate_hz)
    return float((frequency * power).sum() / power.sum()) if power.sum() > 0 else 0.0


def thump(sound, first_hz, rate_hz):
    """Level below 0.75 f0 in the first 100 ms, relative to all: the knock of the body. Under a whole Hann window: what a sudden
    partial itself has down there stays out."""
    start = two_channels(sound)[:int(ATTACK_S * rate_hz)]
    frequency, power = power_spectrum(start * np.hanning(len(start))[:, None], rate_hz)
    return relative_db(band(frequency, power, 0, THUMP_SHARE * first_hz), power.sum())


# ------------------------------------------------------------------------------------------------ loudness
def a_weighting(frequency):
    """Power gain of the A curve (IEC 61672-1), 1 at 1 kHz."""
    f2 = np.asarray(frequency, float) ** 2
    gain = 12194.0 ** 2 * f2 ** 2 / ((f2 + 20.6 ** 2) * np.sqrt((f2 + 107.7 ** 2) * (f2 + 737.9 ** 2)) * (f2 + 12194.0 ** 2))
    return (gain * 10 ** (2.0 / 20)) ** 2


def a_level(sound, rate_hz):
    """A-weighted energy of the first half second over its length."""
    windowed = falling(sound, SPECTRUM_S, rate_hz)
    frequency, power = power_spectrum(windowed, rate_hz)
    length = max(len(windowed), int(rate_hz))
    return decibels(2 * (power * a_weighting(frequency)).sum() / length / (SPECTRUM_S * rate_hz) + 1e-30)


def biquad_response(b, a, frequency, rate_hz):
    z = np.exp(-2j * np.pi * frequency / rate_hz)
    return (b[0] + b[1] * z + b[2] * z * z) / (a[0] + a[1] * z + a[2] * z * z)


def k_weighted(sound, rate_hz):
    """ITU-R BS.1770-4, annex 1: a shelf and a high pass, whose coefficients are stated for 48 kHz."""
    if rate_hz != 48000:
        raise ValueError(f"loudness is measured at 48000 Hz, not {rate_hz}")
    sound = two_channels(sound)
    length = len(sound) + rate_hz  # a second for the filters to ring out in
    frequency = np.fft.rfftfreq(length, 1 / rate_hz)
    shelf = biquad_response((1.53512485958697, -2.69169618940638, 1.19839281085285), (1, -1.69065929318241, 0.73248077421585), frequency, rate_hz)
    high_pass = biquad_response((1, -2, 1), (1, -1.99004745483398, 0.99007225036621), frequency, rate_hz)
    return np.fft.irfft(np.fft.rfft(sound, length, axis=0) * (shelf * high_pass)[:, None], length, axis=0)[:len(sound)]


def loudness_lufs(sound, rate_hz):
    """Integrated loudness with both gates of ITU-R BS.1770-4. A single channel counts as heard from both sides."""
    sound = two_channels(sound)
    if sound.shape[1] == 1:
        sound = np.repeat(sound, 2, axis=1)
    power = (k_weighted(sound, rate_hz) ** 2).sum(axis=1)
    block, hop = int(0.4 * rate_hz), int(0.1 * rate_hz)
    sums = np.concatenate([[0], np.cumsum(power)])
    blocks = np.array([(sums[n + block] - sums[n]) / block for n in range(0, len(power) - block + 1, hop)])
    level = lambda p: -0.691 + 10 * np.log10(np.maximum(p, 1e-30))  # noqa: E731
    blocks = blocks[level(blocks) > -70]
    if len(blocks) == 0:
        return FLOOR_DB
    blocks = blocks[level(blocks) > level(blocks.mean()) - 10]
    return float(level(blocks.mean()))


def correlation(sound, rate_hz):
    """Of left and right in the first second."""
    sound = two_channels(sound)[:rate_hz]
    if sound.shape[1] < 2:
        return 1.0
    left, right = sound[:, 0], sound[:, 1]
    scale = np.sqrt((left ** 2).sum() * (right ** 2).sum())
    return float((left * right).sum() / scale) if scale > 0 else 1.0


# ------------------------------------------------------------------------------------------------ decay
def partial_envelope(mono, frequency_hz, spacing_hz, rate_hz):
    """Magnitude of the partial every 30 ms, through a Blackman window of six periods of the spacing."""
    length = int(rate_hz * max(0.06, 6 / spacing_hz))
    window = np.blackman(length)
    turned = mono * np.exp(-2j * np.pi * frequency_hz / rate_hz * np.arange(len(mono)))
    begins = range(0, len(mono) - length + 1, int(HOP_S * rate_hz))
    return np.array([abs((turned[n:n + length] * window).sum()) for n in begins]) / window.sum()


def t60_of(envelope):
    """Early T60: a line through the level from its peak down to 30 dB below, or to the end. None if nothing decays."""
    if len(envelope) < 8 or envelope.max() <= 0:
        return None
    level = 20 * np.log10(envelope / envelope.max() + 1e-12)
    first = int(level.argmax()) + 1
    below = np.nonzero(level[first:] < STILL_DB)[0]
    last = first + (int(below[0]) if len(below) else len(level) - first)
    if last - first < 4:
        return None
    slope = np.polyfit(np.arange(last - first) * HOP_S, level[first:last], 1)[0]
    return float(-60 / slope) if slope < -0.3 else None


def partial_hz(frequency, power, expected_hz, spacing_hz):
    near = np.abs(frequency - expected_hz) < 0.3 * spacing_hz
    return float(frequency[near][power[near].argmax()]) if near.any() else expected_hz


def louder_side(sound):
    sound = two_channels(sound)
    return sound[:, np.argmax((sound ** 2).sum(axis=0))]


def partials_of(mono, first_hz, rate_hz):
    """Frequency of each of the first sixteen partials, looked for beside the one before [Hz]."""
    frequency, power = power_spectrum(two_channels(mono * np.hanning(len(mono))), rate_hz)
    found, spacing, last = {}, first_hz, 0.0
    for k in range(1, 17):
        if last + 1.5 * spacing > min(rate_hz / 2, 16000):
            break
        here = partial_hz(frequency, power, last + spacing, first_hz)
        spacing, last = max(0.9 * first_hz, min(1.15 * first_hz, here - last if k > 1 else here)), here
        found[k] = here
    return found


def decay_times(sound, first_hz, rate_hz):
    """Median early T60 of the partials of each group."""
    mono = louder_side(sound)
    times = {k: t60_of(partial_envelope(mono, here, first_hz, rate_hz)) for k, here in partials_of(mono, first_hz, rate_hz).items()}
    medians = {}
    for name, partials in GROUPS.items():
        found = [times[k] for k in partials if times.get(k) is not None]
        medians[name] = float(np.median(found)) if len(found) >= 2 else None
    return medians


def release(sound, off_s, rate_hz):
    """Of a note let go at off_s: time in which the sound falls by 60 dB (by the line to -30 dB), and its loudest 50 ms
    from 60 ms to 300 ms after, relative to the loudest of the note [s, dB]."""
    power = (two_channels(sound) ** 2).sum(axis=1)
    hop = int(0.01 * rate_hz)
    steps = power[:len(power) // hop * hop].reshape(-1, hop).mean(axis=1)
    smooth = np.convolve(steps, np.ones(5) / 5, "valid")
    off = int(off_s / 0.01)
    if off + 8 > len(smooth) or smooth.max() <= 0:
        return None, FLOOR_DB
    after = relative_db(smooth[off + 6:off + 26].max(), smooth[:off].max())
    level = 10 * np.log10(smooth[off:] / max(smooth[max(0, off - 1)], 1e-30) + 1e-12)
    below = np.nonzero(level < STILL_DB)[0]
    last = int(below[0]) if len(below) else len(level)
    if last < 3:
        return 0.03, after
    slope = np.polyfit(np.arange(last) * 0.01, level[:last], 1)[0]
    return (float(-60 / slope) if slope < -1 else None), after


def of_note(sound, first_hz, off_s, rate_hz, decays=True):
    """All properties of one note; decay times, which take longest, only if asked for."""
    held = two_channels(sound)[:int(off_s * rate_hz)]
    release_s, release_db = release(sound, off_s, rate_hz)
    return {"third_octaves": [round(x, 2) for x in third_octaves(held, rate_hz)], "high_db": round(high_level(held, rate_hz), 2),
            "centroid_hz": round(centroid_hz(held, rate_hz), 1), "thump_db": round(thump(held, first_hz, rate_hz), 2),
            "a_level_db": round(a_level(held, rate_hz), 2), "correlation": round(correlation(held, rate_hz), 3),
            "t60_s": decay_times(held, first_hz, rate_hz) if decays else {}, "release_s": release_s, "release_db": round(release_db, 2),
            "peak_db": round(2 * decibels(np.abs(held).max() + 1e-30), 2) if len(held) else FLOOR_DB}


def distance_db(one, other):
    """Mean |difference| of two third-octave spectra."""
    return float(np.mean(np.abs(np.subtract(one, other))))
