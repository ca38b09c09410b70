"""Measured notes of presets (rendered by jawari) and of recorded sets (rendered by fluidsynth), kept in a cache.

A measurement is kept under a hash of all that it depends on: program, preset or sample set, notes, and the estimator itself.
A run that is interrupted loses the file at hand alone.
"""
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import coupling
import evenness
import notes
import properties

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "presets"))
from play import read_wav  # noqa: E402

RATE_HZ = 48000
HERE = pathlib.Path(__file__).resolve().parent


def digest(*parts):
    whole = hashlib.sha256()
    for part in parts:
        data = part if isinstance(part, bytes) else str(part).encode()
        whole.update(str(len(data)).encode() + b":" + data)
    return whole.hexdigest()[:32]


def note_hz(key):
    return 440.0 * 2 ** ((key - 69) / 12)


# A sound that ends early has died away if its last hundredth of a second is this far below its loudest sample.
DIED_AWAY_DB = -60.0


def passage(sound, start_s, length_s):
    """Part of a sound. What is missing at its end is silence only where the sound had died away; else it is an error."""
    begin, length = int(start_s * RATE_HZ), int(length_s * RATE_HZ)
    part = sound[begin:begin + length]
    if len(part) == length:
        return part
    peak, last = (float(properties.np.abs(x).max(initial=0.0)) for x in (part, part[-RATE_HZ // 100:]))
    if len(part) < RATE_HZ // 100 or last > peak * 10 ** (DIED_AWAY_DB / 20):
        raise ValueError(f"the sound ends {len(sound) / RATE_HZ:.3f} s after its start, in a note that is heard until {start_s + length_s:.3f} s")
    return properties.np.pad(part, ((0, length - len(part)), (0, 0)))


def measure_key(sound, key, starts):
    return {str(velocity): properties.of_note(passage(sound, start, notes.HEARD_S), note_hz(key), notes.HOLD_S, RATE_HZ,
                                             decays=velocity == notes.USUAL)
            for velocity, start in starts}


def measure_held(sound, key, starts):
    return {str(velocity): coupling.of_held_note(passage(sound, start, notes.LONG_HOLD_S), note_hz(key), RATE_HZ) for velocity, start in starts}


def measure_compass(sound, starts):
    return {str(key): round(properties.a_level(passage(sound, start, notes.SHORT_HOLD_S), RATE_HZ), 2) for key, start in starts}


def measure_powers(sound, starts):
    return {str(key): [float(f"{x:.4g}") for x in evenness.a_weighted_bins(passage(sound, start, notes.SHORT_HOLD_S), RATE_HZ)] for key, start in starts}


def measure_colours(sound, starts):
    return {str(key): properties.third_octaves(passage(sound, start, properties.SPECTRUM_S), RATE_HZ) for key, start in starts}


def measure_phrase(sound):
    left, right = (sound ** 2).sum(axis=0)[[0, -1]]
    return {"lufs": round(properties.loudness_lufs(sound, RATE_HZ), 2), "left_over_right_db": round(properties.relative_db(left, right), 2)}


class Cache:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.estimator = digest(*((HERE / name).read_bytes() for name in ("properties.py", "coupling.py", "evenness.py", "sounds.py", "notes.py")))

    def get(self, key, make):
        path = self.folder / f"{key}.json"
        if path.exists():
            return json.loads(path.read_text())
        result = make()
        with tempfile.NamedTemporaryFile("w", dir=self.folder, suffix=".part", delete=False) as file:
            json.dump(result, file)
        os.replace(file.name, path)
        return result


class Instrument:
    """What plays notes: subclasses say how a MIDI file becomes a sound. `identity` stands for all that the sound depends on."""

    def __init__(self, cache, name, identity, midi):
        self.cache, self.name, self.identity, self.midi = cache, name, identity, midi

    def sound(self, midi_bytes):
        with tempfile.TemporaryDirectory() as folder:
            source, target = pathlib.Path(folder) / "notes.mid", pathlib.Path(folder) / "sound.wav"
            source.write_bytes(midi_bytes)
            command = self.command(str(source), str(target))
            run = subprocess.run(command, capture_output=True, text=True, check=False)
            if run.returncode != 0 or not target.exists():
                sys.exit(f"voice.py: {' '.join(command)}: exit code {run.returncode}: {run.stderr.strip()}")
            samples, rate = read_wav(target)
            assert rate == RATE_HZ
            return samples

    def measured(self, score, make):
        data = score.file_bytes()
        return self.cache.get(digest(self.identity, data, self.cache.estimator), lambda: make(self.sound(data)))

    def key(self, key):
        score, starts = notes.of_key(key, **self.midi)
        return self.measured(score, lambda sound: measure_key(sound, key, starts))

    def held(self, key):
        score, starts = notes.of_held(key, **self.midi)
        return self.measured(score, lambda sound: measure_held(sound, key, starts))

    def compass(self, keys):
        score, starts = notes.of_compass(keys, **self.midi)
        return self.measured(score, lambda sound: measure_compass(sound, starts))

    def powers(self, keys):
        """A-weighted spectrum of every key: which of its partials make it loud."""
        score, starts = notes.of_compass(keys, **self.midi)
        data = score.file_bytes()
        return self.cache.get(digest("powers", self.identity, data, self.cache.estimator), lambda: measure_powers(self.sound(data), starts))

    def colours(self, keys):
        """Third octaves at the usual velocity, key -> levels: what a fit looks at."""
        score, starts = notes.of_colours(keys, **self.midi)
        found = self.measured(score, lambda sound: measure_colours(sound, starts))
        return {int(key): levels for key, levels in found.items()}

    def phrase(self, keys):
        return self.measured(notes.of_phrase(keys, **self.midi), measure_phrase)


class Preset(Instrument):
    def __init__(self, cache, program, path):
        self.program, self.path = program, path
        super().__init__(cache, path.stem, digest(digest(pathlib.Path(program).read_bytes()), path.read_bytes()), {})

    def command(self, source, target):
        return [self.program, "render", source, "--preset", str(self.path), "-o", target, "--rate", str(RATE_HZ), "--format", "float", "--tail", "0.3",
                "--quiet"]


class Recorded(Instrument):
    """Reverberation and chorus are off; the velocity curves, filters and envelopes are the set's own."""

    def __init__(self, cache, name, path, program, bank=0):
        self.path = path
        size = path.stat().st_size
        super().__init__(cache, name, f"{path.name} {size}", {"program": program, "bank": bank})

    def command(self, source, target):
        return ["fluidsynth", "-n", "-i", "-q", "-o", "synth.dynamic-sample-loading=1", "-R", "0", "-C", "0", "-g", "0.5", "-r", str(RATE_HZ), "-O", "float", "-T", "wav", "-F", target,
                str(self.path), source]
