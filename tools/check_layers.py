"""Fails if a room includes a header of a room it may not know, if rooms include each other in a circle, plans counted, or if
two files define types of one name.
The table IS the architecture.

Usage: check_layers.py [repository root]. Prints each violation as FILE:LINE; exit status 1 if there is any.
"""
import pathlib
import re
import sys

PIXELS = {"base", "image"}
MODEL = PIXELS | {"optics", "kernel/model"}
LENS = MODEL | {"colour", "lens_files", "kernel/draw", "kernel/lenses", "kernel/keep"}
WAIST = LENS | {"laws", "device", "engine/waist", "engine/samples"}
ENGINES = {"engine/lights", "engine/scatter", "engine/gather", "engine/gaussian", "engine/sprites", "engine/reference"}
# A room is a folder; the longest name that a path begins with is its room.
ALLOWED = {
    "laws": set(),
    "base": set(),
    "image": {"base"},
    "colour": PIXELS,
    "optics": PIXELS,
    "lens_files": PIXELS | {"optics"},
    "depth": PIXELS,
    "kernel/model": PIXELS | {"optics"},
    "kernel/draw": MODEL | {"colour"},
    "kernel/lenses": MODEL | {"colour", "lens_files", "kernel/draw"},
    "kernel/keep": MODEL,
    "device": MODEL,
    "device/cpu": MODEL | {"laws", "colour", "device", "engine/waist"},
    "device/vulkan": MODEL | {"laws", "colour", "device", "engine/waist"},
    "device/webgl": MODEL | {"laws", "colour", "device", "engine/waist"},
    "engine/waist": MODEL | {"laws"},
    "engine/samples": MODEL | {"laws", "engine/waist"},
    "engine/lights": WAIST,
    "engine/scatter": WAIST | {"engine/lights"},
    "engine/gather": WAIST | {"engine/lights"},
    "engine/gaussian": WAIST,
    "engine/sprites": WAIST | {"engine/lights", "engine/gather", "engine/gaussian"},
    "engine/reference": LENS | {"engine/waist"},
    "views": WAIST | {"device/cpu", "engine/lights", "engine/scatter"},
    "glare": LENS | {"device"},
    "names": {"base", "optics", "depth", "colour", "engine/waist", "glare"},
    "look": {"base", "image", "optics", "colour", "engine/waist", "glare", "names"},
    "scene": PIXELS | {"optics"},
    "scene_files": PIXELS | {"optics", "records", "scene", "sequence", "shot", "files"},
    "lens_sheet": LENS | {"lens_facts", "files", "views", "look", "records", "session", "shot"},
    "files": PIXELS | {"colour", "optics", "depth", "names"},
    "ocio": PIXELS | {"colour"},
    "shot": PIXELS | {"laws", "optics", "depth", "names", "look", "session", "files"},
    "records": {"base", "optics", "depth", "engine/waist", "names", "look", "files"},
    "sequence": PIXELS | {"optics", "depth", "colour", "names", "records", "views", "engine/waist", "lens_facts", "look", "session", "shot", "files"},
    "lens_facts": LENS,
    "farm": {"base", "files", "records", "sequence"},
    "c": PIXELS | {"colour", "depth", "kernel/lenses", "device/vulkan", "lens_facts", "look", "names", "session", "session/rendered"},
    "c/files": PIXELS | {"c", "names", "records", "scene", "session", "sequence", "shot", "files"},
    "session/rendered": PIXELS | {"laws", "optics", "depth", "engine/waist", "engine/samples"},
    "session": WAIST | ENGINES | {"session/rendered", "device/cpu", "device/vulkan", "device/webgl", "depth", "views", "look", "glare"},
}
# What tests beside the code may see as well.
TESTS = {
    "device/vulkan": {"engine/samples", "engine/scatter", "kernel/lenses"},
    "kernel/draw": {"kernel/lenses"},
    "kernel/keep": {"kernel/lenses"},
    "engine/gather": {"kernel/lenses"},
    "device/cpu": {"glare", "kernel/draw", "kernel/lenses"},
    "session/rendered": {"lens_facts", "session"},
    "session": {"lens_facts"},
    "farm": {"session"},
}
# Devices know plans, the data that engines leave, and nothing else of engines.
PLANS = re.compile(r"(engine/\w+|glare)/(\w+_)?plan\.h")
# The room that implements each public header: including it is knowing that room.
PUBLIC = {
    "camera": "optics",
    "compare": "image",
    "deep": "image",
    "defocus": "session",
    "depth": "depth",
    "develop": "colour",
    "devices": "session",
    "dynamic_range": "colour",
    "engine_options": "engine/waist",
    "engine_report": "engine/waist",
    "export": "base",
    "farm/jobs": "farm",
    "farm/state": "farm",
    "files": "files",
    "glare": "glare",
    "image": "image",
    "lens": "kernel/lenses",
    "lens_choice": "optics",
    "lens_facts": "lens_facts",
    "lens_json": "lens_facts",
    "lens_kernel": "lens_facts",
    "lens_report": "lens_sheet",
    "lens_section": "lens_facts",
    "light_point": "image",
    "light_spectrum": "image",
    "look": "look",
    "look_check": "look",
    "look_file": "shot",
    "look_json": "look",
    "motion": "image",
    "names": "names",
    "ocio": "ocio",
    "output": "files",
    "place": "image",
    "petzval": "session",
    "petzval_c": "c",
    "petzval_lens_c": "c",
    "petzval_frame_c": "c",
    "petzval_files_c": "c/files",
    "petzval_run_c": "c/files",
    "pixel_view": "image",
    "result": "base",
    "scene": "scene",
    "neighbours": "sequence",
    "seen_elsewhere": "shot",
    "session": "session",
    "shot": "shot",
    "focus_track": "sequence",
    "frame_stages": "session",
    "rendered": "session/rendered",
    "frames": "sequence",
    "track": "sequence",
    "run_files": "sequence",
    "records": "records",
    "reports/devices": "sequence",
    "reports/lenses": "sequence",
    "reports/stopwatch": "base",
    "reports/words": "base",
    "display_files": "files",
    "frame_loop": "sequence",
    "shot_run": "sequence",
    "shots/compare_files": "sequence",
    "shots/develop_shot": "sequence",
    "shots/inspection": "sequence",
    "shots/scene_files": "scene_files",
    "shots/shot_sheet": "sequence",
    "made_with": "sequence",
    "views": "views",
    "version": "base",
    "vulkan": "c",
    "workers": "base",
}
# Headers of other people and the only files that may see them.
THIRD_PARTY = {
    r"(oneapi/)?tbb/": r"src/base/workers\.cpp",
    r"hwy/": r"src/[\w/]+/\w+_simd(_test)?\.(cpp|h)",
    r"(OpenEXR|Imath)/": r"src/files/",
    r"(png|jpeglib|jerror|tiffio)\.h": r"src/files/",
    r"OpenColorIO/": r"src/ocio/",
    r"embree": r"src/scene/",
    r"vulkan/": r"(src/device/vulkan/|src/c/vulkan_pass\.cpp|include/petzval/vulkan\.h)",
    r"tiny_gltf": r"src/scene/",
    r"nlohmann/": r"(apps/cli|apps/view|src/files|src/lens_facts|src/lens_sheet|src/look|src/records|src/sequence|src/scene_files|src/farm|src/c)/",
    r"CLI/": r"apps/cli/",
    r"(GLFW/|imgui|backends/imgui)": r"apps/view/",
    r"gegl": r"plugins/gegl/",
}
# What a library says must not depend on the program around it: it names fields, not flags.
FLAG = re.compile(r'"(?:[^"\\]|\\.)*?(?<![\w-])--[a-z][a-z-]+')
SAYS_FLAGS = {"lens_sheet", "farm"}  # shows commands, writes them
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]')


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1]


