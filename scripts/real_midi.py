#!/usr/bin/env python3
"""Renders MIDI files that nobody here wrote and checks each: no refusal, no hang, no stuck note, no clipped sample.

The files are those of the Debian packages below that are installed; with --download, of all of them, taken from the archive into
a temporary folder without installing anything. Music in the WAD files of freedoom counts. Programs choose the presets. A stuck
note is one that still sounds 60 s after the end, when a string with a T60 of 40 s has fallen by 90 dB. What the files hold and
strings cannot do is counted by kind, the table at the end. --end 0:30 plays the first half minute of each;
--count plays nothing and counts what the whole files hold, in a few minutes.

usage: real_midi.py [--jawari PROGRAM] [--download | --folder FOLDER...] [--end TIME | --count] [--seconds LONGEST_RUN] [--jobs N]
"""
import argparse
import collections
import concurrent.futures
import gzip
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PACKAGES = ("ardour-data", "chuck-data", "crimson", "csound-doc", "csoundqt-examples", "faust-common", "freedink-data", "freedm", "freedoom",
            "freewheeling", "fretsonfire-songs-muldjord", "fretsonfire-songs-sectoid", "kobodeluxe-data", "liquidwar-data", "mma",
            "nyquist", "octave-audio", "openttd-openmsx", "pangzero", "pd-cyclone", "pd-mrpeach", "pianobooster",
            "pinball-table-hurd-data", "planetblupi-music-midi", "playmidi", "python3-pyo", "sfront", "simutrans-data", "solfege",
            "songwrite", "texlive-lang-english", "texlive-lang-italian", "texlive-music", "timidity", "wims-help", "yoshimi-data",
            "yoshimi-doc")
ENDINGS = (".mid", ".midi", ".kar", ".rmi")
LONGEST_TAIL_S = 59.9


def is_midi(path):
    name = path.name.lower()
    return path.is_file() and (name.endswith(ENDINGS) or name.endswith(tuple(e + ".gz" for e in ENDINGS)))


def is_music(path):
    return is_midi(path) or (path.is_file() and path.suffix.lower() == ".wad")


def lumps(wad):
    """(name, bytes) of what is MIDI in a WAD file: 12 bytes of header, entries of 16 bytes at its table."""
    data = wad.read_bytes()
    kind, count, table = struct.unpack_from("<4sII", data)
    if kind not in (b"IWAD", b"PWAD"):
        return
    for entry in range(count):
        at, size, name = struct.unpack_from("<II8s", data, table + 16 * entry)
        if data[at:at + 4] == b"MThd":
            yield name.rstrip(b"\0").decode(), data[at:at + size]


def pieces(files, folder):
    """Paths of MIDI files, packed ones unpacked into the folder, each content once."""
    found, seen = [], set()
    for path in sorted(set(files)):
        if path.suffix.lower() == ".wad":
            contents = [(f"{path.stem}-{name}", data) for name, data in lumps(path)]
        elif path.name.lower().endswith(".gz"):
            contents = [(path.name[:-3], gzip.decompress(path.read_bytes()))]
        else:
            contents = [(path.name, path.read_bytes())]
        for name, data in contents:
            if data in seen:
                continue
            seen.add(data)
            copy = pathlib.Path(folder) / f"{len(found):04}-{name}"
            copy.write_bytes(data)
            found.append(copy)
    return found


def installed(package):
    listed = subprocess.run(["dpkg", "-L", package], capture_output=True, text=True, check=False).stdout
    return [pathlib.Path(line) for line in listed.splitlines()]


def downloaded(package, folder):
    target = pathlib.Path(folder) / package
    target.mkdir()
    subprocess.run(["apt-get", "-qq", "download", package], cwd=target, check=True)
    for archive in target.glob("*.deb"):
        subprocess.run(["dpkg", "-x", archive, target], check=True)
        archive.unlink()
    for path in target.rglob("*"):
        if path.is_file() and not path.is_symlink() and not is_music(path):
            path.unlink()
    return list(target.rglob("*"))


def candidates(options, folder):
    if options.folder:
        paths = [path for each in options.folder for path in each.rglob("*")]
    else:
        paths = [path for package in PACKAGES
                 for path in (downloaded(package, folder) if options.download else installed(package))]
    return [path for path in paths if is_music(path)]


