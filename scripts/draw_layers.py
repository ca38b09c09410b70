#!/usr/bin/env python3
"""Draws the layers of the tree and their includes: docs/images/layers.svg.

Usage: scripts/draw_layers.py [--check | --table | --png FILE]
  (nothing)   draws the picture; needs graphviz (dot)
  --check     says whether the committed picture shows today's layers and arrows; needs no graphviz
  --table     prints all pairs of layers with the number of includes between them
  --png FILE  draws to a PNG file instead, to look at; needs graphviz

The layers are those of cmake/layers.txt, the arrows are the includes that cmake/check_layers.cmake finds. An arrow that
follows from others (a includes b, b includes c, so a may include c) is left out. The picture carries its own description
in the dot language, so that --check compares arrows and not what a version of graphviz makes of them.
"""

import argparse
import csv
import html
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs" / "images" / "layers.svg"

# What each layer holds, in a line.
PURPOSE = {
    "engine/include": "public headers: descriptions, models, states, rendering",
    "engine/src/base": "assertions, small arithmetic",
    "engine/src/description": "functions of descriptions: modes, obstacles, parameters",
    "engine/src/string/model": "step coefficients of a mode; responses of contacts",
    "engine/src/string/kernels": "SIMD loops over modes",
    "engine/src/string/solver": "complementarity solver: factor, projected gradients",
    "engine/src/string/state": "energy, forces on a string",
    "engine/src/string/contact": "one contact step: gaps, impact law, impulses",
    "engine/src/string/broad_phase": "which contacts provably stay open",
    "engine/src/string/frame": "one output frame; render()",
    "engine/src/string/compile": "compile(): scene description to model",
    "engine/src/instrument/model": "frets, lengths, pitches",
    "engine/src/instrument/touch": "fingers, hammers, felts as forces",
    "engine/src/instrument/voice": "one sounding note of a string; pickups, body",
    "engine/src/instrument/play": "events to strings; render_instrument()",
    "engine/src/instrument/compile": "compile_instrument()",
    "host/base": "files, text, errors, operating system",
    "host/formats/words": "names of enum values",
    "host/formats/json": "JSON with paths in errors",
    "host/formats/tuning": "Scala scales",
    "host/formats/midi_file": "standard MIDI files",
    "host/formats/scene": "scene files",
    "host/formats/scene_sound": "sounds as forces and heights",
    "host/formats/preset": "preset files",
    "host/instrument": "preset library, compiled instruments, limiter",
    "host/midi": "MIDI bytes to instrument events",
    "host/stage": "the core of playing: events with frames in, samples out",
    "host/plugin/core": "one instance of the plugin: parameters, state, blocks",
    "host/plugin/clap": "the plugin for CLAP hosts",
    "host/plugin/vst3": "for VST 3 hosts",
    "host/plugin/lv2": "for LV2 hosts",
    "host/plugin/editor": "the window of a plugin instance",
    "host/window": "what a window is; loading its module",
    "host/window/model": "what it shows, without a display",
    "host/window/view": "drawing it (NanoVG)",
    "host/player": "live playing without a device: threads, queues",
    "host/devices": "sound cards, MIDI ports",
    "host/plot": "pictures by gnuplot",
    "host/cli": "command-line options",
    "host/commands/bench_latency": "jawari bench-latency",
    "host/commands/campaign": "jawari campaign",
    "host/commands/info": "jawari info, presets",
    "host/commands/play": "jawari play, devices",
    "host/commands/render": "jawari render",
    "host/commands/simulate": "jawari simulate",
    "host": "the program's commands",
}


def fail(message):
    sys.exit(f"draw_layers.py: {message}")


def read_rows():
    """Layers, bottom to top; those of one row do not know each other."""
    lines = (ROOT / "cmake" / "layers.txt").read_text().splitlines()
    return [line.split() for line in lines if line.strip() and not line.startswith("#")]


def read_includes():
    """{(from, to): number of includes}, as the build's own check finds them."""
    with tempfile.TemporaryDirectory() as folder:
        edges = pathlib.Path(folder) / "edges.csv"
        check = ROOT / "cmake" / "check_layers.cmake"
        run = subprocess.run(["cmake", "-D", f"ROOT={ROOT}", "-D", f"EDGES={edges}", "-P", str(check)],
                             capture_output=True, text=True)
        if run.returncode != 0:
            fail(f"the layers are not in order\n{run.stderr}")
        with edges.open() as file:
            return {(row["from"], row["to"]): int(row["includes"]) for row in csv.DictReader(file)}


