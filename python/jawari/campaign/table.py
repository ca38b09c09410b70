"""All results of a campaign in one CSV and one HDF5 file that netCDF and xarray read."""

from __future__ import annotations

import csv
import io
import json
import os
from typing import Any

import numpy as np

from .store import Store, write_whole

#: Units by the ends of names, the longest first.
UNITS = (("_m_per_s", "m/s"), ("_Ns", "N s"), ("_hz", "Hz"), ("_m", "m"), ("_s", "s"), ("_N", "N"), ("_J", "J"), ("_Pa", "Pa"))


def unit_of(name: str, probe_units: dict[str, str]) -> str:
    probe = name.split(":", 1)[-1]
    if probe in probe_units:
        return probe_units[probe]
    return next((unit for end, unit in UNITS if name.endswith(end)), "1")


def _columns(rows: list[dict[str, Any]]) -> list[str]:
    names: dict[str, None] = {}
    for row in rows:
        names.update(dict.fromkeys(row["facts"]["numbers"]))
    return list(names)


def _word(value: Any) -> str:
    """Of an input; one that a run does not set is empty."""
    if value is None:
        return ""
    return value if isinstance(value, str) else json.dumps(value)


def _csv(plan: Any, runs: list[int], rows: list[dict[str, Any]], columns: list[str]) -> bytes:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["run", *plan.inputs, *columns, "warnings"])
    for run, row in zip(runs, rows):
        numbers = row["facts"]["numbers"]
        values = ["" if numbers.get(name) is None else repr(numbers[name]) for name in columns]
        inputs = [_word(value) for value in plan.runs[run]]
        writer.writerow([run, *inputs, *values, len(row["facts"]["warnings"])])
    return text.getvalue().encode()


def _variable(file: Any, name: str, values: Any, scales: list[Any], **attributes: str) -> Any:
    data = file.create_dataset(name.replace("/", "|"), data=values)
    for dimension, scale in enumerate(scales):
        data.dims[dimension].attach_scale(scale)
    data.attrs.update(attributes)
    return data


def _scale(file: Any, name: str, values: Any, unit: str | None = None) -> Any:
    scale = file.create_dataset(name, data=values)
    scale.make_scale(name)
    if unit:
        scale.attrs["units"] = unit
    return scale


def _write_arrays(file: Any, run: Any, rows: list[dict[str, Any]], plan: Any) -> None:
    """Spectra and rows, if all runs have the same probes; shorter runs are filled with NaN."""
    probes = rows[0]["facts"]["probe_names"]
    if not probes or any(row["facts"]["probe_names"] != probes for row in rows):
        return
    probe = _scale(file, "probe_name", probes)
    _variable(file, "probe_unit", rows[0]["facts"]["probe_units"], [probe])
    if "spectrum" in rows[0]:
        section = plan.outputs["spectrum"]
        centres = (np.arange(int(section["bands"])) + 0.5) * section["to_hz"] / int(section["bands"])
        band = _scale(file, "band_centre_hz", centres, "Hz")
        _variable(file, "spectrum", np.stack([row["spectrum"] for row in rows]), [run, probe, band], units="see probe_unit")
    if "rows" in rows[0]:
        longest = max(len(row["rows"]) for row in rows)
        row_scale = _scale(file, "row", np.arange(longest), "1")
        values, times = np.full((len(rows), longest, len(probes)), np.nan), np.full((len(rows), longest), np.nan)
        for i, row in enumerate(rows):
            values[i, : len(row["rows"])], times[i, : len(row["rows"])] = row["rows"], row["time_s"]
        _variable(file, "probes", values, [run, row_scale, probe], units="see probe_unit")
        _variable(file, "time_s", times, [run, row_scale], units="s")


def _hdf5(plan: Any, runs: list[int], rows: list[dict[str, Any]], columns: list[str]) -> bytes:
    import h5py

    memory = io.BytesIO()
    with h5py.File(memory, "w", track_order=True) as file:
        file.attrs["schema"], file.attrs["plan_json"] = "jawari.campaign-results/1", plan.text()
        run = _scale(file, "run", np.array(runs), "1")
        units = {name: unit for row in rows for name, unit in zip(row["facts"]["probe_names"], row["facts"]["probe_units"])}
        for i, name in enumerate(plan.inputs):
            values = [plan.runs[r][i] for r in runs]
            if all(isinstance(value, (int, float)) or value is None for value in values):
                values = [np.nan if value is None else value for value in values]
            else:
                values = [_word(value) for value in values]
            _variable(file, f"input:{name}", values, [run], units=unit_of(name, {}), role="input")
        for name in columns:
            values = [row["facts"]["numbers"].get(name) for row in rows]
            values = [np.nan if value is None else value for value in values]
            _variable(file, name, values, [run], units=unit_of(name, units), role="output")
        for name in ("jawari_version", "machine", "processor", "python"):
            _variable(file, name, [row["facts"][name] for row in rows], [run])
        _variable(file, "cpu_s", [row["facts"]["cpu_s"] for row in rows], [run], units="s")
        if rows:
            _write_arrays(file, run, rows, plan)
    return memory.getvalue()


def gather(folder: "str | os.PathLike[str]") -> int:
    """Writes results.csv and, with h5py, results.h5 of all runs that are done; returns how many these are."""
    store = Store(folder)
    plan = store.plan()
    runs = sorted(store.done())
    rows = [store.read(run) for run in runs]
    columns = _columns(rows)
    write_whole(store.folder / "results.csv", _csv(plan, runs, rows, columns))
    try:
        write_whole(store.folder / "results.h5", _hdf5(plan, runs, rows, columns))
    except ImportError:
        pass  # h5py is an extra; the CSV holds the numbers
    return len(runs)
