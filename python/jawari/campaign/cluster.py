"""All runs on a cluster: Slurm's job arrays, or the workers of a Dask scheduler."""

from __future__ import annotations

import json
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Callable

from ..errors import FileError, UsageError
from .plan import Plan
from .run import execute
from .store import Store, write_whole


def run_slurm(store: Store, runs: list[int], tasks: int, options: list[str]) -> None:
    """One job array whose task i does every tasks-th of the runs; returns when all of it has ended, however it ended.

    The folder must be on a file system that the nodes share."""
    tasks = max(1, min(tasks, len(runs)))
    folder = store.folder.resolve()
    write_whole(folder / "pending.json", json.dumps(runs).encode())
    command = shlex.join([sys.executable, "-m", "jawari.campaign", "--task", str(folder)])
    packages = str(Path(__file__).resolve().parents[2])  # where this package is, whatever the nodes' Python finds by itself
    export = f"export PYTHONPATH={shlex.quote(packages)}:$PYTHONPATH\n"
    script = f"#!/bin/sh\n{export}exec {command} \"$SLURM_ARRAY_TASK_ID\" {tasks}\n"
    arguments = ["sbatch", "--wait", "--parsable", f"--array=0-{tasks - 1}", "--job-name=jawari",
                 f"--output={folder}/slurm-%a.log", f"--chdir={folder}", *options]  # fmt: skip
    try:
        done = subprocess.run(arguments, input=script, text=True, capture_output=True)
    except FileNotFoundError:
        raise FileError("sbatch: no such program (Debian: slurm-client)") from None
    if not done.stdout.strip():  # not even submitted
        raise UsageError(f"sbatch: {' '.join(done.stderr.split())}")


def run_task(store: Store, task: int, tasks: int) -> None:
    """What one task of the job array does. Runs that an earlier try of the task has finished are left out."""
    from .run import execute_into

    plan = store.plan()
    for run in json.loads((store.folder / "pending.json").read_text())[task::tasks]:
        if not store.path(run).exists() and not store.failure_path(run).exists():
            execute_into(store, plan, run)


def _remote(plan_of_run: str) -> "tuple[bytes | None, str]":
    from jawari import Error

    try:
        return execute(Plan.from_text(plan_of_run), 0), ""
    except Error as error:
        return None, str(error)


def run_dask(store: Store, runs: list[int], address: str, finished: Callable[[], None]) -> None:
    """Workers need the package jawari, but not the folder: results come back to this process, which writes them.

    A worker that dies gives its unfinished runs to the others."""
    try:
        from distributed import Client, KilledWorker, as_completed
    except ImportError:
        raise UsageError("--dask: no package distributed here (Debian: python3-distributed)") from None
    plan = store.plan()
    try:
        client = Client(address, timeout="30s")
    except OSError as error:
        raise FileError(f"{address}: {error}") from None
    with client:
        # Each task carries its own inputs: data that lies on a worker would be lost with it, and the tasks too.
        # Futures are not kept beyond their run: a number asked for again is computed again.
        futures = {client.submit(_remote, plan.only(run).text(), pure=False): run for run in runs}
        for future in as_completed(list(futures)):
            run = futures.pop(future)
            try:
                content, message = future.result()
            except KilledWorker:
                content, message = None, f"run {run}: its workers died"
            except Exception as error:  # of a worker: no package jawari there, or another version
                raise FileError(f"{address}: {type(error).__name__}: {error}") from None
            if content is None:
                store.write_failure(run, message)
            else:
                store.write(run, content)
            future.release()
            finished()
