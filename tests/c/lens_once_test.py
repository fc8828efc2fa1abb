"""A lens file is opened once however many frames use it: strace counts.

Usage: lens_once_test.py LENS_FRAMES_PROGRAM LENS_FILE. Exits 77 (skipped) where strace is missing or may not trace.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def times_opened(program, lens, frames, how):
    """How often `program` opens `lens`, and what it prints."""
    with tempfile.TemporaryDirectory() as folder:
        log = pathlib.Path(folder) / "log"
        done = subprocess.run(["strace", "-f", "-e", "trace=open,openat", "-o", log, program, lens, str(frames), how],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=300)
        if "ptrace" in done.stderr:
            print(f"skipped: strace may not trace here: {done.stderr.splitlines()[0]}")
            sys.exit(SKIPPED)
        done.check_returncode()
        return log.read_text().count(f'"{lens}"'), done.stdout


def main(program, lens):
    if not shutil.which("strace"):
        print("skipped: strace is missing")
        return SKIPPED
    once, by_handle = times_opened(program, lens, 100, "handle")
    each, by_name = times_opened(program, lens, 3, "by-name")
    print(f"100 frames with a handle open the file {once} times; 3 frames by name {each} times")
    three, same = times_opened(program, lens, 3, "handle")
    return not (once == 1 and three == 1 and each >= 3 and same == by_name and by_handle)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
