"""Heights of frets and fingerboards below the open string's rest line."""
from wire import rounded


def fret_position(length_m, fret):
    """From the nut, equal temperament."""
    return length_m * (1 - 2 ** (-fret / 12))


def below_line(length_m, x_m, first_m, twelfth_m, relief_m):
    """Straight from first_m at the first fret to twelfth_m at the twelfth, plus a bow of relief_m around the seventh fret."""
    first, twelfth = fret_position(length_m, 1), fret_position(length_m, 12)
    straight = first_m + (twelfth_m - first_m) * (x_m - first) / (twelfth - first)
    t = x_m / (2 * fret_position(length_m, 7))
    bow = relief_m * max(0.0, 4 * t * (1 - t))
    return -(straight + bow)


def fret_heights(length_m, count, first_m, twelfth_m, relief_m):
    heights = [below_line(length_m, fret_position(length_m, j), first_m, twelfth_m, relief_m) for j in range(1, count + 1)]
    for i, stop in enumerate(heights):  # every fret must lie below the string that an earlier one stops
        for j in range(i + 1, count):
            line = stop * 2 ** (-(j - i) / 12)
            assert heights[j] < line, (i + 1, j + 1, heights[j], line)
    return [rounded(h) for h in heights]
