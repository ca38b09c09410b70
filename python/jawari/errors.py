"""What goes wrong, as exceptions. Each message is one line: what, its value, and what is allowed."""

from __future__ import annotations

__all__ = ["Error", "UsageError", "InvalidInput", "FileError", "InternalError", "Notice"]


class Error(Exception):
    """Base of all errors of jawari. ``exit_code`` is that of the program for the same error."""

    exit_code = 5


class UsageError(Error, ValueError):
    """An argument contradicts another one, or is not allowed."""

    exit_code = 2


class InvalidInput(Error, ValueError):
    """A scene, a preset, a campaign or a MIDI file says something that is not allowed."""

    exit_code = 3


class FileError(Error, OSError):
    """A file cannot be read or written, or there is none of that name."""

    exit_code = 4


class InternalError(Error, RuntimeError):
    """A defect of jawari, or out of memory."""

    exit_code = 5


class Notice(UserWarning):
    """Music was played, but something in it was repaired, ignored or silent."""


for _class in (Error, UsageError, InvalidInput, FileError, InternalError, Notice):
    _class.__module__ = "jawari"
