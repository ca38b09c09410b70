"""What is played for a measurement: single notes at three velocities, every key once, and a phrase; as MIDI, and where in the
sound each note lies."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "demo"))
from midi import Score  # noqa: E402

TICKS_BPM = 125  # a tick is a millisecond
BEAT_S = 0.48
SOFT, USUAL, LOUD = 40, 100, 120
VELOCITIES = (SOFT, USUAL, LOUD)
EVEN_VELOCITY = 90
HOLD_S, HEARD_S, APART_S = 1.5, 2.0, 2.4      # a note is held, let go and listened to, silenced, followed by the next
SHORT_HOLD_S, SHORT_APART_S = 0.6, 0.85       # of the notes that only have a level
LONG_HOLD_S, LONG_APART_S = 3.0, 3.4          # of the notes whose decay is followed
ALL_SOUND_OFF = 120
# (beat, semitones above the lowest key, beats): a bass note under a slow melody and two chords, velocity 80 to 100.
PHRASE = [(0, 0, 2), (0, 12, 1), (1, 16, 1), (2, 19, 1), (2, 7, 2), (3, 16, 1), (4, 5, 2), (4, 12, 1), (5, 17, 1), (6, 0, 2), (6, 7, 2),
          (6, 16, 2), (6, 24, 2)]


def score(program=None, bank=0):
    result = Score("voicing", TICKS_BPM)
    if program is not None:
        result.control(0, 0, bank)
        result.add(0, 1, 0xC0, program)
    return result


def play(result, start_s, key, velocity, hold_s, silence_s):
    result.note(start_s / BEAT_S, key, hold_s / BEAT_S, velocity)
    result.control((start_s + silence_s) / BEAT_S, ALL_SOUND_OFF, 0)


LEAD_S = 0.1  # programs are chosen before the first note


def of_key(key, **instrument):
    """One key at each velocity; and (velocity, start) of each note."""
    result, starts = score(**instrument), []
    for i, velocity in enumerate(VELOCITIES):
        start = LEAD_S + i * APART_S
        play(result, start, key, velocity, HOLD_S, HEARD_S)
        starts.append((velocity, start))
    return result, starts


def of_held(key, **instrument):
    """One key, long, at the usual velocity and loud; and (velocity, start) of each note."""
    result, starts = score(**instrument), []
    for i, velocity in enumerate((USUAL, LOUD)):
        start = LEAD_S + i * LONG_APART_S
        play(result, start, key, velocity, LONG_HOLD_S, LONG_HOLD_S + 0.1)
        starts.append((velocity, start))
    return result, starts


def of_compass(keys, **instrument):
    """Every key once; and (key, start) of each."""
    result, starts = score(**instrument), []
    for i, key in enumerate(keys):
        start = LEAD_S + i * SHORT_APART_S
        play(result, start, key, EVEN_VELOCITY, SHORT_HOLD_S, SHORT_HOLD_S)
        starts.append((key, start))
    return result, starts


def of_colours(keys, **instrument):
    """Every key once at the usual velocity, for half a second of its colour; and (key, start) of each."""
    result, starts = score(**instrument), []
    for i, key in enumerate(keys):
        start = LEAD_S + i * SHORT_APART_S
        play(result, start, key, USUAL, SHORT_HOLD_S, SHORT_HOLD_S)
        starts.append((key, start))
    return result, starts


def nearest(key, keys):
    """The key of the same name nearest to the one wanted, else the nearest."""
    same = [k for k in keys if (k - key) % 12 == 0]
    return min(same or keys, key=lambda k: (abs(k - key), k))


def of_phrase(keys, **instrument):
    """The same phrase for everyone: from the C or E at the bottom of the compass, moved by octaves where it is too wide."""
    result = score(**instrument)
    base, taken = min(keys), set()
    for beat, above, length in PHRASE:
        key = nearest(base + above, keys)
        if (beat, key) in taken:
            continue
        taken.add((beat, key))
        result.note(LEAD_S / BEAT_S + beat, key, 0.95 * length, 90)
    return result
