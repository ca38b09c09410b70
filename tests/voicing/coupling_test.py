"""scripts/voicing/coupling.py finds the two stages, beats, scatter, glide and foreign sound that were put into a note."""
import pathlib
import struct
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "voicing"))

import coupling  # noqa: E402
import soundfont  # noqa: E402

RATE_HZ = 48000
FIRST_HZ = 220.0
FALL = np.log(1000)


def seconds(length_s):
    return np.arange(int(length_s * RATE_HZ)) / RATE_HZ


def note(envelope_of, length_s=3.0, phase_of=None):
    t = seconds(length_s)
    phase = phase_of(t) if phase_of else 2 * np.pi * FIRST_HZ * t
    return sum(envelope_of(k, t) * np.sin(k * phase + k) / k for k in range(1, 17))


def measured(envelope_of, **more):
    return coupling.of_held_note(note(envelope_of, **more), FIRST_HZ, RATE_HZ)


class CouplingTest(unittest.TestCase):
    def test_a_string_alone_has_one_stage_no_beats_and_a_smooth_decay(self):
        found = measured(lambda k, t: np.exp(-FALL * t / (4 / (1 + 0.1 * k))))
        for group in ("1-3", "4-8", "9-16"):
            self.assertAlmostEqual(found[f"late_over_early_{group}"], 1, delta=0.02)
            self.assertLess(found[f"beat_db_{group}"], 0.03)
        self.assertLess(found["scatter_percent"], 2)
        self.assertAlmostEqual(found["glide_cents"], 0, delta=0.05)
        self.assertLess(found["between_db"], -70)

    def test_a_decay_that_becomes_slower_has_two_stages(self):
        broken = lambda k, t: 10 ** (-(60 * np.minimum(t, 0.8) / 2 + 60 * np.maximum(t - 0.8, 0) / 6) / 20)  # noqa: E731
        found = measured(broken)
        for group in ("1-3", "4-8", "9-16"):
            self.assertAlmostEqual(found[f"late_over_early_{group}"], 3, delta=0.15)
            self.assertLess(found[f"beat_db_{group}"], 0.3)

    def test_beats_of_a_known_depth(self):
        depth_db = 2.0  # amplitude of a level that swings as a sine: rms 1.41 dB
        found = measured(lambda k, t: 10 ** (-(60 * t / 5 + depth_db * np.sin(2 * np.pi * 2.5 * t)) / 20))
        for group in ("1-3", "4-8", "9-16"):
            self.assertAlmostEqual(found[f"beat_db_{group}"], depth_db / np.sqrt(2), delta=0.2)

    def test_scatter_is_what_is_left_of_a_smooth_curve(self):
        factors = {k: 1.5 if k % 2 else 1 / 1.5 for k in range(1, 17)}
        found = measured(lambda k, t: np.exp(-FALL * t / (4 * factors[k])))
        # ln T60 swings by 0.405 about its mean: rms of e^+-0.405 - 1, of equal parts
        expected = 100 * np.sqrt(((1.5 - 1) ** 2 + (1 / 1.5 - 1) ** 2) / 2)
        self.assertAlmostEqual(found["scatter_percent"], expected, delta=4)

    def test_a_glide_of_known_cents(self):
        start_cents, time_s = 20.0, 0.25

        def phase(t):
            return 2 * np.pi * FIRST_HZ * np.cumsum(2 ** (start_cents * np.exp(-t / time_s) / 1200)) / RATE_HZ

        found = measured(lambda k, t: np.exp(-FALL * t / 5), phase_of=phase)
        later = np.mean([start_cents * np.exp(-at / time_s) for at in np.arange(0.6, 1.0, 0.02)])
        self.assertAlmostEqual(found["glide_cents"], start_cents * np.exp(-0.05 / time_s) - later, delta=0.6)

    def test_sound_between_the_partials(self):
        t = seconds(3.0)
        own = note(lambda k, t: np.ones(len(t)))
        power = sum(1 / k ** 2 for k in range(1, 17)) / 2
        other = np.sqrt(2 * power) * 10 ** (-30 / 20) * np.sin(2 * np.pi * 1.5 * FIRST_HZ * t)
        self.assertAlmostEqual(coupling.of_held_note(own + other, FIRST_HZ, RATE_HZ)["between_db"], -30, delta=0.3)

    def test_a_note_too_short_has_no_figures(self):
        found = measured(lambda k, t: np.ones(len(t)), length_s=0.3)
        self.assertIsNone(found["glide_cents"])
        self.assertIsNone(found["scatter_percent"])


def chunk(name, data):
    return name + struct.pack("<I", len(data)) + data + b"\0" * (len(data) & 1)


def bank(samples, loop, root, override):
    """A SoundFont of one preset (program 5, bank 0) with one sample."""
    name = lambda text: text.encode().ljust(20, b"\0")  # noqa: E731
    ends = lambda bags: struct.pack("<2H", bags, 0)  # noqa: E731
    tables = {
        b"phdr": struct.pack("<20s3H3I", name("a"), 5, 0, 0, 0, 0, 0) + struct.pack("<20s3H3I", name("EOP"), 0, 0, 1, 0, 0, 0),
        b"pbag": ends(0) + ends(1), b"pgen": struct.pack("<2H", 41, 0) + ends(0),
        b"inst": struct.pack("<20sH", name("a"), 0) + struct.pack("<20sH", name("EOI"), 1),
        b"ibag": ends(0) + ends(2), b"igen": struct.pack("<4H", 58, override, 53, 0) + ends(0),
        b"shdr": struct.pack("<20s5IBbHH", name("s"), 10, 10 + len(samples), 10 + loop, 10 + len(samples), 22050, root, -7, 0, 1)
                 + struct.pack("<20s5IBbHH", name("EOS"), 0, 0, 0, 0, 0, 0, 0, 0, 0)}
    pcm = np.concatenate([np.zeros(10), samples, np.zeros(46)]).astype("<i2").tobytes()
    lists = chunk(b"LIST", b"sdta" + chunk(b"smpl", pcm)) + chunk(b"LIST", b"pdta" + b"".join(chunk(n, t) for n, t in tables.items()))
    return chunk(b"RIFF", b"sfbk" + lists)


class SoundFontTest(unittest.TestCase):
    def test_a_recording_ends_where_its_loop_begins(self):
        samples = np.arange(100) * 100
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "one.sf2"
            path.write_bytes(bank(samples, loop=60, root=60, override=64))
            heads = list(soundfont.SoundFont(path).heads(5))
            self.assertEqual(list(soundfont.SoundFont(path).heads(6)), [])
        self.assertEqual(len(heads), 1)
        root, cents, rate, found = heads[0]
        self.assertEqual((root, cents, rate), (64, -7, 22050))
        np.testing.assert_allclose(found, samples[:60] / 32768)

    def test_another_file_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "other.sf2"
            path.write_bytes(chunk(b"RIFF", b"WAVE"))
            with self.assertRaises(ValueError):
                soundfont.SoundFont(path)


if __name__ == "__main__":
    unittest.main()
