"""Running one simulation, and how far two of them are apart. Used by the scripts beside it."""
import functools
import json
import pathlib
import resource
import signal
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = {
    "bass": "lab/bass",
    "one-contact": "lab/one-contact",
    "fretless": "lab/fretless",
    "smooth-bass": "smooth/bass",
    "guitar": str(ROOT / "benchmarks/work_precision/scenes/guitar.json"),
}
# Strings known by a table of modes alone: methods that need the string's equation cannot have them.
TABLES = ("bass", "one-contact", "fretless")
RESTITUTIONS = (0.0, 0.5, 0.9, 1.0)
OUTPUT_RATE_HZ = 15680
RATES_HZ = [OUTPUT_RATE_HZ * 2**n for n in range(12)]  # 15.68 kHz to 32.1 MHz
REFERENCE_RATE_HZ = OUTPUT_RATE_HZ * 4096  # 64.2 MHz


def program(build):
    return pathlib.Path(build) / "bin" / "trajectory"


class GivenUp(RuntimeError):
    """The program used more CPU time than it was allowed."""


def simulate(build, scene, repeat=3, enough_s=1.0, cpu_limit_s=None, **options):
    """(statistics, samples as rows x probes) of one run; options are those of the program, `_` for `-`."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "samples"
        command = [program(build), "--scene", SCENES.get(scene, scene), "--out", out, "--repeat", str(repeat),
                   "--enough", repr(enough_s)]
        for key, value in options.items():
            if value is not None:
                command += ["--" + key.replace("_", "-"), repr(value) if isinstance(value, float) else str(value)]
        def limit():
            if cpu_limit_s is not None:
                resource.setrlimit(resource.RLIMIT_CPU, (cpu_limit_s, cpu_limit_s + 1))
        done = subprocess.run(command, capture_output=True, text=True, check=False, preexec_fn=limit)
        if done.returncode == -signal.SIGXCPU:
            raise GivenUp(f"given up after {cpu_limit_s} CPU seconds")
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, command))}: {done.stderr.strip()}")
        stats = json.loads(done.stdout)
        return stats, np.fromfile(out).reshape(stats["rows"], stats["probes"])


@functools.cache
def load_reference(scene, restitution):
    with np.load(ROOT / "benchmarks" / "reference" / f"{scene}.npz") as arrays:
        return arrays[f"e{restitution:g}"]


def relative_error(samples, reference):
    """Relative L2 error over time, root mean square over the positions, each relative to its own reference."""
    if not np.isfinite(samples).all():
        return float("inf")
    each = np.linalg.norm(samples - reference, axis=0) / np.linalg.norm(reference, axis=0)
    return float(np.sqrt(np.mean(each**2)))


def error_at(samples, reference, position):
    """Relative L2 error at one position, as the publications give it."""
    return float(np.linalg.norm(samples[:, position] - reference[:, position]) / np.linalg.norm(reference[:, position]))


def onset_levels_db(samples):
    """Energy [dB] of the velocity in third-octave bands from 99 Hz to 6.3 kHz of the whole onset, bands x positions.

    The difference of two displacements stands for the velocity, as a listener hears a string's motion. The half
    Hann window falls from 1 at the pluck to 0 at the end.
    """
    velocity = np.diff(samples, axis=0) * OUTPUT_RATE_HZ
    window = np.hanning(2 * len(velocity))[len(velocity):]
    power = np.abs(np.fft.rfft(velocity * window[:, None], axis=0)) ** 2
    frequency = np.fft.rfftfreq(len(velocity), 1 / OUTPUT_RATE_HZ)
    centres = 1000 * 2.0 ** (np.arange(-10, 9) / 3)
    edge = 2.0 ** (1 / 6)
    bands = [power[(frequency >= c / edge) & (frequency < c * edge)].sum(axis=0) for c in centres]
    return 10 * np.log10(np.array(bands) + 1e-300)


def spectrum_distance_db(samples, reference):
    """Root mean square difference of the onset's levels over bands and positions [dB]; bands more than 60 dB below the
    reference's strongest do not count."""
    if not np.isfinite(samples).all():
        return float("inf")
    ours, theirs = onset_levels_db(samples), onset_levels_db(reference)
    heard = theirs > theirs.max(axis=0) - 60
    return float(np.sqrt(np.mean((ours - theirs)[heard] ** 2)))
