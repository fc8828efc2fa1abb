"""Fails if libpetzval.so no longer fits programs that were built against it: its C door beside the stored description.

Usage: check_abi.py BUILD_FOLDER [--accept]. --accept stores the description of what was built; the commit says why, and
the soname changes with it if old programs break. Needs abidw and abidiff (Debian: abigail-tools).
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
STORED = ROOT / "src/c/petzval_c.abi.xml"
# What belongs to this machine and not to the door.
DESCRIBE = ["abidw", "--exported-interfaces-only", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs",
            "--no-elf-needed", "--no-architecture",
            "--drop-private-types", "--headers-dir", ROOT / "include/petzval"]


def describe(library, path):
    subprocess.run([*DESCRIBE, "--out-file", path, library], check=True)
    path.write_text(re.sub(r"path='[^']*?(?=src/c/)", "path='", path.read_text()))  # however the build names sources


def main(build, *words):
    library = pathlib.Path(build) / "lib/libpetzval.so"
    if words == ("--accept",):
        describe(library, STORED)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        now = pathlib.Path(folder) / "now.abi.xml"
        describe(library, now)
        # abidiff's status: 1 it failed, 2 misused, 4 something differs, 8 it breaks programs.
        status = subprocess.run(["abidiff", "--no-architecture", STORED, now]).returncode
    if status & 8:
        print("abi: programs that were built against libpetzval.so would break")
    elif status & 4:
        print("abi: the C door is no longer what is stored; if the above is meant, tools/check_abi.py build/release --accept")
    elif not status:
        print("abi: ok")
    return status != 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
