"""The add-on as a user installs it: the zip that fits this Blender, installed and enabled; or Debian's package."""
import importlib
import sys

import bpy


def zips():
    """Paths of the extension and of the add-on, from the words after `--`; "packaged" twice for Debian's package."""
    extension, addon = sys.argv[sys.argv.index("--") + 1:][:2]
    return extension, addon


def package():
    """Name of the enabled package. Blender 4.2 and later take the extension."""
    extension, addon = zips()
    if bpy.app.version >= (4, 2, 0):
        bpy.ops.extensions.package_install_files(filepath=extension, repo="user_default", enable_on_install=True)
        return "bl_ext.user_default.petzval_lens"
    if addon != "packaged":
        bpy.ops.preferences.addon_install(filepath=addon)
    bpy.ops.preferences.addon_enable(module="petzval_lens")
    return "petzval_lens"


NAME = package()


def part(name):
    """A module of the add-on."""
    return importlib.import_module(f"{NAME}.{name}")
