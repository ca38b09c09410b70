#!/usr/bin/python3
"""The plugin's window in jalv: by itself (jalv -s), and through suil inside windows of GTK 3 and Qt 5. A key of it plays, and when
it is closed jalv ends as it should.

on_display.sh jalv_windows.py LV2_BUNDLE [PICTURES]: exit code 77 where jalv, JACK or what a display takes is not installed.
"""
import os
import pathlib
import re
import shutil
import signal
import sys
import tempfile
import time

import display
from display import Display

URI = "urn:jawari:instrument"
SERVER = "jawari-jalv"
PROGRAMS = (["jalv", "-s"], ["jalv.gtk3"], ["jalv.qt5"])
KEY = (640, 545)  # of the keyboard in the plugin's window


def geometry(screen, window):
    words = screen.xdotool("getwindowgeometry", "--shell", window)
    return tuple(int(re.search(rf"{word}=(\d+)", words).group(1)) for word in ("WIDTH", "HEIGHT"))


def check(screen, command, environment, home):
    name = command[0]
    log = home / f"{name}.log"
    host = screen.start([*command, URI], environment, stdin=-1, stdout=log.open("w"), stderr=-2)
    window = screen.wait_for("^Jawari$", host)
    time.sleep(2)
    said = log.read_text()
    if "suil error: Failed to open module" in said:
        host.kill()
        print(f"{name}: left out, because its suil has no module for X11 here")
        return
    assert "urn:jawari:instrument#window" in said, said[-1000:]
    width, height = geometry(screen, window)
    assert width == display.SIZE[0] and height >= display.SIZE[1], (width, height)
    bar = height - display.SIZE[1]  # a menu above the plugin's window, if any
    screen.xdotool("windowactivate", "--sync", window)
    screen.at(window, display.EMPTY[0], display.EMPTY[1] + bar)
    time.sleep(0.7)
    still = screen.picture(window, f"{name}-still")
    assert screen.colours(still) > 50, "the window is blank"
    screen.at(window, KEY[0], KEY[1] + bar, "mousedown", 1)
    time.sleep(0.5)
    moving = screen.picture(window, f"{name}-playing")
    screen.xdotool("mouseup", 1)
    assert screen.different(still, moving) > 300, f"{name}: nothing moves in the window"
    assert host.poll() is None, f"{name} ended with {host.returncode}"
    screen.xdotool("windowactivate", "--sync", window)
    screen.xdotool("key", "alt+F4")
    if name == "jalv":  # it goes on without the window until it is interrupted
        display.wait_until(lambda: not screen.windows("^Jawari$"), "the window to close")
        host.send_signal(signal.SIGINT)
    assert host.wait(20) == 0, f"{name} ended with {host.returncode}: {log.read_text()[-500:]}"
    print(f"{name}: opened, played, closed")


def main(lv2_bundle, pictures=None):
    for tool, package in {"jalv": "jalv", "jalv.gtk3": "jalv", "jackd": "jackd2", "jack_wait": "jackd2"}.items():
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
            for command in PROGRAMS:
                if shutil.which(command[0]) is not None:
                    check(screen, command, more, home)
            if pictures:
                os.makedirs(pictures, exist_ok=True)
                for picture in home.glob("*.png"):
                    shutil.copy(picture, pathlib.Path(pictures) / f"jalv-{picture.name}")


if __name__ == "__main__":
    main(*sys.argv[1:])
