"""A sound server without hardware, a keyboard made of text, and the program between them.

Each test has a server of its own name. Still only one runs at a time: JACK names the socket of a client after the client
and the user, not after the server, so that programs of one name at two servers take it away from each other, and a server
turns one of them down. Without jackd there is nothing to test: exit code 77, which CTest takes for skipped.
"""
import fcntl
import json
import os
import pathlib
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

import numpy as np

SKIPPED = 77
TESTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(TESTS.parent / "presets"))

ENVIRONMENT = {"JACK_NO_START_SERVER": "1", "JACK_NO_AUDIO_RESERVATION": "1"}
PATIENCE_S = 20


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def wait_until(condition, what, patience_s=PATIENCE_S):
    deadline = time.monotonic() + patience_s
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {patience_s} s in vain for {what}")
        time.sleep(0.02)


def wait_for_other_benches():
    """Returns a file that keeps other servers of this user's tests waiting, also those of another checkout, until it is
    closed."""
    lock = open(pathlib.Path(tempfile.gettempdir()) / f"jawari-live-{os.getuid()}.lock", "w")
    fcntl.flock(lock, fcntl.LOCK_EX)
    return lock


class Bench:
    """jackd with the dummy driver, and a folder for files. `with Bench("name") as bench`."""

    def __init__(self, name, program, sender, rate_hz=48000, frames=256):
        # The same in every run: JACK keeps what a killed server leaves until the next one of that name, and has room for
        # eight of them.
        self.server_name = f"jawari-{name}"
        self.program, self.sender_program = program, sender
        self.rate_hz, self.frames = rate_hz, frames
        self.server = None
        self.children = []

    def __enter__(self):
        for tool in ("jackd", "jack_wait", "jack_lsp", "jack_rec"):
            if shutil.which(tool) is None:
                skip(f"{tool} is not installed (scripts/setup.sh --test)")
        self.lock = wait_for_other_benches()
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="jawari-live-"))
        self.environment = {**os.environ, **ENVIRONMENT, "JACK_DEFAULT_SERVER": self.server_name,
                            "XDG_CONFIG_HOME": str(self.folder), "XDG_STATE_HOME": str(self.folder)}
        self.start_server()
        return self

    def __exit__(self, problem, *_):
        codes = [child.poll() for child in self.children]
        for child in self.children:
            child.kill()
            child.wait()
        self.stop_server()
        if problem is not None:
            print(f"jackd: {self.server_said()}\nprograms' exit codes: {codes}", file=sys.stderr)
        shutil.rmtree(self.folder, ignore_errors=True)
        self.lock.close()

    def start_server(self):
        """With real-time priority if that is allowed. Synchronous (-S): a client that the machine kept waiting makes the
        cycle late, which is an xrun, instead of losing the MIDI of that cycle."""
        for priority in (["-R", "-P", "70"], ["-r"]):
            log = open(self.folder / "jackd.log", "w")
            self.server = subprocess.Popen(
                ["jackd", "-S", "-n", self.server_name, *priority, "-d", "dummy", "-r", str(self.rate_hz), "-p", str(self.frames)],
                env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)
            waited = subprocess.run(["jack_wait", "-s", self.server_name, "-w", "-t", "10"], env=self.environment,
                                    capture_output=True, check=False)
            if waited.returncode == 0 and self.server.poll() is None:
                return
            self.stop_server()
        skip("jackd does not start: " + self.server_said())

    def stop_server(self, how=signal.SIGTERM):
        self.server.send_signal(how)
        self.server.wait()

    def server_said(self):
        """The end of it, on one line."""
        return (self.folder / "jackd.log").read_text().strip().replace("\n", "; ")[-600:]

    def path(self, name):
        return str(self.folder / name)

    def play(self, *arguments, commands=False):
        """The program, with commands through a pipe if asked for."""
        return Player(self, ["play", *arguments, *([] if commands else ["--no-shell"])], commands)

    def sender(self, name="keyboard"):
        return Sender(self, name)

    def run(self, *arguments):
        return subprocess.run([self.program, *arguments], env=self.environment, capture_output=True, text=True,
                              check=False, timeout=120)

    def tool(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False, timeout=60)


