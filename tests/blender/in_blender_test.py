"""The add-on inside Blender, without a window.

Usage: blender -b --factory-startup --python-exit-code 3 --python in_blender_test.py -- EXTENSION.zip ADDON.zip
   or: python3 in_blender_test.py -- EXTENSION.zip ADDON.zip    with the module bpy
"""
import math
import os
import pathlib
import sys
import tempfile
import types
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import bpy  # noqa: E402
import numpy as np  # noqa: E402

import installed  # noqa: E402
import scene as scenes  # noqa: E402

camera, exr, job, operators, versions = (installed.part(name) for name in ("camera", "exr", "job", "operators", "versions"))


def view_layer_of(scene):
    return scene.view_layers[0]


def result():
    """The image that the add-on made: (height, width, 4), rows top-down."""
    image = bpy.data.images["petzval"]
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], 4)[::-1].copy()


def psnr(a, b):
    """dB between two pictures after x / (1 + x), without alpha."""
    a, b = (v[..., :3] / (1 + v[..., :3]) for v in (a, b))
    return -10 * math.log10(((a - b) ** 2).mean())


def numbers(scene, unit_m=1.0):
    view_layer_of(scene).update()
    return camera.read(scene, view_layer_of(scene).depsgraph, unit_m)


class InBlender(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.scene = scenes.lamps()
        self.scene.render.filepath = self.path("out_")
        self.scene.render.image_settings.file_format = "PNG"

    def path(self, name):
        return os.path.join(self.folder, name)

    def still(self, **options):
        self.assertEqual(bpy.ops.petzval_lens.still(**options), {"FINISHED"})
        return result()

    def refused(self, pattern, operator="still"):
        with self.assertRaisesRegex(RuntimeError, pattern):
            getattr(bpy.ops.petzval_lens, operator)()

    def cycles_own(self, samples=128):
        """Cycles' own depth of field."""
        before, self.scene.cycles.samples = self.scene.cycles.samples, samples
        path = self.path("truth.exr")
        with versions.changed(versions.pass_file_values(self.scene, path)):
            bpy.ops.render.render(write_still=True)
        self.scene.cycles.samples = before
        channels = exr.read(path)
        return np.stack([channels[f"ViewLayer.Combined.{c}"] for c in "RGB"], -1).copy()


class Stills(InBlender):
    def post_in_front(self):
        """A second render shows what the post hides."""
        foreground = bpy.data.collections.new("foreground")
        foreground.objects.link(bpy.data.objects["post"])
        self.scene.petzval_lens.foreground = foreground

    def test_with_hidden_layers_the_picture_is_that_of_cycles_own_depth_of_field(self):
        self.post_in_front()
        dof = self.scene.camera.data.dof
        for blades, rotation, ratio in ((0, 0, 1), (5, 0.35, 2)):
            dof.aperture_blades, dof.aperture_rotation, dof.aperture_ratio = blades, rotation, ratio
            quality = psnr(self.still(), self.cycles_own())
            self.assertGreater(quality, 33, f"{blades} blades")

    def test_a_shifted_lens_leaves_no_dark_border(self):
        self.post_in_front()
        data = self.scene.camera.data
        data.shift_x, data.shift_y = 0.1, -0.05
        self.assertGreater(psnr(self.still(), self.cycles_own()), 29)

    def test_settings_have_their_old_values_afterwards(self):
        scene, layer, output = self.scene, view_layer_of(self.scene), self.scene.render.image_settings
        watched = [(scene.camera.data.dof, "use_dof"), (layer, "use_pass_z"), (output, "file_format"),
                   (output, "color_depth"), (scene.render, "filepath"), (scene.render, "use_compositing")]
        before = [getattr(*where) for where in watched]
        self.still()
        self.assertEqual([getattr(*where) for where in watched], before)
        self.assertTrue(scene.camera.data.dof.use_dof)
        self.scene.render.engine = "BLENDER_WORKBENCH"
        self.refused("no depth pass")
        self.assertEqual([getattr(*where) for where in watched], before)

    def test_hidden_layers_show_the_lamp_behind_the_post(self):
        truth = self.cycles_own()
        without = psnr(self.still(), truth)
        self.post_in_front()
        self.assertGreater(psnr(self.still(), truth), without + 3)
        self.assertTrue(bpy.data.objects["post"].visible_camera)

    def test_a_shipped_lens_changes_the_picture(self):
        ideal = self.still()
        self.scene.petzval_lens.lens = "doublet"
        self.assertGreater(float(np.abs(self.still() - ideal).max()), 0.05)

    def test_a_preset_is_its_look(self):
        ideal, choices = self.still(), self.scene.petzval_lens
        choices.preset = "achromat"
        by_name = self.still()
        self.assertGreater(float(np.abs(by_name - ideal).max()), 0.05)
        look = installed.part("library").petzval.Look.preset("achromat")
        pathlib.Path(self.path("look.json")).write_text(look.to_json())
        choices.preset, choices.look_file = "", self.path("look.json")
        np.testing.assert_array_equal(by_name, self.still())

    def test_the_lens_again_has_the_bits_of_a_new_render(self):
        self.still()
        dof = self.scene.camera.data.dof
        dof.aperture_fstop, dof.focus_distance = 2, 7
        self.assertEqual(bpy.ops.petzval_lens.develop(), {"FINISHED"})
        again = result()
        np.testing.assert_array_equal(again, self.still())

    def test_a_share_of_the_size_is_the_one_that_blender_renders(self):
        render = self.scene.render
        render.resolution_x, render.resolution_y, render.resolution_percentage = 160, 100, 29
        self.assertEqual(self.still().shape, (29, 46, 4))

    def test_it_appears_in_the_compositor_and_is_written(self):
        self.scene.petzval_lens.to_compositor = True
        self.still(write_still=True)
        tree = versions.compositor_tree(bpy, self.scene)
        end = versions.compositor_output(bpy, tree)
        self.assertEqual([link.from_node.name for link in tree.links if link.to_node == end], ["petzval"])
        self.assertTrue(os.path.exists(self.path("out_.png")))


class Cameras(InBlender):
    def test_the_sensor_is_as_wide_as_blenders_own_frustum(self):
        data, render = self.scene.camera.data, self.scene.render
        data.sensor_width, data.sensor_height = 30, 20
        for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
            for size in ((160, 90), (90, 160)):
                for aspect in ((1, 1), (2, 1), (1, 1.5)):
                    data.sensor_fit, (render.resolution_x, render.resolution_y) = fit, size
                    render.pixel_aspect_x, render.pixel_aspect_y = aspect
                    corners = data.view_frame(scene=self.scene)
                    wide = max(c.x for c in corners) - min(c.x for c in corners)
                    self.assertAlmostEqual(numbers(self.scene).sensor_width_mm, wide * data.lens / -corners[0].z,
                                           delta=1e-3, msg=f"{fit} {size} {aspect}")

    def test_a_shift_moves_the_axis_as_in_blenders_own_frustum(self):
        data, render = self.scene.camera.data, self.scene.render
        data.sensor_width, data.sensor_height, data.shift_x, data.shift_y = 30, 20, 0.1, -0.05
        for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
            for width, height in ((1600, 900), (900, 1600)):
                for aspect in ((1, 1), (2, 1), (1, 1.5)):
                    data.sensor_fit, render.resolution_x, render.resolution_y = fit, width, height
                    render.pixel_aspect_x, render.pixel_aspect_y = aspect
                    x, y = (sorted(getattr(corner, axis) for corner in data.view_frame(scene=self.scene)) for axis in "xy")
                    middle = (x[0] + x[3]) / 2 / (x[3] - x[0]) * width, -(y[0] + y[3]) / 2 / (y[3] - y[0]) * height
                    np.testing.assert_allclose(numbers(self.scene).shift_px, middle, atol=0.51, err_msg=f"{fit} {aspect}")

    def test_the_focus_bone_counts_as_posed_in_each_frame(self):
        rig = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
        self.scene.collection.objects.link(rig)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode="EDIT")
        bone = rig.data.edit_bones.new("tip")
        bone.head, bone.tail = (0, 4, 0), (0, 5, 0)
        bpy.ops.object.mode_set(mode="OBJECT")
        rig.location = (0, 1, 0)
        dof = self.scene.camera.data.dof
        dof.focus_object, dof.focus_subtarget = rig, "tip"
        for frame, y in ((1, 0), (11, 2)):
            rig.pose.bones["tip"].location = (0, y, 0)
            rig.pose.bones["tip"].keyframe_insert("location", frame=frame)
        for frame, distance in ((1, 5), (11, 7)):
            self.scene.frame_set(frame)
            self.assertAlmostEqual(numbers(self.scene).focus_distance_m, distance, delta=1e-5)

    def test_the_focus_object_counts_as_evaluated_in_each_frame(self):
        carrier, target = (bpy.data.objects.new(name, None) for name in ("carrier", "target"))
        for thing in (carrier, target):
            self.scene.collection.objects.link(thing)
        target.parent, target.location = carrier, (3, 1, 0)
        for frame, y in ((1, 2), (11, 12)):
            carrier.location = (0, y, 0)
            carrier.keyframe_insert("location", frame=frame)
        self.scene.camera.data.dof.focus_object = target
        seen = []
        for frame in (1, 11):
            self.scene.frame_set(frame)
            seen.append(numbers(self.scene).focus_distance_m)
        np.testing.assert_allclose(seen, (3, 13), rtol=1e-5)  # along the axis, not to the point 3 beside it

    def test_focus_on_the_visible_surface_is_nearer_than_the_origin(self):
        self.scene.camera.data.dof.focus_object = bpy.data.objects["post"]
        self.scene.petzval_lens.focus = "SURFACE"
        self.still()
        self.assertAlmostEqual(job.Kept.numbers.focus_distance_m, 1.5, delta=0.01)
        self.assertAlmostEqual(numbers(self.scene).focus_distance_m, 1.54, delta=1e-5)

    def test_the_unit_scale_gives_metres(self):
        self.scene.unit_settings.scale_length = 0.1
        self.still()
        self.assertAlmostEqual(job.Kept.numbers.focus_distance_m, 0.15, delta=1e-6)
        self.scene.petzval_lens.unit = "METRE"
        self.still()
        self.assertAlmostEqual(job.Kept.numbers.focus_distance_m, 1.5, delta=1e-6)


