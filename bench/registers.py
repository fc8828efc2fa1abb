"""Registers and shared memory of every program of the device, as drivers' compilers make them: no GPU is needed.

Usage: ./dev bench registers [--families A,B]
Mesa's driver of AMD's GPUs (Debian: mesa-vulkan-drivers) compiles for any of its families without one, and says what
came of it; a device that is here and tells (VK_KHR_pipeline_executable_properties) is added. Nothing is run, no time is
measured. Markdown: vector registers of an invocation, those spilled to memory, bytes of shared memory of a group,
subgroups that fit on a SIMD unit (the driver's count), instructions.
"""
import argparse
import json
import os
import pathlib
import platform
import subprocess
import sys

PROGRAM = pathlib.Path(os.environ["PETZVAL"]).parents[2] / "bench/petzval_bench_registers"
AMD = pathlib.Path(f"/usr/share/vulkan/icd.d/radeon_icd.{platform.machine()}.json")
SHOWN = {"VGPRs": "registers", "Spilled VGPRs": "spilled", "LDS size": "shared bytes", "Subgroups per SIMD": "subgroups",
         "Instructions": "instructions"}


def said(**environment):
    """What the first device of this environment says, or None and why not."""
    result = subprocess.run([PROGRAM], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            env={**os.environ, **environment})
    if result.returncode:
        return None, result.stderr.strip().splitlines()[-1]
    return json.loads(result.stdout), None


def table(found):
    """Of drivers of other makers all that they say, of AMD's what is known to matter."""
    names = list(next(iter(found["programs"].values())))
    shown = {name: SHOWN[name] for name in SHOWN if name in names} or {name: name for name in names if "ash" not in name}
    rows = [["program", *shown.values()], ["---"] * (len(shown) + 1)]
    rows += [[program, *(f"{stats.get(name, 0):g}" for name in shown)] for program, stats in found["programs"].items()]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--families", type=lambda s: s.split(","), default=["vega10", "navi21", "gfx1100"],
                        help="as RADV_FORCE_FAMILY names them")
    given = parser.parse_args()
    if not AMD.exists():
        sys.exit(f"bench registers: {AMD} is not there (Debian: mesa-vulkan-drivers)")
    # The compiler's cache keeps no statistics of what it kept.
    without = [({"VK_ICD_FILENAMES": str(AMD), "RADV_FORCE_FAMILY": family, "MESA_SHADER_CACHE_DISABLE": "true"}, family)
               for family in given.families]
    for environment, name in [*without, ({}, "the device here")]:
        found, why = said(**environment)
        print(f"\n{name}: {why}" if why else f"\n{found['device']}\n\n{table(found)}", flush=True)


if __name__ == "__main__":
    main()
