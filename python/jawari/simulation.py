"""Simulations: whole, and step by step."""

from __future__ import annotations

import math
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .errors import UsageError
from .result import Array, Result, result_of, text
from .sources import SceneLike, text_and_name

#: Callbacks of Simulation.advance(); False ends the advance.
Callback = Callable[["Simulation"], Any]


def simulate(
    scene: SceneLike,
    *,
    duration_s: float | None = None,
    output_rate_hz: float | None = None,
    contact_rate_hz: float | None = None,
    quality: str | None = None,
    scheme: str | None = None,
    theta: float | None = None,
    law: str | None = None,
    restitution: float | None = None,
    start: str | None = None,
    contacts: bool = True,
    meter_steps: bool = False,
    skipping: bool = True,
) -> Result:
    """Simulates a scene from t = 0 to its end, as ``jawari simulate`` does, with the same numbers to the bit.

    ``scene``: a built-in name (``"lab/bass"``), a path, JSON text, a dict or a :class:`Scene`.

    Settings that are given replace those of the scene: ``duration_s`` [s], ``output_rate_hz`` rows per second,
    ``contact_rate_hz`` contact steps per second (a multiple of the output rate), ``quality`` (``live``, ``studio``,
    ``reference``), ``scheme`` (``exact``, ``theta``), ``theta`` (0.5 to 1), ``law`` (``newton``, ``passive``, ``signorini``,
    ``paoli-schatzman``), ``restitution`` of every contact (0 to 1), ``start`` (``exact``, ``backward``).

    ``contacts``: records gaps, impulses and energies at each row as well, (rows, contacts) each. ``meter_steps``: meters losses
    and work at each contact step, which computes every step. ``skipping=False`` skips nothing, for measurement.

    The GIL is released: run scenes in a ``ThreadPoolExecutor``. Ctrl-C ends the simulation. Raises :class:`jawari.Error`.
    """
    source, name = text_and_name(scene, "scene")
    settings = dict(
        duration_s=duration_s, output_rate_hz=output_rate_hz, contact_rate_hz=contact_rate_hz, quality=quality, scheme=scheme,
        theta=theta, law=law, restitution=restitution, start=start, contacts=contacts, meter_steps=meter_steps,
        skipping=skipping,
    )  # fmt: skip
    return result_of(_core.simulate(source, name, settings))


class StringView:
    """A string of a :class:`Simulation`, as it is now. A *view* looks at the engine's own memory without a copy, cannot be
    written to, and keeps the simulation alive. It holds until the simulation advances: the engine exchanges buffers. Ask for
    it again then, and ``.copy()`` what is to stay."""

    def __init__(self, simulation: "Simulation", index: int) -> None:
        self._core = simulation._core
        self._index = index
        facts = self._core.facts(index)
        self.name: str = text(facts["name"])
        self.modes: int = facts["modes"]
        self.contacts: list[int] = facts["contacts"]  #: numbers, in the scene, of the contacts that take part
        self.contact_position_m: Array = np.array(facts["contact_position_m"])  #: of these

    @property
    def q(self) -> Array:
        """View: modal displacement, (modes,) [m^(3/2)]."""
        return self._core.q(self._index)

    @property
    def v(self) -> Array:
        """View: backward modal velocity, (modes,) [m^(3/2)/s]."""
        return self._core.v(self._index)

    @property
    def impulse_Ns(self) -> Array:
        """View: impulses of the last output interval, (contacts,)."""
        return self._core.impulse_Ns(self._index)

    @property
    def contact_height_m(self) -> Array:
        """View: b = +-h of each contact, (contacts,)."""
        return self._core.contact_height_m(self._index)

    @property
    def gap_m(self) -> Array:
        """Gaps of the contacts that take part, (contacts,); computed from q, a new array."""
        return self._core.gap_m(self._index)

    @property
    def energy_J(self) -> float:
        """The discrete energy H."""
        return self._core.energy_J(self._index)

    @property
    def impulses(self) -> int:
        """Impulses since t = 0."""
        return self._core.impulses(self._index)

    def set_modes(self, q: ArrayLike, v: ArrayLike) -> None:
        """Sets modal displacement [m^(3/2)] and backward velocity [m^(3/2)/s], (modes,) each."""
        self._core.set_modes(self._index, np.asarray(q, dtype=np.float64), np.asarray(v, dtype=np.float64))

    def move_contact(self, contact: int, height_m: float, duration_s: float = 0.0) -> None:
        """Starts moving contact number ``contact`` of the scene linearly to ``height_m`` over ``duration_s``."""
        self._core.move_contact(self._index, contact, height_m, duration_s)