class Animations(InBlender):
    def test_24_frames_are_written_and_existing_ones_can_stay(self):
        self.scene.frame_start, self.scene.frame_end, self.scene.frame_step = 1, 47, 2
        dof = self.scene.camera.data.dof
        for frame, distance in ((1, 1.5), (47, 12)):
            dof.focus_distance = distance
            dof.keyframe_insert("focus_distance", frame=frame)
        self.assertEqual(bpy.ops.petzval_lens.animation(), {"FINISHED"})
        names = [f"out_{frame:04}.png" for frame in range(1, 48, 2)]
        self.assertEqual(sorted(os.listdir(self.folder)), names)
        contents = [pathlib.Path(self.path(name)).read_bytes() for name in names]
        self.assertEqual(len(set(contents)), 24)
        pathlib.Path(self.path(names[1])).write_bytes(b"mine")
        self.scene.render.use_overwrite = False
        bpy.ops.petzval_lens.animation()
        self.assertEqual(pathlib.Path(self.path(names[1])).read_bytes(), b"mine")

    def test_a_cancelled_animation_keeps_its_frames_and_restores_the_settings(self):
        scene, layer = self.scene, view_layer_of(self.scene)
        scene.frame_start, scene.frame_end = 1, 5
        scene.frame_set(3)
        watched = [(scene.camera.data.dof, "use_dof"), (layer, "use_pass_z"), (scene.render, "filepath"),
                   (scene.render.image_settings, "file_format"), (scene, "frame_current")]
        before = [getattr(*where) for where in watched]
        for kind, finished in ((job.Render, ["out_0001.png", "out_0002.png"]), (job.Defocus, ["out_0001.png"])):
            steps = job.animation(scene, layer, scene.petzval_lens.wish(scene), lambda *_: None)
            for step in steps:
                if isinstance(step, kind) and sorted(os.listdir(self.folder)) == finished:
                    break
                step.start(waiting=True)
            steps.close()  # as Escape does
            self.assertEqual([getattr(*where) for where in watched], before)
            self.assertEqual(sorted(os.listdir(self.folder)), finished)
            for name in finished:
                os.remove(self.path(name))

    def test_the_camera_may_change_by_markers(self):
        other = bpy.data.objects.new("Wide", self.scene.camera.data.copy())
        other.data.lens, other.rotation_euler = 35, self.scene.camera.rotation_euler
        self.scene.collection.objects.link(other)
        for frame, thing in ((1, self.scene.camera), (2, other)):
            self.scene.timeline_markers.new(f"cut {frame}", frame=frame).camera = thing
        self.scene.frame_start = self.scene.frame_end = 2
        self.assertEqual(bpy.ops.petzval_lens.animation(), {"FINISHED"})
        self.assertAlmostEqual(job.Kept.numbers.focal_length_mm, 35)

    def test_a_film_is_refused(self):
        output = self.scene.render.image_settings
        if hasattr(output, "media_type"):
            output.media_type = "VIDEO"
        output.file_format = "FFMPEG"
        self.refused("a picture per frame", "animation")


