"""The kit's tables: each program in each language declares what kit.json says, under the registers of the page.

Usage: tables_test.py PETZVAL. Ends with 77, after the reason, where a compiler of the kit is missing.
"""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import kit  # noqa: E402


class Tables(unittest.TestCase):
    def read(self, folder, step, suffix):
        return (KIT / folder / f"{step}.{suffix}").read_text()

    def expected(self, step, *kinds):
        return {(row["binding"], row["name"]) for row in PROGRAMS[step]["bindings"] if row["kind"] in kinds}

    def test_glsl(self):
        for step in PROGRAMS:
            text = self.read("glsl", step, "comp")
            images = re.findall(r"layout\([^)]*binding = (\d+)[^)]*\) uniform (?:\w+ )*?(?:sampler|image)\w+ (\w+);", text)
            buffers = re.findall(r"layout\([^)]*binding = (\d+)[^)]*\)(?: \w+)* buffer \w+\s*\{[^}]*\} (\w+);", text)
            found = {(int(binding), name) for binding, name in images + buffers}
            self.assertEqual(found, self.expected(step, "sampled", "storage image", "buffer"), step)

    def test_hlsl(self):
        for step in PROGRAMS:
            text = self.read("hlsl", step, "hlsl")
            found = set(re.findall(r"(\w+) : register\((\w)(\d+)\)", text))
            expected = {("Push", "b", "0")}
            for row in PROGRAMS[step]["bindings"]:
                expected.add((row["name"], "t" if row["access"] == "read" else "u", str(row["binding"])))
                if row["kind"] == "sampled" and f"_{row['name']}_sampler" in text:
                    expected.add((f"_{row['name']}_sampler", "s", str(row["binding"])))
            self.assertEqual(found, expected, step)
            for member in TABLES["push"]:
                self.assertIn(f" at_{member['name']} : packoffset(", text)

    def test_msl(self):
        for step in PROGRAMS:
            signature = re.search(r"kernel void main0\((.*)\)", self.read("msl", step, "metal"))[1]
            found = set(re.findall(r"(\w+) \[\[(texture|buffer)\((\d+)\)\]\]", signature))
            expected = {("at", "buffer", "30")} | {
                (row["name"], "buffer" if row["kind"] == "buffer" else "texture", str(row["binding"]))
                for row in PROGRAMS[step]["bindings"]}
            self.assertEqual(found, expected, step)
            samplers = re.findall(r"sampler (\w+)Smplr \[\[sampler\((\d+)\)\]\]", signature)
            self.assertEqual({(int(binding), name) for name, binding in samplers}, self.expected(step, "sampled"), step)

    def test_the_page_names_each_resource_and_each_program(self):
        page = (KIT / "README.md").read_text()
        self.assertNotRegex(page, r"\]\([^#]", "a link to a file that the kit does not have")
        resources = page[page.index("| resource |"):page.index("## The push block")]
        for step, program in PROGRAMS.items():
            self.assertIn(f"### {step}\n", page)
            self.assertIn(f"`{step}`", page)
            for row in program["bindings"]:
                self.assertRegex(resources, rf"(?m)^\| [^|]*\b{row['resource']}\b", step)

    def used_samplers(self):
        texts = [self.read("hlsl", step, "hlsl") for step in PROGRAMS]
        return {name for text in texts for name in re.findall(r"\((_\w+_sampler)\b", text)}

    def test_unreals_names_compile_without_registers(self):
        edits = re.search(r"^sed -i (-E .*) build/kit/hlsl/\*\.hlsl$", (ROOT / "docs/guide/kit-in-engines.md").read_text(), re.M)[1]
        for step in PROGRAMS:
            file = KIT.parent / f"{step}.hlsl"
            file.write_text(self.read("hlsl", step, "hlsl"))
            subprocess.run(["sed", "-i", *shlex.split(edits), file], check=True)
            self.assertNotRegex(file.read_text(), "register|packoffset|cbuffer")
            self.assertIn("\n    int2 at_size;\n", file.read_text())
            subprocess.run(["glslangValidator", "-D", "-V", "-S", "comp", "-e", "main", "--amb", "-o", file.with_suffix(".spv"), file],
                           check=True, stdout=subprocess.DEVNULL)

    def test_the_guide_uses_names_of_the_kit(self):
        guide = (ROOT / "docs/guide/kit-in-engines.md").read_text()
        steps = re.search(r'for step in \[(.*?)\]', guide)[1]
        self.assertEqual(re.findall(r'"(\w+)"', steps), [step for step in PROGRAMS if step not in ("combine_32", "combine_11")])
        measure = {row["name"] for row in PROGRAMS["measure"]["bindings"]} | {"at_" + member["name"] for member in TABLES["push"]}
        unity = re.findall(r'SetCompute\w+\(measure, (?:0, )?"(\w+)"', guide)
        unreal = re.findall(r"SHADER_PARAMETER\w*\([^,()]*(?:<[^>]*>)?, (\w+)\)", guide)
        for names in (unity, unreal):
            self.assertGreater(len(names), 3)
            self.assertLessEqual(set(names), measure)
        made = re.findall(r'^\t+"(\w+)": device', guide, re.M)
        buffers = {row["resource"] for program in PROGRAMS.values() for row in program["bindings"] if row["kind"] == "buffer"}
        self.assertEqual(set(made), buffers)
        self.assertIn("`_cells_sampler`", guide)
        self.assertEqual(self.used_samplers(), {"_cells_sampler", "_gathered_sampler"})

    def test_the_lens_is_that_of_the_page(self):
        self.assertEqual((KIT / "lens.bin").stat().st_size, 16 * (1 + 264 + 101592))

    def test_an_older_lens_is_refused(self):
        older = KIT.parent / "older.bin"
        lens = bytearray((KIT / "lens.bin").read_bytes())
        kit.check_lens(KIT / "lens.bin", TABLES["lens_mark"])
        lens[16:20] = bytes(4)  # as petzval wrote it before buffers had marks
        for content in (lens, lens[:18], b"GIF89a"):
            older.write_bytes(content)
            with self.assertRaisesRegex(SystemExit, "older.bin is not for these programs"):
                kit.check_lens(older, TABLES["lens_mark"])

    def test_pages_name_the_mark(self):
        guide = (ROOT / "docs/guide/kit-in-engines.md").read_text()
        self.assertEqual(set(re.findall(r'"(PZL\w)"', guide)), {TABLES["lens_mark"]})
        for line in ("lens.slice(16, 20)", "GetString(lens, 16, 4)", "Lens.GetData() + 16"):
            self.assertIn(line, guide)


if __name__ == "__main__":
    for needed in ("glslc", "spirv-cross", "spirv-val", "glslangValidator"):
        if not shutil.which(needed):
            print(f"tables_test: skipped, {needed} is not installed")
            sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="petzval-kit-") as made:
        KIT = pathlib.Path(made) / "kit"
        subprocess.run([sys.executable, ROOT / "tools/kit.py", KIT, "--petzval", sys.argv.pop()], stdout=subprocess.DEVNULL, check=True)
        TABLES = json.loads((KIT / "kit.json").read_text())
        PROGRAMS = {one["name"]: one for one in TABLES["programs"]}
        unittest.main()
