"""Pieces for sitar, tanpura and biwa."""
from midi import Score


def tanpura():
    """Two and a half rounds of Pa Sa Sa low Sa."""
    score = Score("Jawari tanpura demo", 60)
    for round_ in range(3):
        for n, key in enumerate((43, 48, 48, 36)):
            score.note(5 * round_ + 1.1 * n, key, 6, 100 if key != 36 else 108)
    return score


def sitar():
    """A few phrases of an alap on baj, with meend (bends of up to a fourth) over strokes of the chikari."""
    score = Score("Jawari sitar demo", 60)
    score.bend_range(5)
    for beat, key, length, velocity in ((0, 49, 3, 88), (1.2, 59, 2.6, 100), (4, 61, 3.4, 104), (7.6, 58, 1.8, 92), (9.5, 56, 1.4, 96),
                                        (11, 54, 2.4, 100), (13.6, 56, 1.2, 88), (15, 61, 4.5, 110)):
        score.note(beat, key, length, velocity, channel=0)
    score.glide(1.9, 0.7, 0, 0.4)
    score.glide(3.0, 0.5, 0.4, 0)
    score.bend(3.9, 0)
    score.glide(4.6, 0.8, 0, 0.2)
    score.glide(5.6, 0.5, 0.2, 0)
    score.glide(6.2, 0.3, 0, 0.2)
    score.glide(6.6, 0.3, 0.2, 0)
    score.glide(11.8, 0.9, 0, 0.6)
    score.glide(12.9, 0.4, 0.6, 0)
    for beat in (3.4, 7.1, 10.9, 13.2, 16.5, 16.9, 17.3):
        score.note(beat, 73, 0.6, 84, channel=1)
    for beat in (0, 9.4, 15):
        score.note(beat, 37, 4, 92, channel=1)
    return score


def biwa():
    """A stroke that grows faster, then single tones that are pressed upwards."""
    score = Score("Jawari biwa demo", 60)
    score.bend_range(4)
    beat, gap = 0.0, 0.9
    while gap > 0.11:
        score.note(beat, 55, gap * 0.95, min(120, round(70 + 6 / gap)))
        beat += gap
        gap *= 0.83
    score.note(beat, 55, 1.6, 122)
    score.note(beat, 43, 2.6, 110)
    start = beat + 2.0
    for offset, key, length in ((0, 48, 1.7), (1.8, 51, 1.9), (3.8, 55, 2.6), (6.5, 43, 3.5)):
        score.note(start + offset, key, length, 108)
    score.glide(start + 4.3, 0.5, 0, 0.5)
    score.glide(start + 5.3, 0.6, 0.5, 0)
    score.note(start + 6.5, 55, 3.5, 118)
    return score


PIECES = {"tanpura": (tanpura, "tanpura"), "sitar": (sitar, "sitar"), "biwa": (biwa, "biwa")}
