"""Every test that draws on a GPU, suite by suite, under a validation layer; `./dev gpu-laws` runs it (docs/reference/devices.md)."""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
CONFORMANCE = "tests/conformance/test_conformance"
DRIVERS = {"lavapipe": f"/usr/share/vulkan/icd.d/lvp_icd.{os.uname().machine}.json",
           "swiftshader": os.environ.get("PETZVAL_SWIFTSHADER", "/usr/lib/chromium/vk_swiftshader_icd.json")}
NEWER = pathlib.Path("/usr/lib/chromium/libVkLayer_khronos_validation.so")
FOLDER_OF_NEWER = str(ROOT / "tests/newer_layer")
LAYERS = {"newer": {"PETZVAL_VULKAN_VALIDATION": "1", "VK_ADD_LAYER_PATH": FOLDER_OF_NEWER,
                    "VK_LAYER_SETTINGS_PATH": FOLDER_OF_NEWER},
          "system": {"PETZVAL_VULKAN_VALIDATION": "1"}, "none": {}}
# They ask for the layer themselves, because the instance is the host's.
WITH_A_HOST = ("example.EmbedVulkan", "example.SceneOfSprites", "example.InstancedSprites", "c.EmbeddedPass")


def suites_of_devices():
    """Suites that walk the GPUs there are, by whatever tests are asked for."""
    for source in sorted((ROOT / "tests/conformance").glob("*.cpp")):
        text = source.read_text()
        if "gpus()" in text or "devices()" in text:
            yield from re.findall(r"^TEST(?:_F)?\((\w+),", text, re.M)


def suites(program, environment):
    """(suite, filter, number of tests) of what draws on a GPU."""
    listed = subprocess.run([program, "--gtest_list_tests"], env=environment, stdout=subprocess.PIPE, text=True, check=True)
    walking = set(suites_of_devices())
    tests = {}
    for line in listed.stdout.splitlines():
        if re.match(r"\S+\.$", line.split("#")[0].strip()) and not line.startswith(" "):
            suite = line.split("#")[0].strip()[:-1]
        elif line.startswith("  "):
            tests.setdefault(suite, []).append(line.split("#")[0].strip())
    for suite, names in tests.items():
        if not program.match("*/" + CONFORMANCE) or suite in walking:
            yield suite, f"{suite}.*", len(names)
        elif found := [name for name in names if "gpu_" in name]:
            yield suite, f"{suite}.*gpu_*", len(found)


def commands(folder, environment, only):
    """(name, command, number of tests)"""
    for name in ("test_device_vulkan", CONFORMANCE):
        for suite, chosen, count in suites(folder / name, environment):
            if re.search(only, suite):
                yield suite, [folder / name, f"--gtest_filter={chosen}"], count
    for name in WITH_A_HOST:
        if re.search(only, name):
            yield name, ["ctest", "--test-dir", folder, "--output-on-failure", "--no-tests=error", "-R", f"^{re.escape(name)}$"], 1


def run_all(folder, driver, layer, only):
    """Counts of tests, of those skipped, and the suites that failed."""
    environment = {**os.environ, "PETZVAL_TEST_DEVICES": "gpu", "VK_ICD_FILENAMES": DRIVERS.get(driver, driver),
                   **LAYERS[layer]}
    tests, skipped, failed = 0, 0, []
    for suite, command, count in commands(folder, environment, only):
        start = time.monotonic()
        done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace")
        left_out = len(re.findall(r"^\[  SKIPPED \] .* \(\d+ ms\)$|\*\*\*Skipped", done.stdout, re.M))
        tests, skipped = tests + count, skipped + left_out
        said = "ok" if done.returncode == 0 else f"FAILED ({done.returncode})"
        print(f"{driver:12} {layer:7} {suite:32} {count:4} tests {left_out:3} skipped "
              f"{time.monotonic() - start:8.1f} s  {said}", flush=True)
        if done.returncode:
            failed.append(suite)
            print(done.stdout[-4000:], flush=True)
    return tests, skipped, failed


def main():
    parser = argparse.ArgumentParser(prog="./dev gpu-laws", description=__doc__)
    parser.add_argument("--folder", default="build/release", help="what was built (%(default)s)")
    parser.add_argument("--driver", help="lavapipe, swiftshader or an ICD file; else each of the first two that is here")
    parser.add_argument("--layer", choices=LAYERS, help="chromium-common's, Debian's or none; else the newer that is here")
    parser.add_argument("suites", nargs="?", default="", help="a regular expression: suites that match it alone")
    asked = parser.parse_args()
    drivers = [asked.driver] if asked.driver else [name for name, file in DRIVERS.items() if os.path.exists(file)]
    layer = asked.layer or ("newer" if NEWER.exists() else "system")
    tests, skipped, failed = 0, 0, []
    for driver in drivers:
        more = run_all((ROOT / asked.folder).resolve(), driver, layer, asked.suites)
        tests, skipped = tests + more[0], skipped + more[1]
        failed += [f"{suite} on {driver}" for suite in more[2]]
    print(f"{tests} tests, {skipped} of them skipped; " + ("failed: " + ", ".join(failed) if failed else "all silent"))
    if not tests:
        sys.exit("gpu-laws: no test was run (is a Vulkan driver installed?)")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
