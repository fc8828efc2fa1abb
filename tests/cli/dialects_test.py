"""Camera numbers in files with the headers that renderers write: names, types and units of each.

No renderer of these but Blender runs here. Sources: 3Delight 2.1.23, a listing by exrheader in github
johannesvollmer/exrs#90; V-Ray 3 for 3ds Max, throb/vfxpipe#6; Redshift and Arnold, names and use in public scripts
for Nuke (metadataToCamera and others); Unreal, the names in Epic's page on the render passes of Movie Render Queue;
Blender, files of its own with stamped metadata.
"""
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import unittest

from pictures import attribute, picture, write_exr
from program import CommandLineTest

UNIT_MATRIX = struct.pack("<16f", *(float(i % 5 == 0) for i in range(16)))


def number(name, value):
    return attribute(name, "float", struct.pack("<f", value))


def pair(name, x, y):
    return attribute(name, "v2f", struct.pack("<2f", x, y))


def matrix(name):
    return attribute(name, "m44f", UNIT_MATRIX)


def text(name, value):
    return attribute(name, "string", value.encode())


# name: (attributes, flags that the user adds, focal length, sensor width, f-number, focus distance)
FILES = {
    "3Delight": (number("far", 1e38) + number("fieldOfViewHorizontal", 45.6036) + number("fieldOfViewVertical", 35)
                 + number("near", 0.001) + text("software", '3Delight 2.1.23 darwin-x86_64 "Re-Animator"')
                 + matrix("worldToCamera") + matrix("worldToNDC"),
                 ["--sensor-width", "36", "--fstop", "2", "--focus", "3"],
                 18 / math.tan(math.radians(45.6036 / 2)), 36, 2, 3),
    "V-Ray for Maya": (number("cameraAperture", 36) + number("cameraFNumber", 8) + number("cameraFocalLength", 40)
                       + number("cameraFov", 48.4555) + number("cameraNearClip", 0) + number("cameraFarClip", 1e18)
                       + number("cameraTargetDistance", 120) + matrix("cameraTransform"),
                       ["--unit-scale", "1cm"], 40, 36, 8, 1.2),
    "V-Ray 3 for 3ds Max": (number("cameraAperture", 36) + number("cameraFov", 39.5978) + number("cameraTargetDistance", 1e18)
                            + matrix("cameraTransform"), ["--fstop", "2.8", "--focus", "2"], 50, 36, 2.8, 2),
    "Arnold": (number("CameraFilmApertureHorizontal", 24.6) + number("CameraFilmApertureVertical", 18.45)
               + number("CameraFocalLength", 35) + number("arnold/camera/near_clip", 0.1)
               + number("arnold/camera/far_clip", 1e4) + matrix("worldToCamera"),
               ["--fstop", "4", "--focus", "5"], 35, 24.6, 4, 5),
    "Redshift for Maya": (pair("rs/camera/aperture", 36 / 25.4, 24 / 25.4) + number("rs/camera/aspect", 1.5)
                          + number("rs/camera/fov", 39.5978) + number("rs/camera/FStop", 5.6)
                          + number("rs/camera/DOFFocusDistance", 210) + number("rs/camera/nearPlane", 0.1)
                          + number("rs/camera/farPlane", 1e4) + matrix("rs/camera/transform"),
                          ["--unit-scale", "1cm"], 50, 36, 5.6, 2.1),
    "Unreal": (text("unreal/camera/FinalImage/focalDistance", "320.0") + text("unreal/camera/FinalImage/focalLength", "35.0")
               + text("unreal/camera/FinalImage/fov", "37.4") + text("unreal/camera/FinalImage/fstop", "2.8")
               + text("unreal/camera/FinalImage/sensorWidth", "23.76"),
               ["--unit-scale", "1cm"], 35, 23.76, 2.8, 3.2),
    "Blender": (text("Camera", "Camera") + text("Frame", "001") + text("Lens", "85.00") + text("Scene", "Scene")
                + text("RenderTime", "00:03.71"), ["--sensor-width", "36", "--fstop", "2", "--focus", "3"], 85, 36, 2, 3),
}


# Blender's own render of its first scene, with the lens in the metadata.
IN_BLENDER = """
import bpy, sys
scene = bpy.context.scene
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 16, 9, 100
scene.camera.data.lens, scene.view_layers[0].use_pass_z = 85, True
scene.render.use_stamp_lens, scene.render.metadata_input = True, "SCENE"
scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
scene.render.filepath = sys.argv[-1]
bpy.ops.render.render(write_still=True)
"""


class Dialects(CommandLineTest):
    @unittest.skipUnless(shutil.which("blender"), "blender is not installed")
    def test_a_file_that_blender_has_written(self):
        pathlib.Path(self.path("render.py")).write_text(IN_BLENDER)
        # Debian's Blender takes its Python from the PATH: another python3 there has no numpy.
        subprocess.run(["blender", "-b", "--factory-startup", "--python-exit-code", "3", "--python", self.path("render.py"),
                        "--", self.path("blender.exr")], check=True, stdout=subprocess.DEVNULL, timeout=200,
                       env={**os.environ, "PATH": "/usr/bin:/bin"})
        self.assertIn("focal length    85 mm  (Blender Lens)", self.succeed("inspect", "blender.exr").out)

    def test_each_renderers_file_gives_its_camera(self):
        for renderer, (attributes, flags, *camera) in FILES.items():
            with self.subTest(renderer):
                write_exr(self.path("in.exr"), picture(40, 30, 0.5, 300 if "1cm" in flags else 3, 1), half="RGBA",
                          attributes=attributes)
                self.succeed("defocus", "in.exr", "-o", "out.exr", "--json", "report.json", "--overwrite", *flags)
                with open(self.path("report.json")) as file:
                    found = json.load(file)["camera"]
                for name, expected in zip(("focal_length_mm", "sensor_width_mm", "f_number", "focus_distance_m"), camera):
                    self.assertAlmostEqual(found[name], expected, delta=1e-4 * expected, msg=f"{renderer}: {name}")

    def test_the_metadata_stays_in_the_result(self):
        attributes, flags = FILES["Redshift for Maya"][:2]
        write_exr(self.path("in.exr"), picture(40, 30, 0.5, 300, 1), attributes=attributes)
        self.succeed("defocus", "in.exr", "-o", "out.exr", *flags)
        with open(self.path("out.exr"), "rb") as file:
            written = file.read()
        self.assertIn(pair("rs/camera/aperture", 36 / 25.4, 24 / 25.4), written)


if __name__ == "__main__":
    unittest.main()
