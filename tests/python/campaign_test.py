"""Campaigns on this machine: what they hold, what they refuse, and what being killed does to them (nothing)."""

import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import numpy as np
except ImportError:
    print("SKIPPED: no NumPy here (python3-numpy)")
    sys.exit(77)

import campaign_case as case
import jawari
from jawari.campaign.plan import assign, load_plan, tokens_of
from jawari.campaign.run import bands_of

KILLS = 10


class Killed(unittest.TestCase):
    def test_killed_at_ten_random_moments_it_ends_with_the_same_table(self):
        source = random.Random(20)
        with tempfile.TemporaryDirectory() as whole, tempfile.TemporaryDirectory() as killed:
            path = case.write(whole)
            begun = time.monotonic()
            done = case.run(path, "--jobs", "2")
            length_s = time.monotonic() - begun
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr, "")  # no progress where nobody looks
            case.check_against_simulate(self, whole)
            path = case.write(killed)
            deaths, written = 0, {}
            while deaths < KILLS:
                process = subprocess.Popen(case.command(path, "--jobs", "2"), start_new_session=True,
                                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)  # fmt: skip
                time.sleep(source.uniform(0.1, 0.7) * length_s)
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)  # parent and workers at once
                    deaths += 1
                elif process.returncode == 0:  # all was done: from the start again, for the kills that are left
                    for file in os.listdir(os.path.join(killed, "campaign", "runs"))[::2]:
                        os.unlink(os.path.join(killed, "campaign", "runs", file))
                        written.pop(file, None)
                process.communicate()
                for file, stamp in written.items():  # nothing that was done is done again
                    self.assertEqual(os.stat(os.path.join(killed, "campaign", "runs", file)).st_mtime_ns, stamp)
                for entry in os.scandir(os.path.join(killed, "campaign", "runs")) if os.path.exists(os.path.join(killed, "campaign", "runs")) else ():
                    if not entry.name.startswith("."):
                        written[entry.name] = entry.stat().st_mtime_ns
            last = case.run(path, "--jobs", "2")
            self.assertEqual(last.returncode, 0, last.stderr)
            self.assertEqual(case.table(killed), case.table(whole))
            self.assertFalse([f for f in os.listdir(os.path.join(killed, "campaign", "runs")) if not f.endswith(".npz")])

    def test_a_worker_that_dies_is_replaced(self):
        with tempfile.TemporaryDirectory() as folder:
            path = case.write(folder)
            process = subprocess.Popen(case.command(path, "--jobs", "1"), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            killed = 0
            while process.poll() is None and killed < 2:
                time.sleep(0.3)
                for child in children(process.pid):
                    os.kill(child, signal.SIGKILL)
                    killed += 1
            self.assertEqual(process.wait(), 0, process.communicate())
            case.check_against_simulate(self, folder)

    def test_ctrl_c_leaves_what_is_done(self):
        with tempfile.TemporaryDirectory() as folder:
            path = case.write(folder, scene=case.scene(1.0))
            process = subprocess.Popen(case.command(path, "--jobs", "2"), stderr=subprocess.PIPE, text=True)
            runs = os.path.join(folder, "campaign", "runs")
            while not os.path.exists(runs) or not os.listdir(runs):
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=30)[1]
            self.assertEqual(process.returncode, 130)
            self.assertRegex(said, r"^interrupted: \d+ of 45 runs are done; the same command goes on$")


def children(pid):
    found = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True).stdout
    return [int(line) for line in found.split()]


