"""The shell on a terminal: status line, prompt, completion, history; and the terminal as it was before, afterwards."""
import os
import pty
import re
import select
import signal
import subprocess
import sys
import termios
import time

import live_bench
from live_bench import Bench


class Screen:
    """The program on a pseudo-terminal. Understands the control sequences that are used, nothing else."""

    COLUMNS, ROWS = 100, 30

    def __init__(self, bench, *arguments):
        self.master, slave = pty.openpty()
        termios.tcsetwinsize(self.master, (self.ROWS, self.COLUMNS))
        self.before = termios.tcgetattr(slave)
        self.slave = slave
        self.process = subprocess.Popen([bench.program, "play", *arguments], stdin=slave, stdout=slave, stderr=slave,
                                        env={**bench.environment, "TERM": "xterm", "LANG": "C.UTF-8"}, start_new_session=True)
        bench.children.append(self.process)
        self.raw = ""
        self.lines = [""]
        self.row = self.column = 0
        self.saved = (0, 0)

    def _put(self, text):
        line = self.lines[self.row].ljust(self.column)
        self.lines[self.row] = line[:self.column] + text + line[self.column + len(text):]
        self.column += len(text)

    def _control(self, parameter, letter):
        count = int(parameter or 1)
        if letter == "A":
            self.row = max(0, self.row - count)
        elif letter == "B":
            self.row += count
        elif letter == "C":
            self.column += count
        elif letter == "D":
            self.column = max(0, self.column - count)
        elif letter == "G":
            self.column = count - 1
        elif letter == "K":
            self.lines[self.row] = self.lines[self.row][:self.column]
        elif letter == "J":
            self.lines[self.row] = self.lines[self.row][:self.column]
            del self.lines[self.row + 1:]
        elif letter == "P":
            line = self.lines[self.row]
            self.lines[self.row] = line[:self.column] + line[self.column + count:]
        elif letter == "@":
            line = self.lines[self.row]
            self.lines[self.row] = line[:self.column] + " " * count + line[self.column:]

    def _take(self, text):
        self.raw += text
        for part in re.findall(r"\x1b\[[?0-9;]*[A-Za-z@]|\x1b[78=>]|\x1b\([AB0]|[\r\n\x07\b]|[^\x1b\r\n\x07\b]+|\x1b", text):
            if part == "\r":
                self.column = 0
            elif part == "\n":
                self.row += 1
            elif part == "\b":
                self.column = max(0, self.column - 1)
            elif part == "\x1b7":
                self.saved = (self.row, self.column)
            elif part == "\x1b8":
                self.row, self.column = self.saved
            elif part.startswith("\x1b["):
                if part[2:-1].isdigit() or part[2:-1] == "":
                    self._control(part[2:-1], part[-1])
            elif not part.startswith("\x1b") and part != "\x07":
                self._put(part)
            while self.row >= len(self.lines):
                self.lines.append("")

    def read(self, seconds):
        deadline = time.monotonic() + seconds
        while (left := deadline - time.monotonic()) > 0:
            if select.select([self.master], [], [], left)[0]:
                try:
                    self._take(os.read(self.master, 65536).decode(errors="replace"))
                except OSError:
                    return

    def expect(self, pattern, patience_s=live_bench.PATIENCE_S):
        """A pattern somewhere on the screen."""
        deadline = time.monotonic() + patience_s
        while not re.search(pattern, "\n".join(self.lines), re.M):
            assert time.monotonic() < deadline, f"no {pattern!r} on\n" + "\n".join(self.lines)
            assert self.process.poll() is None or self.read(0.2) or True
            self.read(0.05)

    def type(self, text):
        os.write(self.master, text.encode())

    @property
    def last(self):
        """The line of the prompt, without blanks at its end."""
        return self.lines[self.row].rstrip()

    def end(self):
        code = self.process.wait(timeout=live_bench.PATIENCE_S)
        self.read(0.2)
        return code


STATUS = r"^[#-]{16}[|!] .*load +\d+% worst +\d+%  notes \d+  xruns \d+"


def shell(bench):
    screen = Screen(bench, "--preset", "bass-fretted", "--midi", "jack")
    screen.expect(r"^jawari> ")
    screen.expect(STATUS)
    screen.type("note E2 100 3\r")
    screen.expect(r"notes 1 ")
    screen.expect(r"^#{4}")  # the meter moves
    screen.type("pan\t\r")
    screen.read(0.3)
    screen.type("set vol\t0.5\r")
    screen.read(0.3)
    screen.type("get volume\r")
    screen.expect(r"^volume = 0\.5")
    screen.type("preset bass-sl\t\r")
    screen.expect(STATUS + r".*bass-slap")
    screen.type("mon\ton\rnote 52 90 0.2\r")
    screen.expect(r"^ch 1  note on     E3")
    screen.expect(r"^ch 1  note off    E3")
    screen.type("monitor off\r")
    screen.type("\x1b[A\x1b[A\x1b[A")  # up, three times
    screen.expect(r"^jawari> mon")
    screen.type("\x15")  # Ctrl-U
    screen.type("pre\t\t")
    screen.expect(r"^preset +presets")
    screen.type("\x15\x1b")  # a lone Escape must not stop the clock
    before = screen.raw.count("load ")
    screen.read(1.0)
    assert screen.raw.count("load ") >= before + 5, "the status line stands still after Escape"
    screen.type("stats\r")
    screen.expect(r"^held notes \d")
    prompts = [line for line in screen.lines if line.startswith("jawari>")]
    statuses = [line for line in screen.lines if re.match(STATUS, line)]
    screen.read(0.5)
    assert len([line for line in screen.lines if re.match(STATUS, line)]) <= len(prompts) + 1, "\n".join(screen.lines)
    assert statuses
    screen.type("quit\r")
    assert screen.end() == 0
    assert termios.tcgetattr(screen.slave) == screen.before, "the terminal is not as it was"

    again = Screen(bench, "--preset", "bass-fretted")
    again.expect(r"^jawari> ")
    again.type("\x1b[A\x1b[A")
    again.expect(r"^jawari> stats")
    again.type("\x15\x04")  # Ctrl-D on an empty line
    assert again.end() == 0
    print("terminal: status line, completion, history within and across sessions, Escape, Ctrl-D; terminal restored")


def interrupted(bench):
    screen = Screen(bench, "--preset", "bass-fretted")
    screen.expect(STATUS)
    screen.type("half a li")
    os.kill(screen.process.pid, signal.SIGINT)
    assert screen.end() == 0
    assert termios.tcgetattr(screen.slave) == screen.before, "the terminal is not as it was"
    print("Ctrl-C ends it, the terminal is restored")


def main(program, sender_program):
    with Bench("terminal", program, sender_program) as bench:
        shell(bench)
        interrupted(bench)


if __name__ == "__main__":
    main(*sys.argv[1:])
