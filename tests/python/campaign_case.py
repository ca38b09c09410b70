"""A small campaign, and the table that it ends with, for the tests of all the places where it may run."""

import itertools
import json
import os
import subprocess
import sys

import numpy as np

import jawari

RESTITUTIONS = [0.0, 0.25, 0.5, 0.75, 1.0]
RATES_HZ = [48000.0, 96000.0, 480000.0]
HEIGHTS_M = (-0.002, -0.0005)
DRAWS = 3


def scene(duration_s=0.05):
    string = {
        "name": "A", "length_m": 0.65, "linear_density_kg_per_m": 0.001, "modes": {"count": 60, "tension_N": 70},
        "initial": {"pluck": {"position_m": 0.13, "height_m": 0.003}},
        "contacts": [{"position_m": 0.2, "height_m": -0.001}, {"position_m": 0.4, "height_m": -0.0015}],
        "probes": [{"quantity": "displacement", "position_m": 0.1}, {"quantity": "energy"}],
    }  # fmt: skip
    return {"schema": "jawari.scene/1", "duration_s": duration_s, "law": "passive", "strings": [string]}


def write(folder, **changes):
    document = {
        "schema": "jawari.campaign/1",
        "scene": scene(),
        "axes": {"strings[0].contacts[*].restitution": RESTITUTIONS, "contact_rate_hz": RATES_HZ},
        "random": {"count": DRAWS, "seed": 5, "axes": {"strings[0].contacts[0].height_m": list(HEIGHTS_M)}},
        "outputs": {"spectrum": {"bands": 8, "to_hz": 4000}, "rows": {"every": 100}},
    }
    document.update(changes)
    path = os.path.join(folder, "campaign.json")
    with open(path, "w") as file:
        json.dump(document, file)
    return path


def command(path, *options):
    return [sys.executable, "-B", "-m", "jawari.campaign", path, *options]


def run(path, *options, **settings):
    return subprocess.run(command(path, *options), capture_output=True, text=True, **settings)


def table(folder):
    with open(os.path.join(folder, "campaign", "results.csv")) as file:
        return file.read()


def expected_rows():
    """(inputs, result) of each run, by simulate() in a plain loop; the heights are read from the table."""
    return list(itertools.product(RESTITUTIONS, RATES_HZ, range(DRAWS)))


def check_against_simulate(test, folder):
    """Every tenth row has the numbers of jawari.simulate with its inputs."""
    import csv
    import io

    rows = list(csv.DictReader(io.StringIO(table(folder))))
    cases = expected_rows()
    test.assertEqual(len(rows), len(cases))
    for row, (restitution, rate_hz, _) in list(zip(rows, cases))[::10]:
        height_m = float(row["strings[0].contacts[0].height_m"])
        test.assertTrue(HEIGHTS_M[0] <= height_m <= HEIGHTS_M[1])
        one = scene()
        for contact in one["strings"][0]["contacts"]:
            contact["restitution"] = restitution
        one["strings"][0]["contacts"][0]["height_m"] = height_m
        result = jawari.simulate(one, contact_rate_hz=rate_hz)
        test.assertEqual(float(row["rms:displacement_m@0.1"]), float(np.sqrt(np.mean(result[0] ** 2))))
        test.assertEqual(int(row["impulses"]), result.stats["impulses"])
        test.assertEqual(float(row["final_energy_J"]), result.stats["final_energy_J"])