def room_of(included):
    """The room of a path below src/ or of a public header, "(none)" where there should be one; None for other paths."""
    folder, _, rest = included.partition("/")
    if folder == "petzval":
        return PUBLIC.get(rest.removesuffix(".h"), f"(no room implements petzval/{rest})")
    rooms = [room for room in ALLOWED if included.startswith(room + "/")]
    family = any(room.startswith(folder + "/") for room in ALLOWED)
    return max(rooms, key=len, default="(none)" if family else None)


def code_by_room(root):
    """{room: rooms whose headers its code includes}, tests left out."""
    seen = {}
    for path in sorted((root / "src").rglob("*.[hc]*")):
        room = room_of(path.relative_to(root / "src").as_posix())
        if room and not path.name.endswith("_test.cpp"):
            seen.setdefault(room, set()).update({room_of(name) for _, name in includes(path)} - {room, None})
    return seen


def circle(graph):
    """Rooms that include each other, the first one again at the end; [] where there are none."""
    done = set()

    def search(room, way):
        if room in way:
            return way[way.index(room):] + [room]
        if room in done:
            return []
        done.add(room)
        return next(filter(None, (search(other, way + [room]) for other in sorted(graph.get(room, ())))), [])
    return next(filter(None, (search(room, []) for room in sorted(graph))), [])


