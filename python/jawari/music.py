"""Music as `jawari render` plays it."""

from __future__ import annotations

import os
import warnings
from typing import Iterable, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import FileError, Notice
from .result import text as words
from .sources import PresetLike, text_and_name

#: (time [s], bytes of a channel message), such as (0.5, [0x90, 60, 100]).
Event = Tuple[float, Iterable[int]]
MusicLike = Union[bytes, bytearray, str, "os.PathLike[str]", Iterable[Event]]


def render(
    music: MusicLike,
    preset: PresetLike = "auto",
    *,
    rate: int = 48000,
    quality: str = "live",
    gain_db: float = 0.0,
    tail_s: float | None = None,
    limiter_dbfs: float | None = None,
    seed: int | None = None,
) -> NDArray[np.float64]:
    """Plays music with an instrument: the samples of ``jawari render`` before they are rounded, (frames, 2), left and right.

    ``music``: the bytes of a MIDI file, its path, or events ``(time in seconds, bytes of a channel message)``; an event's time
    is that of the nearest frame. ``preset``: a name, a path, JSON text, a dict or a :class:`Preset`; ``"auto"``: each
    channel's program chooses. ``rate``: samples per second, 8000 to 384000. ``quality``: ``live``, ``studio``, ``reference``.
    ``tail_s``: seconds after the last event; None: until the sound has died away. ``limiter_dbfs``: of the look-ahead
    limiter, -40 to 0; None: no limiter. ``seed``: of small irregularities of the player; None: exactly as written.

    What the program gives a notice of (keys that no string has, messages that do nothing, damaged files) is a warning of the
    class :class:`jawari.Notice`. The GIL is released. Raises :class:`jawari.Error`.
    """
    name = "MIDI"
    if isinstance(music, (str, os.PathLike)):
        name = os.fspath(music)
        try:
            with open(music, "rb") as file:
                music = file.read()
        except OSError as error:
            raise FileError(f"{name}: {error.strerror}") from None
    elif isinstance(music, (bytearray, memoryview)):
        music = bytes(music)
    text, preset_name = text_and_name(preset, "preset")
    settings = dict(rate=rate, quality=quality, gain_db=gain_db, tail_s=tail_s, limiter_dbfs=limiter_dbfs, seed=seed)
    sound, notices = _core.render(music, name, text, preset_name, settings)
    for line in notices:
        warnings.warn(f"{name}: {words(line)}", Notice, stacklevel=2)
    return sound
