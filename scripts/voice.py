#!/usr/bin/env python3
"""Measures how the presets sound beside recorded instruments, with one estimator for both.

Presets are rendered by jawari, recorded sets (General MIDI SoundFonts of Debian packages) by fluidsynth without its effects; further
sets are known by figures alone (scripts/voicing/reference.json). docs/voicing.md says what the figures mean. Measurements
are kept in a cache, so that a run that was interrupted goes on where it was.

usage: voice.py PROGRAM [--preset NAME]... [--keys 40,52,64] [--page] [--coupling | --fit [--even] | --gains] [--json FILE] [--cache FOLDER]
  --preset   these alone (a name of presets/instruments, or a preset file)
  --keys     these keys alone, instead of the usual ones of each preset
  --page     writes the tables and the picture of docs/voicing.md (all presets, usual keys); with --coupling that table alone
  --coupling what body and other strings do to notes of 3 s, instead of all else; of examples on a moving bridge too
  --fit      fits the radiation of the bodies and the levels of the strings (scripts/voicing/fit.py); scripts/make_presets.py follows
  --even     also the gains of single modes, so that keys are equally loud; the distance to recorded sets grows
  --gains    the gains that make the phrase as loud as scripts/instruments/levels.py says
  --json     all figures
"""
import argparse
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "scripts" / "voicing"), str(ROOT / "scripts" / "instruments")]
sys.dont_write_bytecode = True

import compare  # noqa: E402
import report  # noqa: E402
import sets  # noqa: E402
import sounds  # noqa: E402
from levels import PHRASE_LUFS  # noqa: E402

PRESETS = ROOT / "presets" / "instruments"
MOVING = [ROOT / "docs" / "examples" / "render" / "coupled-guitar.json"]
PAGE = ROOT / "docs" / "voicing.md"
PICTURE = ROOT / "docs" / "images" / "voicing" / "third_octaves.svg"


def path_of(name):
    for path in (PRESETS / f"{name}.json", pathlib.Path(name)):
        if path.is_file():
            return path
    raise argparse.ArgumentTypeError(f"{name}: neither a preset of presets/instruments nor a file")


def keys_of(text):
    try:
        return [int(key) for key in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text}: not keys with commas between them") from None


def measure(cache, program, path, keys):
    description = json.loads(path.read_text())
    wanted = keys or sets.keys_of(path.stem, description)
    playable = sets.playable_keys(description)
    played = [key for key in wanted if key in playable]
    if not played:
        sys.exit(f"voice.py: {path.stem} has none of the keys {', '.join(map(str, wanted))}")
    return compare.compare(cache, sounds.Preset(cache, program, path), played, description)


def coupling_rows(cache, arguments):
    for path in arguments.preset or [*sorted(PRESETS.glob("*.json")), *MOVING]:
        description = json.loads(path.read_text())
        playable = sets.playable_keys(description)
        keys = [key for key in arguments.keys or sets.keys_of(path.stem, description) if key in playable]
        yield compare.coupling(cache, sounds.Preset(cache, arguments.program, path), keys)
        print(f"{path.stem}: measured", file=sys.stderr, flush=True)


def gain_line(cache, program, path):
    description = json.loads(path.read_text())
    loudness = sounds.Preset(cache, program, path).phrase(sets.playable_keys(description))["lufs"]
    return f'    "{path.stem}": {description["gain"] * 10 ** ((PHRASE_LUFS - loudness) / 20):.3g},'


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--preset", action="append", type=path_of)
    parser.add_argument("--keys", type=keys_of)
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--coupling", action="store_true")
    parser.add_argument("--fit", action="store_true")
    parser.add_argument("--even", action="store_true")
    parser.add_argument("--gains", action="store_true")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--cache", type=pathlib.Path, default=ROOT / ".cache" / "voicing")
    arguments = parser.parse_args()
    if arguments.page and (arguments.preset or arguments.keys):
        parser.error("--page is of all presets and their usual keys")
    if arguments.fit and not arguments.preset:
        parser.error("--fit needs the presets to fit")
    if arguments.even and not arguments.fit:
        parser.error("--even goes with --fit")
    cache = sounds.Cache(arguments.cache)
    if arguments.fit:
        import fit
        for path in arguments.preset:
            print(fit.fit(cache, arguments.program, path.stem, arguments.even), flush=True)
        return
    if arguments.gains:
        for path in arguments.preset or sorted(PRESETS.glob("*.json")):
            print(gain_line(cache, arguments.program, path), flush=True)
        return
    if arguments.coupling:
        rows = list(coupling_rows(cache, arguments))
        table = report.coupling_table(rows)
        print(table)
        if arguments.json:
            arguments.json.write_text(json.dumps(rows, indent=1) + "\n")
        if arguments.page:
            PAGE.write_text(report.filled(PAGE.read_text(), {"coupling": table}))
        return
    rows = []
    for path in arguments.preset or sorted(PRESETS.glob("*.json")):
        rows.append(measure(cache, arguments.program, path, arguments.keys))
        print(f"{path.stem}: measured", file=sys.stderr, flush=True)
    missing = sorted({package for row in rows for package in row["missing"]})
    if missing:
        print(f"voice.py: not compared with {', '.join(missing)}: not installed (scripts/setup.sh --voice)", file=sys.stderr)
    tables = {"distances": report.distances_table(rows), "colour": report.colour_table(rows), "levels": report.levels_table(rows)}
    print("\n".join(tables.values()))
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")
    if arguments.page:
        if missing:
            sys.exit("voice.py: the page is written with all sets installed")
        PAGE.write_text(report.filled(PAGE.read_text(), tables))
        report.draw(rows, PICTURE)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("voice.py: interrupted; what was measured is kept")
