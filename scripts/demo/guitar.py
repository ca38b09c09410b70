"""Pieces for guitars."""
from midi import Score


def nylon():
    """Arpeggios in A minor over a walking bass: p i m a m i."""
    score = Score("Jawari classical guitar demo", 88)
    chords = [(45, 60, 64, 69), (43, 59, 62, 67), (41, 57, 60, 65), (40, 56, 59, 64), (45, 60, 64, 69), (50, 57, 65, 69), (40, 56, 62, 64)]
    for bar, (bass, i, m, a) in enumerate(chords):
        beat = 3 * bar
        score.note(beat, bass, 2.9, 96)
        for n, key in enumerate((i, m, a, m, i)):
            score.note(beat + 0.5 + 0.5 * n, key, 1.2, 74 if n % 2 else 82)
    for n, key in enumerate((45, 52, 57, 60, 64)):
        score.note(21 + 0.06 * n, key, 4, 100)
    return score


def strum(score, beat, keys, length, velocity, up=False, spread=0.045):
    for n, key in enumerate(reversed(keys) if up else keys):
        score.note(beat + spread * n, key, length, max(30, velocity - 3 * n))


def steel():
    """Strummed chords in G with a bass run."""
    score = Score("Jawari steel guitar demo", 104)
    g, c, d, em = (43, 47, 50, 55, 59, 67), (48, 52, 55, 60, 64), (50, 57, 62, 66), (40, 47, 52, 55, 59, 64)
    for bar, chord in enumerate((g, c, em, d)):
        beat = 4 * bar
        strum(score, beat, chord, 1.4, 104)
        strum(score, beat + 1.5, chord, 0.4, 76, up=True)
        strum(score, beat + 2, chord, 0.9, 96)
        strum(score, beat + 3, chord, 0.4, 84)
        strum(score, beat + 3.5, chord, 0.4, 76, up=True)
    for n, key in enumerate((45, 47, 48, 50, 42, 43)):
        score.note(16 + 0.5 * n, key, 0.48, 108)
    strum(score, 19, g, 5, 112)
    return score


def twelve():
    """Slow broken chords that let the octaves shimmer."""
    score = Score("Jawari twelve-string demo", 76)
    for bar, keys in enumerate(((40, 52, 55, 59, 64), (45, 52, 57, 60, 64), (50, 57, 62, 66), (43, 50, 55, 59, 67))):
        for n, key in enumerate(keys + keys[1:-1][::-1]):
            score.note(4 * bar + 0.5 * n, key, 3.4 - 0.4 * n, 92 - 4 * (n % 3))
    strum(score, 16, (40, 47, 52, 55, 59, 64), 5, 108, spread=0.09)
    return score


def electric():
    """A riff with bent thirds, hammered notes and one long bend with vibrato."""
    score = Score("Jawari electric guitar demo", 96)
    score.bend_range(2)
    riff = [(0, 45, 0.45, 112), (0.5, 45, 0.2, 70), (0.75, 48, 0.45, 104), (1.25, 50, 0.7, 110), (2, 45, 0.45, 108), (2.5, 52, 0.4, 100),
            (3, 50, 0.4, 104), (3.5, 48, 0.45, 98)]
    for bar in range(2):
        for beat, key, length, velocity in riff:
            score.note(4 * bar + beat, key, length, velocity)
    for beat, key, length in ((8, 67, 0.9), (9, 69, 0.9), (10, 72, 2.9), (13, 69, 0.9), (14, 67, 0.9), (15, 64, 0.9), (16, 57, 4)):
        score.note(beat, key, length, 108)
    score.glide(10.2, 0.6, 0, 1.0)  # C up to D and back
    for i in range(10):
        score.control(11 + 0.1 * i, 1, 6 * i)
    score.control(12.4, 1, 0)
    score.glide(12.4, 0.4, 1.0, 0)
    score.note(16, 45, 4, 110)
    return score


PIECES = {"nylon": (nylon, "guitar-nylon"), "steel": (steel, "guitar-steel"), "twelve": (twelve, "guitar-12"),
          "electric": (electric, "guitar-electric")}
