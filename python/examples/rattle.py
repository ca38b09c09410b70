"""A string that rattles on one stop, at all restitutions, in threads: energies as one labelled table if xarray is there.

Usage: rattle.py [SECONDS]
"""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import jawari


def main(duration_s=0.05):
    restitutions = np.linspace(0, 1, 6)

    def run(e):
        return jawari.simulate("lab/one-contact", law="passive", restitution=float(e), duration_s=duration_s)

    with ThreadPoolExecutor() as pool:
        results = list(pool.map(run, restitutions))
    left = [r.strings[0].energy_J[-1] / r.strings[0].energy_J[0] for r in results]
    for e, result, share in zip(restitutions, results, left):
        print(f"e = {e:.1f}: {result.stats['impulses']:6d} impulses, {100 * share:6.2f} % of the energy left")
    try:
        import xarray
    except ImportError:
        return left
    table = xarray.concat([r.to_xarray()["energy_J_0"] for r in results], xarray.Variable("restitution", restitutions))
    print(table.isel(time_s=-1))
    return left


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
