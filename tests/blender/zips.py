"""Both zips of the add-on around any build of the library."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import blender_addon as packer  # noqa: E402
import wheel  # noqa: E402


def made(folder, library):
    """(extension, add-on) in the folder. Every library is packed, also one that a released wheel must not have."""
    refused, wheel.NOT_PACKED = wheel.NOT_PACKED, re.compile("^$")
    try:
        return packer.write_both(folder, wheel.write(folder, [library]))
    finally:
        wheel.NOT_PACKED = refused
