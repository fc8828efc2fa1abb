"""libpetzval.so exports what petzval_c.h declares, all of it, what vulkan.h does all or nothing, and nothing else.

Usage: symbols_test.py LIBPETZVAL.SO
"""
import pathlib
import re
import subprocess
import sys

HEADERS = pathlib.Path(__file__).resolve().parents[2] / "include/petzval"
WANTED = [HEADERS / "petzval_c.h", HEADERS / "petzval_lens_c.h"]


def declared(header):
    return set(re.findall(r"^PETZVAL_C_API [^(]*?\b(petzval_\w+)\(", header.read_text(), re.MULTILINE))


def exported(library):
    listing = subprocess.run(["nm", "-D", "--defined-only", library], stdout=subprocess.PIPE, text=True, check=True)
    names = {line.split()[-1].split("@")[0] for line in listing.stdout.splitlines()}
    return {name for name in names if not re.fullmatch(r"PETZVAL_\d+", name)}  # the version itself


def main(library):
    wanted, optional, found = set().union(*map(declared, WANTED)), declared(HEADERS / "vulkan.h"), exported(library)
    if optional & found:
        wanted |= optional
    for name in sorted(wanted - found):
        print(f"{name} is declared and not exported")
    for name in sorted(found - wanted):
        print(f"{name} is exported and not declared")
    if len(wanted) < 10:
        print(f"only {len(wanted)} functions found in {WANTED[0].name}: is it still read right?")
    return wanted != found or len(wanted) < 10


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
