#!/usr/bin/python3
"""The plugin's windows in Qtractor, as CLAP and LV2, on a display without a screen: opening them does not make the session
a changed one, a key of theirs plays, a drag is kept in the session, and the session opens again with the value.

on_display.sh qtractor_windows.py CLAP LV2_BUNDLE SEQUENCER [PICTURES]: SEQUENCER stands in for ALSA's where the kernel has
none, without which Qtractor does not start. Qtractor 0.9.31 of Debian 12 is built without VST 3. Exit code 77 where Qtractor,
JACK or what a display takes is not installed.
"""
import os
import pathlib
import re
import shutil
import sys
import tempfile
import time

import display
from display import Display

KINDS = ("clap", "lv2")
SERVER = "jawari-qtractor"
FIRST_PLUGIN, TRACK_HEIGHT = (172, 181), 96  # in Qtractor's window of its first size: the plugin of the first track
KEY = (640, 545)  # of the keyboard in the plugin's window


def track(number, kind, file):
    return f"""<track name="{kind}" type="midi"><properties><input-bus>Master</input-bus><output-bus>Master</output-bus>
<midi-omni>0</midi-omni><midi-channel>{number}</midi-channel></properties>
<state><mute>0</mute><solo>0</solo><record>0</record><monitor>1</monitor><gain>1</gain><panning>0</panning></state>
<view><height>{TRACK_HEIGHT}</height></view><clips/>
<plugins><plugin type="{kind.upper()}"><filename>{file}</filename><index>0</index><label>Jawari</label><activated>1</activated>
<editor-pos>{40 + 250 * number},{20 + 150 * number}</editor-pos></plugin></plugins></track>"""


def write_session(path, clap):
    tracks = track(0, "clap", clap) + track(1, "lv2", "urn:jawari:instrument")
    path.write_text(f"""<!DOCTYPE qtractor-session>
<session name="piece" version="Qtractor 0.9.31"><properties><directory>{path.parent}</directory><sample-rate>48000</sample-rate>
<tempo>120</tempo><ticks-per-beat>960</ticks-per-beat><beats-per-bar>4</beats-per-bar><beat-divisor>2</beat-divisor></properties>
<state/><files><audio-list/><midi-list/></files><devices><audio-engine><audio-bus name="Master" mode="duplex">
<auto-connect>1</auto-connect><channels>2</channels></audio-bus></audio-engine>
<midi-engine><midi-bus name="Master" mode="duplex"/></midi-engine></devices><tempo-map/><tracks>{tracks}</tracks></session>
""")


def body_mixes(path):
    return [float(value) for value in re.findall(r'name="Body mix"[^>]*>([\d.]+)<', path.read_text())]


class Qtractor:
    """The program with the session open, its windows shown."""

    def __init__(self, screen, session, environment, log):
        self.screen = screen
        self.session = session
        self.program = screen.start(["qtractor", str(session)], environment, stdout=log.open("w"), stderr=-2)
        self.main = screen.wait_for("piece.qtr", self.program)
        time.sleep(3)
        self.windows = {}
        for number, kind in enumerate(KINDS):
            screen.xdotool("windowactivate", "--sync", self.main)
            screen.at(self.main, FIRST_PLUGIN[0], FIRST_PLUGIN[1] + number * TRACK_HEIGHT, "click", "--repeat", 2, "--delay", 80, 1)
            self.windows[kind] = screen.wait_for(f"^Jawari - {kind}", self.program)
            time.sleep(1)

    def check_alive(self):
        assert self.program.poll() is None, f"Qtractor ended with {self.program.returncode}"

    def save(self):
        self.screen.xdotool("windowactivate", "--sync", self.main)
        time.sleep(0.5)
        before = self.session.read_bytes()
        self.screen.xdotool("key", "ctrl+s")
        time.sleep(2)
        self.check_alive()
        return self.session.read_bytes() != before

    def end(self):
        self.check_alive()
        self.program.kill()
        self.program.wait()


def check_key(host, kind):
    """Pressed with the mouse it plays: strings move."""
    window = host.windows[kind]
    screen = host.screen
    screen.xdotool("windowactivate", "--sync", window)
    screen.at(window, *display.EMPTY)
    time.sleep(0.7)
    still = screen.picture(window, f"{kind}-still")
    assert screen.colours(still) > 50, "the window is blank"
    screen.at(window, *KEY, "mousedown", 1)
    time.sleep(0.5)
    moving = screen.picture(window, f"{kind}-playing")
    screen.xdotool("mouseup", 1)
    assert screen.different(still, moving) > 300, f"{kind}: nothing moves in the window"
    host.check_alive()


def main(clap, lv2_bundle, sequencer, pictures=None):
    for tool, package in {"qtractor": "qtractor", "jackd": "jackd2", "jack_wait": "jackd2"}.items():
        if shutil.which(tool) is None:
            display.skip(f"no {tool} (Debian package {package})")
    display.check_tools()
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        with Display(home) as screen:
            more = {"JACK_NO_START_SERVER": "1", "JACK_NO_AUDIO_RESERVATION": "1", "JACK_DEFAULT_SERVER": SERVER,
                    "LV2_PATH": f"{pathlib.Path(lv2_bundle).parent}:/usr/lib/lv2"}
            screen.start(["jackd", "-n", SERVER, "-r", "-d", "dummy", "-r", "48000", "-p", "1024"], more)
            assert screen.start(["jack_wait", "-s", SERVER, "-w", "-t", "10"], more).wait() == 0, "no JACK server"
            if not pathlib.Path("/dev/snd/seq").exists():
                more["LD_PRELOAD"] = sequencer
            session = home / "piece.qtr"
            write_session(session, clap)

            host = Qtractor(screen, session, more, home / "log")
            assert not host.save(), "opening the windows has made the session a changed one"
            for kind in KINDS:
                check_key(host, kind)
                screen.drag(host.windows[kind], *display.BODY_MIX, *display.BODY_MIX_MORE)
            assert host.save(), "drags have not made the session a changed one"
            dragged = body_mixes(session)
            assert len(dragged) == len(KINDS) and min(dragged) > 1.05, f"the drags are not in the session: {dragged}"
            host.end()

            host = Qtractor(screen, session, more, home / "log-again")
            for kind in KINDS:
                screen.drag(host.windows[kind], *display.VOLUME, *display.VOLUME_LESS)
            assert host.save(), "drags have not made the session a changed one"
            again = body_mixes(session)
            assert max(abs(a - b) for a, b in zip(again, dragged)) < 1e-4, f"{dragged} became {again}"
            host.end()
            print("opened, played, dragged and opened again:", dragged)
            if pictures:
                os.makedirs(pictures, exist_ok=True)
                for picture in home.glob("*.png"):
                    shutil.copy(picture, pathlib.Path(pictures) / f"qtractor-{picture.name}")


if __name__ == "__main__":
    main(*sys.argv[1:])
