"""The estimator of scripts/voicing finds what was put in: tones, noise and decays whose figures are known without it."""
import pathlib
import sys
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "voicing"))

import compare  # noqa: E402
import notes  # noqa: E402
import properties  # noqa: E402
import report  # noqa: E402
import sets  # noqa: E402
import sounds  # noqa: E402

RATE_HZ = 48000


def seconds(length_s):
    return np.arange(int(length_s * RATE_HZ)) / RATE_HZ


def tone(frequency_hz, length_s, level_db=0.0):
    return 10 ** (level_db / 20) * np.sin(2 * np.pi * frequency_hz * seconds(length_s))


def string_sound(first_hz, t60_of, partials=16, length_s=1.5):
    t = seconds(length_s)
    return sum(np.exp(-np.log(1000) / t60_of(k) * t) * np.sin(2 * np.pi * k * first_hz * t + k) / k for k in range(1, partials + 1))


class ColourTest(unittest.TestCase):
    def test_two_tones_fill_their_third_octaves_in_proportion(self):
        levels = properties.third_octaves(tone(400, 0.6) + tone(1600, 0.6, -20), RATE_HZ)
        share = 1 / (1 + 0.01)
        self.assertAlmostEqual(levels[6], 10 * np.log10(share), delta=0.1)
        self.assertAlmostEqual(levels[12], 10 * np.log10(0.01 * share), delta=0.2)

    def test_white_noise_rises_by_a_decibel_a_third_octave(self):
        noise = np.random.default_rng(1).normal(size=(RATE_HZ // 2, 64))  # as channels: their powers are added
        levels = properties.third_octaves(noise, RATE_HZ)
        slope = np.polyfit(range(len(levels)), levels, 1)[0]
        self.assertAlmostEqual(slope, 10 * np.log10(2) / 3, delta=0.05)

    def test_a_filter_of_six_decibels_is_a_distance_of_six_decibels_where_it_acts(self):
        sound = sum(tone(f, 0.6) for f in properties.CENTRES_HZ)
        darker = sum(tone(f, 0.6, -6 if f > 900 else 0) for f in properties.CENTRES_HZ)
        one, other = (properties.third_octaves(x, RATE_HZ) for x in (sound, darker))
        change = np.subtract(one, other)
        self.assertAlmostEqual(change[10:].mean() - change[:10].mean(), 6, delta=0.05)
        self.assertEqual(properties.distance_db(one, one), 0)
        self.assertAlmostEqual(properties.distance_db(one, np.add(one, 3)), 3, delta=1e-9)

    def test_sides_out_of_phase_count_as_much_as_in_phase(self):
        left = tone(400, 0.6) + tone(3000, 0.6, -10)
        self.assertAlmostEqual(properties.high_level(np.stack([left, left], 1), RATE_HZ), properties.high_level(np.stack([left, -left], 1), RATE_HZ))

    def test_level_from_five_to_ten_kilohertz(self):
        self.assertAlmostEqual(properties.high_level(tone(500, 0.6) + tone(7000, 0.6, -30), RATE_HZ), -30, delta=0.1)

    def test_centroid_of_two_equal_tones_is_their_mean(self):
        self.assertAlmostEqual(properties.centroid_hz(tone(500, 0.6) + tone(1500, 0.6), RATE_HZ), 1000, delta=5)

    def test_thump_is_what_lies_below_the_first_partial(self):
        knock = tone(100, 0.6, -20)
        self.assertAlmostEqual(properties.thump(tone(400, 0.6) + knock, 400, RATE_HZ), -20, delta=0.3)
        self.assertLess(properties.thump(tone(400, 0.6), 400, RATE_HZ), -40)

    def test_correlation_of_sides(self):
        random = np.random.default_rng(2)
        one, other = random.normal(size=(2, RATE_HZ))
        self.assertAlmostEqual(properties.correlation(np.stack([one, one], 1), RATE_HZ), 1)
        self.assertAlmostEqual(properties.correlation(np.stack([one, -one], 1), RATE_HZ), -1)
        self.assertAlmostEqual(properties.correlation(np.stack([one, other], 1), RATE_HZ), 0, delta=0.02)
        self.assertAlmostEqual(properties.correlation(np.stack([one, one + other], 1), RATE_HZ), np.sqrt(0.5), delta=0.02)


class LoudnessTest(unittest.TestCase):
    def test_the_a_curve_has_the_values_of_its_standard(self):
        for tenths, db in ((15, -39.4), (20, -19.1), (30, 0.0), (34, 1.3), (39, -1.1), (42, -6.6)):  # IEC 61672-1, table 3: 10^(n/10) Hz
            self.assertAlmostEqual(10 * np.log10(properties.a_weighting(10 ** (tenths / 10))), db, delta=0.06)

    def test_a_level_of_a_tone_follows_the_curve(self):
        difference = properties.a_level(tone(1000, 0.6), RATE_HZ) - properties.a_level(tone(100, 0.6), RATE_HZ)
        self.assertAlmostEqual(difference, 19.1, delta=0.2)

    def test_loudness_of_the_tones_of_ebu_tech_3341(self):
        for level_db in (-23.0, -33.0):  # cases 1 and 2: 1 kHz on both sides reads its peak level
            both = np.repeat(tone(1000, 5, level_db)[:, None], 2, axis=1)
            self.assertAlmostEqual(properties.loudness_lufs(both, RATE_HZ), level_db, delta=0.1)

    def test_the_relative_gate_leaves_quiet_parts_out(self):
        loud, quiet = tone(1000, 12, -23), tone(1000, 2, -36)  # case 3, shortened
        both = np.repeat(np.concatenate([quiet, loud, quiet])[:, None], 2, axis=1)
        self.assertAlmostEqual(properties.loudness_lufs(both, RATE_HZ), -23, delta=0.15)


class DecayTest(unittest.TestCase):
    def test_decay_times_of_groups_of_partials(self):
        found = properties.decay_times(string_sound(196, lambda k: 5 / (1 + 0.2 * k)), 196, RATE_HZ)
        for group, middle in (("1-3", 2), ("4-8", 6), ("9-16", 12.5)):
            self.assertAlmostEqual(found[group] / (5 / (1 + 0.2 * middle)), 1, delta=0.03)

    def test_a_tone_that_stays_has_no_decay_time(self):
        self.assertIsNone(properties.decay_times(tone(200, 1.5), 200, RATE_HZ)["1-3"])

    def test_release_time_and_what_is_heard_after_it(self):
        t = seconds(2.0)
        envelope = np.where(t < 1.5, 1, np.exp(-np.log(1000) / 0.4 * (t - 1.5)))
        t60_s, after_db = properties.release(np.sin(2 * np.pi * 500 * t) * envelope, 1.5, RATE_HZ)
        self.assertAlmostEqual(t60_s, 0.4, delta=0.04)
        self.assertAlmostEqual(after_db, -60 / 0.4 * 0.085, delta=2)


class NotesTest(unittest.TestCase):
    def test_every_note_of_a_key_is_in_the_midi_file_once(self):
        score, starts = notes.of_key(60)
        on = [message for _, _, message in score.events if message[0] == 0x90]
        self.assertEqual([message[2] for message in on], [velocity for velocity, _ in starts])
        self.assertTrue(all(message[1] == 60 for message in on))

    def test_the_phrase_stays_on_the_keys_there_are(self):
        keys = [36, 43, 48]
        on = [message[1] for _, _, message in notes.of_phrase(keys).events if message[0] == 0x90]
        self.assertTrue(set(on) <= set(keys))

    def test_playable_keys_of_courses_and_frets(self):
        preset = {"frets": {"count": 2}, "strings": [{"open_note": 40, "course": 0}, {"open_note": 52, "course": 0},
                                                     {"open_note": 60, "frets": {"height_m": [-1e-3], "semitones": [3]}}]}
        self.assertEqual(sets.playable_keys(preset), [40, 41, 42, 60, 63])


class CompareTest(unittest.TestCase):
    def test_distances_are_between_keys_near_each_other(self):
        mine, other = {40: [0] * 20, 60: [0] * 20}, {41: [-4] * 20, 80: [-9] * 20}
        self.assertEqual(compare.distance(mine, other), (4, 1))
        self.assertEqual(compare.distance(mine, {90: [0] * 20}), (None, 0))

    def test_evenness_is_of_neighbours_and_of_the_whole(self):
        found = compare.evenness({"9": -20, "10": -26, "11": -21})
        self.assertEqual((found["step_db"], found["range_db"], found["peak_key"]), (6, 6, "9"))

    def test_the_worst_comes_first_and_what_has_no_sets_last(self):
        rows = [{"name": n, "fitted_db": d, "among_db": a} for n, d, a in (("good", 8, 8), ("alone", None, None), ("bad", 16, 8))]
        self.assertEqual([row["name"] for row in report.worst_first(rows)], ["bad", "good", "alone"])

    def test_what_lies_outside_the_sets_is_bold(self):
        row = {"figures": {"thump_db": -5.0}, "real": {"thump_db": (-24.0, -20.0)}}
        self.assertEqual(report.beside(row, "thump_db"), "**-5.0** (-24.0 to -20.0)")
        row["figures"]["thump_db"] = -22.0
        self.assertEqual(report.beside(row, "thump_db"), "-22.0 (-24.0 to -20.0)")

    def test_no_set_is_both_fitted_and_held_out(self):
        facts = sets.reference()
        self.assertFalse(set(sets.FITTED) & set(sets.HELD_OUT))
        for name, labels in sets.REFERENCE_HELD_OUT.items():
            self.assertTrue(set(labels) <= set(facts["third_octave_sets"][name]))
            self.assertFalse(any(compare.is_of_fluid(label) for label in labels))


class PassageTest(unittest.TestCase):
    def test_a_passage_inside_a_sound_is_that_part_of_it(self):
        sound = np.column_stack([tone(300, 2.0)] * 2)
        self.assertTrue((sounds.passage(sound, 0.5, 1.0) == sound[24000:72000]).all())

    def test_a_sound_that_breaks_off_is_an_error(self):
        sound = np.column_stack([tone(300, 2.0)] * 2)
        for start_s in (1.5, 1.995, 2.5):
            with self.assertRaises(ValueError):
                sounds.passage(sound, start_s, 1.0)

    def test_what_has_died_away_goes_on_in_silence(self):
        sound = np.column_stack([tone(300, 2.0) * np.exp(-np.log(1000) / 0.4 * seconds(2.0))] * 2)
        part = sounds.passage(sound, 0.0, 2.5)
        self.assertEqual(len(part), 120000)
        self.assertTrue((part[:96000] == sound).all() and not part[96000:].any())


if __name__ == "__main__":
    unittest.main()
