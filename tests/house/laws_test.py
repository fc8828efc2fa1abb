"""C++ and the GPU's programs read the same laws.

Each file of src/laws that GLSL includes is preprocessed both ways: the constants must agree in name, type and value.
A constant of the laws must not be defined anywhere else in src. Where glslc is missing, only the second is tested.
"""
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAWS = ROOT / "src/laws"
CONSTANT = re.compile(r"\b(?:constexpr|const)\s+(?:static\s+)?(\w+)\s+(k\w+)\s*=\s*([^;]+);")


def constants(text):
    return {(name, kind, " ".join(value.split())) for kind, name, value in CONSTANT.findall(text)}


def preprocessed(command, source):
    command = [*command, "-E", "-I", ROOT / "src", "-"]
    return subprocess.run(command, input=source, check=True, capture_output=True, text=True).stdout


def shared_files():
    """The laws that programs of a GPU include."""
    shaders = (ROOT / "src/device/vulkan/shaders").rglob("*.*")
    included = {name for s in shaders for name in re.findall(r'#include "laws/(\w+\.h)"', s.read_text())}
    return [LAWS / name for name in sorted(included)]


def differences(file):
    include = f'#include "laws/{file.name}"\n'
    cpp = constants(preprocessed(["c++", "-P", "-x", "c++"], include))
    header = "#version 450\n#extension GL_GOOGLE_include_directive : require\n"
    glsl = constants(preprocessed(["glslc", "-fshader-stage=compute"], header + include))
    if not cpp:
        yield f"{file.name}: no constant was found"
    for name, kind, value in sorted(cpp ^ glsl):
        yield f"{file.name}: {kind} {name} = {value} is read by one language alone"


def second_definitions():
    laws = {name: path.name for path in LAWS.glob("*.h") for name in re.findall(r"\b(k[A-Z]\w+)\s*=", path.read_text())}
    for path in sorted((ROOT / "src").rglob("*")):
        if path.suffix not in {".h", ".cpp", ".comp", ".glsl"} or path.parent == LAWS:
            continue
        for line, text in enumerate(path.read_text().splitlines(), 1):
            shader = path.suffix in {".comp", ".glsl"}
            for name in re.findall(r"\bconst\b[^;]*?\b(k[A-Z]\w+) =", text) if shader else []:
                if name in laws:
                    yield f"{path.relative_to(ROOT)}:{line}: {name} is defined in src/laws/{laws[name]}"


if __name__ == "__main__":
    files = shared_files()
    wrong = list(second_definitions())
    wrong += [] if files else ["no shader includes a law"]
    if shutil.which("glslc"):
        wrong += [d for file in files for d in differences(file)]
    print("\n".join(wrong) or "laws: ok")
    sys.exit(bool(wrong))
