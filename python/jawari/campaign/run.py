"""One run of a campaign: a scene in, the bytes of its result out."""

from __future__ import annotations

import io
import json
import platform
import sys
from typing import Any

import numpy as np

from .. import __version__
from ..errors import Error
from ..result import Result
from ..simulation import simulate
from .plan import Plan
from .store import Store

_STATISTICS = {
    "mean": np.mean,
    "rms": lambda u: np.sqrt(np.mean(np.square(u))),
    "min": np.min,
    "max": np.max,
    "last": lambda u: u[-1],
}
_COUNTERS = ("impulses", "solves", "truncated_solves", "nonfinite_resets", "worst_penetration_m", "initial_energy_J",
             "final_energy_J", "energy_max_over_initial")  # fmt: skip


def bands_of(values: Any, rate_hz: float, bands: int, to_hz: float) -> Any:
    """Root mean square of the values within each of `bands` equal bands from 0 to `to_hz` (Hann window, constant removed)."""
    window = np.hanning(len(values)) if len(values) > 2 else np.ones(len(values))
    power = np.abs(np.fft.rfft((values - values.mean()) * window)) ** 2 * 2 / (len(values) * np.sum(window**2))
    frequency_hz = np.fft.rfftfreq(len(values), 1 / rate_hz)
    band = np.floor(frequency_hz / (to_hz / bands)).astype(int)
    return np.sqrt(np.bincount(band[band < bands], power[band < bands], minlength=bands)[:bands])


def kept(result: Result, outputs: dict[str, Any]) -> dict[str, Any]:
    numbers = {name: result.stats[name] for name in _COUNTERS}
    for probe, values in zip(result.probe_names, result.columns):
        for name in outputs["statistics"]:
            numbers[f"{name}:{probe}"] = float(_STATISTICS[name](values))
    facts = {
        "numbers": numbers, "warnings": result.warnings, "jawari_version": __version__, "machine": platform.node(),
        "processor": platform.machine(), "python": sys.version.split()[0],
        "cpu_s": result.stats["cpu_compile_s"] + result.stats["cpu_render_s"],
        "probe_names": result.probe_names, "probe_units": result.probe_units,
    }  # fmt: skip
    content: dict[str, Any] = {"facts": json.dumps(facts)}
    if "spectrum" in outputs and result.columns:
        section = outputs["spectrum"]
        content["spectrum"] = np.stack(
            [bands_of(u, result.output_rate_hz, int(section["bands"]), section["to_hz"]) for u in result.columns]
        )
    if "rows" in outputs:
        content["rows"] = result.probes[:: int(outputs["rows"]["every"])]
        content["time_s"] = result.time_s[:: int(outputs["rows"]["every"])]
    return content


def execute(plan: Plan, run: int) -> bytes:
    """The bytes of the run's result file. Raises jawari.Error."""
    result = simulate(plan.scene_of(run), contacts=False)
    file = io.BytesIO()
    np.savez(file, **kept(result, plan.outputs))
    return file.getvalue()


def execute_into(store: Store, plan: Plan, run: int) -> None:
    """Result or failure, whole, in the store."""
    try:
        store.write(run, execute(plan, run))
    except Error as error:
        store.write_failure(run, str(error))
