#!/usr/bin/env python3
"""Writes presets/demo/slap.mid, a slap-bass line composed for this project. Pure Python, same bytes on every run.

Thumb notes sound the low string and are muted early, ghost notes are mere clicks, popped octaves are pulled hard enough to
throw the string onto the frets. 112 beats per minute, E minor: two bars of riff, an answer, the riff again, a walk down to a
long low E.

usage: make_demo_midi.py [FILE]
"""
import pathlib
import struct
import sys

TICKS_PER_QUARTER = 480
SIXTEENTH = TICKS_PER_QUARTER // 4
TEMPO_BPM = 112
CHANNEL = 0

E1, G1, A1, B1, C2, D2 = 28, 31, 33, 35, 36, 38
OCTAVE = 12

# One bar: (sixteenth, note, length in sixteenths, velocity).
THUMB, SOFT_THUMB, POP, HARD_POP, GHOST = 92, 78, 118, 127, 62


def riff():
    return [
        (0, E1, 2.2, THUMB), (3, E1, 0.4, GHOST), (4, E1 + OCTAVE, 1.0, POP), (6, E1, 0.9, SOFT_THUMB),
        (7, D2 + OCTAVE, 0.8, POP), (8, E1 + OCTAVE, 1.2, HARD_POP), (10, E1, 0.4, GHOST), (11, G1, 0.9, THUMB),
        (12, A1, 1.6, THUMB), (14, A1 + OCTAVE, 0.9, POP), (15, G1 + OCTAVE, 0.8, POP),
    ]


def riff_end():
    return [
        (0, E1, 2.2, THUMB), (3, E1, 0.4, GHOST), (4, E1 + OCTAVE, 1.0, POP), (6, E1, 0.9, SOFT_THUMB),
        (7, D2, 0.8, THUMB), (8, D2 + OCTAVE, 1.4, HARD_POP), (10, B1, 0.9, THUMB), (11, B1, 0.4, GHOST),
        (12, B1 + OCTAVE, 0.9, POP), (13, A1 + OCTAVE, 0.9, POP), (14, G1 + OCTAVE, 1.6, POP),
    ]


def answer():
    return [
        (0, C2, 2.0, THUMB), (2, C2 + OCTAVE, 0.9, POP), (3, C2, 0.4, GHOST), (4, C2 + OCTAVE, 1.0, HARD_POP),
        (6, C2, 0.9, SOFT_THUMB), (7, B1 + OCTAVE, 0.8, POP), (8, D2, 2.0, THUMB), (10, D2 + OCTAVE, 0.9, POP),
        (11, D2, 0.4, GHOST), (12, D2 + OCTAVE, 1.0, HARD_POP), (14, D2, 0.8, SOFT_THUMB), (15, D2 + OCTAVE, 0.8, POP),
    ]


def walk_down():
    return [
        (0, E1 + OCTAVE, 1.8, HARD_POP), (2, D2, 1.8, THUMB), (4, B1, 1.8, THUMB), (6, A1, 1.8, THUMB),
        (8, G1, 1.6, THUMB), (10, G1, 0.4, GHOST), (11, G1 + OCTAVE, 0.8, POP), (12, A1, 1.6, THUMB),
        (14, B1, 1.0, THUMB), (15, B1 + OCTAVE, 0.8, HARD_POP),
    ]


def ending():
    return [(0, E1, 9.0, 105)]


def variable_length(value):
    digits = [value & 0x7F]
    while value := value >> 7:
        digits.append(0x80 | value & 0x7F)
    return bytes(reversed(digits))


def track_bytes():
    """One track: tempo, name, then notes as (tick, off before on, message)."""
    messages = []
    for bar, notes in enumerate([riff(), riff_end(), answer(), riff(), walk_down(), ending()]):
        for sixteenth, note, length, velocity in notes:
            start = round((16 * bar + sixteenth) * SIXTEENTH)
            end = round(start + length * SIXTEENTH)
            messages.append((start, 1, bytes([0x90 | CHANNEL, note, velocity])))
            messages.append((end, 0, bytes([0x80 | CHANNEL, note, 64])))
    name = b"Jawari slap demo"
    data = b"\x00\xff\x03" + variable_length(len(name)) + name
    data += b"\x00\xff\x51\x03" + struct.pack(">I", round(60e6 / TEMPO_BPM))[1:]
    now = 0
    for tick, _, message in sorted(messages):
        data += variable_length(tick - now) + message
        now = tick
    return data + b"\x00\xff\x2f\x00"


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "presets" / "demo" / "slap.mid"
    path = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    track = track_bytes()
    path.write_bytes(b"MThd" + struct.pack(">IHHH", 6, 0, 1, TICKS_PER_QUARTER) + b"MTrk" + struct.pack(">I", len(track)) + track)


if __name__ == "__main__":
    main()
