"""Pieces for harpsichord, clavichord, dulcimer and prepared piano."""
from midi import Score


def harpsichord():
    """Two voices in G minor, the second a fifth below and a bar later."""
    score = Score("Jawari harpsichord demo", 96)
    subject = [(0, 67, 0.5), (0.5, 70, 0.5), (1, 74, 0.75), (1.75, 72, 0.25), (2, 70, 0.5), (2.5, 69, 0.25), (2.75, 67, 0.25), (3, 66, 0.5),
               (3.5, 69, 0.5), (4, 67, 0.5), (4.5, 62, 0.5), (5, 63, 0.5), (5.5, 60, 0.5), (6, 62, 0.25), (6.25, 63, 0.25), (6.5, 62, 0.25),
               (6.75, 60, 0.25), (7, 58, 0.5), (7.5, 57, 0.5), (8, 55, 1)]
    for beat, key, length in subject:
        score.note(beat, key, 0.92 * length, 90)
        score.note(4 + beat, key - 19, 0.92 * length, 90)
    for beat, key, length in ((8, 70, 1), (9, 69, 0.5), (9.5, 67, 0.5), (10, 66, 1), (11, 69, 1)):
        score.note(beat, key, 0.95 * length, 90)
    for n, key in enumerate((31, 43, 50, 55, 59, 62, 67)):
        score.note(12.2 + 0.07 * n, key, 3.5, 90)
    return score


def clavichord():
    """A sarabande in D minor, loud and soft, with Bebung on its long notes."""
    score = Score("Jawari clavichord demo", 60)
    melody = [(0, 69, 1, 80), (1, 70, 1.8, 110), (3, 69, 0.5, 70), (3.5, 67, 0.5, 64), (4, 65, 1.8, 92), (6, 64, 0.5, 64), (6.5, 65, 0.5, 70),
              (7, 67, 1.8, 104), (9, 65, 0.5, 72), (9.5, 64, 0.5, 60), (10, 62, 2.8, 88)]
    for beat, key, length, velocity in melody:
        score.note(beat, key, 0.97 * length, velocity)
    for beat, keys in ((0, (50, 57)), (1, (50, 55)), (3, (52, 58)), (4, (53, 57)), (6, (45, 55)), (7, (45, 58)), (9, (45, 55)), (10, (38, 50, 57))):
        for key in keys:
            score.note(beat, key, 0.9 if beat < 10 else 2.8, 66, channel=1)
    for start in (1.3, 4.4, 7.3, 10.6):
        for i in range(24):
            score.pressure(start + i / 18, 0 if i == 23 else (64 if i % 4 in (1, 2) else 10))
    return score


def dulcimer():
    """A jig in D, with a tremolo at its end."""
    score = Score("Jawari dulcimer demo", 112)
    tune = [62, 66, 69, 74, 73, 74, 69, 66, 69, 62, 66, 69, 67, 71, 74, 79, 78, 79, 74, 71, 69, 67, 66, 64]
    for n, key in enumerate(tune + tune[:18] + [69, 73, 76, 74, 66, 62]):
        score.note(n / 3, key, 0.3, 104 if n % 3 == 0 else 80)
        if n % 6 == 0:
            score.note(n / 3, {0: 50, 1: 55}[(n // 12) % 2], 0.9, 84)
    for i in range(20):
        score.note(16 + i / 9, (74, 69)[i % 2], 0.1, 60 + 3 * i)
    for key in (50, 57, 62, 66, 74):
        score.note(18.4, key, 1, 110)
    return score


def prepared():
    """Interlocking patterns: plain strings, rattling bolts and rubber take turns."""
    score = Score("Jawari prepared piano demo", 126)
    high = [63, 60, 65, 66, 58, 63, 68, 60]
    low = [48, 55, 49, 53, 48, 52]
    for n in range(48):
        score.note(n / 2, high[(5 * n) % 8], 0.4, 110 if n % 4 == 0 else 78)
        if n % 3 == 0:
            score.note(n / 2, low[(n // 3) % 6], 0.9, 100)
    for key in (48, 55, 60, 70, 72):
        score.note(24, key, 5, 120)
    return score


PIECES = {"harpsichord": (harpsichord, "harpsichord"), "clavichord": (clavichord, "clavichord"), "dulcimer": (dulcimer, "dulcimer"),
          "prepared": (prepared, "prepared")}
