"""The folder of a campaign: its plan, and the result of each run in a file that is whole or not there."""

from __future__ import annotations

import fcntl
import io
import json
import os
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import FileError, UsageError
from .plan import Plan


def write_whole(path: Path, content: bytes) -> None:
    """Under a name of its own first: whoever looks, and whatever is killed, sees the whole file or none."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    with open(temporary, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(temporary, path)


class Store:
    def __init__(self, folder: "str | os.PathLike[str]") -> None:
        self.folder = Path(folder)
        self.results = self.folder / "runs"

    def prepare(self, plan: Plan) -> None:
        """Makes the folder, or finds that it is this plan's."""
        try:
            self.results.mkdir(parents=True, exist_ok=True)
            file = self.folder / "plan.json"
            if not file.exists():
                write_whole(file, plan.text().encode())
            elif file.read_text() != Plan.from_text(plan.text()).text():
                raise UsageError(f"{self.folder}: holds another campaign (allowed: a new folder, or that of this campaign)")
        except OSError as error:
            raise FileError(f"{self.folder}: {error.strerror}") from None

    def plan(self) -> Plan:
        return Plan.from_text((self.folder / "plan.json").read_text())

    def lock(self) -> Any:
        """Held until the process ends, however it ends."""
        file = open(self.folder / "lock", "w")
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise UsageError(f"{self.folder}: another process works on it (allowed: one at a time)") from None
        for leftover in self.results.glob(".*.part"):
            leftover.unlink(missing_ok=True)
        return file

    def path(self, run: int) -> Path:
        return self.results / f"{run:07d}.npz"

    def failure_path(self, run: int) -> Path:
        return self.results / f"{run:07d}.failed.json"

    def write(self, run: int, content: bytes) -> None:
        write_whole(self.path(run), content)

    def write_failure(self, run: int, message: str) -> None:
        write_whole(self.failure_path(run), json.dumps({"run": run, "message": message}).encode())

    def _numbers(self, suffix: str) -> set[int]:
        return {int(path.name[:7]) for path in self.results.iterdir() if path.name[:1] != "." and path.name.endswith(suffix)}

    def done(self) -> set[int]:
        return self._numbers(".npz")

    def failures(self) -> dict[int, str]:
        return {run: json.loads(self.failure_path(run).read_text())["message"] for run in sorted(self._numbers(".failed.json"))}

    def forget_failures(self) -> None:
        for run in self._numbers(".failed.json"):
            self.failure_path(run).unlink()

    def pending(self, runs: int) -> list[int]:
        finished = self.done() | self._numbers(".failed.json")
        return [run for run in range(runs) if run not in finished]

    def read(self, run: int) -> dict[str, Any]:
        with np.load(io.BytesIO(self.path(run).read_bytes()), allow_pickle=False) as file:
            content = {name: file[name] for name in file.files}
        content["facts"] = json.loads(str(content["facts"]))
        return content
