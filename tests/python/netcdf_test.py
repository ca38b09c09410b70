"""Recordings of `jawari simulate` opened by xarray as they are. Usage: netcdf_test.py JAWARI"""

import os
import subprocess
import sys
import tempfile
import unittest

try:
    import h5netcdf  # noqa: F401  xarray's reader
    import h5py
    import numpy as np
    import xarray
except ImportError as missing:
    print(f"SKIPPED: {missing} (python3-xarray, python3-h5netcdf, python3-h5py)")
    sys.exit(77)

import jawari

PROGRAM = sys.argv.pop(1)


class Recordings(unittest.TestCase):
    def record(self, folder, scene, *options):
        path = os.path.join(folder, "a.h5")
        done = subprocess.run([PROGRAM, "simulate", scene, "--out", path, *options], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return path

    def test_xarray_opens_them_with_names_units_and_coordinates(self):
        with tempfile.TemporaryDirectory() as folder:
            path = self.record(folder, "lab/bass", "--duration", "0.005", "--meter-steps")
            result = jawari.simulate("lab/bass", duration_s=0.005, meter_steps=True)
            with xarray.open_dataset(path, engine="h5netcdf") as root:
                self.assertEqual(root["probes"].dims, ("time_s", "probe_name"))
                self.assertEqual(root["time_s"].attrs["units"], "s")
                np.testing.assert_array_equal(root["time_s"], result.time_s)
                np.testing.assert_array_equal(root["probes"].sel(probe_name="displacement_m@0.501"), result["displacement_m@0.501"])
                self.assertEqual(root["probe_unit"].dims, ("probe_name",))
                self.assertEqual(root.attrs["schema"], "jawari.recording/1")
            with xarray.open_dataset(path, group="strings/0", engine="h5netcdf") as string:
                self.assertEqual(string["gap_m"].dims, ("time_s", "contact"))
                self.assertEqual(string["frequency_hz"].dims, ("mode",))
                units = {name: variable.attrs["units"] for name, variable in string.items()
                         if variable.dtype.kind in "biuf"}  # names are objects or strings, by the version of xarray
                self.assertEqual(units, {
                    "gap_m": "m", "impulse_Ns": "N s", "energy_J": "J", "dissipated_J": "J", "contact_work_J": "J",
                    "player_work_J": "J", "contact_position_m": "m", "contact_height_m": "m", "contact_restitution": "1",
                    "contact_takes_part": "1", "frequency_hz": "Hz", "decay_per_s": "1/s",
                    "final_modal_displacement": "m^(3/2)", "final_modal_velocity": "m^(3/2)/s"})  # fmt: skip
                np.testing.assert_array_equal(string["gap_m"], result.strings[0].gap_m)
                np.testing.assert_array_equal(string["mode"], np.arange(1, 863))

    def test_names_are_utf8(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = jawari.Scene("lab/one-contact", duration_s=0.001)
            scene["strings"].append(jawari.Scene("lab/bass")["strings"][0])
            scene["strings"][0]["name"], scene["strings"][1]["name"] = "târ ज", "bass"
            path = os.path.join(folder, "scene.json")
            scene.save(path)
            with h5py.File(self.record(folder, path)) as file:
                self.assertEqual(file["strings/0"].attrs["name"], "târ ज")
                names = file["probe_name"].asstr()[()]
                self.assertTrue(names[0].startswith("târ ज:"), names[0])
                self.assertEqual(h5py.check_string_dtype(file["probe_name"].dtype).encoding, "utf-8")
                self.assertEqual(file["probes"].dims[1][0], file["probe_name"])

    def test_scenes_without_contacts_and_probes_open_too(self):
        string = {"length_m": 0.5, "linear_density_kg_per_m": 0.001, "modes": {"count": 3, "tension_N": 50}}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.json")
            jawari.Scene({"schema": "jawari.scene/1", "duration_s": 0.001, "strings": [string]}).save(path)
            recorded = self.record(folder, path)
            with xarray.open_dataset(recorded, group="strings/0", engine="h5netcdf") as data:
                self.assertEqual(data["energy_J"].dims, ("time_s",))


if __name__ == "__main__":
    unittest.main()
