"""petzval lens buffer: a reader that knows docs/explain/shader-kit.md only finds every vector, and each adds up."""
import math
import struct
import unittest

from program import CommandLineTest

GRID, SHARES, STEPS = 72, 64, 14


class LensBuffer(CommandLineTest):
    def vectors(self, *flags):
        self.succeed("lens", "buffer", *flags, "-o", "lens.bin")
        return list(struct.iter_unpack("<4f", self.content("lens.bin")))

    def all_taps(self, vectors):
        return 4 * int(vectors[0][0]) + GRID

    def kernels_of_lamps(self, vectors, zone=0):
        """(radius in cells, vectors of one kernel): those in front of focus, then those behind."""
        taps = self.all_taps(vectors)
        heads = 1 + taps + 2 * taps * SHARES + zone * (2 * taps * SHARES + 67800)
        for first, half, radius, squared_reach in vectors[heads:heads + 2 * STEPS]:
            side = 2 * int(half) + 1
            kernel = vectors[int(first):int(first) + side * side]
            farthest = max(math.hypot(i % side - half, i // side - half) for i, light in enumerate(kernel) if any(light))
            # A place at the reach lies between four cells without light, and all places within it in the square.
            self.assertGreaterEqual(math.sqrt(squared_reach) + 1e-4, farthest + math.sqrt(2))
            self.assertLess(math.sqrt(squared_reach), half)
            yield radius, kernel

    def test_each_quality_has_its_taps_and_its_size(self):
        for quality, taps, all_taps in (("draft", 24, 168), ("standard", 48, 264), ("final", 127, 580)):
            vectors = self.vectors("ideal", "--quality", quality)
            self.assertEqual((vectors[0][0], *vectors[0][2:]), (taps, 1, 1))
            self.assertEqual(len(vectors), 1 + all_taps + 2 * all_taps * SHARES + 67800)

    def test_its_mark_is_at_byte_16(self):
        self.succeed("lens", "buffer", "ideal", "-o", "lens.bin")
        self.assertEqual(self.content("lens.bin")[16:20], b"PZL2")
        x, y, distance, _ = self.vectors("ideal")[1]  # the tap in the middle is not moved by it
        self.assertLess(abs(x), 1e-6)
        self.assertEqual((y, distance), (0, 0))

    def test_weights_of_taps_sum_to_one(self):
        vectors = self.vectors("ideal", "--blades", "5")
        taps, weights = 48, 1 + self.all_taps(vectors)
        for side in range(2):
            for tap, count in [(spiral * taps, taps) for spiral in range(4)] + [(4 * taps, GRID)]:
                first = weights + (side * self.all_taps(vectors) + tap) * SHARES
                for share in (0, 20, 63):
                    for channel in range(4):
                        total = sum(vectors[first + i * SHARES + share][channel] for i in range(count))
                        self.assertAlmostEqual(total, 1, 4)

    def test_kernels_of_lamps_sum_to_one_and_have_their_radii(self):
        vectors = self.vectors("ideal")
        kernels = list(self.kernels_of_lamps(vectors))
        self.assertEqual(sum(len(kernel) for _, kernel in kernels) + len(kernels), 67800)
        for i, (radius, kernel) in enumerate(kernels):
            pixels = 0.5 * 2 ** (i % STEPS / 2)
            self.assertAlmostEqual(radius, pixels * (2 if pixels < 8.1 else 1), 4)
            for channel in range(4):
                self.assertAlmostEqual(sum(vector[channel] for vector in kernel), 1, 3)

    def test_a_lens_that_changes_over_the_frame_has_a_kernel_for_each_zone(self):
        vectors = self.vectors("ideal", "--cats-eye", "0.8", "--quality", "draft")
        self.assertEqual(vectors[0][2:], (9, 5))
        self.assertEqual(len(vectors), 1 + 168 + 45 * (2 * 168 * SHARES + 67800))
        middle, corner = ([kernel for _, kernel in self.kernels_of_lamps(vectors, zone)][-1] for zone in (22, 0))
        self.assertNotEqual(middle, corner)
        self.assertAlmostEqual(sum(vector[1] for vector in corner), 1, 3)
        upright = self.vectors("ideal", "--cats-eye", "0.8", "--quality", "draft", "--width", "90", "--height", "160")
        self.assertEqual(upright[0][2:], (5, 9))

    def test_bad_input_is_refused(self):
        self.refuse(2, "lens", "buffer", "ideal", says=["-o"])
        self.refuse(2, "lens", "buffer", "ideal", "-o", "lens.bin", "--quality", "best", says=["--quality", "draft"])
        self.refuse(2, "lens", "buffer", "no-such-lens", "-o", "lens.bin", says=["no-such-lens"])
        self.refuse(1, "lens", "buffer", "ideal", "-o", "no-folder/lens.bin", says=["no-folder"])


if __name__ == "__main__":
    unittest.main()
