#!/usr/bin/python3
"""The LV2 plugin in jalv, a host of other people: what JACK hears of a MIDI file is what `jawari render` makes of it,
bit for bit.

jalv_recording.py PROGRAM SENDER TAKER BUNDLE
"""
import pathlib
import shutil
import subprocess
import sys

import numpy as np

import live_bench
from live_bench import Bench

RATE_HZ, FRAMES = 48000, 256
SECONDS = 4
FRAMES_PER_TICK = 53
PIECE, PRESET = "slap", "bass-slap"  # not what a new instance has
START = 4800  # of the piece, in frames of the take
URI = "urn:jawari:instrument"


def preset_state(folder, bundle, label):
    """A state folder for jalv -l, made from the bundle's preset: the preset as lilv reads it."""
    text = (bundle / "presets.ttl").read_text()
    begin = text.index(f"<{URI}#preset-{label}>")
    end = text.find("\n\n", begin)
    prefixes = "".join(line + "\n" for line in text.splitlines() if line.startswith("@prefix"))
    body = text[begin:end].replace(f"<{URI}#preset-{label}>", "<>", 1)
    folder.mkdir()
    (folder / "state.ttl").write_text(prefixes + "\n" + body + "\n")
    (folder / "manifest.ttl").write_text(
        prefixes + f"\n<state.ttl>\n    a pset:Preset ;\n    lv2:appliesTo <{URI}> ;\n    rdfs:seeAlso <state.ttl> .\n")
    return folder


def write_piece(source, path):
    """The piece in a file whose ticks are frames, and its (frame, bytes)."""
    listing = subprocess.run(["midicsv", str(source)], capture_output=True, text=True, check=True).stdout
    lines = ["0, 0, Header, 0, 1, 480", "1, 0, Start_track", "1, 0, Tempo, 10000"]
    for line in listing.splitlines():
        track, tick, kind, *rest = line.split(", ")
        if kind in ("Note_on_c", "Note_off_c", "Control_c"):
            lines.append(", ".join([track, str(int(tick) * FRAMES_PER_TICK), kind, *rest]))
    last = lines[-1].split(", ")[1]
    lines += [f"1, {last}, End_track", "0, 0, End_of_file"]
    subprocess.run(["csvmidi", "-", path], input="\n".join(lines) + "\n", text=True, check=True)
    return live_bench.read_midi_frames(path)


def main(program, sender_program, taker, bundle_path):
    for tool in ("jalv", "midicsv"):
        if shutil.which(tool) is None:
            live_bench.skip(f"no {tool} (Debian package {tool})")
    bundle = pathlib.Path(bundle_path)
    source = pathlib.Path(__file__).resolve().parents[2] / "presets" / "demo" / f"{PIECE}.mid"
    with Bench("jalv", program, sender_program, RATE_HZ, FRAMES) as bench:
        environment = dict(bench.environment, LV2_PATH=f"{bundle.parent}:/usr/lib/lv2")
        state = preset_state(bench.folder / "state", bundle, PRESET)
        host = subprocess.Popen(["jalv", "-t", "-x", "-n", "jalv", "-l", str(state), URI], env=environment,
                                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        bench.children.append(host)
        live_bench.wait_until(lambda: "jalv:events" in bench.tool("jack_lsp").stdout, "jalv")
        piece = bench.path("piece.mid")
        messages = write_piece(source, piece)
        lines = "".join(f"{START + frame} {a} {b} {c}\n" for frame, (a, b, c) in messages if frame < SECONDS * RATE_HZ)
        assert lines.count("\n") > 10
        take = bench.path("take.raw")
        ran = subprocess.run([taker, "jalv:events", "jalv:left", "jalv:right", str(START + SECONDS * RATE_HZ), take],
                             input=lines, env=bench.environment, capture_output=True, text=True)
        assert ran.returncode == 0, ran.stderr
        host.stdin.close()
        host.terminate()
        heard = np.fromfile(take, np.float32).reshape(-1, 2)
        rendered_path = bench.path("rendered.wav")
        ran = bench.run("render", piece, "--preset", PRESET, "--format", "float", "--rate", str(RATE_HZ),
                        "-o", rendered_path)
        assert ran.returncode == 0, ran.stderr
        rendered, _ = live_bench.read_float_wav(rendered_path)
        first_heard, first_rendered = (int(np.argmax(sound.any(axis=1))) for sound in (heard, rendered))
        delay = first_heard - first_rendered - START
        assert 0 <= delay <= 2 * FRAMES, f"the sound is {delay} frames late"
        length = min(len(heard) - first_heard, len(rendered) - first_rendered)
        assert length > (SECONDS - 1) * RATE_HZ
        a, b = heard[first_heard:][:length], rendered[first_rendered:][:length].astype(np.float32)
        assert np.abs(a).max() > 0.01, "jalv is silent"
        differs = np.flatnonzero((a != b).any(axis=1))
        assert len(differs) == 0, f"{len(differs)} of {length} frames differ, the first after {differs[0]} frames"
        print(f"{length} frames through jalv are those of jawari render, bit for bit, {delay} frames later")


if __name__ == "__main__":
    main(*sys.argv[1:])
