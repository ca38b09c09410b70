"""Jawari: strings that strike things. docs/python.md describes the package."""

from ._core import __version__
from .errors import Error, FileError, InternalError, InvalidInput, Notice, UsageError
from .music import render
from .result import Result, StringResult
from .simulation import Simulation, StringView, simulate
from .sources import Preset, Scene, preset_names, scene_names

__all__ = [
    "Error",
    "FileError",
    "InternalError",
    "InvalidInput",
    "Notice",
    "Preset",
    "Result",
    "Scene",
    "Simulation",
    "StringResult",
    "StringView",
    "UsageError",
    "__version__",
    "preset_names",
    "render",
    "scene_names",
    "simulate",
]
