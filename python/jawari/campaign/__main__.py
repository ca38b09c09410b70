"""python -m jawari.campaign FILE: runs what is not done yet of a campaign, and gathers the results."""

from __future__ import annotations

import argparse
import os
import sys
import time
from pathlib import Path

from ..errors import Error
from .cluster import run_dask, run_slurm, run_task
from .local import run_here
from .plan import load_plan
from .store import Store
from .table import gather

INTERRUPTED = 130
SOME_FAILED = 1


class Progress:
    """A line on standard error, if that is a terminal."""

    def __init__(self, done: int, runs: int) -> None:
        self.before, self.done, self.runs = done, done, runs
        self.started = time.monotonic()
        self.shown = sys.stderr.isatty()

    def step(self) -> None:
        self.done += 1
        if not self.shown:
            return
        seconds = (time.monotonic() - self.started) / (self.done - self.before) * (self.runs - self.done)
        bar = "#" * (20 * self.done // self.runs)
        left = f"{int(seconds) // 60}:{int(seconds) % 60:02d} left"
        print(f"\r\033[Kcampaign [{bar:-<20}] {self.done}/{self.runs} runs, {left}", end="", file=sys.stderr, flush=True)

    def clear(self) -> None:
        if self.shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def arguments(words: list[str] | None, program: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog=program, description="Runs what is not done yet of a campaign (docs/campaigns.md)."
    )
    parser.add_argument("file", metavar="FILE", help="campaign as JSON")
    parser.add_argument("-o", "--out", metavar="DIR", help="folder of the results (FILE without its ending)")
    parser.add_argument("--jobs", type=int, metavar="N", default=len(os.sched_getaffinity(0)), help="processes (all processors)")
    parser.add_argument("--retry", action="store_true", help="runs that failed are run again")
    parser.add_argument("--list", action="store_true", help="prints the runs and their inputs, and runs nothing")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--slurm", action="store_true", help="as a job array, through sbatch")
    where.add_argument("--dask", metavar="ADDRESS", help="on the workers of a Dask scheduler")
    parser.add_argument("--tasks", type=int, default=100, metavar="N", help="tasks of the job array, at most (100)")
    parser.add_argument("--sbatch", action="append", default=[], metavar="OPTION", help="handed on to sbatch")
    options = parser.parse_args(words)
    for name in ("jobs", "tasks"):
        if getattr(options, name) < 1:
            parser.error(f"--{name}: {getattr(options, name)} (allowed: 1 or more)")
    return options


def campaign(options: argparse.Namespace) -> int:
    plan = load_plan(options.file)
    if options.list:
        for run, values in enumerate(plan.runs):
            print(run, *(f"{name}={value}" for name, value in zip(plan.inputs, values)))
        return 0
    store = Store(options.out or Path(options.file).with_suffix(""))
    store.prepare(plan)
    lock = store.lock()
    if options.retry:
        store.forget_failures()
    runs = store.pending(len(plan.runs))
    progress = Progress(len(plan.runs) - len(runs), len(plan.runs))
    try:
        if runs and options.slurm:
            run_slurm(store, runs, options.tasks, options.sbatch)
        elif runs and options.dask:
            run_dask(store, runs, options.dask, progress.step)
        elif runs:
            run_here(store, runs, options.jobs, progress.step)
    except KeyboardInterrupt:
        progress.clear()
        print(f"interrupted: {len(store.done())} of {len(plan.runs)} runs are done; the same command goes on", file=sys.stderr)
        return INTERRUPTED
    progress.clear()
    done, failures = gather(store.folder), store.failures()
    for run, message in failures.items():
        print(f"run {run} failed: {message}", file=sys.stderr)
    lost = len(plan.runs) - done - len(failures)
    if lost and options.slurm:
        print(f"runs are missing: {store.folder}/slurm-*.log say why; the same command goes on", file=sys.stderr)
    print(f"{done} of {len(plan.runs)} runs are in {store.folder}/results.csv; {len(failures)} failed, {lost} are missing")
    lock.close()
    return SOME_FAILED if failures or lost else 0


def main(words: list[str] | None = None, program: str = "python -m jawari.campaign") -> int:
    words = sys.argv[1:] if words is None else words
    try:
        if words[:1] == ["--task"]:  # of a job array: folder, number, count
            run_task(Store(words[1]), int(words[2]), int(words[3]))
            return 0
        return campaign(arguments(words, program))
    except Error as error:
        print(error, file=sys.stderr)
        return error.exit_code


if __name__ == "__main__":
    sys.exit(main())
