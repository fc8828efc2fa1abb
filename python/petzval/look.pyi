# Written by tools/python_stubs.py; not edited.
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

    def __init__(self, *, lens: Lens | str | None=None, **fields) -> None:
        ...

    @classmethod
    def from_json(cls, text: str) -> Look:
        """A look as Look.to_json and `petzval defocus --save-look` write it, or a link of the lens lab. Raises InvalidFile."""

    @classmethod
    def preset(cls, name: str) -> Look:
        """A look by name: one of preset_names(). Raises InvalidArgument that lists the names, InvalidFile for a broken file."""

    def to_json(self) -> str:
        """Every field, as JSON."""

    @property
    def lens(self) -> Lens | None:
        """The opened lens that frames use. None: frames open `look["lens.name"]` themselves."""

    @lens.setter
    def lens(self, lens: Lens | str) -> None:
        ...

    def __setitem__(self, field: str, value) -> None:
        """Sets one field, as look["lens.blades"] = 5. The look is unchanged if the value is refused."""

    def __getitem__(self, field: str):
        """The value of one field. Raises KeyError for unknown fields."""

    def __repr__(self) -> str:
        ...

def preset_names() -> list[str]:
    """Names for Look.preset: your own NAME.json in $PETZVAL_PRESETS or ~/.config/petzval/presets, then those that ship."""

def as_look(given: Look | str | dict | None) -> Look:
    """A look, its JSON, or a dictionary of its fields; None: the defaults."""
