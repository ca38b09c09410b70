"""A campaign file as the list of its runs: which scene each simulates, and what is kept of it."""

from __future__ import annotations

import copy
import csv
import itertools
import json
import math
import os
import random
import re
from dataclasses import dataclass, field
from typing import Any, Callable

from .. import _core
from ..errors import FileError, InvalidInput
from ..sources import Scene

SCHEMA = "jawari.campaign/1"
KEYS = {"schema", "comment", "scene", "set", "axes", "table", "random", "outputs"}
OUTPUTS = {"statistics", "spectrum", "rows"}
STATISTICS = ("mean", "rms", "min", "max", "last")
MOST_RUNS = 1_000_000

_TOKEN = re.compile(r"([A-Za-z_][A-Za-z_0-9]*)|\[(\d+|\*)\]|(\.)")


def _refuse(file: str, place: str, value: Any, allowed: str) -> InvalidInput:
    return InvalidInput(f"{file}: {place}: {value} (allowed: {allowed})")


def tokens_of(path: str) -> list[str | int]:
    """``strings[0].contacts[*].restitution`` -> ["strings", 0, "contacts", "*", "restitution"]."""
    tokens: list[str | int] = []
    place = 0
    while place < len(path):
        match = _TOKEN.match(path, place)
        if match is None:
            return []
        if match[1]:
            tokens.append(match[1])
        elif match[2]:
            tokens.append("*" if match[2] == "*" else int(match[2]))
        place = match.end()
    return tokens


def assign(scene: Any, tokens: list[str | int], value: Any) -> int:
    """Sets every place that the path names; how many there were."""
    head, rest = tokens[0], tokens[1:]
    if head == "*":
        return sum(assign(scene, [i, *rest], value) for i in range(len(scene))) if isinstance(scene, list) else 0
    if isinstance(head, int):
        if not isinstance(scene, list) or head >= len(scene):
            return 0
    elif not isinstance(scene, dict) or (rest and head not in scene):
        return 0
    if rest:
        return assign(scene[head], rest, value)
    scene[head] = value
    return 1


@dataclass
class Plan:
    """All that the runs need, without another file."""

    scenes: dict[str, dict[str, Any]]
    inputs: list[str]  #: names of the axes, the columns of the table
    runs: list[list[Any]]  #: values of the inputs, run by run
    constants: dict[str, Any] = field(default_factory=dict)
    outputs: dict[str, Any] = field(default_factory=dict)

    def scene_of(self, run: int) -> Scene:
        values = dict(zip(self.inputs, self.runs[run]))
        name = values.pop("scene", next(iter(self.scenes)))
        scene = copy.deepcopy(self.scenes[name])
        for path, value in {**self.constants, **values}.items():
            if value is None:  # an empty cell of a table: as the scene has it
                continue
            if assign(scene, tokens_of(path), value) == 0:
                raise InvalidInput(f"{name}: {path}: no such place (allowed: paths of the scene)")
        result = Scene(scene)
        result.name = name
        return result

    def only(self, run: int) -> "Plan":
        """The plan of this run alone, which is its run 0: all that it needs, and no more, to be sent elsewhere."""
        names = dict(zip(self.inputs, self.runs[run]))
        name = names.get("scene", next(iter(self.scenes)))
        return Plan({name: self.scenes[name]}, self.inputs, [self.runs[run]], self.constants, self.outputs)

    def text(self) -> str:
        return json.dumps(self.__dict__, sort_keys=True)

    @staticmethod
    def from_text(text: str) -> "Plan":
        return Plan(**json.loads(text))


def _value(text: str) -> Any:
    if not text:
        return None
    try:
        return json.loads(text)
    except ValueError:
        return text


def check_rates(file: str, plan: "Plan") -> None:
    """Rates that do not fit together are refused before anything runs, each pair once."""
    places = ("contact_rate_hz", "output_rate_hz")
    if not set(places) & {*plan.inputs, *plan.constants}:
        return
    seen = set()
    for values in plan.runs:
        given = {**plan.constants, **dict(zip(plan.inputs, values))}
        scene = plan.scenes[given.get("scene", next(iter(plan.scenes)))]
        contact, output = (given.get(place, scene.get(place)) for place in places)
        output = 48000 if output is None else output
        if not all(isinstance(rate, (int, float)) and rate > 0 for rate in (contact, output)) or (contact, output) in seen:
            continue
        seen.add((contact, output))
        ratio = contact / output
        if abs(ratio - max(1, round(ratio))) > 1e-9 * ratio:
            raise _refuse(file, "contact_rate_hz", contact, f"a multiple of output_rate_hz {output:g}; an axis with multiple_of gives them")


