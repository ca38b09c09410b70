#!/usr/bin/python3
"""The same plucked string under Newton's law in Siconos, and under every law of `jawari simulate`: what happens to its energy,
and how deep it goes into its obstacles.

    laws_side_by_side.py --jawari build/release/bin/jawari                 (lab/bass, 862 modes: a few minutes)
    laws_side_by_side.py --jawari ... --scene scenes/fretted_bass.json --check

Prints a row for each law and restitution. *Injected* is the sum of what impacts added to the energy in the steps in which
they added any; *H* the discrete energy (docs/engine/model.md), computed for Siconos from its modal state. Both start from rest
with the same modal shape. With --check nothing but a verdict is printed, and the exit code is 1 unless Siconos injects energy
for some e and penetrates with e = 1, while `passive` and `signorini` inject none and `signorini` never penetrates.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

import jawari_scene
import oracle

h5py = oracle.need("h5py", "python3-h5py")
reference_step = oracle.need("reference_step", "python3-mpmath")
siconos_oracle = oracle.need("siconos_oracle", "python3-siconos")

LAWS = ["newton", "passive", "signorini", "paoli-schatzman"]
NOT_PASSIVE = ("newton", "paoli-schatzman")  # docs/engine/stability.md, section 2


def arguments():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jawari", required=True, help="the program")
    parser.add_argument("--scene", default=os.path.join(here, "../../presets/scenes/lab/bass.json"))
    parser.add_argument("--rate", type=float, default=44100.0, help="contact rate; default: audio rate")
    parser.add_argument("--seconds", type=float, default=0.1)
    parser.add_argument("--louder", type=float, default=1.0, help="factor of the pluck's height")
    parser.add_argument("--restitution", type=float, nargs="+", default=[0.0, 0.5, 0.9, 1.0])
    parser.add_argument("--check", action="store_true", help="only the verdict")
    return parser.parse_args()


def playing(options):
    """The scene's first string at the rate asked for, plucked as hard as asked for."""
    scene = jawari_scene.read_scene(options.scene)
    string = scene["strings"][0]
    initial = string["initial"]
    if "pluck" in initial:
        initial["pluck"]["height_m"] *= options.louder
    for key in ("modal_displacement", "modal_velocity"):
        if key in initial:
            initial[key] = [options.louder * value for value in initial[key]]
    string["probes"] = []
    steps = round(options.seconds * options.rate)
    scene.update(contact_rate_hz=options.rate, output_rate_hz=options.rate, duration_s=steps / options.rate, strings=[string])
    return scene, steps


def record(gaps, impulses, energies, works):
    gained = np.diff(works)
    return {
        "impulses": int(np.count_nonzero(impulses > 0)),
        "injected": float(gained[gained > 0].sum() / energies[0]),
        "highest": float(energies.max() / energies[0]),
        "deepest": float(max(0.0, -gaps.min())),
    }


def by_siconos(scene, steps, restitution):
    string = jawari_scene.read_string(scene["strings"][0], restitution)
    h = 1 / scene["contact_rate_hz"]
    result = siconos_oracle.simulate(string, h, steps)
    gaps = result["q"] @ string.rows.T - string.bias
    before = np.vstack([gaps[:1] - h * (result["v"][:1] @ string.rows.T), gaps[:-1]])
    # Impacts of step n work by sum lambda (y_n - y_(n-2))/(2h).
    works = np.zeros(steps + 1)
    works[1:] = np.cumsum(np.sum(result["impulse"][1:] * (gaps[1:] - before[:-1]), axis=1)) / (2 * h)
    d, e, w = reference_step.exact_coefficients(string.omega, string.sigma, h)
    kinetic = string.density * (2 * (1 + e) - d) / (8 * w)
    potential = string.density * string.omega**2 / 2
    energies = (result["v"] ** 2) @ kinetic + ((result["q"] - h / 2 * result["v"]) ** 2) @ potential
    return record(gaps, result["impulse"], energies, works)


def by_jawari(scene, law, restitution, program):
    with tempfile.TemporaryDirectory() as folder:
        scene_path, out_path = os.path.join(folder, "scene.json"), os.path.join(folder, "out.h5")
        with open(scene_path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        command = [program, "simulate", scene_path, "--start", "backward", "--law", law, "--restitution", repr(restitution),
                   "--meter-steps", "--out", out_path]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} exited with {done.returncode}: {done.stderr.strip()}")
        with h5py.File(out_path, "r") as file:
            string = file["strings/0"]
            return record(string["gap_m"][:], string["impulse_Ns"][:], string["energy_J"][:], string["contact_work_J"][:])


def verdict(rows):
    """What is wrong with the records, as lines; rounding is 1e-12 of the energy and 1e-12 m."""
    wrong = []
    siconos = [row for row in rows if row["law"] == "newton (Siconos)"]
    if not any(row["injected"] > 1e-9 for row in siconos):
        wrong.append("Siconos never injects energy")
    if not any(row["deepest"] > 1e-6 for row in siconos if row["restitution"] == 1):
        wrong.append("Siconos never penetrates with e = 1")
    for row in rows:
        name = f"{row['law']}, e = {row['restitution']:g}"
        if not row["law"].startswith(NOT_PASSIVE) and (row["injected"] > 1e-12 or row["highest"] > 1 + 1e-12):
            wrong.append(f"{name}: injects {row['injected']:.1e} of the energy")
        if row["law"] == "signorini" and row["deepest"] > 1e-12:
            wrong.append(f"{name}: penetrates by {row['deepest']:.1e} m")
        if row["impulses"] < 10:
            wrong.append(f"{name}: {row['impulses']} impulses")
    return wrong


def main():
    options = arguments()
    scene, steps = playing(options)
    rows = []
    if not options.check:
        print("| e | law | impulses | injected (of H at the start) | largest H/H(0) | deepest (mm) |\n|---|---|---|---|---|---|")
    for restitution in options.restitution:
        for law in ["newton (Siconos)", *LAWS]:
            of_siconos = law.endswith("(Siconos)")
            row = by_siconos(scene, steps, restitution) if of_siconos else by_jawari(scene, law, restitution, options.jawari)
            rows.append({"law": law, "restitution": restitution, **row})
            if not options.check:
                print(f"| {restitution:g} | {law} | {row['impulses']} | {row['injected']:.2g} | 1 + {row['highest'] - 1:.1g} | "
                      f"{1000 * row['deepest']:.2g} |", flush=True)
    wrong = verdict(rows)
    if options.check:
        print("\n".join(wrong) or "AS STATED")
    return 1 if options.check and wrong else 0


if __name__ == "__main__":
    sys.exit(main())
