#!/usr/bin/env python3
"""Remakes the reference solutions: 0.1 s of each scene at 64.2 MHz, Newton's impact law.

    benchmarks/reference/make_references.py [--build build/release] [--scene bass]

SCENE.npz holds one float64 array per restitution (e0, e0.5, e0.9, e1): the displacement at the scene's positions, rows at
15 680 Hz. references.json holds what confirms them: the difference to 32.1 MHz (the error bar) and, for e = 0, to the law of
Signorini at 64.2 MHz, and that one's own error bar; each as relative L2 and as distance of the onset's spectrum in dB.
"""
import argparse
import json
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "work_precision"))
import methods  # noqa: E402


def compare(samples, reference):
    return {"error": methods.relative_error(samples, reference),
            "spectrum_dB": methods.spectrum_distance_db(samples, reference)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=methods.ROOT / "build/release")
    parser.add_argument("--scene", choices=methods.SCENES, action="append")
    options = parser.parse_args()
    path = HERE / "references.json"
    facts = json.loads(path.read_text()) if path.exists() else {}
    for scene in options.scene or methods.SCENES:
        arrays, facts[scene] = {}, {}
        for e in methods.RESTITUTIONS:
            def run(rate, law):
                stats, samples = methods.simulate(options.build, scene, repeat=1, contact_rate=rate, law=law, restitution=e)
                print(f"{scene} e = {e} {law} {rate / 1e6:.1f} MHz: {stats['render_s']:.1f} s", file=sys.stderr, flush=True)
                return samples
            finest = run(methods.REFERENCE_RATE_HZ, "newton")
            entry = {"half_rate": compare(run(methods.REFERENCE_RATE_HZ // 2, "newton"), finest)}
            if e == 0:
                other = run(methods.REFERENCE_RATE_HZ, "signorini")
                entry["signorini"] = compare(other, finest)
                entry["signorini_half_rate"] = compare(run(methods.REFERENCE_RATE_HZ // 2, "signorini"), other)
            arrays[f"e{e:g}"] = finest
            facts[scene][f"e{e:g}"] = entry
        np.savez_compressed(HERE / f"{scene}.npz", **arrays)
        path.write_text(json.dumps(facts, indent=1) + "\n")


if __name__ == "__main__":
    main()
