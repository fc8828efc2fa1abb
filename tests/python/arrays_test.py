"""Arrays go in and out of petzval without copies; what cannot is refused by name."""
import array
import math
import sys
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

import petzval
from petzval.arrays import memory_of

HEIGHT, WIDTH = 24, 32


def picture(channels=4, kind=np.float32):
    """A lamp on grey."""
    rgba = np.full((HEIGHT, WIDTH, channels), 0.25, kind)
    rgba[12, 16, :3] = 50
    if channels == 4:
        rgba[..., 3] = 1
    return rgba


def radii():
    return np.full((HEIGHT, WIDTH), 3, np.float32)


class In(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.session = petzval.Session(threads=1)
        cls.expected = cls.session.defocus(petzval.Shot(picture(), radii_px=radii())).image

    @classmethod
    def tearDownClass(cls):
        cls.session.close()

    def same(self, colour, plane=None, tolerance=0.0):
        frame = self.session.defocus(petzval.Shot(colour, radii_px=radii() if plane is None else plane))
        image = np.asarray(frame.image)
        np.testing.assert_allclose(image, self.expected[..., :image.shape[2]], rtol=0, atol=tolerance)

    def test_an_array_is_borrowed_where_it_lies(self):
        colour = picture()
        self.assertEqual(memory_of(colour, "colour").address, colour.ctypes.data)
        flipped = colour[::-1]
        self.assertEqual(memory_of(flipped, "colour").address, flipped.ctypes.data)
        self.assertEqual(memory_of(flipped, "colour").strides, flipped.strides)

    def test_three_channels_are_opaque(self):
        self.same(picture(3))

    def test_separate_planes(self):
        self.same([np.ascontiguousarray(picture()[..., c]) for c in range(4)])

    def test_rows_bottom_up(self):
        self.same(np.ascontiguousarray(picture()[::-1])[::-1])

    def test_every_second_pixel_of_a_wider_array(self):
        wide = np.zeros((HEIGHT, 2 * WIDTH, 6), np.float32)
        wide[:, ::2, 1:5] = picture()
        plane = np.zeros((2 * HEIGHT, WIDTH), np.float32)
        plane[::2] = radii()
        self.same(wide[:, ::2, 1:5], plane[::2])

    def test_columns_first(self):
        self.same(np.asfortranarray(picture()))

    def test_half_floats(self):
        self.same(picture(4, np.float16), radii().astype(np.float16))

    def test_read_only_arrays(self):
        colour = picture()
        colour.flags.writeable = False
        self.same(colour)

    def test_broadcast_arrays_are_copied(self):
        colour, plane = np.full((HEIGHT, WIDTH, 4), 0.5, np.float32), np.full((HEIGHT, WIDTH), 2, np.float32)
        expected = np.asarray(self.session.defocus(petzval.Shot(colour, radii_px=plane)).image)
        for kind in (np.float32, np.float16):
            given = (np.broadcast_to(kind(0.5), colour.shape), np.broadcast_to(kind(2), plane.shape))
            self.assertTrue(memory_of(given[0], "colour").readonly)
            frame = self.session.defocus(petzval.Shot(given[0], radii_px=given[1]))
            np.testing.assert_array_equal(np.asarray(frame.image), expected)
        row = np.arange(WIDTH, dtype=np.float32)
        self.same(picture(), np.broadcast_to(radii()[..., None], (HEIGHT, WIDTH, 1)))
        copied = memory_of(np.broadcast_to(row, (HEIGHT, WIDTH)), "depth_m")
        floats = np.frombuffer(copied.owner, np.float32, HEIGHT * WIDTH).reshape(HEIGHT, WIDTH)
        np.testing.assert_array_equal(floats, np.tile(row, (HEIGHT, 1)))

    def test_a_plain_buffer(self):
        floats = array.array("f", picture().ravel().tolist())
        self.same(memoryview(floats).cast("B").cast("f", (HEIGHT, WIDTH, 4)))

    def test_an_object_with_an_array_interface_alone(self):
        class Host:
            def __init__(self, held):
                self.held, self.__array_interface__ = held, held.__array_interface__
        self.same(Host(picture()), Host(radii()))

    def test_an_array_of_petzval_itself(self):
        own = petzval.Array((HEIGHT, WIDTH, 4))
        np.asarray(own)[...] = picture()
        self.same(own)


class Refused(unittest.TestCase):
    def refuses(self, colour, *words):
        with self.assertRaises(petzval.InvalidArgument) as caught:
            petzval.defocus(colour, radii_px=radii())
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def test_uint8_is_no_light(self):
        self.refuses(np.zeros((HEIGHT, WIDTH, 3), np.uint8), "colour", "uint8", "scene-linear")
        self.refuses(bytes(HEIGHT * WIDTH * 3), "uint8")

    def test_float64_is_not_converted_silently(self):
        self.refuses(picture().astype(np.float64), "float64", "float32")

    def test_types_have_their_names(self):
        class Host:
            def __init__(self, held):
                self.held, self.__array_interface__ = held, held.__array_interface__
        for kind in ("int8", "int16", "int32", "int64", "uint32", "uint64", "bool"):
            given = np.zeros((HEIGHT, WIDTH, 3), kind)
            self.refuses(given, f"colour holds {kind};")
            self.refuses(Host(given), f"colour holds {kind};")

    def test_big_endian_samples(self):
        self.refuses(picture().astype(">f4"), "colour")

    def test_shapes(self):
        self.refuses(np.zeros((HEIGHT, WIDTH), np.float32), "(height, width, 3 or 4)")
        self.refuses(np.zeros((3, HEIGHT, WIDTH), np.float32), "permute(1, 2, 0)")
        self.refuses([radii(), radii()], "2 planes")
        self.refuses([radii(), radii(), radii()[::2]], "one shape")

    def test_no_array(self):
        self.refuses("a file name", "str")
        self.refuses(None, "NoneType")

    def test_a_device_by_its_name(self):
        class OnCuda:
            shape = (HEIGHT, WIDTH, 4)

            def __dlpack_device__(self):
                return (2, 0)
        self.refuses(OnCuda(), "CUDA")


class Out(unittest.TestCase):
    def setUp(self):
        self.session = petzval.Session(threads=1)
        self.addCleanup(self.session.close)
        self.shot = petzval.Shot(picture(), radii_px=radii())

    def test_the_image_comes_in_the_library_of_the_input(self):
        image = self.session.defocus(self.shot).image
        self.assertIsInstance(image, np.ndarray)
        self.assertEqual((image.shape, image.dtype), ((HEIGHT, WIDTH, 4), np.float32))
        self.assertIsNotNone(image.base)  # the memory that petzval wrote
        self.assertAlmostEqual(float(image[..., 0].sum()), float(picture()[..., 0].sum()), delta=1e-2)

    def test_into_an_array_of_the_caller(self):
        expected = self.session.defocus(self.shot).image
        wide = np.zeros((2 * HEIGHT, WIDTH, 4), np.float32)
        frame = self.session.defocus(self.shot, out=wide[::-2])
        self.assertIs(frame.image.base, wide)
        np.testing.assert_array_equal(wide[::-2], expected)
        self.assertEqual(float(np.abs(wide[::2]).max()), 0)

    def test_in_place_and_as_half(self):
        expected = self.session.defocus(self.shot).image
        half = np.zeros((HEIGHT, WIDTH, 4), np.float16)
        self.session.defocus(self.shot, out=half)
        np.testing.assert_array_equal(half, expected.astype(np.float16))
        self.session.defocus(self.shot, out=self.shot.colour)
        np.testing.assert_array_equal(self.shot.colour, expected)

    def test_a_read_only_array_is_refused(self):
        out = np.zeros((HEIGHT, WIDTH, 4), np.float32)
        out.flags.writeable = False
        with self.assertRaisesRegex(petzval.InvalidArgument, "read-only"):
            self.session.defocus(self.shot, out=out)

    def test_a_region_is_a_crop_of_the_whole(self):
        whole = self.session.defocus(self.shot).image
        part = self.session.defocus(self.shot, region=(5, 7, 20, 40)).image
        self.assertTrue(100 < self.session.region_margin_px(self.shot) < 400)
        np.testing.assert_array_equal(part, whole[7:, 5:20])

    def test_dlpack_of_petzvals_arrays(self):
        own = petzval.Array((4, 5, 3))
        np.asarray(own)[...] = np.arange(60, dtype=np.float32).reshape(4, 5, 3)
        taken = np.from_dlpack(own)
        del own
        self.assertEqual(float(taken.sum()), 59 * 30)


class Lights(unittest.TestCase):
    def test_lights_and_what_lies_behind_reach_the_engine(self):
        shot = petzval.Shot(np.zeros((HEIGHT, WIDTH, 4), np.float32), radii_px=radii(),
                            lights=[petzval.Light(10.5, 10.5, 50, 50, 50, math.nan, 4, 0)])
        image = petzval.Session(threads=1).defocus(shot, petzval.Look(engine="sprites")).image
        self.assertAlmostEqual(float(image[..., 0].sum()), 50, delta=0.5)

    def test_deep_samples(self):
        count = HEIGHT * WIDTH
        near = np.full((HEIGHT, WIDTH), -6, np.float32)
        near[:, WIDTH // 2:] = 9
        shot = petzval.Shot(picture(), radii_px=near)
        session = petzval.Session(threads=1)
        bare = session.defocus(shot).image
        shot.behind = petzval.Deep(WIDTH, HEIGHT, range(count + 1), [(0.2, 0.4, 0.6, 1, 9, 9)] * count)
        self.assertGreater(float(np.abs(session.defocus(shot).image - bare).max()), 1e-3)
        shot.behind.first = [0] * (count + 1)
        with self.assertRaises(petzval.InvalidArgument):
            session.defocus(shot)

    def test_deep_samples_in_an_array_are_those_of_a_list(self):
        count = HEIGHT * WIDTH
        near = np.full((HEIGHT, WIDTH), -6, np.float32)
        near[:, WIDTH // 2:] = 9
        rows = [(0.2, 0.4, 0.001 * i, 1, 9, 9) for i in range(count)]
        array, first = np.array(rows, np.float32), np.arange(count + 1, dtype=np.uint64)
        shot = petzval.Shot(picture(), radii_px=near, behind=petzval.Deep(WIDTH, HEIGHT, range(count + 1), rows))
        session = petzval.Session(threads=1)
        listed = session.defocus(shot).image
        shot.behind = petzval.Deep(WIDTH, HEIGHT, first, array)
        np.testing.assert_array_equal(session.defocus(shot).image, listed)
        for samples, index, why in ((array.astype(np.float64), first, "float64|d"), (array[:, :5], first, "packed"),
                                    (array, first.astype(np.uint32), "8-byte")):
            shot.behind = petzval.Deep(WIDTH, HEIGHT, index, samples)
            with self.assertRaisesRegex(petzval.InvalidArgument, why):
                session.defocus(shot)


if __name__ == "__main__":
    unittest.main(verbosity=2)
