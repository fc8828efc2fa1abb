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
sys.path.insert(0, str(ROOT / "tools"))
import lens_export  # noqa: E402

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