class Plans(unittest.TestCase):
    def test_paths_name_places_of_a_scene(self):
        self.assertEqual(tokens_of("strings[0].contacts[*].restitution"), ["strings", 0, "contacts", "*", "restitution"])
        self.assertEqual(tokens_of("a b"), [])
        scene = case.scene()
        self.assertEqual(assign(scene, tokens_of("strings[0].contacts[*].restitution"), 0.5), 2)
        self.assertEqual([c["restitution"] for c in scene["strings"][0]["contacts"]], [0.5, 0.5])
        self.assertEqual(assign(scene, tokens_of("strings[1].length_m"), 1), 0)

    def test_ranges_and_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            axes = {"strings[0].modes.tension_N": {"from": 48000, "to": 4800000, "count": 3, "scale": "log"}}
            plan = load_plan(case.write(folder, axes=axes))
            self.assertEqual(plan.inputs, ["strings[0].modes.tension_N", "strings[0].contacts[0].height_m"])
            np.testing.assert_allclose([run[0] for run in plan.runs[::3]], [48000, 480000, 4800000])
            again = load_plan(case.write(folder, axes=axes))
            self.assertEqual(plan.runs, again.runs)  # a seed is a seed
            other = load_plan(case.write(folder, axes=axes, random={"count": 3, "seed": 6, "axes": {"duration_s": [0.01, 0.02]}}))
            self.assertNotEqual(plan.runs, other.runs)

    def test_tables_set_what_their_columns_say(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "t.csv"), "w") as file:
                file.write("law,contact_rate_hz,strings[0].contacts[0].restitution\nnewton,96000,0.25\nsignorini,,\n")
            path = case.write(folder, table="t.csv", axes={"duration_s": [0.001, 0.002]}, random={})
            plan = load_plan(path)
            self.assertEqual(plan.runs, [[d, *row] for d in (0.001, 0.002) for row in (["newton", 96000, 0.25], ["signorini", None, None])])
            first, second = plan.scene_of(0), plan.scene_of(1)
            self.assertEqual((first["law"], first["strings"][0]["contacts"][0]["restitution"]), ("newton", 0.25))
            self.assertNotIn("contact_rate_hz", second)
            done = case.run(path)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("\n1,0.001,signorini,,,", case.table(folder))

    def test_draws_follow_their_laws(self):
        laws = {
            "duration_s": {"law": "log_uniform", "from": 0.001, "to": 0.1},
            "strings[0].length_m": {"law": "normal", "mean": 0.65, "deviation": 0.01},
            "law": {"law": "choice", "values": ["newton", "passive", "signorini"]},
        }
        with tempfile.TemporaryDirectory() as folder:
            plan = load_plan(case.write(folder, axes={}, random={"count": 4000, "seed": 3, "axes": laws}))
            seconds, lengths, words = zip(*plan.runs)
            self.assertAlmostEqual(np.mean(np.log10(seconds)), -2, delta=0.03)  # three standard errors
            self.assertAlmostEqual(np.std(np.log10(seconds)), 2 / np.sqrt(12), delta=0.02)
            self.assertAlmostEqual(np.mean(lengths), 0.65, delta=0.0005)
            self.assertAlmostEqual(np.std(lengths), 0.01, delta=0.0004)
            # Skewness and excess of a normal law are 0, with standard errors of 0.04 and 0.08.
            normed = (np.array(lengths) - 0.65) / 0.01
            self.assertLess(abs(np.mean(normed**3)), 0.2)
            self.assertAlmostEqual(np.mean(normed**4), 3, delta=0.4)
            for word in laws["law"]["values"]:
                self.assertAlmostEqual(words.count(word) / 4000, 1 / 3, delta=0.023)

    def test_ranges_may_be_of_multiples(self):
        with tempfile.TemporaryDirectory() as folder:
            axis = {"from": 48000, "to": 4800000, "count": 6, "scale": "log", "multiple_of": 48000}
            plan = load_plan(case.write(folder, axes={"contact_rate_hz": axis}, random={}))
            self.assertEqual([run[0] for run in plan.runs], [48000 * k for k in (1, 3, 6, 16, 40, 100)])

    def test_what_is_not_allowed_is_refused_by_place(self):
        refused = [
            (dict(schema="x"), r'schema: "x" \(allowed: "jawari.campaign/1"\)'),
            (dict(axis={}), r"axis: unknown key \(allowed: axes, "),
            (dict(axes={"strings[0": [1]}), r'axes: "strings\[0" \(allowed: paths'),
            (dict(axes={"duration_s": []}), r"axes.duration_s: \[\] \(allowed: a list of values"),
            (dict(axes={"duration_s": {"from": 0, "to": 1, "count": 3, "scale": "log"}}), r"axes.duration_s: .*above 0"),
            (dict(axes={"strings[3].length_m": [1]}, random={}), r"strings\[3\].length_m: no such place"),
            (dict(outputs={"rows": {"every": 0}}), r"outputs.rows.every: 0 \(allowed: a number from 1\)"),
            (dict(random={"count": 1}), r"random: "),
            (dict(scene="lab/bas"), r"lab/bas: no such file"),
            (dict(axes={"contact_rate_hz": [48000, 50000]}), r"contact_rate_hz: 50000 \(allowed: a multiple of output_rate_hz 48000"),
            (dict(table="none.csv"), r"none.csv: No such file"),
            (dict(random={"count": 1, "seed": 1, "axes": {"law": {"law": "normal", "mean": 1}}}), r"random.axes.law: .*a law: uniform"),
            (dict(axes={"duration_s": [1]}, random={"count": 1, "seed": 1, "axes": {"duration_s": [0, 1]}}), r"axes: \"duration_s\" "),
        ]
        with tempfile.TemporaryDirectory() as folder:
            for change, message in refused:
                with self.subTest(change=change), self.assertRaisesRegex(jawari.Error, message):
                    load_plan(case.write(folder, **change))
            path = case.write(folder)
            with open(path, "w") as file:
                file.write("{")
            said = case.run(path)
            self.assertEqual((said.returncode, said.stderr.count("\n")), (3, 1))

    def test_another_campaigns_folder_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            small = dict(axes={"duration_s": [0.01]}, random={})
            self.assertEqual(case.run(case.write(folder, **small)).returncode, 0)
            said = case.run(case.write(folder, axes={"duration_s": [0.02]}, random={}))
            self.assertEqual(said.returncode, 2)
            self.assertIn("holds another campaign", said.stderr)


