"""Fails if a room includes a header of a room it may not know. The table IS the architecture.

Usage: check_layers.py [repository root]. Prints each violation as FILE:LINE; exit status 1 if there is any.
"""
import pathlib
import re
import sys

PIXELS = {"base", "image"}
LENS = PIXELS | {"colour", "optics", "lens_files", "depth", "kernel"}
ALLOWED = {
    "base": set(),
    "image": {"base"},
    "colour": PIXELS,
    "optics": PIXELS,
    "lens_files": PIXELS | {"optics"},
    "depth": PIXELS,
    "kernel": PIXELS | {"colour", "optics", "lens_files"},
    "engine": LENS,
    "glare": PIXELS | {"colour", "optics", "lens_files", "kernel"},
    "scene": PIXELS | {"optics"},
    "report": LENS | {"api", "files"},
    "files": PIXELS | {"colour", "optics", "depth"},
    "ocio": PIXELS,
    "api": LENS | {"engine", "glare"},
}
# The room that implements each public header: including it is knowing that room.
PUBLIC = {
    "export": "base", "result": "base", "version": "base", "image": "image", "deep": "image",
    "compare": "image", "light_point": "image", "camera": "optics", "lens": "optics", "depth": "depth", "develop": "colour",
    "dynamic_range": "colour", "lens_facts": "api", "lens_kernel": "api", "defocus": "engine",
    "engine_options": "engine", "glare": "glare", "files": "files", "lens_report": "report", "ocio": "ocio",
    "scene": "scene", "petzval": "api",
}
# Headers of other people and the only files that may see them.
THIRD_PARTY = {
    r"(oneapi/)?tbb/": r"src/base/parallel\.cpp",
    r"hwy/": r"src/\w+/\w+_simd(_test)?\.(cpp|h)",
    r"(OpenEXR|Imath)/": r"src/files/",
    r"png\.h": r"src/files/",
    r"OpenColorIO/": r"src/ocio/",
    r"embree": r"src/scene/",
    r"nlohmann/": r"(apps/cli|src/files|src/report)/",
    r"CLI/": r"apps/cli/",
}
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]')


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1]


def room_of(included):
    folder, _, rest = included.partition("/")
    if folder == "petzval":
        return PUBLIC.get(rest.removesuffix(".h"), f"(no room implements petzval/{rest})")
    return folder if folder in ALLOWED else None


def violations(root):
    files = [p for d in ("include", "src", "apps") for p in sorted((root / d).rglob("*.[hc]*"))]
    for path in files:
        name = path.relative_to(root).as_posix()
        parts = name.split("/")
        for number, included in includes(path):
            for pattern, home in THIRD_PARTY.items():
                if re.match(pattern, included) and not re.match(home, name):
                    yield f"{name}:{number}: {included} belongs behind {home}"
            room = room_of(included)
            if parts[0] == "src" and room and room not in ALLOWED[parts[1]] | {parts[1]}:
                yield f"{name}:{number}: {parts[1]} must not include {included} ({room})"
            if parts[0] == "include" and room and not included.startswith("petzval/"):
                yield f"{name}:{number}: a public header must not include {included}"
            if parts[0] == "apps" and included.split("/")[0] in ALLOWED:
                yield f"{name}:{number}: apps include petzval/ only, not {included}"


if __name__ == "__main__":
    found = list(violations(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "layers: ok")
    sys.exit(bool(found))
