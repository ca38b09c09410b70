#!/usr/bin/env python3
"""Fills docs/presets/*.md: tables of strings and of provenance from the preset files, pictures of the demo pieces.

Text between <!-- NAME --> and <!-- /NAME --> is replaced by the tables of that preset; all else is written by hand.

usage: presets_page.py [--check]                    tables only; --check: write nothing, fail if a page is out of date
       presets_page.py --images PROGRAM [PIECE...]  renders the demo pieces and draws docs/images/presets/*.png
       presets_page.py --measure PROGRAM            fills the tables of docs/presets.md that tests/presets/check_*.py print
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs" / "presets"
IMAGES = ROOT / "docs" / "images" / "presets"
LONGEST_TABLE = 14


def tension_n(string):
    stiff = 1 + string.get("inharmonicity", 0)
    return string["linear_density_kg_per_m"] * (2 * string["length_m"] * string["open_frequency_hz"]) ** 2 / stiff


def strings_table(preset):
    strings = preset["strings"]
    shown = strings if len(strings) <= LONGEST_TABLE else [strings[i] for i in sorted({*range(0, len(strings), len(strings) // 8), len(strings) - 1})]
    rows = ["| string | key | Hz | length (m) | density (g/m) | tension (N) | B | T60 (s at Hz) |", "|---|---|---|---|---|---|---|---|"]
    for s in shown:
        points = ", ".join(f"{p['t60_s']:g} at {p['frequency_hz']:g}" for p in s["damping"]["points"])
        rows.append(f"| {s['name']} | {s['open_note']} | {s['open_frequency_hz']:.2f} | {s['length_m']:g} | "
                    f"{1000 * s['linear_density_kg_per_m']:.4g} | {tension_n(s):.1f} | {s.get('inharmonicity', 0):.3g} | {points} |")
    if len(shown) < len(strings):
        rows.append(f"\n({len(shown)} of {len(strings)} strings.)")
    return "\n".join(rows)


def origins(value, path, found):
    """found: origin -> keys, in the order of the file."""
    if isinstance(value, dict):
        name = value.get("name")
        here = f"{path} {name}" if name is not None and path else path
        for key, origin in value.get("provenance", {}).items():
            found.setdefault(origin, []).append(f"{here}: {key}" if here else key)
        for key, child in value.items():
            if key != "provenance":
                origins(child, key if isinstance(child, (dict, list)) else here, found)
    elif isinstance(value, list):
        for child in value:
            origins(child, path, found)


def gathered(keys):
    """strings E: length_m, strings A: length_m -> strings E, A: length_m."""
    by_key = {}
    for entry in keys:
        place, _, key = entry.rpartition(": ")
        kind, _, name = place.partition(" ")
        by_key.setdefault((kind, key), []).append(name)
    texts = {}
    for (kind, key), names in by_key.items():
        where = f"{kind} ({', '.join(names)})" if any(names) and len(names) <= 6 else kind
        texts.setdefault(where, []).append(f"`{key}`")
    return "; ".join(f"{where}: {', '.join(keys)}" if where else ", ".join(keys) for where, keys in texts.items())


def provenance_table(preset):
    found = {}
    origins({k: v for k, v in preset.items() if k != "name"}, "", found)
    rows = ["| where from | what |", "|---|---|"]
    for kind in ("measured", "published", "chosen"):
        rows += [f"| {origin} | {gathered(keys)} |" for origin, keys in found.items() if origin.startswith(kind)]
    return "\n".join(rows)


def block(name):
    preset = json.loads((ROOT / "presets" / "instruments" / f"{name}.json").read_text())
    comment = preset.get("comment", [])
    text = " ".join([comment] if isinstance(comment, str) else comment)
    return f"{text}\n\n{strings_table(preset)}\n\n{provenance_table(preset)}\n"


def ranges(keys):
    """36, 43 to 45: the keys that some string has, without those between that none has."""
    runs = []
    for key in sorted(keys):
        if runs and key == runs[-1][1] + 1:
            runs[-1][1] = key
        else:
            runs.append([key, key])
    return ", ".join(f"{low}" if low == high else f"{low} to {high}" for low, high in runs)


def overview():
    rows = ["| preset | name | strings | notes | exciters | obstacles |", "|---|---|---|---|---|---|"]
    for path in sorted((ROOT / "presets" / "instruments").glob("*.json")):
        preset = json.loads(path.read_text())
        frets = [s.get("frets", preset.get("frets", {})) for s in preset["strings"]]
        keys = {}  # the first string of a course gives its key
        for i, (string, stops) in enumerate(zip(preset["strings"], frets)):
            count = stops.get("count", len(stops.get("height_m", [])))
            keys.setdefault(string.get("course", f"alone {i}"), {string["open_note"] + n for n in [0, *stops.get("semitones", range(1, count + 1))]})
        exciters = sorted({e["kind"] for e in preset["exciters"]})
        bodies = (["frets"] if any("height_m" in f for f in frets) else []) + sorted({o["name"].split(" ")[0] for o in preset.get("obstacles", [])})
        rows.append(f"| `{path.stem}` | {preset['name']} | {len(preset['strings'])} | {ranges(set().union(*keys.values()))} | "
                    f"{', '.join(exciters)} | {', '.join(bodies)} |")
    return "\n".join(rows) + "\n"


def filled(page, texts):
    """Replaces the marked blocks of which `texts` has the text, or which bear a preset's name."""
    def text_of(match):
        name = match[1]
        if name in texts:
            text = texts[name]
        elif (ROOT / "presets" / "instruments" / f"{name}.json").exists():
            text = block(name)
        else:
            return match[0]
        return f"<!-- {name} -->\n{text}<!-- /{name} -->"
    return re.sub(r"<!-- ([a-z0-9-]+) -->\n.*?<!-- /\1 -->", text_of, page, flags=re.S)


