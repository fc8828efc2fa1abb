"""Parts of the add-on for Blender beside stand-ins of its old and new forms: for versions that cannot be installed.

The stand-ins follow docs.blender.org/api, "Change Log", of 3.4 to 5.1: names, and which values exclude each other.
"""
import math
import pathlib
import struct
import sys
import tempfile
import types
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "plugins/blender"))
from petzval_lens import camera, cryptomatte, exr, refused, versions  # noqa: E402


class Rna:
    """An object that has the given properties and no others, as Blender's have."""

    def __init__(self, **properties):
        self.__dict__.update(properties)

    def __setattr__(self, name, value):
        if name not in self.__dict__:
            raise AttributeError(f"no property {name}")
        self.__dict__[name] = value


class Output3(Rna):
    """Image settings up to 4.5."""

    def __init__(self):
        super().__init__(file_format="PNG", color_depth="8", exr_codec="ZIP")

    def allowed(self):
        return {"PNG", "OPEN_EXR", "OPEN_EXR_MULTILAYER", "FFMPEG"}

    def __setattr__(self, name, value):
        if name == "file_format" and value not in self.allowed():
            raise TypeError(f"enum {value} not found")
        super().__setattr__(name, value)
        if name == "file_format" and value == "PNG" and self.color_depth == "32":
            self.__dict__["color_depth"] = "8"


class Output5(Output3):
    """Image settings of 5.0 and later: the kind of output limits the formats."""

    def __init__(self):
        super().__init__()
        self.__dict__.update(media_type="IMAGE", use_exr_interleave=False)

    def allowed(self):
        return {"IMAGE": {"PNG", "OPEN_EXR"}, "MULTI_LAYER_IMAGE": {"OPEN_EXR_MULTILAYER"},
                "VIDEO": {"FFMPEG"}}[self.media_type]

    def __setattr__(self, name, value):
        super().__setattr__(name, value)
        if name == "media_type":
            self.__dict__["file_format"] = sorted(self.allowed())[0]


def scene_of(output, **render):
    defaults = {"filepath": "//", "use_file_extension": False, "use_overwrite": False, "use_placeholder": True,
                "resolution_x": 1920, "resolution_y": 1080, "resolution_percentage": 100, "pixel_aspect_x": 1,
                "pixel_aspect_y": 1}
    return Rna(render=Rna(image_settings=output, **{**defaults, **render}), camera=None)


class Versions(unittest.TestCase):
    def test_passes_are_written_uncompressed_and_settings_come_back_in_both_forms(self):
        for output in (Output3(), Output5()):
            scene = scene_of(output)
            before = dict(output.__dict__), dict(scene.render.__dict__)
            with versions.changed(versions.pass_file_values(scene, "/tmp/passes.exr")):
                self.assertEqual((output.file_format, output.color_depth, output.exr_codec),
                                 ("OPEN_EXR_MULTILAYER", "32", "NONE"))
                self.assertEqual(scene.render.filepath, "/tmp/passes.exr")
                self.assertTrue(output.__dict__.get("use_exr_interleave", True))
            self.assertEqual((output.__dict__, scene.render.__dict__), before)

    def test_settings_come_back_after_a_failure_too(self):
        output = Output5()
        before = dict(output.__dict__)
        values = versions.pass_file_values(scene_of(output), "x") + [(output, "no_such_property", 1)]
        with self.assertRaises(AttributeError), versions.changed(values):
            self.fail("it was entered")
        with self.assertRaisesRegex(ZeroDivisionError, "planted"), versions.changed(values[:-1]):
            raise ZeroDivisionError("planted")
        self.assertEqual(output.__dict__, before)

    def test_a_multilayer_output_saves_single_pictures(self):
        for output in (Output3(), Output5()):
            self.assertEqual(versions.picture_file_values(scene_of(output)), [])
            if hasattr(output, "media_type"):
                output.media_type = "MULTI_LAYER_IMAGE"
            output.file_format = "OPEN_EXR_MULTILAYER"
            with versions.changed(versions.picture_file_values(scene_of(output))):
                self.assertEqual(output.file_format, "OPEN_EXR")
            self.assertEqual(output.file_format, "OPEN_EXR_MULTILAYER")

    def test_films_are_recognised_in_both_forms(self):
        old, new = scene_of(Output3(), is_movie_format=True), scene_of(Output5())
        new.render.image_settings.media_type = "VIDEO"
        self.assertTrue(versions.writes_movies(old) and versions.writes_movies(new))
        self.assertFalse(versions.writes_movies(scene_of(Output3(), is_movie_format=False)))
        self.assertFalse(versions.writes_movies(scene_of(Output5())))

    def test_the_compositing_nodes_of_both_forms(self):
        nodes = types.SimpleNamespace(new=lambda kind: made.append(kind))
        made, sockets = [], []
        tree = types.SimpleNamespace(nodes=nodes, interface=types.SimpleNamespace(
            new_socket=lambda name, **how: sockets.append((name, how))))
        old = Rna(use_nodes=False, node_tree=tree)
        self.assertIs(versions.compositor_tree(None, old), tree)
        self.assertTrue(old.use_nodes)
        new = Rna(compositing_node_group=None)  # has no node_tree
        bpy = types.SimpleNamespace(data=types.SimpleNamespace(node_groups=types.SimpleNamespace(
            new=lambda name, kind: tree)))
        self.assertIs(versions.compositor_tree(bpy, new), tree)
        self.assertIs(new.compositing_node_group, tree)
        self.assertEqual((made, [name for name, _ in sockets]), (["NodeGroupOutput"], ["Image"]))


