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
import body  # noqa: E402
import eastern  # noqa: E402
import guitars  # noqa: E402
import keyboards  # noqa: E402
import layout  # noqa: E402
from levels import PHRASE_LUFS  # noqa: E402

SCHEMA, SCHEMA_OF_BRIDGES = "jawari.preset/2", "jawari.preset/3"  # the latter where the bridge moves
# Under docs/examples/render: what a preset may have and no built-in one has. Fitted and as loud as the preset behind it.
EXAMPLES = {"coupled-guitar": (guitars.coupled, "guitar-nylon")}
INSTRUMENTS = {**basses.INSTRUMENTS, **guitars.INSTRUMENTS, **eastern.INSTRUMENTS, **keyboards.INSTRUMENTS}
# Chosen so that the same phrase is equally loud on all: scripts/voice.py PROGRAM --gains prints them. The sitar is 0.8 dB below that,
# as far as its loudest chord demands; the tanpura 0.8 dB above, as its chord is the softest.
GAIN = {
    "bass-fretted": 0.0835, "bass-fretless": 0.0392, "bass-slap": 0.0232, "guitar-steel": 27.6, "guitar-nylon": 63, "guitar-electric": 0.0197, "guitar-12": 28.8,
    "sitar": 40.7, "tanpura": 34.8, "biwa": 30, "harpsichord": 26.9, "clavichord": 194, "dulcimer": 5.75, "prepared": 2.07,
}
GAIN_SOURCE = f"chosen: the same phrase has {PHRASE_LUFS:g} LUFS on every preset (scripts/voice.py --gains)"
QUALITY_SOURCE = "chosen: a compromise of cost and of what ultrasonic modes add (scripts/preset_convergence.py)"
ORDER = ["comment", "provenance", "gain", "contact_rate_min_hz", "mode_limit_hz", "studio", "law", "play", "frets", "obstacles", "soft_touches", "exciters", "hand",
         "pickups", "bridge", "body", "strings"]


def preset(name):
    make, name = EXAMPLES.get(name, (INSTRUMENTS.get(name), name))
    content = make()
    if "body" in content:
        content["body"] = body.fitted(name, content["body"])
        if "bridge" in content:
            content["body"] = body.moving(content["body"], *content.pop("masses"), strings=len(content["strings"]),
                                          tilts=content.pop("tilts"))
        content["provenance"] = {**content.get("provenance", {}), "body": body.source(name, content.get("provenance", {})["body"])}
    content = body.coloured(name, content)
    content["strings"] = body.levelled(name, content["strings"])
    content["gain"] = GAIN[name]
    content["provenance"] = {"gain": GAIN_SOURCE, "contact_rate_min_hz": QUALITY_SOURCE, "mode_limit_hz": QUALITY_SOURCE,
                             **content.get("provenance", {})}
    ordered = {"schema": SCHEMA_OF_BRIDGES if "bridge" in content else SCHEMA, "name": content.pop("name")}
    ordered.update((key, content.pop(key)) for key in ORDER if key in content)
    assert not content, f"{name}: {list(content)} have no place in the file"
    return layout.document(ordered)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("names", nargs="*", default=[*INSTRUMENTS, *EXAMPLES])
    arguments = parser.parse_args()
    stale = []
    for name in arguments.names:
        folder = "docs/examples/render" if name in EXAMPLES else "presets/instruments"
        path = ROOT / folder / f"{name}.json"
        text = preset(name)
        if arguments.check:
            if not path.exists() or path.read_text() != text:
                stale.append(name)
        else:
            path.write_text(text)
    if stale:
        sys.exit(f"make_presets.py: presets/instruments or docs/examples/render differ from scripts/instruments: {', '.join(stale)}")


if __name__ == "__main__":
    main()
