"""Makes build/torch: a virtual environment with torch and numpy from Python's package index, for torch_test.py.

Downloads about 3 GB. Nothing else needs it; the test is skipped where it is missing.
"""
import pathlib
import subprocess
import sys
import venv

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    folder = ROOT / "build/torch"
    venv.create(folder, with_pip=True)
    return subprocess.run([folder / "bin/pip", "install", "--quiet", "torch", "numpy"], cwd=ROOT).returncode


if __name__ == "__main__":
    sys.exit(main())