class Refusals(InBlender):
    def test_cameras_without_a_lens_by_name(self):
        for kind, name in (("ORTHO", "orthographic"), ("PANO", "panoramic")):
            self.scene.camera.data.type = kind
            self.refused(f"Camera is an? {name} camera")

    def test_scenes_that_cannot_be_rendered(self):
        self.scene.render.use_border = True
        self.refused("render region")
        self.scene.render.use_border = False
        self.scene.render.use_multiview = True
        self.refused("stereoscopy")
        self.scene.render.use_multiview = False
        self.scene.camera.data.dof.focus_object = self.scene.camera
        self.refused("own plane")
        self.scene.camera = None
        self.refused("no camera")

    def test_wrong_choices(self):
        choices = self.scene.petzval_lens
        choices.lens = "no such lens"
        self.refused("no such lens")
        choices.lens = ""
        pathlib.Path(self.path("look.json")).write_text("{ broken")
        choices.look_file = self.path("look.json")
        self.refused("look.json cannot be read: is not JSON")
        choices.look_file = self.path("missing.json")
        self.refused("No such file")
        choices.preset = "night"
        self.refused("both given")
        choices.look_file, choices.preset = "", "nigt"
        self.refused("did you mean night.*there are .*portrait")
        choices.preset, choices.focus = "", "SURFACE"
        self.refused("needs a focus object")
        hidden = bpy.data.objects.new("hidden", None)
        self.scene.collection.objects.link(hidden)
        hidden.location = (0, 3, 0)
        self.scene.camera.data.dof.focus_object = hidden
        self.refused("not in sight")

    def test_what_petzval_refuses_is_refused_before_the_render(self):
        renders, choices = [], self.scene.petzval_lens
        bpy.app.handlers.render_pre.append(lambda *_: renders.append(1))
        self.addCleanup(bpy.app.handlers.render_pre.clear)
        choices.lens = "no such lens"
        self.refused("no such lens")
        choices.lens = "petzval-portrait"
        self.refused("this lens opens to 3.6")
        choices.lens, self.scene.camera.data.dof.aperture_fstop = "", 0.02
        self.refused("must be 0.1 or more")
        self.scene.camera.data.dof.aperture_fstop, choices.focus = 2, "SURFACE"
        self.refused("needs a focus object")
        self.assertEqual(renders, [])

    def test_a_file_that_cannot_be_written_by_its_path(self):
        self.scene.render.filepath = "/proc/petzval/out_"
        self.scene.frame_end = self.scene.frame_start
        self.refused("/proc/petzval/out_0001.png cannot be written: ", "animation")

    def test_nothing_to_take_again(self):
        job.Kept.forget()
        self.refused("nothing has been rendered", "develop")

    def test_a_damaged_file_of_passes(self):
        self.scene.petzval_lens.keep_passes = True
        self.still()
        path = self.path("out_0001_passes.exr")
        whole = pathlib.Path(path).read_bytes()
        refused = installed.part("refused").Refused
        for cut in (b"", whole[:6], whole[:300], whole[:-1000]):
            pathlib.Path(self.path("cut.exr")).write_bytes(cut)
            with self.assertRaises(refused):
                exr.read(self.path("cut.exr"))


