"""Looks: all that an artist chooses, as one value."""
from __future__ import annotations

import ctypes
import json

from . import _declared, errors
from ._library import call, library, made, names
from .lens import Lens


class Look:
    """A look: engine, quality, lens options, glare. Fields have the names of `petzval defocus --save-look`.

        look = petzval.Look(engine="gather", lens="doublet")
        look["lens.blades"] = 5

    `lens` is a Lens, or a name or file, which is opened once, here. Raises InvalidArgument for unknown fields and
    values of the wrong type, and the errors of Lens.
    """

    def __init__(self, *, lens: Lens | str | None = None, **fields) -> None:
        self._handle = made(_declared.petzval_look, "petzval_look_new")
        self._lens: Lens | None = None
        for field, value in fields.items():
            self[field] = value
        if lens is not None:
            self.lens = lens

    @classmethod
    def from_json(cls, text: str) -> Look:
        """A look as Look.to_json and `petzval defocus --save-look` write it, or a link of the lens lab. Raises InvalidFile."""
        look = cls.__new__(cls)
        look._lens = None
        look._handle = ctypes.POINTER(_declared.petzval_look)()
        errors.of_type(text, str, "look", "text")
        try:
            call("petzval_look_from_json", text.encode(), ctypes.byref(look._handle))
        except errors.Error as why:
            raise type(why)(f"look: {why}") from None
        return look

    @classmethod
    def preset(cls, name: str) -> Look:
        """A look by name: one of preset_names(). Raises InvalidArgument that lists the names, InvalidFile for a broken file."""
        look = cls.__new__(cls)
        look._lens = None
        look._handle = made(_declared.petzval_look, "petzval_look_from_preset", name.encode())
        return look

    def to_json(self) -> str:
        """Every field, as JSON."""
        text = ctypes.c_char_p()
        call("petzval_look_json", self._handle, ctypes.byref(text))
        return (text.value or b"").decode()

    @property
    def lens(self) -> Lens | None:
        """The opened lens that frames use. None: frames open `look["lens.name"]` themselves."""
        return self._lens

    @lens.setter
    def lens(self, lens: Lens | str) -> None:
        opened = lens if isinstance(lens, Lens) else Lens(lens)
        call("petzval_look_set_lens", self._handle, opened._handle)
        self._lens = opened

    def __setitem__(self, field: str, value) -> None:
        """Sets one field, as look["lens.blades"] = 5. The look is unchanged if the value is refused."""
        text = value if isinstance(value, str) else json.dumps(value)
        call("petzval_look_set", self._handle, field.encode(), text.encode())
        if field == "lens.name":
            self._lens = None if self._lens is None or self._lens.name != value else self._lens

    def __getitem__(self, field: str):
        """The value of one field. Raises KeyError for unknown fields."""
        value = json.loads(self.to_json())
        for part in field.split("."):
            try:
                value = value[part]
            except (KeyError, TypeError):
                raise KeyError(field) from None
        return value

    def __del__(self) -> None:
        handle = getattr(self, "_handle", None)
        if handle:
            library().petzval_look_close(handle)

    def __repr__(self) -> str:
        return f"petzval.Look(engine={self['engine']!r}, lens={self['lens.name']!r})"


def preset_names() -> list[str]:
    """Names for Look.preset: your own NAME.json in $PETZVAL_PRESETS or ~/.config/petzval/presets, then those that ship."""
    return names("petzval_preset_name")


def as_look(given: Look | str | dict | None) -> Look:
    """A look, its JSON, or a dictionary of its fields; None: the defaults."""
    if given is None:
        return Look()
    if isinstance(given, Look):
        return given
    if isinstance(given, dict):
        return Look(**given)
    if isinstance(given, str):
        return Look.from_json(given)
    raise errors.InvalidArgument(f"look is {type(given).__name__}; a Look, its JSON or its fields are needed")
