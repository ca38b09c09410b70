#!/usr/bin/env python3
"""Writes presets/demo/*.mid, small pieces composed for this project. Pure Python, same bytes on every run.

usage: make_demo_midi.py [FILE...]     without arguments all of them; a FILE's name says which piece, as in out/slap.mid
       make_demo_midi.py --list        pieces and their presets
"""
import pathlib
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS / "demo"))

import bass  # noqa: E402
import eastern  # noqa: E402
import guitar  # noqa: E402
import keyboard  # noqa: E402

PIECES = {**bass.PIECES, **guitar.PIECES, **eastern.PIECES, **keyboard.PIECES}


def main():
    if sys.argv[1:] == ["--list"]:
        for name, (_, preset) in PIECES.items():
            print(name, preset)
        return
    files = [pathlib.Path(argument) for argument in sys.argv[1:]]
    for path in files or [SCRIPTS.parent / "presets" / "demo" / f"{name}.mid" for name in PIECES]:
        if path.stem not in PIECES:
            sys.exit(f"make_demo_midi.py: {path}: no piece of that name (there are: {', '.join(PIECES)})")
        path.write_bytes(PIECES[path.stem][0]().file_bytes())


if __name__ == "__main__":
    main()
