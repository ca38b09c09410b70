#!/usr/bin/env python3
"""How far mode_limit_hz and contact_rate_min_hz of a preset change the sound of hard plucks.

Renders single notes at several settings and compares each with the finest in third-octave bands (60 Hz to 16.5 kHz).
Collisions are chaotic, so spectra are compared; the waveform's error over the first 50 ms stands beside them.

usage: preset_convergence.py [--jawari PROGRAM] [--preset FILE] [--note KEY:VELOCITY]... [--setting RATE_HZ:LIMIT_HZ]...
(needs numpy)
"""
import argparse
import json
import pathlib
import struct
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
RATE_HZ = 48000
NOTES = {"E1": (28, 127), "B1": (35, 120), "A2": (45, 120)}
FINEST = (4e6, 160e3)
SETTINGS = [(400e3, 20e3), (500e3, 20e3), (500e3, 40e3), (1e6, 40e3), (250e3, 80e3), (500e3, 80e3), (1e6, 80e3), (2e6, 80e3)]


def note_file(key, velocity):
    """0.5 s of one note, 1 ms per tick."""
    track = bytes([0, 0x90, key, velocity, 0x83, 0x74, 0x80, key, 0]) + b"\x00\xff\x2f\x00"
    return b"MThd" + struct.pack(">IHHH", 6, 0, 1, 500) + b"MTrk" + struct.pack(">I", len(track)) + track


def read_float_wav(path):
    """The left channel."""
    data = path.read_bytes()
    at = data.index(b"data")
    size = struct.unpack("<I", data[at + 4:at + 8])[0]
    channels = struct.unpack("<H", data[22:24])[0]
    return np.frombuffer(data[at + 8:at + 8 + size], "<f4").astype(float).reshape(-1, channels).mean(axis=1)


def render(program, preset, setting, key, velocity, folder):
    varied = dict(preset, contact_rate_min_hz=setting[0], mode_limit_hz=setting[1])
    (folder / "preset.json").write_text(json.dumps(varied))
    (folder / "note.mid").write_bytes(note_file(key, velocity))
    run = subprocess.run(
        [program, "render", folder / "note.mid", "--preset", folder / "preset.json", "-o", folder / "note.wav",
         "--rate", str(RATE_HZ), "--format", "float", "--tail", "0.1", "--stats", "-"],
        check=True, capture_output=True, text=True)
    return read_float_wav(folder / "note.wav"), json.loads(run.stdout)


def band_levels_db(sound):
    spectrum = np.abs(np.fft.rfft(sound * np.hanning(2 * len(sound))[len(sound):])) ** 2
    frequency = np.fft.rfftfreq(len(sound), 1 / RATE_HZ)
    centres = 1000 * 2.0 ** (np.arange(-12, 13) / 3)
    edge = 2.0 ** (1 / 6)
    return np.array([10 * np.log10(spectrum[(frequency >= c / edge) & (frequency < c * edge)].sum()) for c in centres])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jawari", default=ROOT / "build/release/bin/jawari")
    parser.add_argument("--preset", default=ROOT / "presets/instruments/bass-fretted.json", type=pathlib.Path)
    parser.add_argument("--note", action="append", metavar="KEY:VELOCITY", help="instead of the bass's E1 B1 A2")
    parser.add_argument("--setting", action="append", metavar="RATE_HZ:LIMIT_HZ", help="instead of those of the bass")
    options = parser.parse_args()
    notes = {note.split(":")[0]: tuple(map(int, note.split(":"))) for note in options.note} if options.note else NOTES
    settings = [tuple(map(float, pair.split(":"))) for pair in options.setting] if options.setting else SETTINGS
    preset = json.loads(options.preset.read_text())
    print("note  contact rate  mode limit  bands rms  bands max  first 50 ms  real time")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for note, (key, velocity) in notes.items():
            finest, _ = render(options.jawari, preset, FINEST, key, velocity, folder)
            reference = band_levels_db(finest)
            start = slice(0, RATE_HZ // 20)
            for setting in settings:
                sound, stats = render(options.jawari, preset, setting, key, velocity, folder)
                error = band_levels_db(sound) - reference
                wave = np.linalg.norm(sound[start] - finest[start]) / np.linalg.norm(finest[start])
                print(f"{note:4}  {setting[0] / 1e3:8.0f} kHz  {setting[1] / 1e3:6.0f} kHz  "
                      f"{np.sqrt(np.mean(error**2)):6.2f} dB  {np.abs(error).max():6.2f} dB  {100 * wave:9.1f} %  "
                      f"{stats['real_time_factor']:8.2f}x")


if __name__ == "__main__":
    main()
