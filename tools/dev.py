"""What ./dev does once the machine has what it needs. Each verb is one function; its docstring is its help."""
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["include", "src", "apps", "plugins", "tests", "bench"]
JOBS = str(len(os.sched_getaffinity(0)))


def fail(message, status=2):
    sys.exit(print(f"dev: {message}", file=sys.stderr) or status)


def run(*command, **options):
    """Says what it runs, runs it at the root of the repository, stops with its exit status if it fails."""
    print("+ " + shlex.join(map(str, command)), file=sys.stderr, flush=True)
    status = subprocess.run(command, cwd=ROOT, **options).returncode
    if status:
        sys.exit(status)


def quietly(*command):
    """Runs; on a terminal everything shows, elsewhere only the output of what fails."""
    if sys.stderr.isatty():
        return run(*command, stdout=sys.stderr)
    print("+ " + shlex.join(map(str, command)), file=sys.stderr, flush=True)
    result = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode:
        sys.stderr.write(result.stdout)
        sys.exit(result.returncode)


def folder_of(preset):
    return ROOT / "build" / preset


def make(preset, *targets):
    """Configures once (ninja repeats it when a CMake file changes), then builds."""
    if not (folder_of(preset) / "build.ninja").exists():
        quietly("cmake", "--preset", preset)
    quietly("cmake", "--build", f"build/{preset}", *[word for t in targets for word in ("--target", t)])


def take_preset(words):
    """Removes `--preset NAME` from the words; the preset and what is left."""
    if words[:1] != ["--preset"]:
        return "release", words
    return (words[1], words[2:]) if len(words) > 1 else fail("--preset needs a name, see CMakePresets.json")


def program(preset="release"):
    return folder_of(preset) / "apps/cli/petzval"


def sources(*suffixes):
    return sorted(p for folder in FOLDERS for s in suffixes for p in (ROOT / folder).rglob("*" + s))


def demo(*_):
    """the night scene through a doublet: leaves build/demo/night_defocused.png and prints its path"""
    make("release", "petzval_cli")
    out = ROOT / "build/demo"
    out.mkdir(parents=True, exist_ok=True)
    sharp, behind, taken, shown = (out / name for name in ("night.exr", "night_behind.exr", "night_defocused.exr",
                                                           "night_defocused.png"))
    run(program(), "scene", "make", "night", "-o", sharp, "--layers", behind, "--overscan", "60")
    run(program(), "defocus", sharp, "-o", taken, "--behind", behind, "--lens", "doublet")
    run(program(), "develop", taken, "-o", shown, "--exposure", "0.8")
    print(shown)


def build(*words):
    """[preset] [target…]: configures and builds (presets: release, debug, clang, asan, tsan, scalar, plain, core, no-tbb, portable, fuzz)"""
    make(*[word for word in words if word != "--preset"] or ["release"])


def test(*words):
    """[--preset P] [regex]: builds and runs every test, or those whose name matches"""
    preset, words = take_preset(list(words))
    make(preset)
    command = ["ctest", "--test-dir", f"build/{preset}", "-j", JOBS, "--output-on-failure"]
    if words:
        command += ["--no-tests=error", "-R", words[0], *words[1:]]
    print("+ " + shlex.join(command), file=sys.stderr, flush=True)
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, errors="replace") as ctest:
        for line in ctest.stdout:  # what passed is counted in the summary
            if not (" Passed " in line or line.lstrip().startswith(("Start ", "Internal ctest", "Test project"))):
                print(line, end="", flush=True)
    say_skipped(folder_of(preset) / "Testing/Temporary/LastTest.log")
    sys.exit(ctest.returncode)


def say_skipped(log):
    """Ends the run with every test that was skipped and its reason, one line per reason."""
    tests_of = {}
    for test, reason in skipped_tests(log.read_text(errors="replace")):
        tests_of.setdefault(reason, []).append(test)
    for reason, tests in tests_of.items():
        print(f"skipped: {reason}: {', '.join(tests)}", flush=True)


def skipped_tests(log):
    """(test, reason) of each skipped test in ctest's log. Of a Python file that passes, ctest itself counts no skips."""
    for output in re.split(r"^\d+/\d+ Testing: ", log, flags=re.M)[1:]:
        for name, reason in re.findall(r"^(test_\w+) .*\.\.\. skipped ['\"](.*)['\"]$", output, re.M):
            yield name, reason
        if "[  SKIPPED ]" in output:
            reason = re.search(r"^.*: Skipped\n(.*)$", output, re.M)
            yield output.split("\n", 1)[0], reason[1] if reason else "no reason given"


def path(*_):
    """prints where the program is (and builds it first if it is not there)"""
    if not program().exists():
        make("release", "petzval_cli")
    print(program())


