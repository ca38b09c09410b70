#!/usr/bin/env python3
"""Writes presets/instruments/*.json from the tables of scripts/instruments. Pure Python, same bytes on every run.

The tables hold what is known of each instrument (wire gauges, scalings, sources); what follows from them by a formula
(linear density, inharmonicity, fret heights) is computed here and nowhere else.

usage: make_presets.py [--check] [NAME...]     --check: write nothing, fail if a file differs
"""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts" / "instruments"))

import basses  # noqa: E402
import eastern  # noqa: E402
import guitars  # noqa: E402
import keyboards  # noqa: E402
import layout  # noqa: E402
from levels import AIM_DB  # noqa: E402

SCHEMA = "jawari.preset/2"
INSTRUMENTS = {**basses.INSTRUMENTS, **guitars.INSTRUMENTS, **eastern.INSTRUMENTS, **keyboards.INSTRUMENTS}
# Chosen so that a chord at velocity 127 peaks near AIM_DB: tests/presets/check_levels.py --suggest.
GAIN = {
    "bass-fretted": 0.12, "bass-fretless": 0.094, "bass-slap": 0.053, "guitar-steel": 16, "guitar-nylon": 28, "guitar-electric": 0.044,
    "guitar-12": 22, "sitar": 23, "tanpura": 130, "biwa": 65, "harpsichord": 100, "clavichord": 120, "dulcimer": 3.1, "prepared": 2.3,
}
GAIN_SOURCE = f"chosen: a chord at velocity 127 peaks near {AIM_DB:g} dBFS (tests/presets/check_levels.py)"
QUALITY_SOURCE = "chosen: a compromise of cost and of what ultrasonic modes add (scripts/preset_convergence.py)"
ORDER = ["comment", "provenance", "gain", "contact_rate_min_hz", "mode_limit_hz", "studio", "law", "play", "frets", "obstacles", "soft_touches", "exciters", "hand",
         "pickups", "body", "strings"]


def preset(name):
    content = INSTRUMENTS[name]()
    content["gain"] = GAIN[name]
    content["provenance"] = {"gain": GAIN_SOURCE, "contact_rate_min_hz": QUALITY_SOURCE, "mode_limit_hz": QUALITY_SOURCE,
                             **content.get("provenance", {})}
    ordered = {"schema": SCHEMA, "name": content.pop("name")}
    ordered.update((key, content.pop(key)) for key in ORDER if key in content)
    assert not content, f"{name}: {list(content)} have no place in the file"
    return layout.document(ordered)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("names", nargs="*", default=list(INSTRUMENTS))
    arguments = parser.parse_args()
    stale = []
    for name in arguments.names:
        path = ROOT / "presets" / "instruments" / f"{name}.json"
        text = preset(name)
        if arguments.check:
            if not path.exists() or path.read_text() != text:
                stale.append(name)
        else:
            path.write_text(text)
    if stale:
        sys.exit(f"make_presets.py: presets/instruments differs from scripts/instruments: {', '.join(stale)}")


if __name__ == "__main__":
    main()
