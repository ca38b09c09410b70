"""All runs on the processors of this machine, in processes of their own: one that dies takes no other with it."""

from __future__ import annotations

import queue
import subprocess
import sys
import threading
from typing import Callable

from .store import Store

#: A run that has killed its worker this often is a failure.
MOST_DEATHS = 3


class _Pool:
    def __init__(self, store: Store, runs: list[int], finished: Callable[[], None]) -> None:
        self.store, self.finished = store, finished
        self.waiting: "queue.SimpleQueue[tuple[int, int]]" = queue.SimpleQueue()
        for run in runs:
            self.waiting.put((run, 0))
        self.children: set[subprocess.Popen[str]] = set()
        self.stopping = False

    def spawn(self) -> "subprocess.Popen[str]":
        command = [sys.executable, "-m", "jawari.campaign.worker", str(self.store.folder)]
        child = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.children.add(child)
        return child

    def serve(self) -> None:
        """Of one thread: gives a worker run after run."""
        child = self.spawn()
        while not self.stopping:
            try:
                run, deaths = self.waiting.get_nowait()
            except queue.Empty:
                break
            if not self.ask(child, run):
                if self.stopping:
                    break
                child = self.spawn()
                if deaths + 1 < MOST_DEATHS:
                    self.waiting.put((run, deaths + 1))
                    continue
                self.store.write_failure(run, f"run {run}: its process died {MOST_DEATHS} times")
            self.finished()
        assert child.stdin is not None
        child.stdin.close()
        child.wait()

    @staticmethod
    def ask(child: "subprocess.Popen[str]", run: int) -> bool:
        assert child.stdin is not None and child.stdout is not None
        try:
            child.stdin.write(f"{run}\n")
            child.stdin.flush()
        except BrokenPipeError:
            child.wait()
            return False
        if child.stdout.readline().strip() == str(run):
            return True
        child.wait()
        return False

    def stop(self) -> None:
        self.stopping = True
        for child in list(self.children):
            child.kill()


def run_here(store: Store, runs: list[int], jobs: int, finished: Callable[[], None]) -> None:
    """`finished` is called after each run. On KeyboardInterrupt the workers are ended; what they have finished stays."""
    pool = _Pool(store, runs, finished)
    threads = [threading.Thread(target=pool.serve, daemon=True) for _ in range(min(jobs, len(runs)))]
    for thread in threads:
        thread.start()
    try:
        for thread in threads:
            thread.join()
    except BaseException:
        pool.stop()
        raise
