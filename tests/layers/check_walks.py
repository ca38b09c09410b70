#!/usr/bin/env python3
"""The ways of a note and of a frame in docs/architecture.md name functions that are in the files named beside them.

In each row of the tables of these two sections, a function in `code` belongs to the next file name of the row, or to the last one
if none follows. Types (CamelCase without ::) are not looked at.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TOKEN = re.compile(r"`([A-Za-z_:]+)(?:\(\))?`|([\w/]+\.(?:cpp|h))\b")


def named_in(row):
    """(function, file) of a row."""
    tokens = TOKEN.findall(row)
    files = [(i, file) for i, (_, file) in enumerate(tokens) if file]
    for i, (name, _) in enumerate(tokens):
        if not name or re.fullmatch(r"[A-Z]\w*", name):
            continue
        after = [file for j, file in files if j > i]
        yield name, (after or [file for _, file in files] or [""])[0 if after else -1]


def main():
    text = (ROOT / "docs/architecture.md").read_text()
    paths = [path for side in ("engine", "host") for path in sorted((ROOT / side).rglob("*.*"))]
    faults, count = [], 0
    for section in re.findall(r"^## The way of .*?(?=^## )", text, flags=re.DOTALL | re.MULTILINE):
        for name, file in (pair for row in section.splitlines() if row.startswith("|") for pair in named_in(row)):
            count += 1
            found = [path for path in paths if file and path.as_posix().endswith("/" + file)]
            if not any(re.search(rf"\b{re.escape(name.split('::')[-1])}\(", path.read_text()) for path in found):
                faults.append(f"docs/architecture.md: {name} is not in {file or 'any file named beside it'}")
    if count < 30:
        faults.append(f"docs/architecture.md: only {count} functions found; have the sections other names?")
    print("\n".join(faults) or f"{count} functions are where docs/architecture.md says")
    sys.exit(1 if faults else 0)


main()
