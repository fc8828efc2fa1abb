"""clang-tidy on the sources that changed, on all, or on those that are named.

Usage: lint.py BUILD_FOLDER [--all | FILE…]. "Changed" is since the branch left main; on main, in the last
commit; what is not committed counts. A changed header is seen through one source that includes it.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def git(*words):
    result = subprocess.run(["git", *words], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return result.stdout.split() if result.returncode == 0 else []


def changed():
    """Paths that differ from where the work began; None where there is no history to ask."""
    head = git("rev-parse", "HEAD")
    if not head:
        return None
    base = git("merge-base", "HEAD", "main") or git("merge-base", "HEAD", "origin/main")
    if not base or base == head:
        base = git("rev-parse", "HEAD~1")
    if not base:
        return None
    return git("diff", "--name-only", *base) + git("ls-files", "--others", "--exclude-standard")


def sources_for(paths, compiled):
    """The compiled sources among the paths, and one that includes each header among them."""
    chosen = set()
    for path in paths:
        if path in compiled:
            chosen.add(path)
        elif path.endswith(".h"):
            include = re.compile(rf'#include "{re.escape(re.sub("^(include|src)/", "", path))}"')
            users = sorted(s for s in compiled if include.search((ROOT / s).read_text()))
            same = [s for s in users if pathlib.Path(s).stem == pathlib.Path(path).stem]
            chosen.update((same or users)[:1])
    return sorted(chosen)


# What a kind of file is spared, beyond .clang-tidy.
SPARED = {
    # The static analyser spends most of its time inside gtest; the sanitizers watch the tests instead. Only a
    # macro can skip the test that uses it.
    "_test.cpp": "-clang-analyzer-*,-cppcoreguidelines-macro-usage",
    # Tests of the C API compare the bits of pictures.
    "_test.c": "-bugprone-suspicious-memory-comparison",
    # Names and macros as Highway has them.
    "_simd.cpp": "-readability-identifier-naming,-cppcoreguidelines-macro-usage",
}


def tidy(build, source):
    command = ["clang-tidy", "--quiet", "-p", build, source]
    command += [f"--checks={checks}" for ending, checks in SPARED.items() if source.endswith(ending)]
    # The build is GCC's, whose own warning flags clang does not know.
    command.append("--extra-arg=-Wno-unknown-warning-option")
    result = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return source, result.returncode, re.sub(r"^\d+ warnings.*\n", "", result.stdout, flags=re.MULTILINE)


def each_alone(entries):
    """Commands of the sources themselves where the build compiles several at once (cmake/petzval_batches.cmake)."""
    for entry in entries:
        if not re.search(r"/Unity/unity_\d+_cxx\.cxx$", entry["file"]):
            yield entry
            continue
        for source in re.findall(r'^#include "(.*)"', pathlib.Path(entry["file"]).read_text(), flags=re.MULTILINE):
            yield entry | {"file": source, "command": entry["command"].replace(f"-c {entry['file']}", f"-c {source}")}


def commands_of(build):
    """A folder with the commands of the build that clang takes: GCC's precompiled headers and parameters are not its own."""
    text = (ROOT / build / "compile_commands.json").read_text()
    text = re.sub(r" -Winvalid-pch| -fpch-preprocess| --param \S+|( -Xclang)? -include(-pch)?( -Xclang)? \S*cmake_pch\S*", "", text)
    entries = list(each_alone(json.loads(text)))
    (ROOT / build / "lint").mkdir(exist_ok=True)
    (ROOT / build / "lint" / "compile_commands.json").write_text(json.dumps(entries, indent=1))
    return f"{build}/lint", entries


def main(build, words):
    build, entries = commands_of(build)
    compiled = {os.path.relpath(e["file"], ROOT) for e in entries}
    compiled = {c for c in compiled if not c.startswith(("..", "build"))}
    paths = sorted(compiled) if words == ["--all"] else words or changed()
    if paths is None:
        return print("lint: no history here that tells what changed; ./dev lint --all looks at everything")
    sources = sources_for(paths, compiled)
    failed = []
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for source, status, output in pool.map(lambda s: tidy(build, s), sources):
            if status:
                failed.append(source)
                print(output, end="", flush=True)
    print(f"lint: {len(failed)} of {len(sources)} sources have findings" if failed else
          f"lint: ok ({len(sources)} sources)")
    sys.exit(bool(failed))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
