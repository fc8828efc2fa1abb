"""petzval lens atlas: its texels are the discs of lens psf, and bad input leaves nothing behind."""
import json
import os
import struct
import unittest

from pictures import read_exr
from program import CommandLineTest

SIDE = 31


class LensAtlas(CommandLineTest):
    def atlas(self, lens, *flags):
        """(header, texels as rows of (r, g, b), divided by the texels of a tile as the page says)."""
        self.succeed("lens", "atlas", lens, "-o", "atlas", *flags)
        header = json.loads(self.content("atlas/atlas.json"))
        words = struct.iter_unpack("<I", self.content("atlas/atlas.bin"))
        light = [tuple((w >> s & 511) * 2.0 ** ((w >> 27) - 24) / SIDE ** 2 for s in (0, 9, 18)) for (w,) in words]
        across = header["texels"]["width"]
        return header, [light[i:i + across] for i in range(0, len(light), across)]

    def tile(self, texels, zone, radius):
        return [row[radius * SIDE:(radius + 1) * SIDE] for row in texels[zone * SIDE:(zone + 1) * SIDE]]

    def test_a_file_in_the_place_of_the_folder_is_refused_before_work_begins(self):
        with open(self.path("taken"), "w") as file:
            file.write("kept")
        outcome = self.refuse(1, "lens", "atlas", "doublet", "-o", "taken", says=["-o taken", "must be a folder"])
        self.assertNotIn("progress", outcome.err)
        self.assertEqual(self.content("taken"), b"kept")

    def test_the_header_tells_what_a_reader_needs(self):
        header, texels = self.atlas("doublet", "--zones", "3", "--defocus", "40")
        self.assertEqual([header["format"], header["version"]], ["petzval lens atlas", 1])
        self.assertEqual(header["zones"], [0, 0.5, 1])
        self.assertEqual(header["camera"]["focal_length_mm"], 50)
        self.assertEqual((len(texels), len(texels[0])), (header["texels"]["height"], header["texels"]["width"]))
        radii = header["radii_px"]
        self.assertEqual(radii, sorted(radii))
        self.assertEqual((len(radii), radii[0], radii[-1]), (14, -40, 40))
        self.assertAlmostEqual(radii[7], 40 / 13 ** 2)

    def test_the_sums_are_those_of_the_texels(self):
        header, texels = self.atlas("doublet", "--coma", "1", "--zones", "2")
        for zone in range(2):
            for radius in range(14):
                tile = self.tile(texels, zone, radius)
                for c in range(3):
                    total = sum(texel[c] for row in tile for texel in row)
                    self.assertAlmostEqual(header["sums"][zone][radius][c], total, 9)
                    self.assertLess(total, 1.01)
                    self.assertGreater(total, 0.97 if c == 1 else 0.8)  # what is lost is measured in green

    def test_a_tile_is_the_disc_of_lens_psf(self):
        header, texels = self.atlas("petzval-portrait", "--zones", "3")
        for zone, radius in ((0, 0), (0, 13), (0, 8), (2, 1), (1, 12), (2, 6)):
            coc_px = header["radii_px"][radius]
            finer = SIDE / header["sides_px"][zone][radius]
            width = round(1920 * finer)
            place = "%g,0" % header["zones"][zone]
            self.succeed("lens", "psf", "petzval-portrait", "-o", "psf.exr", "--size", str(SIDE), "--width", str(width),
                         "--height", str(round(1080 * finer)), "--defocus", repr(coc_px * width / 1920), "--field", place)
            disc = read_exr(self.path("psf.exr"))[0]
            for c, name in enumerate("RGB"):
                expected = disc[name]
                most = max(max(row) for row in expected)
                for row, theirs in zip(self.tile(texels, zone, radius), expected):
                    for texel, value in zip(row, theirs):
                        # Half a step of nine bits, of a texel's brightest colour.
                        self.assertLess(abs(texel[c] - value), 1.01 * max(max(texel), most / 8) / 512)

    def test_zone_and_aperture_change_it_and_one_zone_takes_blades(self):
        _, texels = self.atlas("doublet", "--cats-eye", "0.8", "--zones", "2")
        self.assertNotEqual(self.tile(texels, 0, 13), self.tile(texels, 1, 13))
        _, stopped = self.atlas("doublet", "--cats-eye", "0.8", "--zones", "2", "--fstop", "8")
        self.assertNotEqual(texels, stopped)
        _, round_disc = self.atlas("doublet", "--zones", "1")
        _, blades = self.atlas("doublet", "--zones", "1", "--blades", "5")
        self.assertNotEqual(round_disc, blades)

    def test_an_atlas_that_is_there_is_kept_when_asked(self):
        self.atlas("ideal", "--zones", "1")
        before = self.content("atlas/atlas.bin")
        self.succeed("lens", "atlas", "doublet", "-o", "atlas", "--zones", "1", "--no-clobber")
        self.assertEqual(self.content("atlas/atlas.bin"), before)

    def test_bad_input_is_refused(self):
        atlas = ("lens", "atlas", "doublet", "-o", "atlas")
        self.refuse(2, "lens", "atlas", "doublet", says=["-o"])
        self.refuse(2, *atlas, "--zones", "65", says=["--zones"])
        self.refuse(2, *atlas, "--zones", "0", says=["--zones"])
        self.refuse(2, *atlas, "--blades", "5", says=["--blades", "--zones 1"])
        self.refuse(2, *atlas, "--zones", "1", "--cats-eye", "0.5", says=["--cats-eye", "--zones 1"])
        self.refuse(2, *atlas, "--defocus", "1e9", says=["--defocus"])
        self.refuse(2, "lens", "atlas", "no-such-lens", "-o", "atlas", says=["no-such-lens"])
        with open(self.path("atlas"), "w", encoding="utf8") as file:
            file.write("a file")
        self.refuse(1, *atlas, "--zones", "1", says=["atlas"])
        os.remove(self.path("atlas"))


if __name__ == "__main__":
    unittest.main()