def render(program, midi, folder, longest_s, extra):
    """Statistics, or the reason why there are none."""
    wav = pathlib.Path(folder) / (midi.name + ".wav")
    try:
        run = subprocess.run([program, "render", midi, "-o", wav, "--stats", "-", "--limiter", "-1", *extra], capture_output=True, text=True,
                             timeout=longest_s, check=False)
    except subprocess.TimeoutExpired:
        return None, f"still running after {longest_s} s"
    finally:
        wav.unlink(missing_ok=True)
    if run.returncode != 0:
        return None, run.stderr.strip().splitlines()[-1] if run.stderr.strip() else f"exit code {run.returncode}"
    return json.loads(run.stdout), None


def problems(stats):
    found = []
    if stats["clipped_samples"]:
        found.append(f"{stats['clipped_samples']} clipped samples")
    if stats["nonfinite_resets"]:
        found.append(f"{stats['nonfinite_resets']} resets")
    if stats["sound_s"] - stats["score_s"] > LONGEST_TAIL_S:
        found.append("a stuck note")
    return found


class Notices:
    """Files and messages of each kind."""

    def __init__(self):
        self.files, self.counts = collections.Counter(), collections.Counter()

    def add(self, what, count):
        if count:
            self.files[what] += 1
            self.counts[what] += count

    def take(self, stats):
        self.add("0 notes without an instrument: drums, sound effects", stats["silent_notes"])
        self.add("0 notes that no string has", stats["ignored_notes"])
        self.add("0 notes beyond the keys of their preset, played by another", sum(lent["notes"] for lent in stats["lent_notes"]))
        for repair in stats["repairs"]:
            what = re.sub(r"0x[0-9A-F]+ ?|[0-9]+ s ", "", repair["what"])
            self.add(f"1 repair: {what}; {repair['assumed']}", repair["count"])
        for kind in stats["ignored"]:
            self.add(f"2 {kind['what']}", kind["messages"])

    def lines(self):
        """Lost notes first, then repairs, then messages; each by the number of files."""
        order = sorted(self.files, key=lambda what: (what[0], -self.files[what], -self.counts[what]))
        yield "| what | files | times |"
        yield "|---|---|---|"
        for what in order:
            yield f"| {what[2:]} | {self.files[what]} | {self.counts[what]} |"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jawari", default=ROOT / "build/release/bin/jawari")
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--download", action="store_true")
    source.add_argument("--folder", type=pathlib.Path, nargs="+")
    part = parser.add_mutually_exclusive_group()
    part.add_argument("--end")
    part.add_argument("--count", action="store_true")
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    return parser.parse_args()


def main():
    options = arguments()
    notices, failed, music_s = Notices(), 0, 0
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        songs = pathlib.Path(folder) / "songs"
        songs.mkdir()
        files = pieces(candidates(options, folder), songs)
        if not files:
            sys.exit("real_midi.py: no MIDI files; --download, or apt-get install " + " ".join(PACKAGES))
        print(f"{'file':40} {'music s':>8} {'tail s':>7} {'notes':>6} {'silent':>6} {'peak dBFS':>9} {'x real time':>11}")
        extra = ["--end", options.end] if options.end else []
        if options.count:
            extra = ["--mute", ",".join(str(channel) for channel in range(1, 17)), "--tail", "0", "--rate", "8000"]
        jobs = [pool.submit(render, options.jawari, midi, folder, options.seconds, extra) for midi in files]
        for midi, job in zip(files, jobs):
            stats, error = job.result()
            found = [error] if error else problems(stats)
            failed += bool(found)
            if error:
                print(f"{midi.stem:40} {error}", flush=True)
                continue
            notices.take(stats)
            music_s += stats["score_s"]
            peak = "-" if stats["peak_dbfs"] is None else f"{stats['peak_dbfs']:.1f}"
            speed = "-" if stats["real_time_factor"] is None else f"{stats['real_time_factor']:.1f}"
            print(f"{midi.stem:40} {stats['score_s']:8.1f} {stats['sound_s'] - stats['score_s']:7.2f} {stats['notes']:6} "
                  f"{stats['silent_notes']:6} {peak:>9} {speed:>11}{'  ' + ', '.join(found) if found else ''}", flush=True)
    print(f"\n{len(files) - failed} of {len(files)} files without a problem, {music_s / 60:.0f} minutes of music\n")
    print("\n".join(notices.lines()))
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
