"""Scenes and presets as dicts, and what else may stand for one."""

from __future__ import annotations

import contextlib
import copy
import json
import os
from typing import Any, Mapping, Union

from . import _core
from .errors import FileError, InvalidInput

SceneLike = Union[str, "os.PathLike[str]", Mapping[str, Any]]
PresetLike = Union[str, "os.PathLike[str]", Mapping[str, Any]]


def _plain(value: Any) -> Any:
    """NumPy's arrays and numbers, which json does not know."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"a {type(value).__name__} in a scene or preset (allowed: what JSON has, and NumPy arrays)")


def json_text(value: Mapping[str, Any]) -> str:
    """JSON of a dict; numbers read back as the same doubles."""
    return json.dumps(value, default=_plain)


def text_and_name(source: Any, kind: str) -> tuple[str | None, str]:
    """(JSON text, what messages call it), or (None, name or path)."""
    if isinstance(source, _Document):
        return json_text(source), source.name
    if isinstance(source, Mapping):
        return json_text(source), kind
    path = os.fspath(source)
    if not isinstance(path, str):
        raise TypeError(f"a {kind} is a name, a path, JSON text or a dict, not {type(source).__name__}")
    if path.lstrip().startswith("{"):
        return path, kind
    return None, path


class _Document(dict):
    """A dict that knows its name."""

    _kind = ""

    def __init__(self, source: Any = (), **changes: Any) -> None:
        self.name = self._kind
        if isinstance(source, _Document):
            self.name = source.name
            super().__init__(copy.deepcopy(dict(source)))
        elif isinstance(source, (Mapping, tuple)):
            super().__init__(copy.deepcopy(dict(source)))
        else:
            text, self.name = text_and_name(source, self._kind)
            if text is None:
                text = self._text_of(self.name)
            try:
                content = json.loads(text)
            except ValueError:
                self._check(text, self.name)  # says where the text is no JSON, in the program's words
                raise
            if not isinstance(content, dict):
                self._check(text, self.name)
                raise InvalidInput(f"{self.name}: no object (allowed: a JSON object)")
            super().__init__(content)
        self.update(changes)

    @staticmethod
    def _text_of(name: str) -> str:
        raise NotImplementedError

    @staticmethod
    def _check(text: str, name: str) -> None:
        raise NotImplementedError

    def json(self, indent: int | None = None) -> str:
        """JSON text; numbers read back as the same doubles."""
        return json.dumps(self, default=_plain, indent=indent)

    def save(self, path: "str | os.PathLike[str]") -> None:
        """Writes the JSON file whole or not at all."""
        temporary = f"{os.fspath(path)}.{os.getpid()}.part"
        text = self.json(indent=1) + "\n"
        try:
            with open(temporary, "w", encoding="utf-8") as file:
                file.write(text)
            os.replace(temporary, path)
        except OSError as error:
            with contextlib.suppress(OSError):
                os.unlink(temporary)
            raise FileError(f"{os.fspath(path)}: {error.strerror}") from None

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r}, {len(self)} keys)"


class Scene(_Document):
    """A scene as a dict, with the keys of docs/formats/scene.md.

    ``source``: a built-in name (``scene_names()``), a path, JSON text or a dict. Keyword arguments replace keys of the scene:
    ``Scene("lab/bass", duration_s=0.01)``. The source is copied.
    """

    _kind = "scene"

    @staticmethod
    def _text_of(name: str) -> str:
        return _core.scene_text(name).decode("utf-8", "surrogateescape")

    @staticmethod
    def _check(text: str, name: str) -> None:
        _core.check_scene(text, name, {})

    def validate(self) -> "Scene":
        """Raises ``InvalidInput`` unless the engine can simulate the scene; returns the scene."""
        self._check(json_text(self), self.name)
        return self


class Preset(_Document):
    """An instrument as a dict, with the keys of docs/formats/preset.md.

    ``source``: a name (``preset_names()``), a path, JSON text or a dict. Keyword arguments replace keys. The source is copied.
    """

    _kind = "preset"

    @staticmethod
    def _text_of(name: str) -> str:
        return _core.preset_text(name).decode("utf-8", "surrogateescape")

    @staticmethod
    def _check(text: str, name: str) -> None:
        _core.check_preset(text, name)

    def validate(self) -> "Preset":
        """Raises ``InvalidInput`` unless the engine can play the preset; returns the preset."""
        self._check(json_text(self), self.name)
        return self


def scene_names() -> list[str]:
    """Names of the built-in scenes."""
    return _core.scene_names()


def preset_names() -> list[str]:
    """Names of the presets that are built in or in the user's and the system's folders, sorted."""
    return _core.preset_names()
