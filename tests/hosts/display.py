"""Other people's programs on the display that tests/host/window/on_display.sh gives, driven by mouse and keys."""
import os
import shutil
import subprocess
import sys
import time

TOOLS = {"xdotool": "xdotool", "import": "imagemagick", "compare": "imagemagick", "openbox": "openbox"}


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def check_tools():
    for tool, package in TOOLS.items():
        if shutil.which(tool) is None:
            skip(f"no {tool} (Debian package {package})")
    if "DISPLAY" not in os.environ:
        skip("no display")


def wait_until(happened, what, patience_s=20):
    end = time.monotonic() + patience_s
    while not happened():
        assert time.monotonic() < end, f"waited {patience_s} s for {what}"
        time.sleep(0.2)


class Display:
    """With a window manager, as hosts expect one."""

    def __init__(self, folder):
        self.folder = folder
        self.children = []
        self.start(["openbox"])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for child in reversed(self.children):
            if child.poll() is None:
                child.kill()
            child.wait()

    def environment(self, more=None):
        own = {name: os.environ[name] for name in ("DISPLAY", "XAUTHORITY") if name in os.environ}
        return {"HOME": str(self.folder), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", **own, **(more or {})}

    def start(self, command, environment=None, **options):
        options = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **options}
        child = subprocess.Popen(command, env=self.environment(environment), **options)
        self.children.append(child)
        return child

    def tool(self, *words):
        return subprocess.run([str(word) for word in words], env=self.environment(), capture_output=True, text=True,
                              check=False)

    def xdotool(self, *words):
        return self.tool("xdotool", *words).stdout

    def windows(self, title):
        """Ids of the visible windows whose title matches."""
        return self.xdotool("search", "--onlyvisible", "--name", title).split()

    def wait_for(self, title, program, patience_s=40):
        end = time.monotonic() + patience_s
        while time.monotonic() < end:
            found = self.windows(title)
            if found:
                return found[0]
            assert program.poll() is None, f"the host ended with {program.returncode} before a window called {title}"
            time.sleep(0.3)
        raise AssertionError(f"no window called {title}")

    def at(self, window, x, y, *then):
        self.xdotool("mousemove", "--window", window, int(x), int(y), *then)
        time.sleep(0.2)

    def drag(self, window, x, y, to_x, to_y):
        self.at(window, x, y, "mousedown", 1)
        for step in (0.3, 0.6, 1):
            self.at(window, x + step * (to_x - x), y + step * (to_y - y))
        self.xdotool("mouseup", 1)
        time.sleep(0.3)

    def picture(self, window, name):
        path = self.folder / f"{name}.png"
        ran = self.tool("import", "-window", window, path)
        assert ran.returncode == 0, ran.stderr
        return path

    def different(self, one, other):
        """Pixels that differ."""
        ran = self.tool("compare", "-metric", "AE", one, other, "null:")
        assert ran.returncode in (0, 1), ran.stderr
        return int(float(ran.stderr.split()[0]))

    def colours(self, picture):
        return int(self.tool("identify", "-format", "%k", picture).stdout)


# Of the plugin's window in its usual size, 1200 x 768, in pixels.
SIZE = (1200, 768)
BODY_MIX, BODY_MIX_MORE = (123, 743), (190, 743)
VOLUME, VOLUME_LESS = (215, 623), (120, 623)
EMPTY = (600, 12)  # of the head: a click there does nothing
