#!/usr/bin/env python3
"""Runs what README.md shows, as it stands.

usage: readme_commands.py JAWARI        the program; the README is the one of this tree

Lines of ```sh blocks run one after the other in one shell, in an empty folder that holds links to the tree's folders, with
JAWARI where `build/release/bin/jawari` is. Not run, but checked: `jawari play` and `jawari devices` need devices, so every
option of theirs must be in their --help; `bash scripts/...` builds everything, so the script must be there. Lines of ```cpp
blocks must be lines of the programs in docs/examples/embed, which examples.embed builds. Links are checked by
scripts/check_docs.py.
"""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NEEDS_DEVICES = ("play", "devices")


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, flags=re.DOTALL | re.MULTILINE)


def option_problems(program, line):
    words = shlex.split(line, comments=True)
    options = subprocess.run([program, words[1], "--help"], capture_output=True, text=True, check=True).stdout
    return [f"{line}: {word} is no option" for word in words[2:]
            if word.startswith("-") and not re.search(rf"(^|[\s,]){re.escape(word)}\b", options)]


def run_commands(program, lines, folder):
    """Problems of the lines, each of which runs in the shell that the ones before it have left."""
    problems = []
    script = ["set -euo pipefail"]
    for line in lines:
        words = shlex.split(line, comments=True)
        if not words:
            continue
        if words[0] == "jawari" and words[1] in NEEDS_DEVICES:
            problems += option_problems(program, line)
        elif words[:1] == ["bash"] and words[1].startswith("scripts/"):
            if not (ROOT / words[1]).is_file():
                problems.append(f"{line}: there is no {words[1]}")
        else:
            script += [f"echo {shlex.quote('+ ' + line)}", line]
    done = subprocess.run(["bash", "-c", "\n".join(script)], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        last = [line for line in done.stdout.splitlines() if line.startswith("+ ")][-1:]
        problems.append(f"{''.join(last)[2:]}: exit code {done.returncode}\n{done.stderr}")
    return problems


def embed_problems(text):
    programs = {" ".join(line.split()) for file in (ROOT / "docs/examples/embed").glob("*.cpp")
                for line in file.read_text().splitlines()}
    return [f"{line}: in no program of docs/examples/embed" for block in blocks(text, "cpp") for line in block.splitlines()
            if line.strip() and " ".join(line.split()) not in programs]


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    text = (ROOT / "README.md").read_text()
    lines = [line for block in blocks(text, "sh") for line in block.splitlines()]
    commands = [line for line in lines if line.startswith("jawari ")]
    if len(commands) < 8:
        sys.exit(f"README.md shows {len(commands)} commands of jawari: are its blocks still ```sh?")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for part in ("docs", "presets", "scripts"):
            (folder / part).symlink_to(ROOT / part)
        (folder / "build/release/bin").mkdir(parents=True)
        (folder / "build/release/bin/jawari").symlink_to(program)
        problems = run_commands(str(program), lines, folder)
    problems += embed_problems(text)
    for problem in problems:
        print(problem, file=sys.stderr)
    if problems:
        sys.exit(1)
    skipped = [line for line in commands if line.split()[1] in NEEDS_DEVICES]
    print(f"{len(commands) - len(skipped)} commands of README.md work, {len(skipped)} need devices: {'; '.join(skipped)}")


main()