class _Reader:
    def __init__(self, document: dict[str, Any], file: str) -> None:
        self.document, self.file = document, file

    def refuse(self, place: str, value: Any, allowed: str) -> InvalidInput:
        shown = value if isinstance(value, str) and value in ("missing", "unknown key") else json.dumps(value)
        return _refuse(self.file, place, shown, allowed)

    def object(self, key: str) -> dict[str, Any]:
        value = self.document.get(key, {})
        if not isinstance(value, dict):
            raise self.refuse(key, value, "an object")
        return value

    def number(self, place: str, value: Any, lowest: float = -math.inf) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not value >= lowest:
            raise self.refuse(place, value, "a number" if lowest == -math.inf else f"a number from {lowest:g}")
        return value

    def values(self, place: str, axis: Any) -> list[Any]:
        """Of an axis: a list, or a range."""
        if isinstance(axis, list) and axis:
            return axis
        if not isinstance(axis, dict) or not {"from", "to", "count"} <= set(axis) <= {"from", "to", "count", "scale", "multiple_of"}:
            raise self.refuse(place, axis, "a list of values, or from, to, count and, if you like, scale and multiple_of")
        scale = axis.get("scale", "linear")
        if scale not in ("linear", "log"):
            raise self.refuse(f"{place}.scale", scale, '"linear", "log"')
        count = int(self.number(f"{place}.count", axis["count"], 1))
        first, last = (self.number(f"{place}.{key}", axis[key]) for key in ("from", "to"))
        if scale == "log" and not (first > 0 and last > 0):
            raise self.refuse(place, axis, "from and to above 0 with the scale log")
        steps = [i / max(1, count - 1) for i in range(count)]
        if scale == "log":
            values = [first * (last / first) ** t for t in steps]
        else:
            values = [first + (last - first) * t for t in steps]
        unit = axis.get("multiple_of")
        if unit is None:
            return values
        if not self.number(f"{place}.multiple_of", unit) > 0:
            raise self.refuse(f"{place}.multiple_of", unit, "a number above 0")
        return list(dict.fromkeys(unit * max(1, round(value / unit)) for value in values))  # each once

    def path(self, section: str, path: str) -> None:
        if path != "scene" and not tokens_of(path):
            raise self.refuse(section, path, "paths such as strings[0].contacts[*].restitution, or scene")

    def scene(self, place: str, scene: Any) -> tuple[str, dict[str, Any]]:
        if isinstance(scene, dict):
            return "scene", Scene(scene)
        if not isinstance(scene, str):
            raise self.refuse(place, scene, "a built-in name, a file or an object")
        beside = os.path.join(os.path.dirname(self.file), scene)
        return scene, Scene(beside if os.path.exists(beside) else scene)

    def random_draws(self) -> tuple[list[str], list[list[float]]]:
        section = self.object("random")
        if not section:
            return [], [[]]
        if set(section) != {"count", "seed", "axes"} or not isinstance(section["axes"], dict):
            raise self.refuse("random", sorted(section), "count, seed and axes")
        count = int(self.number("random.count", section["count"], 1))
        source = random.Random(int(self.number("random.seed", section["seed"], 0)))
        laws = [self.law(path, given) for path, given in section["axes"].items()]
        return list(section["axes"]), [[draw(source) for draw in laws] for _ in range(count)]

    def law(self, path: str, given: Any) -> Callable[[random.Random], Any]:
        """What one axis draws: [lowest, highest] is uniform, an object names its law."""
        place = f"random.axes.{path}"
        self.path("random.axes", path)
        if isinstance(given, list) and len(given) == 2:
            given = {"law": "uniform", "from": given[0], "to": given[1]}
        laws = {"uniform": {"from", "to"}, "log_uniform": {"from", "to"}, "normal": {"mean", "deviation"}, "choice": {"values"}}
        if not isinstance(given, dict) or given.get("law") not in laws or set(given) != {"law", *laws[given["law"]]}:
            raise self.refuse(place, given, "[lowest, highest], or a law: uniform or log_uniform with from and to, normal with "
                              "mean and deviation, choice with values")  # fmt: skip
        if given["law"] == "choice":
            values = given["values"]
            if not isinstance(values, list) or not values:
                raise self.refuse(f"{place}.values", values, "a list of values")
            return lambda source: values[int(source.random() * len(values))]
        numbers = {key: self.number(f"{place}.{key}", given[key]) for key in laws[given["law"]]}
        if given["law"] == "normal":
            if not numbers["deviation"] >= 0:
                raise self.refuse(f"{place}.deviation", numbers["deviation"], "a number from 0")
            # random() alone is promised to give the same numbers in every version of Python: Box and Muller.
            return lambda source: numbers["mean"] + numbers["deviation"] * math.sqrt(-2 * math.log(1 - source.random())) * math.cos(
                2 * math.pi * source.random())  # fmt: skip
        low, high = numbers["from"], numbers["to"]
        if given["law"] == "log_uniform":
            if not (low > 0 and high > 0):
                raise self.refuse(place, given, "from and to above 0")
            return lambda source: low * (high / low) ** source.random()
        return lambda source: low + (high - low) * source.random()

    def table(self) -> tuple[list[str], list[list[Any]]]:
        """A CSV file whose columns are paths and whose rows are settings: values as in JSON, else words; empty: not set."""
        name = self.document.get("table")
        if name is None:
            return [], [[]]
        if not isinstance(name, str):
            raise self.refuse("table", name, "the name of a CSV file")
        path = os.path.join(os.path.dirname(self.file), name)
        try:
            with open(path, newline="", encoding="utf-8-sig") as source:
                rows = [row for row in csv.reader(source) if row]
        except OSError as error:
            raise FileError(f"{path}: {error.strerror}") from None
        if len(rows) < 2:
            raise _refuse(path, "rows", len(rows), "a row of paths, and at least one of values")
        names = rows[0]
        for each in names:
            self.path(f"table {name}", each)
        if len(set(names)) < len(names):
            raise _refuse(path, "row 1", ",".join(names), "each path once")
        for number, row in enumerate(rows[1:], start=2):
            if len(row) != len(names):
                raise _refuse(path, f"row {number}", f"{len(row)} values", f"{len(names)}, as many as paths")
        return names, [[_value(text) for text in row] for row in rows[1:]]

    def outputs(self) -> dict[str, Any]:
        outputs = dict(self.object("outputs"))
        for key in outputs:
            if key not in OUTPUTS:
                raise self.refuse(f"outputs.{key}", "unknown key", ", ".join(sorted(OUTPUTS)))
        statistics = outputs.setdefault("statistics", list(STATISTICS))
        if not isinstance(statistics, list) or not set(statistics) <= set(STATISTICS):
            raise self.refuse("outputs.statistics", statistics, "some of " + ", ".join(STATISTICS))
        for key, wanted in (("spectrum", ("bands", "to_hz")), ("rows", ("every",))):
            section = outputs.get(key)
            if section is None:
                continue
            if not isinstance(section, dict) or set(section) != set(wanted):
                raise self.refuse(f"outputs.{key}", section, "an object with " + " and ".join(wanted))
            for name in wanted:
                self.number(f"outputs.{key}.{name}", section[name], 1)
        return outputs

    def plan(self) -> Plan:
        for key in self.document:
            if key not in KEYS:
                raise self.refuse(key, "unknown key", ", ".join(sorted(KEYS)))
        if self.document.get("schema") != SCHEMA:
            raise self.refuse("schema", self.document.get("schema", "missing"), f'"{SCHEMA}"')
        axes = {path: self.values(f"axes.{path}", axis) for path, axis in self.object("axes").items()}
        for section, paths in (("axes", axes), ("set", self.object("set"))):
            for path in paths:
                self.path(section, path)
        scenes = {}
        drawn, draws = self.random_draws()
        tabled, rows = self.table()
        if twice := sorted({*axes} & {*tabled} | {*axes, *tabled} & {*drawn}):
            raise self.refuse("axes", twice[0], "each path in one of axes, table and random")
        count = len(draws) * len(rows) * math.prod(map(len, axes.values()))
        if count > MOST_RUNS:
            raise self.refuse("axes", f"{count} runs", f"at most {MOST_RUNS}")
        column = tabled.index("scene") if "scene" in tabled else None
        names = axes.get("scene") or ([row[column] for row in rows] if column is not None else [self.document.get("scene")])
        for name in dict.fromkeys(map(json.dumps, names)):
            found, scene = self.scene("scene", json.loads(name))
            scenes[found] = dict(scene)
        runs = [[*grid, *row, *draw] for grid in itertools.product(*axes.values()) for row in rows for draw in draws]
        plan = Plan(scenes, [*axes, *tabled, *drawn], runs, self.object("set"), self.outputs())
        check_rates(self.file, plan)
        return plan


def load_plan(path: "str | os.PathLike[str]") -> Plan:
    """Reads a campaign file (docs/campaigns.md); problems name file, place, value and what is allowed."""
    file = os.fspath(path)
    try:
        with open(file, encoding="utf-8") as source:
            document = json.load(source)
    except OSError as error:
        raise FileError(f"{file}: {error.strerror}") from None
    except ValueError as error:
        raise InvalidInput(f"{file}: {error} (allowed: JSON)") from None
    if not isinstance(document, dict):
        raise InvalidInput(f"{file}: no object (allowed: a JSON object)")
    plan = _Reader(document, file).plan()
    first = plan.scene_of(0)
    _core.check_scene(first.json(), first.name, {})
    return plan