class Cameras(unittest.TestCase):
    def scene(self, kind):
        scene = scene_of(Output5())
        thing = Rna(name="Cam", data=Rna(type=kind))
        thing.__dict__["evaluated_get"] = lambda depsgraph: thing
        scene.camera = thing
        return scene

    def test_every_kind_without_a_lens_is_refused_by_name(self):
        for kind, name in (("ORTHO", "orthographic"), ("PANO", "panoramic"), ("CUSTOM", "own shader"), ("NEW", "NEW")):
            with self.assertRaisesRegex(refused.Refused, name):
                camera.read(self.scene(kind), None)


    def test_the_size_in_whole_numbers(self):
        for width, height, percent, size in ((1280, 720, 70, (896, 504)), (100, 101, 29, (29, 29)), (3, 3, 50, (1, 1))):
            render = Rna(resolution_x=width, resolution_y=height, resolution_percentage=percent)
            self.assertEqual(camera.size(render), size)


class Reasons(unittest.TestCase):
    def test_one_line_says_what_failed_and_what_to_change(self):
        # As Debian's Blender 3.4.1 raises them.
        self.assertEqual(refused.reason(RuntimeError("Error: Build without OpenImageDenoiser\n")),
                         "Build without OpenImageDenoiser; switch off Denoise in the panel Sampling")
        self.assertEqual(refused.reason(RuntimeError("Error: Could not write image: Invalid argument\nError: Image …\n")),
                         "Could not write image: Invalid argument")
        self.assertEqual(refused.reason(RuntimeError()), "Blender gives no reason")


class Cryptomattes(unittest.TestCase):
    def test_published_hashes(self):  # en.wikipedia.org/wiki/MurmurHash, "Test vectors"
        for text, seed, value in ((b"", 0, 0), (b"", 1, 0x514E28B7), (b"test", 0, 0xBA6BD213),
                                  (b"Hello, world!", 0, 0xC0363E43),
                                  (b"The quick brown fox jumps over the lazy dog", 0, 0x2E4FF723)):
            self.assertEqual(cryptomatte.murmur3(text, seed), value, text)

    def test_an_identifier_is_a_normal_number(self):
        for i in range(3000):
            value, = struct.unpack("<f", struct.pack("<I", cryptomatte.identifier(f"thing {i}")))
            self.assertTrue(math.isfinite(value) and abs(value) >= 2 ** -126)

    def test_the_median_depth_of_an_object(self):
        who = np.full((1, 4), np.uint32(cryptomatte.identifier("post"))).view(np.float32)
        channels = {"L.CryptoObject00.r": who, "L.CryptoObject00.g": np.float32([[1, 0.2, 1, 1]]),
                    "L.CryptoObject00.b": who * 0, "L.CryptoObject00.a": np.float32([[0, 0, 0, 0]])}
        depth = np.float32([[2, 99, 4, 3]])
        self.assertEqual(cryptomatte.median_depth(channels, "L", "post", depth), 3)
        self.assertIsNone(cryptomatte.median_depth(channels, "L", "wall", depth))


class Files(unittest.TestCase):
    def written(self, names, rows, compression=0, version=2):
        """An EXR of float channels, 2 x 2; rows: bytes of each scan line."""
        def attribute(name, kind, data):
            return f"{name}\0{kind}\0".encode() + struct.pack("<I", len(data)) + data
        channels = b"".join(n.encode() + b"\0" + struct.pack("<IIII", 2, 0, 1, 1) for n in names) + b"\0"
        head = struct.pack("<II", 20000630, version) + attribute("channels", "chlist", channels)
        head += attribute("compression", "compression", bytes([compression]))
        head += attribute("dataWindow", "box2i", struct.pack("<4i", 0, 0, 1, 1)) + b"\0" + bytes(16)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "passes.exr"
        path.write_bytes(head + b"".join(struct.pack("<ii", y, len(row)) + row for y, row in enumerate(rows)))
        return path

    def test_rows_and_channels(self):
        rows = [struct.pack("<4f", 1, 2, 10, 20), struct.pack("<4f", 3, 4, 30, 40)]
        read = exr.read(self.written(["L.A", "L.B"], rows))
        np.testing.assert_array_equal(read["L.A"], [[1, 2], [3, 4]])
        np.testing.assert_array_equal(read["L.B"], [[10, 20], [30, 40]])

    def test_other_files_are_refused(self):
        rows = [struct.pack("<2f", 1, 2)] * 2
        for path in (self.written(["A"], rows, compression=3), self.written(["A"], rows[:1]),
                     self.written(["A"], rows, version=0x1002), self.written(["A"], [rows[0], b""])):
            with self.assertRaises(refused.Refused):
                exr.read(path)


if __name__ == "__main__":
    unittest.main(verbosity=2)
