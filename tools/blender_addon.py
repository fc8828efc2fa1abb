#!/usr/bin/env python3
"""Packs the add-on for Blender into two zips from one source.

Usage: tools/blender_addon.py FOLDER WHEEL

FOLDER/petzval_lens-VERSION-extension.zip    for Blender 4.2 and later: a manifest, the wheel inside, no other program
FOLDER/petzval_lens-VERSION-addon.zip        for Blender 3.4 and later: bl_info, the Python package unpacked inside
The bytes of a zip depend on its content alone.
"""
import pathlib
import re
import sys
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCES = ROOT / "plugins/blender"
NAME = "petzval_lens"
SELF_HOSTED_ALONE = {"view_program.py"}  # starts another program, which the extension platform does not allow


def version():
    return re.search(r'PETZVAL_VERSION "([\d.]+)"', (ROOT / "include/petzval/version.h").read_text())[1]


def sources():
    """{file name: bytes} of the add-on itself."""
    files = {p.name: p.read_bytes() for p in sorted((SOURCES / NAME).glob("*.py"))}
    return {**files, "LICENSE": (SOURCES / "LICENSE").read_bytes()}


def extension(wheel):
    """{path: bytes} of the extension."""
    files = {name: data for name, data in sources().items() if name not in SELF_HOSTED_ALONE}
    manifest = (SOURCES / NAME / "blender_manifest.toml").read_text()
    files["blender_manifest.toml"] = manifest.replace("wheels/WHEEL", f"wheels/{wheel.name}").encode()
    files[f"wheels/{wheel.name}"] = wheel.read_bytes()
    return files


def addon(wheel):
    """{path: bytes} of the self-hosted add-on, in a folder of its own as Blender asks for it."""
    files = {f"{NAME}/{name}": data for name, data in sources().items()}
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            if name.startswith("petzval/") and not name.endswith(".pyi"):
                files[f"{NAME}/{name}"] = archive.read(name)
            elif "/licenses/" in name:
                files[f"{NAME}/petzval/licenses/{pathlib.PurePath(name).name}"] = archive.read(name)
    return files


def write(path, files):
    path.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in sorted(files.items()):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return path


def write_both(folder, wheel):
    """The paths of both zips."""
    base = f"{NAME}-{version()}"
    return (write(pathlib.Path(folder) / f"{base}-extension.zip", extension(wheel)),
            write(pathlib.Path(folder) / f"{base}-addon.zip", addon(wheel)))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    for made in write_both(sys.argv[1], pathlib.Path(sys.argv[2])):
        print(made)