class Windows(unittest.TestCase):
    def test_image_editors_that_show_the_render_show_the_picture(self):
        def editor(image, kind="IMAGE_EDITOR"):
            return types.SimpleNamespace(type=kind, spaces=types.SimpleNamespace(active=types.SimpleNamespace(image=image)))
        render, other = types.SimpleNamespace(type="RENDER_RESULT"), types.SimpleNamespace(type="IMAGE")
        areas = [editor(render), editor(other), editor(None), editor(render, "VIEW_3D")]
        installed.part("compositor").reveal([types.SimpleNamespace(areas=areas)], "petzval")
        self.assertEqual([area.spaces.active.image for area in areas], ["petzval", other, None, render])

    def test_escape_during_a_render_ends_what_follows(self):
        ended, context = [], types.SimpleNamespace(workspace=types.SimpleNamespace(status_text_set=lambda _: None))
        running = types.SimpleNamespace(_escaped=False, _steps=iter([job.Step()]), _end=lambda _, why: ended.append(why))
        operators.Now.step = job.Step()
        self.addCleanup(setattr, operators.Now, "step", None)
        for kind in ("ESC", "TIMER"):
            operators.Stepped.modal(running, context, types.SimpleNamespace(type=kind))
        self.assertEqual(ended, ["cancelled"])