def run_program(*words):
    """ARGS…: builds what changed, then runs petzval with these arguments"""
    if not (folder_of("release") / "build.ninja").exists():
        make("release", "petzval_cli")
    else:
        built = subprocess.run(["cmake", "--build", "build/release", "--target", "petzval_cli"], cwd=ROOT,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if built.returncode:
            sys.stderr.write(built.stdout)
            sys.exit(built.returncode)
    os.execv(program(), ["petzval", *words])


def bench(*words):
    """NAME [ARGS…]: runs bench/NAME.py, e.g. `bench quality`; without a name, lists them"""
    known = sorted(p.stem for p in (ROOT / "bench").glob("*.py") if not p.stem.startswith("_"))
    if not words or words[0] not in known:
        fail(f"bench needs one of: {', '.join(known)}")
    make("release", "petzval_cli", "petzval_bench")
    run(sys.executable, f"bench/{words[0]}.py", *words[1:], 
        env={**os.environ, "PETZVAL": str(program()), "PETZVAL_KERNEL_CACHE": "off"})


def format_sources(*words):
    """[--check]: clang-format over every source file"""
    how = ["--dry-run", "-Werror"] if words[:1] == ("--check",) else ["-i"]
    files = sources(".h", ".cpp")
    print(f"+ clang-format {' '.join(how)} ({len(files)} files)", file=sys.stderr)
    sys.exit(subprocess.run(["clang-format", *how, *files]).returncode)


def lint(*words):
    """[--all | FILE…]: clang-tidy on what changed since main (on main: in the last commit), or on everything"""
    if not (folder_of("release") / "build.ninja").exists():
        quietly("cmake", "--preset", "release")
    run(sys.executable, "tools/lint.py", "build/release", *words)


def check(*_):
    """formatting, layers, sizes, density, prose, headers that compile alone, the C interface, clang-tidy on changed files"""
    make("release", "petzval_shared", "petzval_bench")
    failed = []
    for command in (["./dev", "format", "--check"], [sys.executable, "tools/check_layers.py"],
                    [sys.executable, "tools/check_sizes.py"], [sys.executable, "tools/check_density.py"], [sys.executable, "tools/check_prose.py"], [sys.executable, "tools/check_headers.py"],
                    [sys.executable, "tools/check_abi.py", "build/release"],
                    ["./dev", "lint"]):
        start = time.monotonic()
        print("+ " + shlex.join(command), file=sys.stderr, flush=True)
        status = subprocess.run(command, cwd=ROOT).returncode
        print(f"  {'ok' if status == 0 else 'FAILED'} after {time.monotonic() - start:.1f} s", file=sys.stderr)
        failed += [shlex.join(command)] if status else []
    if failed:
        fail("check failed: " + "; ".join(failed), 1)
    print("check: ok")


def golden(*words):
    """run | accept: small pictures beside stored ones and the truth; accept stores the new ones"""
    if words[:1] not in (("run",), ("accept",)):
        fail("golden needs run or accept")
    make("release")
    run(sys.executable, "tests/golden/golden.py", words[0], program())


def validate_lenses(*words):
    """[FILE]: every published number of every lens beside ours; FILE: of a lens file, or a list {"lenses": […]}"""
    make("release", "petzval_validate_lenses")
    found = [p for p in folder_of("release").rglob("petzval_validate_lenses") if p.is_file()]
    run(found[0], *words)


def gpu_laws(*words):
    """[--driver D] [--layer L] [SUITES]: every test that draws on a GPU, on each driver, under a validation layer"""
    make("release")
    run(sys.executable, "tools/gpu_laws.py", *words)


def samples(*words):
    """[--docs]: the night through many lenses, in build/samples; --docs: small, into docs/pictures/samples"""
    if words not in ((), ("--docs",)):
        fail("samples takes --docs or nothing")
    make("release", "petzval_cli")
    run(sys.executable, "tools/sample_set.py", program(), "docs/pictures/samples" if words else "build/samples", *words)


def web(*words):
    """[--serve]: builds the lens lab into build/web; --serve: then serves it on this machine"""
    make("release", "petzval_cli", "petzval_validate_lenses")
    run(sys.executable, "tools/web.py", program(), *words)


def web_test(*words):
    """[--short] [ARGS…]: builds the lens lab and tests it in a headless Chromium; --short: only the lab's own page; ARGS go to unittest"""
    short = words[:1] == ("--short",)
    make("release", "petzval_cli", *(() if short else ("petzval_validate_lenses", "petzval_shared", "petzval_ofx", "ofx_check")))
    run(sys.executable, "tools/web.py", program(), *words[:short])
    tests = [ROOT / "tests/web/lab_test.py", ROOT / "tests/web/screens_test.py"] if short else sorted(ROOT.glob("tests/web/*_test.py"))
    for test in tests:
        run("/usr/bin/python3", test, program(), *words[short:])  # Debian's: selenium is its package


def kit(*words):
    """[FOLDER]: the real-time pass's programs as GLSL, SPIR-V, HLSL, MSL and WGSL, each compiled, and a lens, in build/kit"""
    make("release", "petzval_cli")
    run(sys.executable, "tools/kit.py", *words, "--petzval", program())


def farm_test(*words):
    """[ARGS…]: jobs for render farms, run by openjd-cli and by a Slurm cluster on this machine; ARGS go to unittest"""
    make("release", "petzval_cli")
    with tempfile.TemporaryDirectory(prefix="petzval-farm-") as folder:
        run(sys.executable, "-m", "venv", folder)
        run(f"{folder}/bin/pip", "-q", "install", "openjd-cli==0.8.0")
        for test in sorted(ROOT.glob("tests/farm/*_test.py")):
            run(sys.executable, "-B", test, "-v", *words,
                env={**os.environ, "PETZVAL": str(program()), "OPENJD": f"{folder}/bin/openjd"})


def fuzz(*words):
    """[CORPUS…] [--seconds N]: readers under libFuzzer, 120 s each; counts go to docs/results/fuzz.md"""
    make("fuzz", "fuzzers")
    run(sys.executable, "tools/fuzz.py", "build/fuzz/tests/fuzz", *words)


def wheel(*_):
    """the Python package for any Python 3: builds the preset portable, leaves build/wheel/petzval-…-linux_x86_64.whl"""
    make("portable", "petzval_shared")
    run(sys.executable, "tools/wheel.py", "build/wheel", "build/portable/lib/libpetzval.so")


def blender_addon(*_):
    """the add-on for Blender: leaves an extension and a self-hosted add-on, each a zip, in build/blender"""
    wheel()
    run(sys.executable, "tools/blender_addon.py", "build/blender", *sorted((ROOT / "build/wheel").glob("*.whl"))[-1:])


def blender_test(*words):
    """[debian | VERSION…]: the add-on in Debian's Blender and in modules bpy of Python's package index (1 GB each)"""
    blender_addon()
    made = [sorted((ROOT / "build/blender").glob(f"*-{kind}.zip"))[-1] for kind in ("extension", "addon")]
    run(sys.executable, "tools/blender_test.py", *made, *words)


def ofx(*_):
    """the OpenFX plug-in: leaves build/ofx/petzval.ofx.bundle and checks it with ofx-check"""
    make("release", "petzval_ofx", "ofx_check")
    library = "Contents/Linux-x86-64/petzval.ofx"
    made, left = (ROOT / f"{folder}/ofx/petzval.ofx.bundle" / library for folder in ("build/release", "build"))
    left.parent.mkdir(parents=True, exist_ok=True)
    run("strip", "-o", left, made)
    run(folder_of("release") / "apps/ofx-check/ofx-check", left.parents[2], "--param", "focalLength=200")
    print(left.parents[2])


def packages(*_):
    """Debian packages in build/packages, with their lists of files and what lintian says of them"""
    run(sys.executable, "tools/packages.py", "build/packages")


def tarball(*_):
    """program, window, libraries and OpenFX plug-in for any folder of Debian 12 or later, in build/packages"""
    make("release")
    run(sys.executable, "tools/tarball.py", "build/packages", "build/release")


def packages_test(*words):
    """[--without-blender]: builds packages twice and compares bits; uses packages and tarball in a bare Debian 12 (root)"""
    packages()
    run(sys.executable, "tools/packages.py", "build/packages", "--again")
    tarball()
    run(sys.executable, "tools/packages_test.py", "build/packages", *words)


def site(*words):
    """[--no-gallery] [--test]: static pages of docs/ with a gallery of every lens, in build/site; tested in Chromium"""
    make("release", "petzval_cli")
    run(sys.executable, "tools/site_pages.py", program(), *(word for word in words if word != "--test"))
    if "--test" in words:
        run("/usr/bin/python3", "tests/site/site_test.py", "build/site")  # Debian's: selenium is its package


VERBS = {"demo": demo, "build": build, "test": test, "path": path, "run": run_program, "bench": bench,
         "format": format_sources, "lint": lint, "check": check, "golden": golden,
         "validate-lenses": validate_lenses, "gpu-laws": gpu_laws, "samples": samples, "site": site, "web": web,
         "web-test": web_test, "kit": kit, "wheel": wheel, "farm-test": farm_test, "fuzz": fuzz, "ofx": ofx,
         "packages": packages, "tarball": tarball, "packages-test": packages_test,
         "blender-addon": blender_addon, "blender-test": blender_test}


def help_text():
    rows = "\n".join(f"  {verb:16}{function.__doc__}" for verb, function in VERBS.items())
    return f"usage: ./dev VERB [ARGS…]\n{rows}"


if __name__ == "__main__":
    verb, *rest = sys.argv[1:] or ["help"]
    if verb in ("help", "-h", "--help"):
        print(help_text())
    elif verb in VERBS:
        try:
            VERBS[verb](*rest)
        except KeyboardInterrupt:
            sys.exit(130)
    else:
        fail(f"unknown verb '{verb}'\n{help_text()}")
