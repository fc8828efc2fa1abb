"""Frames in parts: colour layers and mattes, stages, display codes; comparison of pictures."""
import sys
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

import petzval

HEIGHT, WIDTH = 48, 64
CAMERA = petzval.Camera(50, 36, 2, 2)


def shot(**more):
    rng = np.random.default_rng(7)
    colour = rng.random((HEIGHT, WIDTH, 4), np.float32)
    colour[..., 3] = 1
    colour[20, 30, :3] = 40
    depth_m = np.full((HEIGHT, WIDTH), 8, np.float32)
    depth_m[:, 40:] = 1.2
    return petzval.Shot(colour, depth_m=depth_m, camera=CAMERA, **more)


class Layers(unittest.TestCase):
    def test_layers_that_sum_to_the_picture_sum_to_it_when_blurred(self):
        whole = shot()
        key, fill = whole.colour * np.float32(0.25), whole.colour * np.float32(0.75)
        matte = np.zeros((HEIGHT, WIDTH, 3), np.float32)
        matte[:, 40:] = 1
        whole.layers = [petzval.Layer(key), petzval.Layer(fill), petzval.Layer(matte, is_matte=True)]
        with petzval.Session(threads=2) as session:
            frame = session.defocus(whole)
            plain = session.defocus(shot())
        np.testing.assert_array_equal(frame.image, plain.image)
        sum_of = frame.layers[0][..., :3] + frame.layers[1][..., :3]
        np.testing.assert_allclose(sum_of, frame.image[..., :3], rtol=1e-4, atol=1e-4)
        self.assertEqual(frame.layers[2].shape, (HEIGHT, WIDTH, 4))
        self.assertGreater(float(frame.layers[2][:, 60, :3].mean()), 0.9)
        self.assertLess(float(frame.layers[2][:, :20, :3].max()), 0.05)

    def test_a_region_of_layers(self):
        whole = shot()
        whole.layers = [petzval.Layer(whole.colour)]
        with petzval.Session(threads=2) as session:
            all_of_it = session.defocus(whole).layers[0]
            part = session.defocus(whole, region=(5, 6, 40, 30)).layers[0]
        np.testing.assert_array_equal(part, all_of_it[6:30, 5:40])

    def test_what_does_not_fit_is_refused_by_name(self):
        whole = shot()
        whole.layers = [petzval.Layer(np.zeros((4, 4, 3), np.float32))]
        with petzval.Session(threads=1) as session:
            with self.assertRaisesRegex(petzval.InvalidArgument, r"layers\[0\]"):
                session.defocus(whole)
            whole.layers = [petzval.Layer(whole.colour, spectrum="moonlight")]
            with self.assertRaisesRegex(petzval.InvalidArgument, "sodium"):
                session.defocus(whole)


class Stages(unittest.TestCase):
    def test_all_stages_in_turn_are_the_frame(self):
        look = petzval.Look(lens="doublet", **{"glare.vignetting": True, "glare.bloom": 0.1})
        rendered = shot()
        with petzval.Session(threads=2) as session:
            expected = session.defocus(rendered, look).image
            for stages in (("blur", "falloff", "glare"), ("blur", "light")):
                rendered = shot()
                for stage in stages:
                    before = rendered.colour
                    rendered.colour = session.stage(stage, rendered, look).image
                    self.assertFalse(np.array_equal(rendered.colour, before), stage)
                np.testing.assert_array_equal(rendered.colour, expected)
            with self.assertRaisesRegex(petzval.InvalidArgument, "blur, falloff, glare"):
                session.stage("dissolve", rendered, look)

    def test_the_blur_makes_layers_too(self):
        rendered = shot()
        rendered.layers = [petzval.Layer(rendered.colour)]
        with petzval.Session(threads=2) as session:
            whole, blurred = session.defocus(rendered), session.stage("blur", rendered)
            np.testing.assert_array_equal(blurred.layers[0], whole.layers[0])
            rendered.mask = np.full(rendered.colour.shape[:2], 0.5, np.float32)
            lit = session.stage("light", rendered, petzval.Look(**{"glare.bloom": 0.1}))
            self.assertEqual(lit.layers, [])
            self.assertEqual([line.split(" has ")[0] for line in lit.report["warnings"]], ["shot.mask", "shot.layers"])


class Codes(unittest.TestCase):
    def test_codes_are_those_of_the_developed_image(self):
        with petzval.Session(threads=2) as session:
            codes = np.asarray(session.codes(shot(), tone="none", transfer="linear", dither=False).codes)
            image = session.defocus(shot()).image
            deep = np.asarray(session.codes(shot(), bits=16, tone="none", transfer="linear", dither=False).codes)
        self.assertEqual((codes.shape, codes.dtype, deep.dtype), ((HEIGHT, WIDTH, 3), np.uint8, np.uint16))
        expected = np.clip(image[..., :3], 0, 1) * 255
        self.assertLessEqual(float(np.abs(codes - expected).max()), 0.51)
        self.assertLessEqual(float(np.abs(deep - expected * 257).max()), 0.6)

    def test_choices_are_refused_by_name(self):
        with petzval.Session(threads=1) as session:
            for wrong in ({"tone": "vivid"}, {"bits": 10}, {"transfer": "pq"}):
                with self.assertRaisesRegex(petzval.InvalidArgument, "codes."):
                    session.codes(shot(), **wrong)


class Compare(unittest.TestCase):
    def test_equal_pictures_and_a_difference(self):
        colour = shot().colour
        same = petzval.compare(colour, colour)
        self.assertEqual((same["psnr_lin"], same["max_error"]), (float("inf"), 0))
        other = colour.copy()
        other[3, 5, 0] += 0.25
        found = petzval.compare(colour * 0.5, other * 0.5)
        self.assertEqual(found["max_error_at"], [5, 3])
        mask = np.zeros((HEIGHT, WIDTH), np.float32)
        mask[10:, :] = 1
        self.assertEqual(petzval.compare(colour, other, mask=mask)["psnr_lin"], float("inf"))
        with self.assertRaises(petzval.InvalidArgument):
            petzval.compare(colour, colour[:5])


if __name__ == "__main__":
    unittest.main(verbosity=2)
