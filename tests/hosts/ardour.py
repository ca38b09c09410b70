#!/usr/bin/python3
"""The plugin in Ardour, as LV2 and VST 3: it is found, plays a note, is saved and opened again; then a MIDI region is put
into the session and exported.

ardour.py LV2_BUNDLE VST3_BUNDLE: exit code 77 where Ardour is not installed.
"""
import glob
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import wave

import numpy as np

TICKS_PER_S = 3840  # Ardour's 1920 a quarter, 120 quarters a minute
NOTES = [(960, 40, 112), (2880, 47, 100), (4800, 52, 90)]  # (tick, key, velocity)
HELD_TICKS = 1500
REGION_TICKS = 7680
ATTEMPTS = 12


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def scan_vst3(bundle, environment):
    """Ardour's own scanner, which its window would call."""
    scanners = glob.glob("/usr/lib/ardour*/ardour-vst3-scanner")
    assert scanners, "Ardour has no scanner for VST 3"
    library = os.path.dirname(scanners[0])
    ran = subprocess.run([scanners[0], "-v", str(bundle)], env=dict(environment, LD_LIBRARY_PATH=library), text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    assert "Found Plugin: Jawari" in ran.stdout, ran.stdout[-2000:]
    assert 'n_outputs="2" n_aux_inputs="0" n_aux_outputs="16" n_midi_inputs="1"' in ran.stdout, ran.stdout[-2000:]


def write_midi(path):
    """A file as Ardour keeps its sources."""
    events = [(tick, 1, f"Note_on_c, 0, {key}, {velocity}") for tick, key, velocity in NOTES]
    events += [(tick + HELD_TICKS, 0, f"Note_off_c, 0, {key}, 64") for tick, key, _ in NOTES]
    lines = ["0, 0, Header, 0, 1, 1920", "1, 0, Start_track", *(f"1, {tick}, {text}" for tick, _, text in sorted(events)),
             f"1, {REGION_TICKS}, End_track", "0, 0, End_of_file"]
    subprocess.run(["csvmidi", "-", str(path)], input="\n".join(lines) + "\n", text=True, check=True)


def add_region(session):
    """The piece on each track, and the range that an export takes, written into the saved session."""
    write_midi(next(session.glob("interchange/*/midifiles")) / "piece.mid")
    path = session / "piece.ardour"
    text = path.read_text()

    def region(number, name):
        return (f'<Region name="{name}" muted="0" opaque="1" locked="0" video-locked="0" automatic="0" whole-file="0" '
                'import="0" external="0" hidden="0" position-locked="0" valid-transients="0" start="b0" '
                f'length="b{REGION_TICKS}@b0" type="midi" first-edit="nothing" layering-index="0" stretch="1" shift="1" '
                f'id="{number}" source-0="900001" master-source-0="900001" channels="1"/>')

    text = text.replace("<Sources/>", '<Sources><Source name="piece.mid" take-id="" type="midi" '
                        'flags="Writable,CanRename" id="900001" natural-position="a0" origin="piece.mid"/></Sources>')
    for number, name in ((900010, "lv2"), (900020, "vst3")):
        text, count = re.subn(rf'(<Playlist id="\d+" name="{name}"[^/>]*)/>',
                              lambda match, n=number, m=name: match.group(1) + ">" + region(n, m) + "</Playlist>", text)
        assert count == 1, f"{count} empty playlists are called {name}"
    end = int(282240000 * 3)
    text = text.replace("<Locations/>", f'<Locations><Location id="900030" name="session" start="a0" end="a{end}" '
                        'flags="IsSessionRange" locked="0" timestamp="0"/></Locations>')
    path.write_text(re.sub(r'id-counter="\d+"', 'id-counter="900100"', text, count=1))


def level_db(samples):
    return 20 * np.log10(np.abs(samples).max() + 1e-9)


def export(exporter, session, sound, environment):
    """In some runs of Ardour 7's exporter both tracks, in two formats, are silent to the last bit at once, and right in the
    next with the same session: no notes have come. That is tried again."""
    for _ in range(ATTEMPTS):
        ran = subprocess.run([exporter, "-o", str(sound), str(session), "piece"], env=environment, capture_output=True,
                             text=True, check=False, timeout=120)
        assert sound.exists(), ran.stdout[-2000:] + ran.stderr[-2000:]
        if level_db(read_pcm16(sound)[0]) > -100:
            return
    raise AssertionError(f"{ATTEMPTS} exports are silent")


def read_pcm16(path):
    with wave.open(str(path)) as file:
        assert file.getsampwidth() == 2
        samples = np.frombuffer(file.readframes(file.getnframes()), np.int16).reshape(-1, file.getnchannels())
        return samples / 32768, file.getframerate()


def check_export(path):
    samples, rate_hz = read_pcm16(path)
    for tick, key, _ in NOTES:
        begin = int(tick / TICKS_PER_S * rate_hz)
        during = level_db(samples[begin + rate_hz // 100:begin + rate_hz // 4])
        assert during > -40, f"key {key} is at {during:.1f} dBFS in the export"
    assert level_db(samples[-rate_hz // 4:]) < -60, "the export does not end in silence"
    print(f"exported: {len(samples) / rate_hz:.1f} s, peak {level_db(samples):.1f} dBFS")


def main(lv2_bundle, vst3_bundle):
    programs = [path for name in ("ardour*-lua", "ardour-lua") for path in glob.glob(f"/usr/bin/{name}")]
    exporters = [path for name in ("ardour*-export", "ardour-export") for path in glob.glob(f"/usr/bin/{name}")]
    if not programs or not exporters:
        skip("no Ardour (Debian package ardour)")
    if shutil.which("csvmidi") is None:
        skip("no csvmidi (Debian package midicsv)")
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        bundle = home / ".vst3" / "jawari.vst3"
        bundle.parent.mkdir()
        bundle.symlink_to(vst3_bundle)
        environment = {"HOME": folder, "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8",
                       "LV2_PATH": f"{pathlib.Path(lv2_bundle).parent}:/usr/lib/lv2", "JAWARI_SESSION": str(home / "session")}
        scan_vst3(bundle, environment)
        script = pathlib.Path(__file__).with_suffix(".lua")
        ran = subprocess.run([programs[0], str(script)], env=environment, capture_output=True, text=True, check=False, timeout=120)
        said = dict(re.findall(r"^((?:lv2|vst3)_\w+)\s+(\S+)", ran.stdout, re.MULTILINE))
        errors = [line for line in (ran.stdout + ran.stderr).splitlines() if "jawari:" in line]
        assert not errors, errors[0]
        for kind in ("lv2", "vst3"):
            assert f"{kind}_palm_mute" in said, ran.stdout[-2000:] + ran.stderr[-2000:]
            assert float(said[f"{kind}_peak_db"]) > -40, f"{kind} is silent: {said}"
            assert abs(float(said[f"{kind}_palm_mute"]) - 0.25) < 1e-6, f"{kind} forgets its parameter: {said}"
        print("played, saved and opened again:", said)
        add_region(home / "session")
        sound = home / "export.wav"
        export(exporters[0], home / "session", sound, environment)
        check_export(sound)


if __name__ == "__main__":
    main(*sys.argv[1:])
