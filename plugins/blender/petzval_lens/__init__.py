# SPDX-License-Identifier: GPL-3.0-or-later
"""Depth of field of a real lens for Blender's renders, made by petzval."""
bl_info = {
    "name": "petzval lens",
    "description": "Gives renders the depth of field of a real lens",
    "author": "the petzval authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > petzval lens",
    "category": "Render",
    "support": "COMMUNITY",
}

import importlib  # noqa: E402: Blender reads bl_info first

PARTS = ("settings", "operators", "panel", "view_program")  # the last is not in the extension


def _parts():
    for name in PARTS:
        try:
            yield importlib.import_module(f"{__package__}.{name}")
        except ModuleNotFoundError as missing:
            if missing.name != f"{__package__}.view_program":
                raise


def register():
    for part in _parts():
        part.register()


def unregister():
    for part in reversed(list(_parts())):
        part.unregister()