class Program(InBlender):
    def test_petzval_view_opens_the_passes_through_the_same_lens(self):
        if not hasattr(bpy.types, "PETZVAL_LENS_OT_view"):
            self.skipTest("the extension starts no other program")
        self.scene.petzval_lens.lens, self.scene.camera.data.dof.aperture_blades = "doublet", 6
        self.still()
        view = installed.part("view_program")
        with unittest.mock.patch.object(view.shutil, "which", return_value="/bin/petzval"), \
                unittest.mock.patch.object(view.subprocess, "Popen") as started:
            self.assertEqual(bpy.ops.petzval_lens.view(), {"FINISHED"})
        words = started.call_args[0][0]
        look = installed.part("library").petzval.Look.from_json(
            pathlib.Path(words[words.index("--look") + 1]).read_text())
        self.assertEqual((look["lens.name"], look["lens.blades"]), ("doublet", 6))
        self.assertTrue(os.path.exists(words[2]))


class Threads(InBlender):
    def test_a_frame_in_a_thread_is_cancelled_with_progress(self):
        self.still()
        wish = self.scene.petzval_lens.wish(self.scene)
        passes, petzval = installed.part("passes"), installed.part("library").petzval
        step = job.Defocus(job.Kept.session_of(1), passes.shot(job.Kept.numbers, job.Kept.front), job.look_of(
            wish, job.Kept.numbers))
        told, report = [], step._report
        step._report = lambda share: (told.append(share), report(share), False)[2]
        step.start(waiting=True)
        with self.assertRaises(petzval.Cancelled):
            step.frame()
        self.assertTrue(told)


if __name__ == "__main__":
    done = unittest.main(argv=["in_blender_test", "-v"], exit=False).result
    sys.stdout.flush()
    raise SystemExit(not done.wasSuccessful())