class Player:
    def __init__(self, bench, arguments, commands):
        self.bench = bench
        # Whoever runs the tests may ignore SIGHUP (nohup), and the program would too.
        self.process = subprocess.Popen([bench.program, *arguments], env=bench.environment,
                                        stdin=subprocess.PIPE if commands else subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, bufsize=1,
                                        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL))
        bench.children.append(self.process)
        self.said = {self.process.stdout: "", self.process.stderr: ""}

    def _read(self, wait_s):
        streams = [stream for stream in self.said if not stream.closed]
        for stream in select.select(streams, [], [], wait_s)[0]:
            self.said[stream] += os.read(stream.fileno(), 65536).decode()

    @property
    def err(self):
        self._read(0)
        return self.said[self.process.stderr]

    @property
    def out(self):
        self._read(0)
        return self.said[self.process.stdout]

    def expect(self, text, stream="err", patience_s=PATIENCE_S):
        deadline = time.monotonic() + patience_s
        while text not in getattr(self, stream):
            if self.process.poll() is not None and text not in getattr(self, stream):
                raise AssertionError(f"ended with {self.process.returncode} before '{text}':\n{self.err}{self.out}")
            if time.monotonic() > deadline:
                raise AssertionError(f"no '{text}' after {patience_s} s:\n{self.err}{self.out}")
            self._read(0.05)

    def expect_times(self, text, times):
        deadline = time.monotonic() + PATIENCE_S
        while self.err.count(text) < times:
            assert time.monotonic() < deadline, f"not {times} times '{text}':\n{self.err}{self.out}"
            self._read(0.05)

    def expect_keyboard(self, name, times=1):
        """Connected so often by now, and JACK has taken it up: a new client gets going some cycles after it was promised."""
        deadline = time.monotonic() + PATIENCE_S
        while self.err.count(f'connected to "{name}') < times:
            assert time.monotonic() < deadline, self.err
            self._read(0.05)
        time.sleep(0.3)

    def command(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def end(self, how=signal.SIGTERM):
        """The exit code."""
        if how is not None and self.process.poll() is None:
            self.process.send_signal(how)
        code = self.process.wait(timeout=PATIENCE_S)
        for stream in self.said:
            self.said[stream] += os.read(stream.fileno(), 1 << 20).decode()
        return code


class Sender:
    def __init__(self, bench, name):
        self.process = subprocess.Popen([bench.sender_program, "jack", name], env=bench.environment, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, bufsize=1)
        bench.children.append(self.process)
        assert self.process.stdout.readline().strip() == "ready", self.process.stderr.read()

    def send(self, messages):
        """(delay in ms, bytes) each; returns when each went out, in s on time.monotonic()'s clock."""
        for delay_ms, message in messages:
            self.process.stdin.write(f"{delay_ms} {' '.join(f'{byte:x}' for byte in message)}\n")
        self.process.stdin.flush()
        return [int(self.process.stdout.readline()) * 1e-9 for _ in messages]

    def unplug(self):
        """The port goes, as that of a USB keyboard; JACK's client stays."""
        self._say("unplug")

    def plug(self):
        self._say("plug")

    def _say(self, word):
        self.process.stdin.write(word + "\n")
        self.process.stdin.flush()
        self.process.stdout.readline()

    def end(self):
        self.process.stdin.close()
        self.process.wait()


class Osc:
    """A hand-written encoder and decoder of OSC 1.0: nothing of liblo."""

    def __init__(self, port):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.settimeout(PATIENCE_S)
        self.socket.connect(("127.0.0.1", port))

    @staticmethod
    def text(value):
        data = value.encode() + b"\0"
        return data + b"\0" * (-len(data) % 4)

    @classmethod
    def packet(cls, path, *arguments):
        types, data = ",", b""
        for value in arguments:
            if isinstance(value, bool):
                types += "T" if value else "F"
            elif isinstance(value, int):
                types, data = types + "i", data + struct.pack(">i", value)
            elif isinstance(value, float):
                types, data = types + "f", data + struct.pack(">f", value)
            else:
                types, data = types + "s", data + cls.text(value)
        return cls.text(path) + cls.text(types) + data

    def send(self, path, *arguments):
        self.socket.send(self.packet(path, *arguments))

    def receive(self):
        data = self.socket.recv(65536)
        words = []
        at = 0

        def take_text():
            nonlocal at
            end = data.index(b"\0", at)
            value = data[at:end].decode()
            at = end + 4 - end % 4
            return value

        path, types = take_text(), take_text()
        for kind in types[1:]:
            if kind == "s":
                words.append(take_text())
            else:
                words.append(struct.unpack(">" + kind, data[at:at + 4])[0])
                at += 4
        return path, words

    def ask(self, verb, *arguments):
        """All answers of a command: up to the last line."""
        self.send("/jawari/" + verb, *arguments)
        answers = [self.receive()]
        self.socket.settimeout(0.3)
        try:
            while True:
                answers.append(self.receive())
        except TimeoutError:
            pass
        self.socket.settimeout(PATIENCE_S)
        return answers

    def values(self, verb, *arguments):
        return {words[1]: words[2] for path, words in self.ask(verb, *arguments) if path == "/jawari/value"}


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def read_midi_frames(path, bends=False):
    """(frame, message bytes) of notes and controllers, and of bends if asked for, in a type-0 file whose ticks are frames; its own
    reading, checked against midicsv."""
    listing = subprocess.run(["midicsv", path], capture_output=True, text=True, check=True).stdout
    events = []
    for line in listing.splitlines():
        fields = [field.strip() for field in line.split(",")]
        if fields[2] in ("Note_on_c", "Note_off_c"):
            status = 0x90 if fields[2] == "Note_on_c" else 0x80
            events.append((int(fields[1]), (status | int(fields[3]), int(fields[4]), int(fields[5]))))
        elif fields[2] == "Control_c":
            events.append((int(fields[1]), (0xB0 | int(fields[3]), int(fields[4]), int(fields[5]))))
        elif fields[2] == "Pitch_bend_c" and bends:
            events.append((int(fields[1]), (0xE0 | int(fields[3]), int(fields[4]) % 128, int(fields[4]) // 128)))
    return events


def read_float_wav(path):
    """Samples (frames, channels) and the sampling rate [Hz]."""
    from play import read_wav
    samples, rate_hz = read_wav(path)
    return samples, rate_hz


def render_again(bench, midi, preset, rate_hz, tail_s=2.0, arguments=()):
    """What jawari render makes of a recorded MIDI file."""
    wav = bench.path("again.wav")
    ran = bench.run("render", midi, "--preset", preset, "-o", wav, "--rate", str(rate_hz), "--format", "float", "--tail",
                    str(tail_s), "--stats", "-", *arguments)
    assert ran.returncode == 0, ran.stderr
    return read_float_wav(wav)[0], json.loads(ran.stdout)


def stereo_equal(a, b):
    frames = min(len(a), len(b))
    return bool(np.array_equal(a[:frames], b[:frames]))