class Results(unittest.TestCase):
    def test_failures_are_listed_and_run_again_if_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            path = case.write(folder, axes={"strings[0].length_m": [0.65, -1.0, 0.7]}, random={})
            for options in ((), (), ("--retry",)):
                said = case.run(path, *options)
                self.assertEqual(said.returncode, 1)
                self.assertEqual(said.stderr, "run 1 failed: scene: strings[0].length_m: -1 (allowed: 0.001 to 1000)\n")
                self.assertIn("2 of 3 runs", said.stdout)

    def test_bands_hold_the_power_of_a_tone(self):
        t = np.arange(48000) / 48000
        bands = bands_of(3 * np.sin(2 * np.pi * 1100 * t) + 7, 48000, 8, 4000)
        np.testing.assert_allclose(bands[2], 3 / np.sqrt(2), rtol=1e-9)
        self.assertLess(bands[[0, 1, 3, 4, 5, 6, 7]].max(), 1e-3)

    def test_hdf5_opens_in_xarray_with_units(self):
        try:
            import h5netcdf  # noqa: F401
            import xarray
        except ImportError as missing:
            self.skipTest(str(missing))
        with tempfile.TemporaryDirectory() as folder:
            path = case.write(folder, axes={"scene": ["lab/one-contact", "lab/bass"]}, random={}, set={"duration_s": 0.002})
            said = case.run(path)
            self.assertEqual(said.returncode, 0, said.stderr)
            with xarray.open_dataset(os.path.join(folder, "campaign", "results.h5"), engine="h5netcdf") as data:
                self.assertEqual(list(data["input:scene"].values), ["lab/one-contact", "lab/bass"])
                self.assertEqual(data["final_energy_J"].attrs["units"], "J")
                self.assertEqual(data["final_energy_J"].dims, ("run",))
                self.assertEqual(set(data["jawari_version"].values), {jawari.__version__})
                self.assertIn("machine", data)
                plan = json.loads(data.attrs["plan_json"])
                self.assertEqual(plan["constants"], {"duration_s": 0.002})
        with tempfile.TemporaryDirectory() as folder:
            path = case.write(folder, axes={"duration_s": [0.01, 0.02]}, random={})
            self.assertEqual(case.run(path).returncode, 0)
            with xarray.open_dataset(os.path.join(folder, "campaign", "results.h5"), engine="h5netcdf") as data:
                self.assertEqual(data["spectrum"].dims, ("run", "probe_name", "band_centre_hz"))
                self.assertEqual(data["input:duration_s"].attrs["units"], "s")
                result = jawari.simulate(case.scene(0.02))
                np.testing.assert_array_equal(data["probes"][1], result.probes[::100])


if __name__ == "__main__":
    unittest.main()
