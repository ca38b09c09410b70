#!/usr/bin/python3
"""The plugin's windows in Ardour, as LV2 and VST 3, on a display without a screen: a session is opened with both windows
open, opening them changes no state, the space bar goes on to Ardour and plays, strings move, a drag is kept in the session,
and the session opens with its windows again.

on_display.sh ardour_windows.py LV2_BUNDLE VST3_BUNDLE [PICTURES]: exit code 77 where Ardour or what a display takes is not installed.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree

import ardour
import display
from display import Display

KINDS = ("lv2", "vst3")
TITLES = {"lv2": r"lv2: Jawari.*\[LV2\]", "vst3": r"vst3: Jawari.*\[VST3\]"}
BODY_MIX = "Body mix"

CONFIGURATION = """<?xml version="1.0" encoding="UTF-8"?>
<Ardour><Config>
<Option name="try-autostart-engine" value="1"/><Option name="hide-dummy-backend" value="0"/>
<Option name="discover-plugins-on-start" value="0"/>
</Config><Metadata/><Extra><AudioMIDISetup><EngineStates>
<State backend="None (Dummy)" driver="Normal Speed" device="Silence" input-device="" output-device="" sample-rate="48000"
 buffer-size="1024" n-periods="0" input-latency="0" output-latency="0" lm-input="" lm-output="" active="1" use-buffered-io="0"
 midi-option="No MIDI I/O" lru="1"><MIDIDevices/></State>
</EngineStates></AudioMIDISetup></Extra></Ardour>
"""


def write_configuration(home):
    folder = home / ".config" / "ardour7"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / ".a7").touch()  # Ardour has been here before
    (folder / "instant.xml").write_text('<?xml version="1.0" encoding="UTF-8"?><instant><no-memory-warning/></instant>')
    (folder / "config").write_text(CONFIGURATION)


def processors(session):
    """The plugins of the session by kind: (id of the route, element)."""
    root = ElementTree.parse(session / "piece.ardour").getroot()
    return {processor.get("type"): (route.get("id"), processor) for route in root.iter("Route")
            for processor in route.findall("Processor") if processor.get("type") in KINDS}


def open_windows(session):
    """Written into the session, as if it had been saved with both windows open."""
    path = session / "piece.ardour"
    text = path.read_text()
    windows = "".join(f'<Window name="P-{route}-{processor.get("id")}" visible="1" x-off="{40 + 250 * n}" y-off="{20 + 150 * n}" '
                      'x-size="0" y-size="0" custom-ui="1"/>'
                      for n, (route, processor) in enumerate(processors(session).values()))
    text, count = re.subn("</Session>", f"<Extra><UI>{windows}</UI></Extra></Session>", text)
    assert count == 1 and windows.count("<Window") == 2, windows
    path.write_text(text)


def states(session):
    """The whole text of each plugin's state."""
    found = {}
    for kind, (_, processor) in processors(session).items():
        if kind == "vst3":
            found[kind] = "".join(chunk.text or "" for chunk in processor.iter("chunk"))
            continue
        folder = processor.find("lv2").get("state-dir")
        texts = sorted((session / "plugins" / processor.get("id") / folder).glob("*.ttl"))
        found[kind] = "\n".join(re.search(r"instrument#state>\s+\"+([^\"]+)", text.read_text()).group(1) for text in texts
                                if "instrument#state" in text.read_text())
    for kind, text in found.items():
        assert len(text) > 1000, f"no state of {kind} in the session: {text[:200]}"
    return found


def body_mixes(session):
    """As the sessions keep it: automation controls carry the value of each parameter by name."""
    found = {}
    for kind, (_, processor) in processors(session).items():
        if kind == "lv2":
            found[kind] = float(next(port.get("value") for port in processor.iter("Port") if port.get("symbol") == "body_mix"))
        else:
            found[kind] = next(float(control.get("value")) for control in processor.iter("Controllable")
                               if control.get("name") == BODY_MIX)
    return found


