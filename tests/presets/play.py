"""Renders MIDI through the program and reads what it wrote."""
import json
import os
import pathlib
import struct
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts" / "demo"))
from midi import Score  # noqa: E402

RATE_HZ = 48000
TICKS_BPM = 125  # with 480 ticks a quarter, a beat lasts 0.48 s and a tick a millisecond
BEAT_S = 0.48


def score():
    return Score("test", TICKS_BPM)


def beats(seconds):
    return seconds / BEAT_S


def read_wav(path):
    """Samples (frames, channels) of a float or 24-bit WAV."""
    data = pathlib.Path(path).read_bytes()
    at, form = 12, None
    while at + 8 <= len(data):
        kind, size = data[at:at + 4], struct.unpack("<I", data[at + 4:at + 8])[0]
        body = data[at + 8:at + 8 + size]
        if kind == b"fmt ":
            form = struct.unpack("<HHIIHH", body[:16])
        if kind == b"data":
            channels, bits = form[1], form[5]
            if bits == 32:
                return np.frombuffer(body, "<f4").astype(float).reshape(-1, channels), form[2]
            raise ValueError(f"{path}: {bits} bits a sample")
        at += 8 + size + size % 2
    raise ValueError(f"{path}: no data")


class Rendered:
    def __init__(self, samples, stats):
        self.stereo = samples
        self.mono = samples.mean(axis=1)
        self.stats = stats


def render(program, preset, midi, folder, name, tail_s=0.5, arguments=(), rate_hz=RATE_HZ):
    """preset: a name, or a dictionary that becomes a file; midi: a Score."""
    folder = pathlib.Path(folder)
    if isinstance(preset, dict):
        path = folder / f"{name}.json"
        path.write_text(json.dumps(preset))
        preset = str(path)
    (folder / f"{name}.mid").write_bytes(midi.file_bytes())
    wav = folder / f"{name}.wav"
    command = [program, "render", str(folder / f"{name}.mid"), "--preset", preset, "-o", str(wav), "--rate", str(rate_hz), "--format", "float",
               "--tail", str(tail_s), "--stats", "-", *arguments]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: exit code {run.returncode}: {run.stderr.strip()}")
    samples, rate = read_wav(wav)
    assert rate == rate_hz
    os.remove(wav)
    return Rendered(samples, json.loads(run.stdout))
