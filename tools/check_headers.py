"""Every public header compiles alone as C++20, without a warning, with each compiler that is installed.

Usage: check_headers.py [repository root]. The only include path is include/, as it is for those who install us.
"""
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys

COMPILERS = ["g++", "clang++"]
FLAGS = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]


def compiles(compiler, root, header):
    # Twice: the second inclusion must be empty.
    line = f'#include "{header.relative_to(root / "include").as_posix()}"\n'
    command = [compiler, *FLAGS, "-I", str(root / "include"), "-x", "c++", "-"]
    result = subprocess.run(command, input=line * 2, text=True, stderr=subprocess.PIPE)
    sys.stderr.write(result.stderr)
    return result.returncode == 0


def main(root):
    compilers = [c for c in COMPILERS if shutil.which(c)]
    headers = sorted((root / "include").rglob("*.h"))
    if not compilers or not headers:
        sys.exit("headers: no compiler or no header found")
    pairs = [(c, h) for c in compilers for h in headers]
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        fine = pool.map(lambda pair: compiles(pair[0], root, pair[1]), pairs)
    failed = [f"{h.name} ({c})" for (c, h), ok in zip(pairs, fine) if not ok]
    print(f"headers: not alone: {', '.join(failed)}" if failed
          else f"headers: ok ({len(headers)} with {', '.join(compilers)})")
    sys.exit(bool(failed))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve())
