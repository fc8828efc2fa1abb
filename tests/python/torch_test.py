"""DLPack with a real torch: CPU tensors in, torch tensors out, without copies; other devices are refused by name.

Runs in the environment of tests/python/make_torch.py. Exits 77 (skipped) where torch is missing.
"""
import sys
import unittest

try:
    import torch
except ImportError:
    print("skipped: torch is missing: tests/python/make_torch.py installs it under build/torch")
    sys.exit(77)

import petzval
from petzval.arrays import memory_of

HEIGHT, WIDTH = 24, 32


def tensors():
    colour = torch.full((HEIGHT, WIDTH, 4), 0.25)
    colour[12, 16, :3] = 50
    return colour, torch.full((HEIGHT, WIDTH), 3.0)


class Torch(unittest.TestCase):
    def test_a_tensor_in_gives_a_tensor_out(self):
        colour, radii = tensors()
        image = petzval.defocus(colour, radii_px=radii).image
        self.assertIsInstance(image, torch.Tensor)
        self.assertEqual((tuple(image.shape), image.dtype), ((HEIGHT, WIDTH, 4), torch.float32))
        self.assertAlmostEqual(float(image[..., 0].sum()), float(colour[..., 0].sum()), delta=1e-2)

    def test_nothing_is_copied_on_the_way_in(self):
        colour, _ = tensors()
        self.assertEqual(memory_of(colour, "colour").address, colour.data_ptr())
        shown = colour.permute(2, 0, 1).contiguous().permute(1, 2, 0)  # channels first in memory
        self.assertEqual(memory_of(shown, "colour").strides, tuple(4 * s for s in shown.stride()))

    def test_nothing_is_copied_on_the_way_out(self):
        own = petzval.Array((4, 5, 3))
        tensor = torch.from_dlpack(own)
        self.assertEqual(tensor.data_ptr(), own.address)
        own.data[2, 3, 1] = 7.0
        del own
        self.assertEqual(float(tensor[2, 3, 1]), 7.0)

    def test_strides_halves_and_channels_first_give_the_same_picture(self):
        colour, radii = tensors()
        expected = petzval.defocus(colour, radii_px=radii).image
        for given in (colour.permute(2, 0, 1).contiguous().permute(1, 2, 0), colour.half(),
                      torch.cat([colour, colour], 1)[:, :WIDTH], list(colour.permute(2, 0, 1))):
            self.assertTrue(torch.equal(petzval.defocus(given, radii_px=radii.half()).image, expected))

    def test_into_a_tensor_of_the_caller(self):
        colour, radii = tensors()
        out = torch.zeros(HEIGHT, WIDTH, 4, dtype=torch.float16)
        with petzval.Session(threads=1) as session:
            session.defocus(petzval.Shot(colour, radii_px=radii), out=out)
            expected = session.defocus(petzval.Shot(colour, radii_px=radii)).image
        self.assertTrue(torch.equal(out, expected.half()))

    def test_other_types_and_devices_are_refused_by_name(self):
        colour, radii = tensors()
        for given, word in ((colour.to(torch.uint8), "scene-linear"), (colour.bfloat16(), "bfloat16"),
                            (colour.double(), "float64")):
            with self.assertRaisesRegex(petzval.InvalidArgument, word):
                petzval.defocus(given, radii_px=radii)
        if torch.cuda.is_available():
            with self.assertRaisesRegex(petzval.InvalidArgument, "CUDA"):
                petzval.defocus(colour.cuda(), radii_px=radii)

    def test_gradients_are_refused_by_torch_itself(self):
        colour, radii = tensors()
        with self.assertRaises((BufferError, RuntimeError)):
            petzval.defocus(colour.requires_grad_(), radii_px=radii)


if __name__ == "__main__":
    unittest.main(verbosity=2)