TYPE = re.compile(r"(?:template <.*> ?)?(?:struct|class|enum class|union) (\w+)(?: final)?(?: :[^:].*)? ?\{")
NAMESPACE = re.compile(r"(?:inline )?namespace ?([\w:]*) \{")


def types_of(path):
    """Types that a file defines in named namespaces, with their namespaces."""
    inside = []
    for line in path.read_text().splitlines():
        if opened := NAMESPACE.match(line):
            inside.append(opened[1])
        elif line.startswith("}  // namespace") and inside:
            inside.pop()
        elif (found := TYPE.match(line)) and inside and all(inside):
            yield "::".join([*inside, found[1]])


def shared_names(files):
    """Types of one name in two files: the linker takes either for both, and says nothing."""
    homes = {}
    for path in files:
        for name in types_of(path):
            homes.setdefault(name, []).append(path)
    return {name: paths for name, paths in homes.items() if len(paths) > 1}


def violations(root):
    round_trip = circle(code_by_room(root))
    if round_trip:
        yield "rooms include each other: " + " -> ".join(round_trip)
    files = [p for d in ("include", "src", "apps", "plugins") for p in sorted((root / d).rglob("*.[hc]*"))]
    for name, paths in shared_names([p for p in files if "plugins" not in p.parts]).items():
        yield f"{paths[-1].relative_to(root)}:1: {name} is also a type of {paths[0].relative_to(root)}"
    for path in files:
        name = path.relative_to(root).as_posix()
        top = name.split("/")[0]
        own = room_of(name.removeprefix("src/")) if top == "src" else None
        if top == "src" and own not in ALLOWED:
            yield f"{name}:1: stands in no room"
            continue
        allowed = ALLOWED[own] | {own} if own else set()
        if own and name.endswith("_test.cpp"):
            allowed = allowed | TESTS.get(own, set())
        if own and own not in SAYS_FLAGS and not name.endswith("_test.cpp"):
            for number, line in enumerate(path.read_text().splitlines(), 1):
                if FLAG.search(line) and not line.lstrip().startswith("//"):
                    yield f"{name}:{number}: a library names fields, as camera.f_number, not flags"
        for number, included in includes(path):
            for pattern, home in THIRD_PARTY.items():
                if re.match(pattern, included) and not re.match(home, name):
                    yield f"{name}:{number}: {included} belongs behind {home}"
            room = room_of(included)
            if own and own.startswith("device/") and PLANS.fullmatch(included):
                continue
            if own and room and room not in allowed:
                yield f"{name}:{number}: {own} must not include {included} ({room})"
            if top == "include" and room and not included.startswith("petzval/"):
                yield f"{name}:{number}: a public header must not include {included}"
            if top in ("apps", "plugins") and room and not included.startswith("petzval/"):
                yield f"{name}:{number}: {top} include petzval/ only, not {included}"


if __name__ == "__main__":
    found = list(violations(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "layers: ok")
    sys.exit(bool(found))
