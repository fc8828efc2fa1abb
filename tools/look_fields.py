#!/usr/bin/env python3
"""Writes docs/reference/look-fields.md: every field of a look with its flag, default, accepted values and help text.

Usage: tools/look_fields.py [--check] PROGRAM. Defaults come from --save-look, help texts from `petzval help`, accepted
values from what the program answers to a look with a field out of range.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/reference/look-fields.md"
ROW = re.compile(r'row\("([^"]+)", "(--[\w-]+)", "([\w.]+)"')
HEAD = """# Look fields

A look file (`--save-look`, `--look`) is one JSON object with these fields. A missing field keeps
its default; an unknown field is refused, with the name of a similar one. `"inf"` stands for
infinity. `tools/look_fields.py` generates this page from the program.

Paths in a look file are relative to that file. Camera numbers, threads and outputs are not part of
a look. A look may start from a preset: `{"petzval_look": 1, "preset": "night"}`. `--look` also
accepts a link of the [lens lab](lens-lab.md#links), or the part after its `#`. The look then has
the lens and controls of the link, and a pasted lens as text.
"""


# Fields whose JSON is not the text of their flag.
ACCEPTED = {
    "focus.range_m": "`[near, far]` in metres, or `null`",
    "lens.barrel": 'a list of `{"radius_mm": R, "distance_mm": D}`',
    "lens.barn_doors": "four numbers: left, right, top, bottom",
    "lens.kernel_image": "a list of one or two files",
    "gaussian.focus_band": "0 or more, or `null`",
    "gaussian.depth_offset": "a number, or `null`",
    "gaussian.depth_band_range_m": "`[near, far]` in metres, or `null`",
    "gather.blurred_px": "at least 1, or `null`",
}
# Fields without a flag.
MEANING = {"plate.knee": "light up to this value was recorded unchanged; above it, the shoulder of the plate begins"}


def fields_of(value, path=""):
    """(path, default) of every leaf."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from fields_of(inner, f"{path}.{key}".lstrip("."))
    else:
        yield path, value


def with_field(look, path, value):
    copy = json.loads(json.dumps(look))
    *parents, last = path.split(".")
    place = copy
    for parent in parents:
        place = place[parent]
    place[last] = value
    return copy


class Prober:
    """Asks the program about looks, on a picture of a few pixels."""

    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)
        self.run("scene", "make", "slant", "-o", "in.exr", "--width", "8", "--height", "8", "--pinhole-samples", "1")
        self.run("defocus", "in.exr", "-o", "out.exr", "--save-look", "look.json")
        self.look = json.loads((self.folder / "look.json").read_text())

    def run(self, *words):
        done = subprocess.run([self.program, *words, "-q"], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout

    def check_word(self, path, word):
        """Exits if the program refuses a word that the page is about to list."""
        (self.folder / "probe.json").write_text(json.dumps(with_field(self.look, path, word)))
        status, said = self.run("defocus", "in.exr", "-o", "out.exr", "--look", "probe.json")
        if status and re.search(re.escape(path) + ": (must|.* is not one of)", said):
            sys.exit(f"look_fields: {said.strip()}")

    def accepted(self, path, default, flag):
        """The rule that the program states when a number is out of range, in a look or as the flag's value."""
        if isinstance(default, bool):
            return "`true`, `false`"
        whole = isinstance(default, int)
        for value in (-5, 2**31 - 1) if whole else (-1e30, 1e30) if isinstance(default, float) or default == "inf" else ():
            (self.folder / "probe.json").write_text(json.dumps(with_field(self.look, path, value)))
            for words in (["--look", "probe.json"], [f"{flag}={value}"] if flag else []):
                status, said = self.run("defocus", "in.exr", "-o", "out.exr", *words)
                rule = re.search(r"must (?:be|lie) ([^\n;]*)", said)
                if status and rule:
                    return re.sub(r"^a number |, not -?[\d.e+]+$", "", rule[1])
        return ""


def helps(program):
    """{flag: (placeholder, help)} of defocus."""
    text = subprocess.run([program, "help", "--format", "md"], stdout=subprocess.PIPE, text=True, check=True).stdout
    verb = text[text.index("### `petzval defocus"):].split("\n### ")[0]
    rows = re.findall(r"^\| `(--[\w-]+) ?(.*?)` \| (.*) \|$", verb, re.MULTILINE)
    return {flag: (placeholder, said) for flag, placeholder, said in rows}


def page_of(program):
    rows = {field: (heading, flag) for heading, flag, field in ROW.findall((ROOT / "apps/cli/flags/look_rows.cpp").read_text())}
    told = helps(program)
    lines = [HEAD]
    with tempfile.TemporaryDirectory() as folder:
        prober = Prober(program, folder)
        group = None
        for path, default in fields_of({k: v for k, v in prober.look.items() if k != "petzval_look"}):
            heading, flag = rows.get(path, ("", ""))
            placeholder, said = told.get(flag, ("", ""))
            name = path.split(".")[0] if "." in path else "general"
            if name != group:
                lines += ["", f"## {name}", "", "| field | flag | default | accepted | meaning |", "|---|---|---|---|---|"]
                group = name
            words = "|" in placeholder and not isinstance(default, bool)
            said = said or MEANING.get(path, "")
            accepted = ACCEPTED.get(path)
            if not accepted and words:
                listed = placeholder.replace("\\", "").split("|")
                for word in listed:
                    prober.check_word(path, int(word) if isinstance(default, int) else word)
                accepted = ", ".join(f"`{word}`" for word in listed)
            accepted = accepted or prober.accepted(path, default, flag)
            lines.append(f"| `{path}` | {f'`{flag}`' if flag else ''} | `{json.dumps(default)}` | {accepted} | {said} |")
    return "\n".join(lines).replace("\n\n\n", "\n\n") + "\n"


def main():
    *options, program = sys.argv[1:] or sys.exit(__doc__)
    made = page_of(pathlib.Path(program).resolve())
    if options != ["--check"]:
        PAGE.write_text(made)
    elif made != PAGE.read_text():
        sys.exit(f"{PAGE.name} is not what the program answers; run tools/look_fields.py {program}")


if __name__ == "__main__":
    main()
