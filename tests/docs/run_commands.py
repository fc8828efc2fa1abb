"""Runs what the documents tell people to type: every block marked ```sh in README.md and docs/, one page at a time.

Usage: run_commands.py PROGRAM [PAGE…]. Each page gets an empty folder, a `petzval` on its PATH, a `./dev run` that
is the same program, `shot.exr`, a small rendered picture with depth, and `beauty.exr`, the same without camera numbers, as
most files of readers are. Blocks that need a GPU are skipped, with a message, if there is none. Blocks marked ```text are not run; `./dev demo` and `./dev test` have their own tests.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
from pictures import read_exr, write_exr  # noqa: E402

BLOCK = re.compile(r"^```sh\n(.*?)^```", re.DOTALL | re.MULTILINE)
DEV = '#!/bin/sh\n[ "$1" = run ] || exit 0\nshift\nexec petzval "$@"\n'


def place(folder, program):
    """What a page may count on; the environment to run it in."""
    (folder / "bin").mkdir()
    (folder / "bin/petzval").symlink_to(program)
    (folder / "dev").write_text(DEV)
    (folder / "dev").chmod(0o755)
    subprocess.run([program, "scene", "make", "table", "-o", folder / "shot.exr", "--width", "160", "--height", "90",
                    "-q"], check=True)
    channels, _ = read_exr(folder / "shot.exr")
    write_exr(folder / "beauty.exr", channels)
    return {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}


def has_gpu(program):
    listed = subprocess.run([program, "devices", "--json", "-"], stdout=subprocess.PIPE, check=True).stdout
    return any(device["name"] != "cpu" and not device["lacks"] for device in json.loads(listed)["devices"])


def failures(page, program):
    blocks = BLOCK.findall(page.read_text())
    if not blocks:
        return
    with tempfile.TemporaryDirectory() as name:
        environment = place(pathlib.Path(name), program)
        for block in blocks:
            if "--device gpu" in block and not has_gpu(program):
                print(f"{page.relative_to(ROOT)}: skipped, there is no GPU")
                continue
            result = subprocess.run(["sh", "-eu", "-c", block], cwd=name, env=environment, text=True,
                                    stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if result.returncode:
                yield f"{page.relative_to(ROOT)}: status {result.returncode}\n{block}{result.stdout}"


def main(program, *pages):
    pages = [pathlib.Path(p).resolve() for p in pages] or [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    found = [failure for page in pages for failure in failures(page, pathlib.Path(program).resolve())]
    print("\n".join(found) or f"docs: every command of {len(pages)} pages ran")
    sys.exit(bool(found))


if __name__ == "__main__":
    main(*sys.argv[1:])
