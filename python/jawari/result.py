"""What a simulation has computed."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]


def text(name: bytes) -> str:
    """Names of strings and probes may hold any bytes; those that are no UTF-8 become replacement characters."""
    return name.decode("utf-8", "replace")


@dataclass(frozen=True, eq=False)
class StringResult:
    """One string of a scene. Arrays over contacts follow the scene's numbering; over modes, k = 1 first."""

    name: str
    length_m: float
    linear_density_kg_per_m: float
    contact_position_m: Array  #: (contacts,)
    contact_height_m: Array  #: (contacts,), at t = 0
    contact_restitution: Array  #: (contacts,)
    contact_side: list[str]  #: ``below`` or ``above``
    contact_takes_part: NDArray[np.bool_]  #: (contacts,), False for contacts on the string's ends
    frequency_hz: Array  #: (modes,), undamped
    decay_per_s: Array  #: (modes,)
    final_modal_displacement: Array  #: q at the last row, (modes,) [m^(3/2)]
    final_modal_velocity: Array  #: backward velocity v at the last row, (modes,) [m^(3/2)/s]
    gap_m: Array | None = None  #: (rows, contacts), NaN for contacts that do not take part
    impulse_Ns: Array | None = None  #: (rows, contacts), of the output interval that ends at the row
    energy_J: Array | None = None  #: (rows,), the discrete energy H
    dissipated_J: Array | None = None  #: (rows,), with ``meter_steps``: lost in the string since t = 0
    contact_work_J: Array | None = None  #: (rows,), with ``meter_steps``: work of impacts on the string
    player_work_J: Array | None = None  #: (rows,), with ``meter_steps``: work of moving obstacles


@dataclass(frozen=True, eq=False)
class Result:
    """Result of :func:`jawari.simulate`. Row n is t = n/output_rate_hz; ``result[name]`` is one probe, (rows,)."""

    time_s: Array  #: (rows,)
    output_rate_hz: float
    probe_names: list[str]  #: as in the program's CSV, ``displacement_m@0.0863``
    probe_units: list[str]  #: ``m``, ``m/s``, ``N``, ``J``
    probe_strings: list[int]  #: index of the string of each probe
    columns: list[Array] = field(repr=False)  #: one array (rows,) for each probe
    strings: list[StringResult] = field(repr=False)
    stats: dict[str, Any] = field(repr=False)  #: the program's statistics, docs/commands/simulate.md
    warnings: list[str] = field(default_factory=list)  #: what makes the numbers doubtful, one line each

    def __getitem__(self, probe: str | int) -> Array:
        """Values of a probe by name or index, (rows,)."""
        if isinstance(probe, int):
            return self.columns[probe]
        try:
            return self.columns[self.probe_names.index(probe)]
        except ValueError:
            raise KeyError(f"{probe} (allowed: {', '.join(self.probe_names)})") from None

    @property
    def probes(self) -> Array:
        """All probes, (rows, probes); a new array."""
        return np.stack(self.columns, axis=1) if self.columns else np.empty((len(self.time_s), 0))

    def to_xarray(self) -> "xarray.Dataset":
        """A labelled ``xarray.Dataset``: dimensions ``time_s``, ``probe`` and, for string s, ``contact_s`` and ``mode_s``;
        every variable has the attribute ``units``. Needs xarray."""
        from .labels import dataset

        return dataset(self)


def result_of(raw: dict[str, Any]) -> Result:
    """From what the extension module returns."""
    strings = []
    for string in raw["strings"]:
        string["name"] = text(string["name"])
        string["contact_takes_part"] = string["contact_takes_part"] != 0
        strings.append(StringResult(**string))
    return Result(
        time_s=np.arange(raw["rows"]) / raw["output_rate_hz"],
        output_rate_hz=raw["output_rate_hz"],
        probe_names=[text(name) for name in raw["probe_names"]],
        probe_units=raw["probe_units"],
        probe_strings=raw["probe_strings"],
        columns=raw["probes"],
        strings=strings,
        stats=json.loads(raw["stats"]),
        warnings=[text(line) for line in raw["warnings"]],
    )
