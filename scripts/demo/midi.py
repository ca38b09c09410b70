"""A score in beats, written as a standard MIDI file of type 0. Same bytes on every run."""
import struct

TICKS_PER_QUARTER = 480


def variable_length(value):
    digits = [value & 0x7F]
    while value := value >> 7:
        digits.append(0x80 | value & 0x7F)
    return bytes(reversed(digits))


class Score:
    """Events at beats (quarters); ends of notes come before what starts at the same tick."""

    def __init__(self, title, tempo_bpm):
        self.title = title
        self.tempo_bpm = tempo_bpm
        self.events = []

    def add(self, beat, rank, *message):
        self.events.append((round(beat * TICKS_PER_QUARTER), rank, bytes(message)))

    def note(self, beat, key, length, velocity, channel=0, release=64):
        self.add(beat, 2, 0x90 | channel, key, velocity)
        self.add(beat + length, 0, 0x80 | channel, key, release)

    def control(self, beat, controller, value, channel=0):
        self.add(beat, 1, 0xB0 | channel, controller, value)

    def bend_range(self, semitones, channel=0):
        """RPN 0."""
        for controller, value in ((101, 0), (100, 0), (6, semitones), (38, 0), (101, 127), (100, 127)):
            self.control(0, controller, value, channel)

    def bend(self, beat, share, channel=0):
        """share of the bend range, -1 to 1."""
        value = min(16383, max(0, round(8192 + 8192 * share)))
        self.add(beat, 1, 0xE0 | channel, value & 0x7F, value >> 7)

    def glide(self, beat, length, start, end, channel=0, steps=24):
        """A bend in steps, slow at both ends."""
        for i in range(steps + 1):
            t = i / steps
            self.bend(beat + length * t, start + (end - start) * t * t * (3 - 2 * t), channel)

    def pressure(self, beat, value, channel=0):
        self.add(beat, 1, 0xD0 | channel, value)

    def file_bytes(self):
        name = self.title.encode()
        data = b"\x00\xff\x03" + variable_length(len(name)) + name
        data += b"\x00\xff\x51\x03" + struct.pack(">I", round(60e6 / self.tempo_bpm))[1:]
        now = 0
        for tick, _, message in sorted(self.events, key=lambda event: event[:2] if event[1] == 1 else event):
            data += variable_length(tick - now) + message
            now = tick
        data += b"\x00\xff\x2f\x00"
        return b"MThd" + struct.pack(">IHHH", 6, 0, 1, TICKS_PER_QUARTER) + b"MTrk" + struct.pack(">I", len(data)) + data
