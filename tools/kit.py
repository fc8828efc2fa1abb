"""Builds build/kit: the programs of the real-time pass as GLSL, SPIR-V, HLSL, MSL and WGSL, with a table of their bindings.

Usage: kit.py [FOLDER]. Each program is compiled where this machine has a compiler; a program that is refused ends the run.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHADERS = ROOT / "src/device/vulkan/shaders"
STEPS = ("measure", "split", "reach", "gather", "combine_16", "combine_32", "combine_11")
GLSL = ("-V", "--version", "450")
SAMPLER, PUSH = 32, 64  # WGSL: a sampler is bound so far behind its texture; the push block as uniforms
# Programs without WGSL, with the reason.
NO_WGSL = {"combine_11": "WebGPU has no storage texture of r11f_g11f_b10f"}

# For naga: it takes the result of findLSB to have the argument's sign, and WGSL knows neither isinf nor isnan.
INSTEAD = """
int kit_findLSB(uint x) { return findLSB(int(x)); }
bvec4 kit_isinf(vec4 v) { return equal(floatBitsToUint(v) & 0x7fffffffu, uvec4(0x7f800000u)); }
bvec4 kit_isnan(vec4 v) { return greaterThan(floatBitsToUint(v) & 0x7fffffffu, uvec4(0x7f800000u)); }
"""


def run(*command):
    done = subprocess.run(list(map(str, command)), cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(done.stdout + f"kit: {' '.join(map(str, command[:1]))} refused {command[-1]}")
    return done.stdout


def compiled(step, spirv, *flags):
    run("glslc", "--target-env=vulkan1.2", "-O", "-Werror", *flags, "-I", ROOT / "src", "-o", spirv,
        SHADERS / f"realtime/realtime_{step}.comp")


def separated(glsl):
    """GLSL with textures and samplers apart and the push block as uniforms, as WGSL has them."""
    kinds = {}

    def apart(found):
        binding, array, name = int(found[1]), found[2] or "", found[3]
        kinds[name] = array
        return (f"layout(set = 0, binding = {binding}) uniform texture2D{array} {name};\n"
                f"layout(set = 0, binding = {binding + SAMPLER}) uniform sampler {name}_sampler;")
    glsl = re.sub(r"layout\([^)]*binding = (\d+)[^)]*\) uniform sampler2D(Array)? (\w+);", apart, glsl)
    for name, array in kinds.items():
        glsl = re.sub(rf"\b(texture\w*|texelFetch\w*)\({name}\b", rf"\1(sampler2D{array}({name}, {name}_sampler)", glsl)
    glsl = re.sub(r"layout\(push_constant, std430\)", f"layout(set = 0, binding = {PUSH}, std140)", glsl)
    glsl = re.sub(r"\b(findLSB|isinf|isnan)\(", r"kit_\1(", glsl)
    return glsl.replace("\nvoid main()", f"\n{INSTEAD}\nvoid main()", 1)


def uniform(text, glsl, step):
    """WGSL whose barriers browsers take: they ask for proof that all invocations of a group come to each. A buffer that
    nobody writes serves as such a proof, and so does the place of the group, but naga drops the first and copies the other
    into variables of the module. `combine` also loops over words that its group shares."""
    inputs = re.findall(r"var<private> (gl_\w+)_1: ([^;]+);\n", text)
    text = re.sub(r"var<private> gl_\w+_1: [^;]+;\n|    gl_\w+_1 = gl_\w+;\n", "", text)
    text = text.replace("fn main_1()", f"fn main_1({', '.join(f'{name}_1: {kind}' for name, kind in inputs)})")
    text = text.replace("    main_1();", f"    main_1({', '.join(name for name, _ in inputs)});")
    for binding in re.findall(r"layout\([^)]*binding = (\d+)[^)]*\) readonly buffer", glsl):
        text = re.sub(rf"(@binding\({binding}\)\s*var<storage), read_write>", r"\1, read>", text)
    return re.sub(r"\batomicLoad\(\((&[^)]*)\)\)", r"workgroupUniformLoad(\1)", text) if step.startswith("combine") else text


def wgsl(step, made, out):
    """Writes the WGSL by naga, or says why there is none."""
    if step in NO_WGSL:
        return NO_WGSL[step]
    if not shutil.which("naga"):
        return "naga is not installed (cargo install naga-cli)"
    plain, spirv = made / f"{step}.comp", made / f"{step}.apart.spv"
    plain.write_text(separated((out / "glsl" / f"{step}.comp").read_text()))
    # Not -O: it shares pointers into buffers between blocks, which naga refuses.
    run("glslc", "--target-env=vulkan1.1", "-O0", "-o", spirv, plain)
    written = out / "wgsl" / f"{step}.wgsl"
    run("naga", spirv, written)
    written.write_text(uniform(written.read_text(), plain.read_text(), step))
    run("naga", written)
    return "written"


def translate(step, made, out):
    """All languages of a program; returns its reflection and what became of the WGSL."""
    spirv = out / "spirv" / f"{step}.spv"
    compiled(step, spirv)
    run("spirv-val", "--target-env", "vulkan1.2", spirv)
    for folder, suffix, flags in (("glsl", "comp", GLSL), ("hlsl", "hlsl", ("--hlsl", "--shader-model", "60")),
                                  ("msl", "metal", ("--msl", "--msl-version", "20200"))):
        run("spirv-cross", spirv, *flags, "--output", out / folder / f"{step}.{suffix}")
    run("glslangValidator", "--target-env", "vulkan1.1", "-V", "-o", made / "checked.spv", out / "glsl" / f"{step}.comp")
    run("glslangValidator", "-D", "-V", "-S", "comp", "-e", "main", "-o", made / "checked.spv", out / "hlsl" / f"{step}.hlsl")
    return json.loads(run("spirv-cross", spirv, "--reflect")), wgsl(step, made, out)


# What is bound where; a binding that the programs have and this table lacks ends the run. Sizes: tiles are of 16 x 16 pixels, cells
# of 2 x 2.
BOUND = {
    "measure": {0: "colour", 1: "surroundings: 2 floats a tile"},
    "split": {0: "colour", 1: "depth", 2: "cells, level 0", 3: "cells, level 1", 4: "cells, level 2", 5: "cells, level 3",
              6: "tiles: radii, 4 floats a tile", 7: "surroundings", 8: "lamps: 4 words a tile", 9: "lamps of cells: 4 words a cell"},
    "reach": {0: "tiles", 1: "reach: 4 floats a tile", 2: "lamps", 3: "boxes: 4 ints a tile", 4: "kept: 4 words a tile", 5: "lamps of cells"},
    "gather": {0: "cells, all levels, linear", 1: "lens", 2: "reach", 3: "gathered: 3 layers of cells"},
    "combine_16": {0: "colour", 1: "cells, all levels, linear", 2: "layer over the picture, or anything", 3: "gathered, linear",
                   4: "result, rgba16f", 5: "lens", 6: "kept", 7: "boxes", 8: "reach", 9: "lamps of cells"},
}
BOUND["combine_32"] = {**BOUND["combine_16"], 4: "result, rgba32f"}
BOUND["combine_11"] = {**BOUND["combine_16"], 4: "result, r11f_g11f_b10f: alpha is dropped"}
KINDS = {"textures": "sampled", "images": "storage image", "ssbos": "buffer"}


def table(step, reflection):
    rows = []
    for kind, said in KINDS.items():
        for one in reflection.get(kind, []):
            binding = one["binding"]
            if binding not in BOUND[step]:
                sys.exit(f"kit: binding {binding} of {step} is new: say in tools/kit.py what is bound there")
            rows.append((binding, f"{said}{' ' + one['format'] if 'format' in one else ''}", BOUND[step][binding]))
    lines = "".join(f"| {binding} | {kind} | {what} |\n" for binding, kind, what in sorted(rows))
    return f"### {step}\n\n| binding | kind | what |\n|---|---|---|\n{lines}\n"


def push_table(reflection):
    block = reflection["types"][reflection["push_constants"][0]["type"]]["members"]
    names = re.search(r"uniform Push \{(.*?)\}", (SHADERS / "realtime/realtime.glsl").read_text(), re.S)[1]
    names = re.findall(r"\b(\w+)(?=[,;])", re.sub(r"//.*", "", names))
    if len(names) != len(block):
        sys.exit("kit: the push block of realtime.glsl cannot be read")
    return "| offset | type | name |\n|---|---|---|\n" + "".join(
        f"| {member['offset']} | {member['type']} | `{name}` |\n" for name, member in zip(names, block))


def write(out):
    shutil.rmtree(out, ignore_errors=True)
    made = out.parent / (out.name + "-made")
    for folder in (made, *(out / name for name in ("glsl", "spirv", "hlsl", "msl", "wgsl"))):
        folder.mkdir(parents=True, exist_ok=True)
    tables, told, push = "", "", ""
    for step in STEPS:
        reflection, said = translate(step, made, out)
        tables += table(step, reflection)
        told += f"| `{step}` | {said} |\n"
        push = push or push_table(reflection)
    (out / "README.md").write_text((ROOT / "docs/explain/shader-kit.md").read_text() +
                                   f"\n## WGSL of this kit\n\n| program | WGSL |\n|---|---|\n{told}\n## Push block\n\n{push}\n## Bindings\n\n{tables}")
    shutil.copy(ROOT / "LICENSE", out)
    shutil.rmtree(made)


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/kit").resolve()
    write(folder)
    print(folder)
