"""What the body and other strings do to a note that rings: decays in two stages, beating, decay times that scatter from partial to
partial, pitch that glides, sound between the partials. Samples alone are looked at, as in properties.py.
"""
import numpy as np
import properties
from properties import GROUPS, HOP_S

DEEPEST_DB = -40.0      # envelopes are followed down to here below their peak
SHORTEST_STEPS = 12     # of an envelope that has two stages
EARLY_S, LATER_S = 0.05, (0.6, 1.0)  # pitch here relative to the mean there
RINGING_S = 0.35        # the attack is over


def two_stages(level_db):
    """A broken line through levels that are HOP_S apart: early and late T60 [s] (None where nothing falls) and the rms about it [dB]."""
    count = len(level_db)
    t = HOP_S * np.arange(count)
    best = None
    for knot in range(count // 6, count - count // 4):
        basis = np.stack([np.ones(count), t, np.maximum(0, t - t[knot])], 1)
        solution, *_ = np.linalg.lstsq(basis, level_db, rcond=None)
        rms = float(np.sqrt(np.mean((basis @ solution - level_db) ** 2)))
        if best is None or rms < best[2]:
            best = (solution[1], solution[1] + solution[2], rms)
    early, late, rms = best
    time = lambda slope: float(-60 / slope) if slope < -0.3 else None  # noqa: E731
    return time(early), time(late), rms


def audible(envelope):
    """Levels [dB] from the step after the peak down to DEEPEST_DB below it, or to the end."""
    level = 20 * np.log10(envelope / envelope.max() + 1e-12)
    first = int(level.argmax()) + 1
    below = np.nonzero(level[first:] < DEEPEST_DB)[0]
    return level[first:first + (int(below[0]) if len(below) else len(level))]


def scatter(times):
    """Deviation of decay times from a curve that is smooth over the partials: rms of T60 over the curve, less 1 [%]; None of few."""
    known = {k: t for k, t in times.items() if t is not None}
    if len(known) < 7:
        return None
    x, y = np.log(list(known)), np.log(list(known.values()))
    return float(100 * np.sqrt(np.mean((np.exp(y - np.polyval(np.polyfit(x, y, 2), x)) - 1) ** 2)))


def glide_cents(mono, first_hz, rate_hz):
    """Pitch of the first partial 50 ms after the onset, relative to its pitch later: from its phase, through windows of six periods."""
    length = int(rate_hz * max(0.06, 6 / first_hz))
    window = np.blackman(length)
    turned = mono * np.exp(-2j * np.pi * first_hz / rate_hz * np.arange(len(mono)))

    def frequency(at_s, over_s=0.03):
        first, second = (int((at_s + shift) * rate_hz) - length // 2 for shift in (-over_s / 2, over_s / 2))
        one, other = ((turned[max(0, n):max(0, n) + length] * window).sum() for n in (first, second))
        return first_hz + np.angle(other * np.conj(one)) / (2 * np.pi) * rate_hz / (max(0, second) - max(0, first))

    if len(mono) < (LATER_S[1] + 0.1) * rate_hz:
        return None
    early = frequency(max(EARLY_S, length / rate_hz / 2 + 0.016))
    later = np.median([frequency(at) for at in np.arange(*LATER_S, 0.02)])
    return float(1200 * np.log2(early / later)) if early > 0 and later > 0 else None


def between_db(sound, partials, first_hz, rate_hz):
    """Level between the partials, from RINGING_S on, relative to all: more than 0.2 f0 from each, and between the first and the last."""
    part = properties.two_channels(sound)[int(RINGING_S * rate_hz):int((RINGING_S + 1.0) * rate_hz)]
    frequency, power = properties.power_spectrum(part * np.hanning(len(part))[:, None], rate_hz)
    inside = (frequency > 0.5 * first_hz) & (frequency < max(partials.values()) + 0.5 * first_hz)
    near = np.zeros(len(frequency), bool)
    for place in partials.values():
        near |= np.abs(frequency - place) < 0.2 * first_hz
    return properties.relative_db(power[inside & ~near].sum(), power[inside].sum())


def of_held_note(sound, first_hz, rate_hz):
    """All of these of one note that is held: by group of partials `late_over_early` and `beat_db` (medians), and of all of them
    `scatter_percent`; `glide_cents`; `between_db`. None where the note is too short for it."""
    mono = properties.louder_side(sound)
    partials = properties.partials_of(mono, first_hz, rate_hz)
    early, ratio, beat = {}, {}, {}
    for k, frequency_hz in partials.items():
        envelope = properties.partial_envelope(mono, frequency_hz, first_hz, rate_hz)
        level = audible(envelope) if len(envelope) and envelope.max() > 0 else []
        if len(level) < SHORTEST_STEPS:
            continue
        early[k], late, beat[k] = two_stages(level)
        ratio[k] = late / early[k] if late and early[k] else None
    result = {"scatter_percent": scatter(early), "glide_cents": glide_cents(mono, partials[1], rate_hz),
              "between_db": between_db(sound, partials, first_hz, rate_hz)}
    for name, group in GROUPS.items():
        for word, values in (("late_over_early", ratio), ("beat_db", beat)):
            known = [values[k] for k in group if values.get(k) is not None]
            result[f"{word}_{name}"] = float(np.median(known)) if len(known) >= 2 else None
    return result
