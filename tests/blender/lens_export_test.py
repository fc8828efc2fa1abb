"""Lenses written for renderers: petzval itself reads pbrt's form back; what has no such form is refused.

Usage: lens_export_test.py PETZVAL
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/cli")]
import lens_export  # noqa: E402
from pictures import camera_attributes, exr_bytes, read_exr  # noqa: E402

petzval = ""


class Export(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def facts(self, lens):
        out = self.folder / "facts.json"
        subprocess.run([petzval, "lens", "show", lens, "--json", out], check=True, capture_output=True)
        return json.loads(out.read_text())

    def test_a_lens_file_of_pbrt_has_the_first_order_numbers_of_its_source(self):
        source, written = ROOT / "lenses/double-gauss.json", self.folder / "lens.dat"
        lens_export.main(str(source), str(written))
        ours, theirs = self.facts(source), self.facts(written)
        for key in ("efl_mm", "entrance_pupil_position_mm", "exit_pupil_position_mm", "entrance_pupil_diameter_mm"):
            self.assertAlmostEqual(ours[key], theirs[key], delta=1e-3, msg=key)

    def test_its_own_paraxial_rays_agree_with_petzvals(self):
        source = ROOT / "lenses/double-gauss.json"
        focal, entrance, radius, exit_at, exit_radius = lens_export.first_order(lens_export.read(source))
        facts = self.facts(source)
        for number, key in ((focal, "efl_mm"), (entrance, "entrance_pupil_position_mm"),
                            (2 * radius, "entrance_pupil_diameter_mm"), (exit_at, "exit_pupil_position_mm"),
                            (2 * exit_radius, "exit_pupil_diameter_mm")):
            self.assertAlmostEqual(number, facts[key], delta=1e-6, msg=key)

    def test_a_camera_shader_holds_every_surface(self):
        text = lens_export.osl(lens_export.read(ROOT / "lenses/double-gauss.json"), "lens", 50, 2.1, 2)
        self.assertIn("#define COUNT 11\n", text)
        for name in ("radius", "place", "clear", "nd", "cauchy"):
            values = re.search(rf"float {name}\[COUNT\] = {{(.*)}};", text)[1]
            self.assertEqual(len(values.split(",")), 11, name)

    def test_the_exported_camera_darkens_corners_as_petzval_does(self):
        """Light of a white scene at places of the frame: rays of the exported surfaces beside petzval --vignetting."""
        width, height = 160, 90
        channels = {c: [[1.0] * width] * height for c in "RGBA"} | {"Z": [[5.0] * width] * height}
        white, seen = self.folder / "white.exr", self.folder / "seen.exr"
        white.write_bytes(exr_bytes(channels, attributes=camera_attributes(50, 36, 2.1, 1.2)))
        subprocess.run([petzval, "defocus", white, "-o", seen, "--lens", "double-gauss", "--vignetting"], check=True, capture_output=True)
        ours = read_exr(seen)[0]["G"]
        numbers, columns = lens_export.camera(lens_export.read(ROOT / "lenses/double-gauss.json"), 50, 2.1, 1.2)
        for part in (0, 0.25, 0.5, 0.75, 0.95):
            x, y = part * 18, part * 18 * height / width
            at = (-x * numbers["SPAN"] / 50, -y * numbers["SPAN"] / 50, numbers["SENSOR"])
            theirs = self.light(numbers, columns, at)
            self.assertAlmostEqual(theirs, ours[int(height / 2 * (1 + part))][int(width / 2 * (1 + part))], delta=0.03, msg=part)

    def light(self, numbers, columns, at, across=48):
        total, count = 0, 0
        for i in range(across * across):
            u, v = ((2 * k + 1) / across - 1 for k in divmod(i, across))
            if u * u + v * v < 1:
                radius = numbers["PUPIL_RADIUS"]
                along, weight = lens_export.aimed(at, (u * radius, v * radius, numbers["PUPIL"]))
                total += weight * lens_export.leaves(columns, at, along)
                count += 1
        return numbers["GAIN"] / 3 * total / count

    def test_wrong_input_is_refused_in_one_sentence(self):
        surfaces = lens_export.read(ROOT / "lenses/double-gauss.json")
        with self.assertRaisesRegex(lens_export.Refused, "opens to f/2.03 only"):
            lens_export.osl(surfaces, "lens", 50, 1, 2)
        with self.assertRaisesRegex(lens_export.Refused, "inside the lens"):
            lens_export.osl(surfaces, "lens", 50, 4, 0.01)
        sphere = {"radius": 10, "thickness": 1, "semi_aperture": 3}
        for given, why in (({**sphere, "conic": 1}, "conic; only spheres"), ({"radius": 1}, "no semi_aperture"),
                           ({**sphere, "medium": {"glass": "BK7"}}, "no nd and Vd"), (sphere, "one stop")):
            path = self.folder / "wrong.json"
            path.write_text(json.dumps({"surfaces": [given]}))
            with self.assertRaisesRegex(lens_export.Refused, why):
                lens_export.read(path)


if __name__ == "__main__":
    petzval = sys.argv.pop(1)
    unittest.main(verbosity=2)
