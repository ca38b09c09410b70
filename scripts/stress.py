#!/usr/bin/env python3
"""Plays many hostile scenes (tests/stress) in several processes and sums up what the checks found.

Every seed that is done is one line of the log; called again with the same log, the run goes on where it stopped. The
summary is rewritten whenever a run ends, also when it is interrupted.

usage: stress.py [--scenes 100000] [--first 0] [--jobs N] [--cpu 0.1] [--log FILE] [--summary FILE]
"""
import argparse
import collections
import json
import os
import pathlib
import queue
import signal
import subprocess
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SEEDS_PER_PROCESS = 50
COUNTED = ("blocks", "frames", "strings", "contacts", "impulses", "notes", "truncated")


class Log:
    """Lines of finished seeds, appended as they come."""

    def __init__(self, path):
        self.path = path
        self.lock = threading.Lock()
        self.done = set()
        self.violations = 0
        if path.exists():
            self._read()
        self.file = path.open("a", encoding="utf-8")

    def _read(self):
        whole = b""
        for line in self.path.read_bytes().splitlines(keepends=True):
            if not line.endswith(b"\n"):
                break  # a run that was killed while writing
            self._note(json.loads(line))
            whole += line
        self.path.write_bytes(whole)

    def _note(self, entry):
        self.done.add(entry["seed"])
        self.violations += len(entry["violations"])

    def append(self, line):
        entry = json.loads(line)
        with self.lock:
            self._note(entry)
            self.file.write(line)
            self.file.flush()
        return entry


def ranges_to_do(first, scenes, done):
    """(first, count) of seeds not done yet, in pieces for one process each."""
    begin = None
    for seed in range(first, first + scenes + 1):
        open_range = begin is not None
        ends = seed == first + scenes or seed in done or (open_range and seed - begin == SEEDS_PER_PROCESS)
        if open_range and ends:
            yield begin, seed - begin
            begin = None
        if begin is None and seed < first + scenes and seed not in done:
            begin = seed


class Run:
    """Processes at work, until all pieces are done or stop() is called."""

    def __init__(self, options, log):
        self.options = options
        self.log = log
        self.pieces = queue.SimpleQueue()
        for piece in ranges_to_do(options.first, options.scenes, log.done):
            self.pieces.put(piece)
        self.stopping = threading.Event()
        self.failed = []
        self.threads = [threading.Thread(target=self._work) for _ in range(options.jobs)]
        for thread in self.threads:
            thread.start()

    def _work(self):
        while not self.stopping.is_set():
            try:
                first, count = self.pieces.get_nowait()
            except queue.Empty:
                return
            self._play(first, count)

    def _play(self, first, count):
        command = [self.options.program, "--first", str(first), "--count", str(count), "--cpu", str(self.options.cpu)]
        # A session of its own: what interrupts this script must not look like a crash.
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                              start_new_session=True) as process:
            played = 0
            for line in process.stdout:
                self.report(self.log.append(line))
                played += 1
                if self.stopping.is_set():
                    process.terminate()
                    return
        if played < count:  # a crash is a violation too
            self.failed.append(first + played)
            print(f"\nCRASH ({process.returncode}): {command[0]} --seed {first + played:#x} --cpu {self.options.cpu}",
                  file=sys.stderr)
            if played + 1 < count:
                self._play(first + played + 1, count - played - 1)

    @staticmethod
    def report(entry):
        for violation in entry["violations"]:
            print(f"\nVIOLATION {violation['invariant']}: {entry['kind']}, {violation['where']}: {violation['found']}, "
                  f"allowed {violation['allowed']}; replay: {violation['replay']}", file=sys.stderr)

    def stop(self):
        self.stopping.set()

    def wait(self):
        for thread in self.threads:
            thread.join()


def show_progress(run, log, scenes, start, at_start):
    while any(thread.is_alive() for thread in run.threads):
        time.sleep(0.2)
        if not sys.stderr.isatty():
            continue
        done = len(log.done)
        rate = (done - at_start) / max(1e-9, time.monotonic() - start)
        left = (scenes - done) / rate if rate > 0 else float("inf")
        print(f"\r{done} of {scenes} scenes, {log.violations} violations, {rate:.1f}/s, {left / 60:.0f} min left ",
              end="", file=sys.stderr)


def summary_of(path, crashed):
    total = collections.Counter()
    by_kind = collections.defaultdict(collections.Counter)
    closest = collections.defaultdict(float)
    sums = collections.Counter()
    violations = []
    for line in path.open(encoding="utf-8"):
        entry = json.loads(line)
        counts = {"scenes": 1, "refused": int("refused" in entry), "exploded": int(entry.get("exploded", False)),
                  "violating": int(bool(entry["violations"])), **{key: entry[key] for key in COUNTED}}
        total.update(counts)
        by_kind[entry["kind"]].update(counts)
        sums.update({"sound_s": entry["sound_s"], "cpu_s": entry["cpu_s"]})
        for invariant, ratio in entry["closest"].items():
            closest[invariant] = max(closest[invariant], float(ratio))
        violations += entry["violations"]
    return {**total, **{key: round(value, 3) for key, value in sums.items()}, "largest_share_of_bound": dict(closest),
            "violations": violations, "crashed_seeds": crashed,
            "by_kind": {kind: dict(counts) for kind, counts in sorted(by_kind.items())}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/jawari_stress"))
    parser.add_argument("--scenes", type=int, default=100000)
    parser.add_argument("--first", type=int, default=0, help="first seed")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--cpu", type=float, default=0.1, help="seconds of CPU time a scene")
    parser.add_argument("--log", type=pathlib.Path, default=ROOT / "build/stress.jsonl")
    parser.add_argument("--summary", type=pathlib.Path, default=ROOT / "build/stress.json")
    options = parser.parse_args()
    if not os.access(options.program, os.X_OK):
        sys.exit(f"stress.py: no program {options.program} (cmake --build build/release --target jawari_stress)")
    options.log.parent.mkdir(parents=True, exist_ok=True)
    log = Log(options.log)
    at_start = len(log.done)
    # Also where a shell has started this in the background, with interrupts ignored.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    run = Run(options, log)
    try:
        show_progress(run, log, options.scenes, time.monotonic(), at_start)
    except KeyboardInterrupt:
        print("\nstopping; the same command goes on from here", file=sys.stderr)
        run.stop()
    run.wait()
    summary = summary_of(options.log, run.failed)
    options.summary.write_text(json.dumps(summary, indent=1) + "\n", encoding="utf-8")
    print(f"{summary.get('scenes', 0)} scenes, {summary.get('blocks', 0)} blocks, {summary.get('impulses', 0)} impulses, "
          f"{summary.get('sound_s', 0):.1f} s of sound, {len(summary['violations'])} violations, "
          f"{len(run.failed)} crashes; {options.summary}")
    sys.exit(bool(summary["violations"] or run.failed))


if __name__ == "__main__":
    main()