def without_implied(arrows):
    """The transitive reduction of an acyclic graph."""
    below = {}
    for a, b in arrows:
        below.setdefault(a, set()).add(b)

    def reaches(a, b):
        return any(c == b or reaches(c, b) for c in below.get(a, ()))

    return [(a, b) for a, b in arrows if not any(c != b and reaches(c, b) for c in below[a])]


def describe(rows, includes):
    """The picture in the dot language."""
    layers = [layer for row in rows for layer in row]
    for layer in layers:
        if layer not in PURPOSE:
            fail(f"say in PURPOSE what {layer} holds")

    def node(layer, indent):
        name = "main.cpp" if layer == "host" else layer.removeprefix("engine/src/").removeprefix("host/")
        text = "<br/>".join(html.escape(line) for line in textwrap.wrap(PURPOSE[layer], 24))
        return f'{indent}"{layer}" [label=<<b>{name}</b><br/><font point-size="11">{text}</font>>];'

    lines = [
        "digraph layers {",
        "  rankdir=TB; ranksep=0.3; nodesep=0.12; newrank=true; splines=true;",
        '  fontname="Helvetica"; fontsize=16;',
        '  node [shape=box, style="filled,rounded", fillcolor=white, color="#8899aa", fontname="Helvetica", fontsize=13,'
        ' margin="0.06,0.05"];',
        '  edge [color="#556677", fontname="Helvetica", fontsize=10, fontcolor="#556677", arrowsize=0.7];',
    ]
    for side, color, title in (("engine/src", "#eaf2fb", "engine/src: the library jawari::engine"),
                               ("host", "#f6f1e4", "host: the program jawari")):
        lines += [f'  subgraph "cluster_{side}" {{', f'    label=<<b>{title}</b>>; style="filled,rounded"; color="{color}";']
        lines += [node(layer, "    ") for layer in reversed(layers) if layer.startswith(side)]
        lines += ["  }"]
    lines += [node("engine/include", "  ")]
    # Layers of one row that other rows separate stand at one height.
    for row in rows:
        if len(row) > 1:
            lines.append("  { rank=same; " + " ".join(f'"{layer}";' for layer in row) + " }")
    for a, b in without_implied(sorted(includes)):
        lines.append(f'  "{a}" -> "{b}" [label=" {includes[a, b]}"];')
    return "\n".join(lines + ["}"]) + "\n"


def without_counts(text):
    return re.sub(r'\[label=" \d+"\]', "", text)


def draw(text, form):
    try:
        return subprocess.run(["dot", f"-T{form}"], input=text.encode(), capture_output=True, check=True).stdout
    except FileNotFoundError:
        fail("needs graphviz (apt-get install graphviz)")


def picture_of(text):
    """SVG that carries its description; without the lines that name graphviz's version."""
    svg = draw(text, "svg").decode()
    svg = re.sub(r"<!-- Generated by graphviz.*?-->\n", "", svg, flags=re.DOTALL)
    metadata = f"<metadata>\n{html.escape(text, quote=False)}</metadata>\n"
    return re.sub(r"(<svg[^>]*>\n)", lambda match: match.group(1) + metadata, svg, count=1)


def description_in(svg):
    found = re.search(r"<metadata>\n(.*?)</metadata>", svg, flags=re.DOTALL)
    return html.unescape(found.group(1)) if found else ""


def check(text):
    committed = description_in(PICTURE.read_text()) if PICTURE.exists() else ""
    old, new = (without_counts(t).splitlines() for t in (committed, text))
    if old == new:
        print(f"{PICTURE.relative_to(ROOT)} shows today's layers")
        return
    for line in new:
        if line not in old:
            print(f"not in the picture: {line.strip()}", file=sys.stderr)
    for line in old:
        if line not in new:
            print(f"only in the picture: {line.strip()}", file=sys.stderr)
    fail(f"{PICTURE.relative_to(ROOT)} is out of date; scripts/draw_layers.py draws it")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ways = parser.add_mutually_exclusive_group()
    ways.add_argument("--check", action="store_true", help="is the committed picture current?")
    ways.add_argument("--table", action="store_true", help="print the number of includes between all pairs")
    ways.add_argument("--png", metavar="FILE", type=pathlib.Path, help="draw to a PNG file instead")
    arguments = parser.parse_args()

    includes = read_includes()
    if arguments.table:
        for (a, b), count in sorted(includes.items()):
            print(f"{count:4}  {a} -> {b}")
        return
    text = describe(read_rows(), includes)
    if arguments.check:
        check(text)
    elif arguments.png:
        arguments.png.write_bytes(draw(text, "png"))
    else:
        PICTURE.write_text(picture_of(text))
        print(PICTURE.relative_to(ROOT))


main()
