#!/usr/bin/env python3
"""Tests the add-on for Blender in each Blender of this machine.

Usage: tools/blender_test.py EXTENSION.zip ADDON.zip [VERSION…]

Debian's blender runs if it is installed. The modules bpy come from Python's package index, one environment a version,
in $PETZVAL_BPY or ~/.cache/petzval/bpy: about 1 GB each. VERSION: "debian" or versions of bpy; none: all.
Every host that cannot run is named with its reason.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent.parent / "tests/blender"
VERSIONS = ("4.2.23", "4.5.15", "5.0.1")  # of bpy for Python 3.11; later ones need Python 3.13
KEPT = pathlib.Path(os.environ.get("PETZVAL_BPY", pathlib.Path.home() / ".cache/petzval/bpy"))


class Missing(Exception):
    """A host that this machine cannot run."""


def debian():
    """The command that runs a script in the installed Blender."""
    program = shutil.which("blender")
    if not program:
        raise Missing("blender is not installed (tools/packages_blender.txt)")
    return [program, "-b", "--factory-startup", "--python-exit-code", "3", "--python"]


def module(version):
    """The command that runs a script beside a bpy of that version."""
    python = KEPT / version / "bin/python"
    if not (KEPT / version / "ready").exists():
        if sys.version_info[:2] != (3, 11):
            raise Missing("needs Python 3.11")
        print(f"installing bpy {version} into {KEPT / version}", file=sys.stderr, flush=True)
        for command in ([sys.executable, "-m", "venv", "--clear", KEPT / version],
                        [python, "-m", "pip", "-q", "install", f"bpy=={version}"]):
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            if done.returncode:
                raise Missing("cannot be installed: " + (done.stdout.strip().splitlines() or ["no reason given"])[-1])
        (KEPT / version / "ready").touch()
    return [python]


def run(command, script, zips):
    """Exit status of a script in a Blender whose user folders are private."""
    with tempfile.TemporaryDirectory(prefix="petzval-blender-") as folder:
        for name in ("resources", "scripts"):
            os.mkdir(f"{folder}/{name}")
        private = {"BLENDER_USER_RESOURCES": f"{folder}/resources", "BLENDER_USER_SCRIPTS": f"{folder}/scripts"}
        # Debian's Blender takes its Python from the PATH: another python3 there has no numpy.
        environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PETZVAL_LIBRARY")}
        environment["PATH"] = "/usr/bin:/bin"
        return subprocess.run([*command, script, "--", *zips], env={**environment, **private},
                              timeout=900).returncode


def main(extension, addon, *wanted):
    failed, skipped = [], []
    for host in wanted or ("debian", *VERSIONS):
        try:
            command = debian() if host == "debian" else module(host)
        except Missing as why:
            skipped.append(f"skipped: {host}: {why}")
            continue
        for script in sorted(HERE.glob("in_blender_*.py")):
            print(f"+ {script.name} in {host}", file=sys.stderr, flush=True)
            if run(command, script, [os.path.abspath(extension), os.path.abspath(addon)]):
                failed.append(f"failed: {host}: {script.name}")
    print("\n".join([*skipped, *failed]) or "blender-test: ok")
    return 1 if failed else 77 if skipped and len(skipped) == len(wanted or ("debian", *VERSIONS)) else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