class Simulation:
    """A scene that advances when it is told to. Settings are those of :func:`simulate`, but for ``duration_s`` and ``contacts``.

    One thread at a time may work with it; :meth:`copy` gives another thread its own.
    """

    def __init__(
        self,
        scene: SceneLike,
        *,
        output_rate_hz: float | None = None,
        contact_rate_hz: float | None = None,
        quality: str | None = None,
        scheme: str | None = None,
        theta: float | None = None,
        law: str | None = None,
        restitution: float | None = None,
        start: str | None = None,
        meter_steps: bool = False,
        skipping: bool = True,
    ) -> None:
        source, name = text_and_name(scene, "scene")
        settings = dict(
            output_rate_hz=output_rate_hz, contact_rate_hz=contact_rate_hz, quality=quality, scheme=scheme, theta=theta,
            law=law, restitution=restitution, start=start, meter_steps=meter_steps, skipping=skipping,
        )  # fmt: skip
        self._adopt(_core.Stepper(source, name, settings))

    def _adopt(self, core: Any) -> None:
        self._core = core
        self.probe_names: list[str] = [text(probe) for probe in core.probe_names]
        self.strings: list[StringView] = [StringView(self, index) for index in range(core.string_count)]

    @property
    def time_s(self) -> float:
        """Time of the present state, frame/output_rate_hz."""
        return self._core.time_s

    @property
    def frame(self) -> int:
        """Output frames since t = 0."""
        return self._core.frame

    @property
    def duration_s(self) -> float:
        """Length that the scene asks for; the simulation may go on after it."""
        return self._core.duration_s

    @property
    def output_rate_hz(self) -> float:
        """Output frames per second."""
        return self._core.output_rate_hz

    @property
    def contact_rate_hz(self) -> float:
        """Contact steps per second."""
        return self._core.contact_rate_hz

    @property
    def probes(self) -> Array:
        """Values of all probes now, (probes,)."""
        return self._core.probe_values()

    def advance(
        self,
        frames: int | None = None,
        *,
        seconds: float | None = None,
        callback: Callback | None = None,
        every: int = 1,
    ) -> Array:
        """Advances by ``frames`` output frames, or by ``seconds`` (to the nearest frame); by one frame without both.

        Returns the probes of the frames that were passed, the present one first, (frames, probes): the rows that
        :func:`simulate` records. ``callback(simulation)`` is called before the first of every ``every`` frames; if it returns
        False, the advance ends there. The GIL is released in between.
        """
        if frames is not None and seconds is not None:
            raise UsageError(f"advance: {frames} frames and {seconds} seconds (allowed: one of the two)")
        if seconds is not None:
            if not (math.isfinite(seconds) and seconds >= 0):
                raise UsageError(f"seconds: {seconds} (allowed: finite numbers, 0 or more)")
            frames = round(seconds * self.output_rate_hz)
        frames = 1 if frames is None else int(frames)
        if frames < 0 or every < 1:
            raise UsageError(f"advance: {frames} frames, every {every} (allowed: frames from 0, every from 1)")
        if callback is None:
            return self._rows([self._core.advance(frames)])
        blocks = []
        while frames > 0:
            if callback(self) is False:
                break
            count = min(every, frames)
            blocks.append(self._core.advance(count))
            frames -= count
        return self._rows(blocks)

    def _rows(self, blocks: list[list[Array]]) -> Array:
        if not blocks or not self.probe_names:
            return np.empty((0, len(self.probe_names)))
        return np.concatenate([np.stack(block, axis=1) for block in blocks])

    def reset(self) -> None:
        """Back to t = 0."""
        self._core.reset()

    def save(self) -> bytes:
        """Everything that the simulation goes on from, as ``jawari simulate --save-state`` writes it."""
        return self._core.save()

    def restore(self, state: bytes) -> bool:
        """Goes on from a saved state, with its time. True: with the bits that it would have had; False: the state is of another
        rate or of other settings, and its motion was converted. Modes and contacts must be the same."""
        return self._core.restore(state)

    def copy(self) -> "Simulation":
        """Another simulation in the same state; from there each goes its own way."""
        other = object.__new__(Simulation)
        other._adopt(self._core.copy())
        return other
