"""The Python package beside the program and beside closed forms. Usage: package_test.py JAWARI [unittest arguments]."""

import concurrent.futures
import json
import math
import os
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

try:
    import numpy as np
except ImportError:
    print("SKIPPED: no NumPy here (python3-numpy)")
    sys.exit(77)

import jawari

PROGRAM = sys.argv.pop(1)


def program(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


def free_string(**changes):
    """Two modes without loss: u(x, t) = sum q_k(0) cos(omega_k t) phi_k(x)."""
    string = {
        "length_m": 0.5, "linear_density_kg_per_m": 0.001,
        "modes": {"frequency_hz": [100.0, 230.0], "decay_per_s": [0.0, 3.0]},
        "initial": {"modal_displacement": [1e-3, 2e-4]},
        "probes": [{"quantity": "displacement", "position_m": 0.2}, {"quantity": "energy"}],
    }  # fmt: skip
    string.update(changes)
    return {"schema": "jawari.scene/1", "duration_s": 0.05, "output_rate_hz": 8000, "strings": [string]}


class LikeTheProgram(unittest.TestCase):
    def csv(self, scene, *options):
        done = program("simulate", scene, "--out", "-", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return np.array([line.split(",") for line in done.stdout.splitlines()[1:]], dtype=float)

    def test_probes_have_the_bits_of_the_program(self):
        for scene, contacts in (("lab/bass", True), ("lab/one-contact", False), ("lab/tanpura", True)):
            with self.subTest(scene=scene):
                result = jawari.simulate(scene, duration_s=0.01, contacts=contacts)
                table = self.csv(scene, "--duration", "0.01")
                np.testing.assert_array_equal(result.time_s, table[:, 0])
                np.testing.assert_array_equal(result.probes, table[:, 1:])

    def test_settings_are_those_of_the_command_line(self):
        result = jawari.simulate("lab/bass", duration_s=0.005, law="passive", restitution=0.9, contact_rate_hz=480000,
                                 output_rate_hz=48000, start="exact")  # fmt: skip
        table = self.csv("lab/bass", "--duration", "0.005", "--law", "passive", "--restitution", "0.9", "--contact-rate",
                         "480000", "--output-rate", "48000", "--start", "exact")  # fmt: skip
        np.testing.assert_array_equal(result.probes, table[:, 1:])
        self.assertEqual(result.stats["settings"]["law"], "passive")

    def test_contacts_and_energies_have_the_bits_of_hdf5(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("no h5py here")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.h5")
            self.assertEqual(program("simulate", "lab/one-contact", "--duration", "0.01", "--meter-steps", "--out", path).returncode, 0)
            string = jawari.simulate("lab/one-contact", duration_s=0.01, meter_steps=True).strings[0]
            with h5py.File(path) as file:
                group = file["strings/0"]
                for name in ("gap_m", "impulse_Ns", "energy_J", "dissipated_J", "contact_work_J", "player_work_J",
                             "contact_position_m", "contact_height_m", "frequency_hz", "decay_per_s",
                             "final_modal_displacement", "final_modal_velocity"):  # fmt: skip
                    np.testing.assert_array_equal(getattr(string, name), group[name][()], err_msg=name)
            self.assertGreater(np.count_nonzero(string.impulse_Ns), 0)

    def test_a_dict_has_the_bits_of_its_name(self):
        scene = jawari.Scene("lab/bass", duration_s=0.003)
        np.testing.assert_array_equal(jawari.simulate(scene).probes, jawari.simulate("lab/bass", duration_s=0.003).probes)
        np.testing.assert_array_equal(jawari.simulate(scene.json()).probes, jawari.simulate(scene).probes)

    def test_what_is_not_played_is_a_warning(self):
        with self.assertWarnsRegex(jawari.Notice, "sitar: no string has the keys 40; their notes are not played"):
            sound = jawari.render([(0.0, [0x90, 40, 100]), (0.1, [0x80, 40, 0])], "sitar", tail_s=0.1)
        self.assertEqual(np.abs(sound).max(), 0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            sound = jawari.render([(0.0, [0x90, 49, 100]), (0.1, [0x80, 49, 0])], "sitar", tail_s=0.1)
        self.assertGreater(np.abs(sound).max(), 0.01)

    def test_a_scene_that_cannot_be_saved_leaves_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            target = os.path.join(folder, "taken")
            os.mkdir(target)
            with self.assertRaises(jawari.FileError) as raised:
                jawari.Scene(free_string()).save(target)
            self.assertIn(target, str(raised.exception))
            self.assertEqual(os.listdir(folder), ["taken"])
            with self.assertRaises(jawari.FileError):
                jawari.Scene(free_string()).save(os.path.join(folder, "nowhere", "scene.json"))

    def test_messages_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.json")
            for change in ({"length_m": -1}, {"lenght_m": 1}, {"probes": [{"quantity": "speed"}]},
                           {"contacts": [{"position_m": 2, "height_m": 0}]}):  # fmt: skip
                jawari.Scene(free_string(**change)).save(path)
                said = program("simulate", path)
                with self.assertRaises(jawari.InvalidInput) as raised:
                    jawari.simulate(path)
                self.assertEqual(str(raised.exception), said.stderr.strip().removeprefix("jawari: "))
                self.assertEqual(raised.exception.exit_code, said.returncode)
                with self.assertRaises(jawari.InvalidInput) as of_dict:
                    jawari.simulate(free_string(**change))
                self.assertEqual(str(of_dict.exception), str(raised.exception).replace(path, "scene"))
        said = program("simulate", "lab/bas")
        with self.assertRaises(jawari.FileError) as raised:
            jawari.simulate("lab/bas")
        self.assertEqual(str(raised.exception), said.stderr.strip().removeprefix("jawari: "))

    def test_music_has_the_samples_of_render(self):
        midi = os.path.join(os.path.dirname(__file__), "..", "..", "presets", "demo", "slap.mid")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.wav")
            for preset in ("bass-slap", "auto"):
                done = program("render", midi, "--preset", preset, "--format", "float", "--tail", "0.2", "-o", path)
                self.assertEqual(done.returncode, 0, done.stderr)
                sound = jawari.render(midi, preset, tail_s=0.2)
                np.testing.assert_array_equal(sound.astype(np.float32), wav_floats(path))
        with open(midi, "rb") as file:
            np.testing.assert_array_equal(jawari.render(file.read(), jawari.Preset("bass-slap"), tail_s=0.2),
                                          jawari.render(midi, "bass-slap", tail_s=0.2))  # fmt: skip


def wav_floats(path):
    with open(path, "rb") as file:
        data = file.read()
    place = 12
    while data[place : place + 4] != b"data":
        place += 8 + struct.unpack("<I", data[place + 4 : place + 8])[0]
    return np.frombuffer(data, "<f4", struct.unpack("<I", data[place + 4 : place + 8])[0] // 4, place + 8).reshape(-1, 2)


class ClosedForms(unittest.TestCase):
    def test_a_free_string_is_the_sum_of_its_modes(self):
        scene = free_string()
        result = jawari.simulate(scene)
        modes, string = scene["strings"][0]["modes"], scene["strings"][0]
        u = np.zeros_like(result.time_s)
        for k, (f, decay, q0) in enumerate(zip(modes["frequency_hz"], modes["decay_per_s"], (1e-3, 2e-4)), start=1):
            omega = math.sqrt((2 * math.pi * f) ** 2 - decay**2)
            phi = math.sqrt(2 / string["length_m"]) * math.sin(k * math.pi * 0.2 / string["length_m"])
            t = result.time_s
            u += q0 * phi * np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t))
        np.testing.assert_allclose(result[0], u, rtol=0, atol=1e-9 * np.abs(u).max())

    def test_energy_balance_closes(self):
        string = jawari.simulate("lab/one-contact", duration_s=0.01, law="passive", meter_steps=True).strings[0]
        change = string.energy_J - string.energy_J[0]
        works = string.contact_work_J + string.player_work_J - string.dissipated_J
        np.testing.assert_allclose(change, works, rtol=0, atol=1e-12 * string.energy_J[0])

    def test_events_sound_at_their_pitch(self):
        sound = jawari.render([(0.0, [0x90, 45, 100]), (1.0, (0x80, 45, 0))], "guitar-steel", tail_s=0)
        self.assertEqual(sound.shape, (48000, 2))
        spectrum = np.abs(np.fft.rfft(sound[4800:, 0] * np.hanning(43200)))
        octave = spectrum[50:180]  # bins of 1.11 Hz: 55 to 200 Hz
        self.assertAlmostEqual((50 + int(octave.argmax())) * 48000 / 43200, 110.0, delta=1.5)


class Stepwise(unittest.TestCase):
    def test_rows_are_those_of_simulate_however_they_are_grouped(self):
        whole = jawari.simulate("lab/bass", duration_s=0.005)
        simulation = jawari.Simulation("lab/bass")
        rows = [simulation.advance(7), simulation.advance(seconds=20 / whole.output_rate_hz), simulation.advance()]
        rows.append(simulation.advance(len(whole.time_s) - 1 - simulation.frame))
        np.testing.assert_array_equal(np.concatenate(rows), whole.probes[:-1])
        np.testing.assert_array_equal(simulation.probes, whole.probes[-1])
        string, last = simulation.strings[0], whole.strings[0]
        np.testing.assert_array_equal(string.q, last.final_modal_displacement)
        np.testing.assert_array_equal(string.v, last.final_modal_velocity)
        np.testing.assert_allclose(string.gap_m, last.gap_m[-1][string.contacts], rtol=1e-9, atol=1e-15)
        np.testing.assert_array_equal(string.impulse_Ns, last.impulse_Ns[-1][string.contacts])
        self.assertEqual(string.energy_J, last.energy_J[-1])

    def test_views_are_the_engines_memory_and_cannot_be_written_to(self):
        string = jawari.Simulation(free_string()).strings[0]  # the views keep the simulation alive
        self.assertTrue(np.shares_memory(string.q, string.q))
        with self.assertRaises(ValueError):
            string.q[0] = 1
        before = string.q.copy()
        string.set_modes(2 * before, string.v)
        np.testing.assert_array_equal(string.q, 2 * before)

    def test_a_copy_goes_its_own_way(self):
        simulation = jawari.Simulation("lab/bass")
        simulation.advance(100)
        other = simulation.copy()
        first = simulation.advance(200)
        np.testing.assert_array_equal(other.advance(200), first)
        simulation.reset()
        self.assertEqual((simulation.frame, other.frame), (0, 300))

    def test_a_saved_state_goes_on_with_the_same_bits(self):
        whole = jawari.Simulation("lab/bass")
        whole.advance(500)
        state = whole.save()
        other = jawari.Simulation("lab/bass")
        self.assertTrue(other.restore(state))
        self.assertEqual(other.frame, 500)
        np.testing.assert_array_equal(whole.advance(700), other.advance(700))
        finer = jawari.Simulation("lab/bass", contact_rate_hz=4014080)
        self.assertFalse(finer.restore(state))
        self.assertEqual(finer.frame, 500)
        with self.assertRaises(jawari.Error):
            jawari.Simulation("lab/one-contact").restore(state)
        with self.assertRaises(jawari.Error):
            other.restore(state[:-9])

    def test_callbacks_come_at_output_times(self):
        simulation = jawari.Simulation(free_string())
        times = []
        rows = simulation.advance(10, callback=lambda s: times.append(s.frame), every=4)
        self.assertEqual(times, [0, 4, 8])
        np.testing.assert_array_equal(rows, jawari.simulate(free_string()).probes[:10])
        self.assertEqual(len(simulation.advance(10, callback=lambda s: s.frame < 14, every=2)), 4)
        with self.assertRaisesRegex(KeyError, "mine"):
            simulation.advance(1, callback=lambda s: {}["mine"])

    def test_modes_that_are_set_continue_the_motion(self):
        simulation = jawari.Simulation(free_string())
        simulation.advance(50)
        other = jawari.Simulation(free_string())
        other.strings[0].set_modes(simulation.strings[0].q, simulation.strings[0].v)
        np.testing.assert_array_equal(other.advance(20)[:, 0], simulation.advance(20)[:, 0])
        with self.assertRaisesRegex(jawari.UsageError, r"q: 1 values \(allowed: 2, one per mode\)"):
            other.strings[0].set_modes([0], [0, 0])

    def test_an_obstacle_that_is_moved_lifts_the_string(self):
        scene = free_string(initial={}, contacts=[{"position_m": 0.2, "height_m": -1e-3}])
        simulation = jawari.Simulation(scene)
        simulation.strings[0].move_contact(0, 5e-4, 0.01)
        simulation.advance(seconds=0.02)
        self.assertAlmostEqual(simulation.strings[0].contact_height_m[0], 5e-4, places=12)
        self.assertGreater(simulation.strings[0].energy_J, 0)
        for wrong in ((1, 0.0, 0.0), (0, math.nan, 0.0), (0, 0.0, -1.0)):
            with self.assertRaises(jawari.UsageError):
                simulation.strings[0].move_contact(*wrong)


class Threads(unittest.TestCase):
    def test_a_sweep_in_threads_has_the_bits_of_one_thread(self):
        def run(e):
            return jawari.simulate("lab/bass", duration_s=0.004, law="passive", restitution=e).probes

        sweep = [i / 11 for i in range(12)]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            together = list(pool.map(run, sweep))
        for e, probes in zip(sweep, together):
            np.testing.assert_array_equal(probes, run(e))

    def test_the_gil_is_released(self):
        simulation = jawari.Simulation("lab/bass", skipping=False)
        thread = threading.Thread(target=simulation.advance, args=(200,))
        counted = 0
        thread.start()
        while thread.is_alive():
            counted += 1
        self.assertGreater(counted, 100)

    def test_one_thread_at_a_time_may_advance_a_simulation(self):
        simulation = jawari.Simulation("lab/bass", skipping=False)
        thread = threading.Thread(target=simulation.advance, args=(400,))
        thread.start()
        with self.assertRaisesRegex(jawari.UsageError, "in use by another thread"):
            while thread.is_alive():
                simulation.advance(1)
            self.fail("never met the other thread")
        thread.join()

    def test_ctrl_c_ends_a_simulation(self):
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            jawari.simulate("lab/bass", duration_s=100, skipping=False)


class Package(unittest.TestCase):
    def test_version_is_that_of_the_program(self):
        self.assertIn(jawari.__version__, program("--version").stdout)

    def test_what_is_not_allowed_is_refused(self):
        refused = [
            (dict(law="newtom"), r'law: "newtom"; did you mean "newton"'),
            (dict(duration_s=-1), r"duration_s: -1 \(allowed: 0 to 86400\)"),
            (dict(duration_s=math.nan), r"duration_s: nan"),
            (dict(contact_rate_hz=50001), r"--contact-rate: 50001"),
            (dict(theta=0.7), r"--theta: 0.7"),
            (dict(restitution=2), r"restitution"),
        ]
        for settings, message in refused:
            with self.subTest(settings=settings), self.assertRaisesRegex(jawari.Error, message):
                jawari.simulate("lab/bass", **settings)
        with self.assertRaisesRegex(jawari.Error, "NaN"):
            jawari.simulate(free_string(length_m=math.nan))
        for events in ([(0, [60, 1, 2])], [(0, [0x90, 60])], [(0, [0x90, 60, 128])], [(-1, [0x90, 60, 1])], [(0, [])]):
            with self.subTest(events=events), self.assertRaises(jawari.UsageError):
                jawari.render(events, "bass-slap")
        with self.assertRaises(jawari.InvalidInput):
            jawari.render(b"no MIDI", "bass-slap")
        with self.assertRaises(jawari.UsageError):
            jawari.render([], "bass-slap", rate=7)
        preset = jawari.Preset("bass-slap")
        preset["strings"] = []
        with self.assertRaisesRegex(jawari.InvalidInput, "^bass-slap: "):
            preset.validate()

    def test_scenes_are_dicts(self):
        self.assertIn("lab/bass", jawari.scene_names())
        scene = jawari.Scene("lab/bass")
        other = jawari.Scene(scene, duration_s=1)
        other["strings"][0]["length_m"] = -1
        self.assertGreater(scene.validate()["strings"][0]["length_m"], 0)
        with self.assertRaisesRegex(jawari.InvalidInput, r"^lab/bass: strings\[0\].length_m: -1"):
            other.validate()
        scene["strings"][0]["initial"]["modal_displacement"] = np.zeros(862)
        scene["duration_s"] = np.float64(0.001)
        self.assertEqual(np.abs(jawari.simulate(scene)[0]).max(), 0)
        self.assertEqual(json.loads(scene.json())["duration_s"], 0.001)

    def test_xarray_labels_the_results(self):
        try:
            import xarray
        except ImportError:
            self.skipTest("no xarray here")
        data = jawari.simulate("lab/bass", duration_s=0.002).to_xarray()
        self.assertIsInstance(data, xarray.Dataset)
        self.assertEqual(data["gap_m_0"].dims, ("time_s", "contact_0"))
        self.assertEqual((data["gap_m_0"].attrs["units"], data["time_s"].attrs["units"]), ("m", "s"))
        at = data["probes"].sel(probe="displacement_m@0.0863")
        np.testing.assert_array_equal(at, jawari.simulate("lab/bass", duration_s=0.002)["displacement_m@0.0863"])


if __name__ == "__main__":
    unittest.main()
