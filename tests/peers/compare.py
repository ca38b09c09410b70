#!/usr/bin/python3
"""Runs a scene in `jawari simulate` and in an independent program, and compares them step by step.

    compare.py --jawari build/release/bin/jawari --scene scenes/fretted_bass.json --peer siconos --restitution 0.5
    compare.py --jawari ... --scene ../../presets/scenes/lab/bass.json --full        (862 modes, minutes)

Peers: `siconos` (MoreauJeanBilbaoOSI for the exact scheme, MoreauJeanOSI for theta; Newton's law only) and `reference`
(the documented step in numpy, for every impact law). Both start with the velocity taken literally (`backward`).

Compared at every step: displacement probes, relative to the largest displacement; velocity probes, relative to the largest
velocity; the impulse of every contact, relative to the largest impulse. Exit code 0 if all agree to --tolerance and the
run had at least --min-impulses impulses, 1 if not, 2 if something could not be run, 77 if the peer is not installed.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

import jawari_scene
import oracle


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jawari", required=True, help="the program under test")
    parser.add_argument("--scene", required=True)
    parser.add_argument("--peer", choices=["siconos", "reference"], default="siconos")
    parser.add_argument("--scheme", choices=["exact", "theta"], default="exact")
    parser.add_argument("--theta", type=float, default=0.5)
    parser.add_argument("--law", default="newton")
    parser.add_argument("--restitution", type=float, help="of every contact; default: as the scene says")
    parser.add_argument("--peer-restitution", type=float, help="another one for the peer: the comparison must then fail")
    parser.add_argument("--steps", type=int, help="default: the scene's duration")
    parser.add_argument("--contact-rate", type=float, help="default: the scene's")
    parser.add_argument("--tolerance", type=float, default=1e-10)
    parser.add_argument("--min-impulses", type=int, default=24)
    parser.add_argument("--full", action="store_true", help="lab scenes at 15 680 Hz; accepts minutes of computing")
    parser.add_argument("--out", help="save both trajectories as .npz")
    options = parser.parse_args()
    if options.full and options.contact_rate is None:
        options.contact_rate = 15680.0
    return options


def stepwise_scene(scene, options):
    """The scene with one output row per contact step and a force probe on every contact."""
    scene = json.loads(json.dumps(scene))
    string = scene["strings"][0]
    rate = options.contact_rate or scene["contact_rate_hz"]
    steps = options.steps or round(scene["duration_s"] * rate)
    scene.update(contact_rate_hz=rate, output_rate_hz=rate, duration_s=steps / rate, strings=[string])
    probes = [p for p in string.get("probes", []) if p["quantity"] in ("displacement", "velocity")]
    contacts = len(jawari_scene.read_string(string).bias)
    if contacts + len(probes) <= 256:
        probes = probes + [{"quantity": "contact_force", "contact": c} for c in range(contacts)]
    string["probes"] = probes
    return scene, 1 / rate, steps


def run_jawari(scene, options):
    """Rows of (displacement and velocity probes, impulses)."""
    with tempfile.TemporaryDirectory() as folder:
        scene_path, csv_path = os.path.join(folder, "scene.json"), os.path.join(folder, "out.csv")
        with open(scene_path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        command = [options.jawari, "simulate", scene_path, "--start", "backward", "--scheme", options.scheme,
                   "--law", options.law, "--out", csv_path]
        if options.scheme == "theta":
            command += ["--theta", repr(options.theta)]
        if options.restitution is not None:
            command += ["--restitution", repr(options.restitution)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            print(f"{' '.join(command)} exited with {done.returncode}: {done.stderr.strip()}", file=sys.stderr)
            sys.exit(2)
        return np.loadtxt(csv_path, delimiter=",", skiprows=1)


def peer_of(options):
    """simulate(string, step, steps) of the peer."""
    if options.peer == "siconos":
        if options.law != "newton":
            print("Siconos has Newton's law only; use --peer reference", file=sys.stderr)
            sys.exit(2)
        siconos = oracle.need("siconos_oracle", "python3-siconos")
        return lambda string, step, steps: siconos.simulate(string, step, steps, options.scheme, options.theta)
    reference = oracle.need("reference_step", "python3-mpmath")
    return lambda string, step, steps: reference.simulate(string, step, steps, options.scheme, options.theta, options.law)


def probe_values(string, result):
    displacement, velocity = result["q"] @ string.probe_rows.T, result["v"] @ string.probe_rows.T
    is_displacement = np.array([q == "displacement" for q in string.probe_quantities])
    return np.where(is_displacement, displacement, velocity), is_displacement


def relative_error(ours, theirs):
    largest = np.max(np.abs(theirs), initial=0.0)
    return np.max(np.abs(ours - theirs), initial=0.0) / largest if largest > 0 else 0.0


def main():
    options = arguments()
    simulate = peer_of(options)
    scene, step, steps = stepwise_scene(jawari_scene.read_scene(options.scene), options)
    started = time.perf_counter()
    table = run_jawari(scene, options)
    ours_s = time.perf_counter() - started
    if table.shape[0] != steps + 1:
        print(f"jawari wrote {table.shape[0]} rows, expected {steps + 1}", file=sys.stderr)
        sys.exit(2)

    restitution = options.restitution if options.peer_restitution is None else options.peer_restitution
    string = jawari_scene.read_string(scene["strings"][0], restitution)
    started = time.perf_counter()
    result = simulate(string, step, steps)
    peer_s = time.perf_counter() - started
    theirs, is_displacement = probe_values(string, result)
    count = theirs.shape[1]
    ours, impulses = table[:, 1 : 1 + count], table[:, 1 + count :] * step

    errors = {"displacement": relative_error(ours[:, is_displacement], theirs[:, is_displacement])}
    if not is_displacement.all():
        errors["velocity"] = relative_error(ours[:, ~is_displacement], theirs[:, ~is_displacement])
    if impulses.shape[1]:
        errors["impulse"] = relative_error(impulses, result["impulse"])
    struck = int(np.count_nonzero(result["impulse"] > 0))
    agree = all(error <= options.tolerance for error in errors.values()) and struck >= options.min_impulses

    numbers = " ".join(f"{name}={error:.2e}" for name, error in errors.items())
    scheme = options.scheme if options.scheme == "exact" else f"theta={options.theta}"
    residual = f" peer_lcp_residual={result['residual'].max():.1e}" if "residual" in result else ""
    print(f"{'AGREE' if agree else 'DISAGREE'} {options.peer} {os.path.basename(options.scene)} {scheme} {options.law} "
          f"e={'scene' if restitution is None else restitution} steps={steps} impulses={struck} {numbers}{residual} "
          f"jawari_s={ours_s:.2f} peer_s={peer_s:.2f}")
    if options.out:
        np.savez(options.out, ours=ours, theirs=theirs, impulses=impulses, peer_impulses=result["impulse"])
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