class Ardour:
    """The program with the session open, its windows shown."""

    def __init__(self, screen, session, environment, log):
        self.screen = screen
        self.session = session
        self.log = log
        self.program = screen.start(["/usr/bin/ardour", "-n", str(session / "piece.ardour")], environment,
                                    stdout=log.open("w"), stderr=subprocess.STDOUT)
        try:
            self.main = screen.wait_for("^piece - Ardour$", self.program)
            self.windows = {kind: screen.wait_for(TITLES[kind], self.program) for kind in KINDS}
        except AssertionError as error:
            raise AssertionError(f"{error}\n{log.read_text()[-2000:]}") from None
        time.sleep(2)

    def check_alive(self):
        assert self.program.poll() is None, f"Ardour ended with {self.program.returncode}"

    def raise_window(self, kind):
        """Its upper left corner is where the plugin's is, below Ardour's bar."""
        window = self.windows[kind]
        self.screen.xdotool("windowactivate", "--sync", window)
        time.sleep(0.5)
        geometry = dict(re.findall(r"(WIDTH|HEIGHT)=(\d+)", self.screen.xdotool("getwindowgeometry", "--shell", window)))
        assert int(geometry["WIDTH"]) == display.SIZE[0], geometry
        return window, int(geometry["HEIGHT"]) - display.SIZE[1]

    def save(self):
        path = self.session / "piece.ardour"
        before = path.stat().st_mtime_ns
        self.screen.xdotool("windowactivate", "--sync", self.main)
        time.sleep(0.5)
        self.screen.xdotool("key", "ctrl+s")
        for _ in range(100):
            if path.stat().st_mtime_ns != before:
                time.sleep(0.5)
                return
            time.sleep(0.1)
        raise AssertionError("Ardour does not save")

    def end(self):
        self.check_alive()
        self.program.terminate()
        self.program.wait(20)


def check_space_bar(host, kind):
    """Pressed in the plugin's window it starts and stops Ardour's transport: the strings of the region move."""
    window, bar = host.raise_window(kind)
    screen = host.screen
    screen.at(window, display.EMPTY[0], display.EMPTY[1] + bar, "click", 1)
    time.sleep(1)
    still = screen.picture(window, f"{kind}-still")
    assert screen.colours(still) > 50, "the window is blank"
    screen.xdotool("key", "space")
    time.sleep(1.2)
    moving = screen.picture(window, f"{kind}-playing")
    host.check_alive()
    screen.xdotool("key", "space")
    time.sleep(1)
    screen.xdotool("windowactivate", "--sync", host.main)
    screen.xdotool("key", "Home")
    assert screen.different(still, moving) > 300, f"{kind}: nothing moves in the window while Ardour plays"


def main(lv2_bundle, vst3_bundle, pictures=None):
    if not pathlib.Path("/usr/bin/ardour").exists() or not pathlib.Path("/usr/bin/ardour7-lua").exists():
        display.skip("no Ardour 7 (Debian package ardour)")
    display.check_tools()
    if shutil.which("csvmidi") is None:
        display.skip("no csvmidi (Debian package midicsv)")
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        session = home / "session"
        bundle = home / ".vst3" / "jawari.vst3"
        bundle.parent.mkdir()
        bundle.symlink_to(vst3_bundle)
        with Display(home) as screen:
            more = {"LV2_PATH": f"{pathlib.Path(lv2_bundle).parent}:/usr/lib/lv2", "JAWARI_SESSION": str(session)}
            ardour.scan_vst3(bundle, screen.environment(more))
            made = subprocess.run(["/usr/bin/ardour7-lua", str(pathlib.Path(__file__).with_name("ardour.lua"))],
                                  env=screen.environment(more), capture_output=True, text=True, check=False, timeout=120)
            assert (session / "piece.ardour").exists(), made.stdout[-1000:] + made.stderr[-1000:]
            ardour.add_region(session)
            write_configuration(home)
            open_windows(session)
            before, mixes = states(session), body_mixes(session)

            host = Ardour(screen, session, more, home / "ardour.log")
            host.save()
            for kind, text in states(session).items():
                assert text == before[kind], f"opening the window of {kind} has changed its state"
            for kind in KINDS:
                check_space_bar(host, kind)
            for kind in KINDS:
                window, bar = host.raise_window(kind)
                screen.drag(window, display.BODY_MIX[0], display.BODY_MIX[1] + bar, display.BODY_MIX_MORE[0],
                            display.BODY_MIX_MORE[1] + bar)
            host.save()
            dragged = body_mixes(session)
            for kind in KINDS:
                assert dragged[kind] > mixes[kind] + 0.05, f"{kind}: the drag is not in the session: {mixes}, {dragged}"
            host.end()

            host = Ardour(screen, session, more, home / "ardour-again.log")  # its windows are open again
            for kind in KINDS:
                window, _ = host.raise_window(kind)
                screen.picture(window, f"{kind}-again")
            host.save()
            again = body_mixes(session)
            assert all(abs(again[kind] - dragged[kind]) < 1e-6 for kind in KINDS), f"{dragged} became {again}"
            host.end()
            print("opened, played, dragged and opened again:", dragged)
            if pictures:
                os.makedirs(pictures, exist_ok=True)
                for picture in home.glob("*.png"):
                    shutil.copy(picture, pathlib.Path(pictures) / f"ardour-{picture.name}")


if __name__ == "__main__":
    main(*sys.argv[1:])