def measured(program):
    """What the judging scripts print, as text for the marked blocks of docs/presets.md."""
    texts = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, script, extra in (("tuning", "check_tuning", []), ("tuning-contacts", "check_tuning", ["--contacts"]), ("levels", "check_levels", []),
                                    ("buzz", "check_buzz", []), ("clicks", "check_clicks", [])):
            table = pathlib.Path(folder) / name
            run = subprocess.run([sys.executable, "-B", str(ROOT / "tests" / "presets" / f"{script}.py"), program, "--table", str(table), *extra],
                                 check=False)
            if run.returncode != 0:
                print(f"presets_page.py: {script} found faults", file=sys.stderr)
            texts[name] = table.read_text()
    return texts


def draw(program, pieces):
    sys.path.insert(0, str(ROOT / "scripts"))
    import make_demo_midi
    IMAGES.mkdir(parents=True, exist_ok=True)
    for name in pieces or make_demo_midi.PIECES:
        preset = make_demo_midi.PIECES[name][1]
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "render", str(ROOT / "presets" / "demo" / f"{name}.mid"), "--preset", preset, "-o", f"{folder}/demo.wav",
                            "--plot", str(IMAGES / f"{name}.png")], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--images", metavar="PROGRAM")
    parser.add_argument("--measure", metavar="PROGRAM")
    parser.add_argument("pieces", nargs="*")
    arguments = parser.parse_args()
    if arguments.images:
        return draw(arguments.images, arguments.pieces)
    texts = {"overview": overview(), **(measured(arguments.measure) if arguments.measure else {})}
    stale = []
    for path in [ROOT / "docs" / "presets.md", *sorted(PAGES.glob("*.md"))]:
        page = path.read_text()
        current = filled(page, texts)
        if current != page:
            stale.append(path.name)
            if not arguments.check:
                path.write_text(current)
    if arguments.check and stale:
        sys.exit(f"presets_page.py: out of date: {', '.join(stale)} (run scripts/presets_page.py)")


if __name__ == "__main__":
    main()
