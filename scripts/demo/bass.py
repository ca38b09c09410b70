"""Pieces for basses."""
from midi import Score

E1, G1, A1, B1, C2, D2 = 28, 31, 33, 35, 36, 38
OCTAVE = 12
THUMB, SOFT_THUMB, POP, HARD_POP, GHOST = 92, 78, 118, 127, 62

# One bar of a slap line: (sixteenth, note, length in sixteenths, velocity).
RIFF = [
    (0, E1, 2.2, THUMB), (3, E1, 0.4, GHOST), (4, E1 + OCTAVE, 1.0, POP), (6, E1, 0.9, SOFT_THUMB),
    (7, D2 + OCTAVE, 0.8, POP), (8, E1 + OCTAVE, 1.2, HARD_POP), (10, E1, 0.4, GHOST), (11, G1, 0.9, THUMB),
    (12, A1, 1.6, THUMB), (14, A1 + OCTAVE, 0.9, POP), (15, G1 + OCTAVE, 0.8, POP),
]
RIFF_END = [
    (0, E1, 2.2, THUMB), (3, E1, 0.4, GHOST), (4, E1 + OCTAVE, 1.0, POP), (6, E1, 0.9, SOFT_THUMB),
    (7, D2, 0.8, THUMB), (8, D2 + OCTAVE, 1.4, HARD_POP), (10, B1, 0.9, THUMB), (11, B1, 0.4, GHOST),
    (12, B1 + OCTAVE, 0.9, POP), (13, A1 + OCTAVE, 0.9, POP), (14, G1 + OCTAVE, 1.6, POP),
]
ANSWER = [
    (0, C2, 2.0, THUMB), (2, C2 + OCTAVE, 0.9, POP), (3, C2, 0.4, GHOST), (4, C2 + OCTAVE, 1.0, HARD_POP),
    (6, C2, 0.9, SOFT_THUMB), (7, B1 + OCTAVE, 0.8, POP), (8, D2, 2.0, THUMB), (10, D2 + OCTAVE, 0.9, POP),
    (11, D2, 0.4, GHOST), (12, D2 + OCTAVE, 1.0, HARD_POP), (14, D2, 0.8, SOFT_THUMB), (15, D2 + OCTAVE, 0.8, POP),
]
WALK_DOWN = [
    (0, E1 + OCTAVE, 1.8, HARD_POP), (2, D2, 1.8, THUMB), (4, B1, 1.8, THUMB), (6, A1, 1.8, THUMB),
    (8, G1, 1.6, THUMB), (10, G1, 0.4, GHOST), (11, G1 + OCTAVE, 0.8, POP), (12, A1, 1.6, THUMB),
    (14, B1, 1.0, THUMB), (15, B1 + OCTAVE, 0.8, HARD_POP),
]
ENDING = [(0, E1, 9.0, 105)]


def slap():
    """Thumb, ghost notes, popped octaves. 112 beats per minute, E minor."""
    score = Score("Jawari slap demo", 112)
    for bar, notes in enumerate([RIFF, RIFF_END, ANSWER, RIFF, WALK_DOWN, ENDING]):
        for sixteenth, key, length, velocity in notes:
            score.note(4 * bar + sixteenth / 4, key, length / 4, velocity)
    return score


def fretless():
    """A slow line in D minor that slides into its notes and sings with vibrato."""
    score = Score("Jawari fretless demo", 66)
    score.bend_range(2)
    line = [(0, 38, 2.4, 92), (2.5, 45, 0.5, 70), (3, 50, 2.6, 100), (6, 48, 0.9, 84), (7, 46, 0.9, 80), (8, 45, 2.8, 98),
            (11, 43, 0.9, 76), (12, 41, 1.4, 88), (13.5, 40, 0.5, 70), (14, 38, 4.5, 104)]
    for beat, key, length, velocity in line:
        score.note(beat, key, length, velocity)
    for beat, start in ((3, -1.0), (8, -0.5), (14, -1.0)):  # a whole or half tone below, into the note
        score.glide(beat, 0.35, start, 0)
    for beat in (4.2, 9.3, 15.6):
        for i in range(12):
            score.control(beat + i * 0.1, 1, min(60, 6 * i))
        score.control(beat + 1.6, 1, 0)
    return score


PIECES = {"slap": (slap, "bass-slap"), "fretless": (fretless, "bass-fretless")}
