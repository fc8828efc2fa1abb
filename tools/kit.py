"""Builds build/kit: the programs of the real-time pass as GLSL, SPIR-V, HLSL, MSL and WGSL, with tables of what they bind.

Usage: kit.py [FOLDER] [--petzval PROGRAM]. Each program is compiled where this machine has a compiler; a program that is
refused ends the run. PROGRAM writes lens.bin.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHADERS = ROOT / "src/device/vulkan/shaders"
PAGE = ROOT / "docs/explain/shader-kit.md"
LENS = ROOT / "src/engine/gather/realtime_plan.h"
GLSL = ("-V", "--version", "450")
SAMPLER, PUSH = 32, 64  # WGSL: a sampler is bound so far behind its texture; the push block as uniforms
MSL_PUSH = 30           # the last buffer that Metal has
# Programs without WGSL, with the reason.
NO_WGSL = {"combine_11": "WebGPU has no storage texture of r11f_g11f_b10f"}

# What is bound where, with the names of the page; a binding that the programs have and this table lacks ends the run. A
# number is a level of the image.
COMBINE = {0: "colour", 1: "cells", 2: "layer", 3: "gathered", 4: "result", 5: "lens", 6: "kept", 7: "boxes", 8: "reach", 9: "cell_lamps"}
BOUND = {
    "measure": {0: "colour", 1: "surroundings"},
    "split": {0: "colour", 1: "depth", 2: "cells 0", 3: "cells 1", 4: "cells 2", 5: "cells 3", 6: "tiles", 7: "surroundings",
              8: "lamps", 9: "cell_lamps"},
    "reach": {0: "tiles", 1: "reach", 2: "lamps", 3: "boxes", 4: "kept", 5: "cell_lamps"},
    "gather": {0: "cells", 1: "lens", 2: "reach", 3: "gathered"},
    "combine_16": COMBINE, "combine_32": COMBINE, "combine_11": COMBINE,
}
# Groups along x and y, as the page has them.
GROUPS = {"measure": "tiles", "split": "tiles", "reach": "tiles / 64", "gather": "tiles", "combine_16": "pixels / 8",
          "combine_32": "pixels / 8", "combine_11": "pixels / 8"}
KINDS = {"textures": "sampled", "images": "storage image", "ssbos": "buffer"}

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


def buffer_name(block):
    return re.sub(r"(?<!^)([A-Z])", r"_\1", block).lower() + "_buffer"


def name_buffers(texts):
    """Gives buffers the names of their blocks in all texts of a program. spirv-cross numbers them, because the sources name
    only the members."""
    for block, number in re.findall(r"buffer (\w+)\s*\{[^}]*\} (_\d+);", texts["glsl"].read_text()):
        for text in texts.values():
            text.write_text(re.sub(rf"\b{number}\b", buffer_name(block), text.read_text()))


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
    spirv, named = out / "spirv" / f"{step}.spv", made / f"{step}.spv"
    compiled(step, spirv)
    run("spirv-val", "--target-env", "vulkan1.2", spirv)
    compiled(step, named, "-g")
    texts = {}
    for folder, suffix, flags in (("glsl", "comp", GLSL), ("hlsl", "hlsl", ("--hlsl", "--shader-model", "60")),
                                  ("msl", "metal", ("--msl", "--msl-version", "20200", "--msl-decoration-binding"))):
        texts[folder] = out / folder / f"{step}.{suffix}"
        run("spirv-cross", named, *flags, "--output", texts[folder])
    name_buffers(texts)
    # spirv-cross leaves these two open: the first has no register, the second the place of another buffer.
    for folder, found, instead in (("hlsl", r"\bcbuffer Push\b", "cbuffer Push : register(b0)"),
                                   ("msl", r"constant Push& at \[\[buffer\(0\)\]\]", f"constant Push& at [[buffer({MSL_PUSH})]]")):
        written, count = re.subn(found, instead, texts[folder].read_text())
        if count != 1:
            sys.exit(f"kit: {texts[folder]} has no push block where it is expected")
        # Space 0 is meant anyway, and compilers before shader model 5.1 know none.
        texts[folder].write_text(written.replace(", space0)", ")"))
    run("glslangValidator", "--target-env", "vulkan1.1", "-V", "-o", made / "checked.spv", texts["glsl"])
    run("glslangValidator", "-D", "-V", "-S", "comp", "-e", "main", "-o", made / "checked.spv", texts["hlsl"])
    return json.loads(run("spirv-cross", named, "--reflect")), wgsl(step, made, out)


def bindings(step, reflection):
    """What a program binds, in the order of its bindings."""
    rows = []
    for kind, said in KINDS.items():
        for one in reflection.get(kind, []):
            binding = one["binding"]
            if binding not in BOUND[step]:
                sys.exit(f"kit: binding {binding} of {step} is new: say in tools/kit.py what is bound there")
            name = buffer_name(one["name"]) if kind == "ssbos" else one["name"]
            what, _, level = BOUND[step][binding].partition(" ")
            access = "write" if one.get("writeonly") else "read" if kind == "textures" or one.get("readonly") else "read and write"
            rows.append({"binding": binding, "name": name, "kind": said, "access": access, "resource": what,
                         **({"format": one["format"]} if "format" in one else {}), **({"level": int(level)} if level else {})})
    if len(rows) != len(BOUND[step]):
        sys.exit(f"kit: {step} no longer has all bindings of the table in tools/kit.py")
    return sorted(rows, key=lambda row: row["binding"])


def table(step, rows):
    lines = ""
    for row in rows:
        level = f", level {row['level']}" if "level" in row else ""
        lines += f"| {row['binding']} | `{row['name']}` | {row['kind']}{' ' + row.get('format', '') if 'format' in row else ''} | {row['access']} | {row['resource']}{level} |\n"
    return f"### {step}\n\n| binding | name | kind | access | resource |\n|---|---|---|---|---|\n{lines}\n"


def push_block(reflection):
    """Offset, type and name of each member, which the page must have as well."""
    block = reflection["types"][reflection["push_constants"][0]["type"]]["members"]
    members = [{"offset": one["offset"], "type": one["type"], "name": one["name"]} for one in block]
    rows = re.findall(r"^\| (\d+) \| (\w+) \| `(\w+)` \|", PAGE.read_text(), re.M)
    if rows != [(str(one["offset"]), one["type"], one["name"]) for one in members]:
        sys.exit(f"kit: the push block of {PAGE.name} is not that of realtime.glsl: {members}")
    return members


def mark_of_lens():
    """What a lens buffer for these programs has at byte 16."""
    return "".join(re.findall(r"'(\w)'", re.search(r"kMark\{(.*)\};", LENS.read_text())[1]))


def check_lens(path, mark):
    found = path.read_bytes()[16:20]
    if found != mark.encode():
        sys.exit(f"kit: {path.name} is not for these programs: its bytes 16 to 19 are {found}, not {mark}")


def page_of_kit():
    """The page as it stands beside the programs: links to other files name their paths in the sources instead."""
    def named(link):
        path = (PAGE.parent / link[2]).resolve().relative_to(ROOT)
        return link[1] if link[1] == str(path) else f"{link[1]} (`{path}`)"
    return re.sub(r"\[([^\]]*)\]\(([^)#]+)(?:#[^)]*)?\)", named, PAGE.read_text())


def write(out, program):
    shutil.rmtree(out, ignore_errors=True)
    made = out.parent / (out.name + "-made")
    for folder in (made, *(out / name for name in ("glsl", "spirv", "hlsl", "msl", "wgsl"))):
        folder.mkdir(parents=True, exist_ok=True)
    tables, told, kit = "", "", {"format": "petzval shader kit", "version": 1, "lens_mark": mark_of_lens(), "push": None, "programs": []}
    for step in BOUND:
        reflection, said = translate(step, made, out)
        rows = bindings(step, reflection)
        kit["programs"].append({"name": step, "groups": GROUPS[step], "bindings": rows})
        kit["push"] = push_block(reflection)
        tables += table(step, rows)
        told += f"| `{step}` | {said} |\n"
    (out / "README.md").write_text(page_of_kit() + f"\n## WGSL of this kit\n\n| program | WGSL |\n|---|---|\n{told}\n## Bindings\n\n{tables}")
    (out / "kit.json").write_text(json.dumps(kit, indent=1) + "\n")
    if program:
        run(program, "lens", "buffer", "ideal", "-o", out / "lens.bin")
        check_lens(out / "lens.bin", kit["lens_mark"])
    shutil.copy(ROOT / "LICENSE", out)
    shutil.rmtree(made)


if __name__ == "__main__":
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("folder", nargs="?", type=pathlib.Path, default=ROOT / "build/kit")
    asked.add_argument("--petzval", metavar="PROGRAM")
    given = asked.parse_args()
    write(given.folder.resolve(), given.petzval)
    print(given.folder.resolve())
