"""The published bass over its frets: when it strikes which fret, and what a fret costs the note.

Usage: published_bass.py [SECONDS]
"""

import sys

import numpy as np

import jawari


def main(duration_s=0.1):
    result = jawari.simulate("lab/bass", law="signorini", duration_s=duration_s)
    bass = result.strings[0]
    struck = bass.impulse_Ns.sum(axis=0)
    for fret in np.flatnonzero(struck):
        first = result.time_s[np.flatnonzero(bass.impulse_Ns[:, fret])[0]]
        print(f"fret {fret + 1:2d} at {bass.contact_position_m[fret]:.3f} m: first at {1e3 * first:6.2f} ms, {struck[fret]:.3e} N s")
    lost = 1 - bass.energy_J[-1] / bass.energy_J[0]
    print(f"{result.stats['impulses']} impulses, {100 * lost:.1f} % of the energy lost in {duration_s} s")
    return struck.sum()


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
