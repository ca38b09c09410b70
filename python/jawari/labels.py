"""Results as labelled datasets of xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import xarray

if TYPE_CHECKING:
    from .result import Result, StringResult

#: Quantities of a string: name -> (dimensions after those of the string, unit).
STRING_ROWS = {
    "gap_m": (("time_s", "contact"), "m"),
    "impulse_Ns": (("time_s", "contact"), "N s"),
    "energy_J": (("time_s",), "J"),
    "dissipated_J": (("time_s",), "J"),
    "contact_work_J": (("time_s",), "J"),
    "player_work_J": (("time_s",), "J"),
    "contact_height_m": (("contact",), "m"),
    "contact_restitution": (("contact",), "1"),
    "contact_takes_part": (("contact",), "1"),
    "frequency_hz": (("mode",), "Hz"),
    "decay_per_s": (("mode",), "1/s"),
    "final_modal_displacement": (("mode",), "m^(3/2)"),
    "final_modal_velocity": (("mode",), "m^(3/2)/s"),
}


def _string_variables(string: "StringResult", index: int) -> dict[str, Any]:
    variables = {}
    for name, (dimensions, unit) in STRING_ROWS.items():
        values = getattr(string, name)
        if values is None:
            continue
        own = tuple(d if d == "time_s" else f"{d}_{index}" for d in dimensions)
        variables[f"{name}_{index}"] = (own, values, {"units": unit, "long_name": f"{name} of string {string.name}"})
    return variables


def dataset(result: "Result") -> xarray.Dataset:
    variables: dict[str, Any] = {"probes": (("time_s", "probe"), result.probes, {"units": "see probe_unit"})}
    coordinates: dict[str, Any] = {
        "time_s": ("time_s", result.time_s, {"units": "s"}),
        "probe": ("probe", result.probe_names),
        "probe_unit": ("probe", result.probe_units),
    }
    for index, string in enumerate(result.strings):
        variables.update(_string_variables(string, index))
        coordinates[f"contact_position_m_{index}"] = (f"contact_{index}", string.contact_position_m, {"units": "m"})
    settings = result.stats["settings"]
    attributes = {"jawari_version": result.stats["jawari_version"], "scene": result.stats["scene"], **settings}
    return xarray.Dataset(variables, coordinates, attributes)
