"""The library's messages name fields; every one of those that a user of the program can meet has its flag."""
import pathlib
import re
import unittest

from program import CommandLineTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIELD = re.compile(r"(?<![\w/.])(?:job|shot|read|session|lens|camera|focus|depth|scene|disc|develop|glare)\.[a-z_]+(?:\.[a-z_]+)*")
NO_FLAG = {"disc.exr", "shot.json"}  # names of files


def messages():
    """File, and what stands between quotes in it."""
    for path in sorted((ROOT / "src").rglob("*.cpp")):
        if path.name.endswith("_test.cpp") or path.is_relative_to(ROOT / "src/c"):
            continue
        for line in path.read_text().splitlines():
            if not line.lstrip().startswith(("//", "#include")):
                yield from ((path, text) for text in re.findall(r'"((?:[^"\\]|\\.)*)"', line))


class Fields(CommandLineTest):
    def test_every_field_that_a_message_names_has_a_flag(self):
        rows = (ROOT / "apps/cli/flags/fields.cpp").read_text() + (ROOT / "apps/cli/flags/look_rows.cpp").read_text()
        known = set(re.findall(r'"([a-z]+\.[a-z_.]+)"', rows))
        met = {(field, path.name) for path, text in messages() for field in FIELD.findall(text)}
        self.assertGreater(len(met), 50)
        self.assertEqual({f for f in met if f[0] not in known | NO_FLAG}, set())

    def test_warnings_name_flags(self):
        self.succeed("scene", "make", "bars", "-o", "in.exr", "--layers", "hidden.exr", "--width", "64", "--height", "36", "-q")
        said = self.succeed("defocus", "in.exr", "-o", "out.exr", "--engine", "reference", "--pupil-points", "16").err
        self.assertIn("supply it as --plate", said)
        said = self.succeed("defocus", "in.exr", "-o", "out.exr", "--engine", "gaussian", "--behind", "hidden.exr").err
        self.assertIn("--plate has no effect with --engine gaussian", said)


if __name__ == "__main__":
    unittest.main()
