"""The gallery picture: Cycles' own depth of field, petzval's, the difference; both times. A film of 24 frames.

Usage: … gallery_in_blender.py -- EXTENSION.zip ADDON.zip picture|film|lens FOLDER, as in_blender_test.py
"""
import colorsys
import math
import os
import pathlib
import random
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import bpy  # noqa: E402
import numpy as np  # noqa: E402

import installed  # noqa: E402
import scene as scenes  # noqa: E402

FOLDER = sys.argv[-1]
exr, versions = installed.part("exr"), installed.part("versions")


def matt(name, rgb):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    principled = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    principled.inputs["Base Color"].default_value = (*rgb, 1)
    principled.inputs["Roughness"].default_value = 1
    return material


def market():
    """A row of balls on a table at dusk, with strings of lamps behind."""
    scene = scenes.empty()
    scenes.place_camera(scene, lens=50, fstop=1.4, focus=1.2)
    scene.camera.location = (0, 0, 0.25)
    scene.camera.rotation_euler = (math.radians(86), 0, 0)
    scene.world = bpy.data.worlds.new("dusk")
    scene.world.use_nodes = True
    background = next(n for n in scene.world.node_tree.nodes if n.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0.10, 0.14, 0.25, 1)
    scenes.thing(scene, "table", "plane", matt("wood", (0.30, 0.2, 0.12)), size=8, location=(0, 4, 0))
    scenes.thing(scene, "wall", "plane", matt("wall", (0.25, 0.25, 0.3)), size=40, location=(0, 9, 0),
                 rotation=(math.pi / 2, 0, 0))
    for i, (x, y) in enumerate([(-0.17, 0.8), (0.03, 1.2), (0.22, 1.7), (-0.25, 2.4), (0.55, 3.2), (-0.9, 4.2)]):
        scenes.thing(scene, f"ball{i}", "uv_sphere", matt(f"ball{i}", colorsys.hsv_to_rgb(i / 6, 0.7, 0.8)), radius=0.09,
                     segments=48, ring_count=24, location=(x, y, 0.09))
        bpy.ops.object.shade_smooth()
    chance = random.Random(4)
    for i in range(40):
        rgb = colorsys.hsv_to_rgb(chance.choice((0.07, 0.09, 0.12, 0.55, 0.95)), 0.7, 1)
        scenes.thing(scene, f"lamp{i}", "uv_sphere", scenes.shining(f"lamp{i}", rgb, 150), radius=0.015, segments=12,
                     ring_count=8, location=(chance.uniform(-3, 3), chance.uniform(5, 8.5), chance.uniform(0.2, 2.2)))
    light = bpy.data.objects.new("light", bpy.data.lights.new("light", "AREA"))
    light.data.energy, light.data.size, light.location = 30, 1, (-1, 0.5, 2)
    light.rotation_euler = (math.radians(25), math.radians(-25), 0)
    scene.collection.objects.link(light)
    scene.render.resolution_x, scene.render.resolution_y = 480, 270
    return scene


def timed(call):
    """The result, elapsed and CPU seconds."""
    wall, cpu = time.monotonic(), time.process_time()
    made = call()
    return made, time.monotonic() - wall, time.process_time() - cpu


def cycles(scene, samples):
    scene.cycles.samples = samples
    path = os.path.join(FOLDER, "cycles.exr")
    with versions.changed(versions.pass_file_values(scene, path)):
        bpy.ops.render.render(write_still=True)
    channels = exr.read(path)
    return np.stack([channels[f"ViewLayer.Combined.{c}"] for c in "RGB"], -1).copy()


def ours(scene, samples):
    scene.cycles.samples = samples
    bpy.ops.petzval_lens.still()
    image = bpy.data.images["petzval"]
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], 4)[::-1, :, :3].copy()


def save(name, rgb):
    """Linear light to sRGB, JPEG."""
    height, width = rgb.shape[:2]
    image = bpy.data.images.new(name, width, height, float_buffer=False)
    rgb = np.clip(rgb, 0, 1)
    codes = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1 / 2.4) - 0.055)
    pixels = np.concatenate([codes, np.ones((height, width, 1))], -1)[::-1].astype(np.float32)
    image.pixels.foreach_set(np.ascontiguousarray(pixels).ravel())
    image.filepath_raw, image.file_format = os.path.join(FOLDER, name), "JPEG"
    image.save()


def compare():
    scene = market()
    front = bpy.data.collections.new("front")
    for i in range(3):
        front.objects.link(bpy.data.objects[f"ball{i}"])
    truth, *t_cycles = timed(lambda: cycles(scene, 512))
    noisy, *t_noisy = timed(lambda: cycles(scene, 32))
    plain, *t_plain = timed(lambda: ours(scene, 32))
    scene.petzval_lens.foreground = front
    mine, *t_mine = timed(lambda: ours(scene, 32))
    for name, picture, seconds in (("Cycles 512", truth, t_cycles), ("Cycles 32", noisy, t_noisy),
                                   ("petzval 32", plain, t_plain), ("petzval 32, hidden layer", mine, t_mine)):
        a, b = picture / (1 + picture), truth / (1 + truth)
        error = ((a - b) ** 2).mean()
        print(f"RESULT {bpy.app.version_string} | {name} | {seconds[0]:.1f} | {seconds[1]:.1f} | "
              f"{-10 * math.log10(error) if error else math.inf:.1f} dB")
    rows = [[noisy, plain], [truth, np.abs(truth - plain) * 4]]
    save("blender-dof.jpg", np.concatenate([np.concatenate(row, 1) for row in rows], 0))


def film():
    scene = market()
    scene.render.resolution_x, scene.render.resolution_y = 320, 180
    scene.cycles.samples, scene.frame_start, scene.frame_end = 8, 1, 24
    target = bpy.data.objects.new("focus", None)
    scene.collection.objects.link(target)
    for frame, y in ((1, 0.8), (24, 4.2)):
        target.location = (0, y, 0.1)
        target.keyframe_insert("location", frame=frame)
        scene.camera.location = (0.06 * (frame > 1), 0, 0.25)
        scene.camera.keyframe_insert("location", frame=frame)
    scene.camera.data.dof.focus_object = target
    scene.petzval_lens.lens = "doublet"
    scene.render.filepath = os.path.join(FOLDER, "film.####.png")
    done, *seconds = timed(bpy.ops.petzval_lens.animation)
    print("RESULT film", done, f"{seconds[0]:.1f} s, {seconds[1]:.1f} CPU s")


def traced():
    """Cycles through a prescription of ours, exported as OSL camera, beside petzval through the same lens."""
    sys.path += [str(pathlib.Path(__file__).resolve().parents[2] / "tools"), os.path.join(
        bpy.utils.resource_path("LOCAL"), "python/lib/python3.11/site-packages")]  # of Blender's own oslquery
    import lens_export
    scene = market()
    scene.render.resolution_x, scene.render.resolution_y = 320, 180
    data = scene.camera.data
    data.dof.aperture_fstop = 2.1
    look = installed.part("library").petzval.Look(lens="double-gauss")
    look["lens.focus_mode"], look["glare.vignetting"] = "paraxial", True
    scene.petzval_lens.look_file = os.path.join(FOLDER, "look.json")
    pathlib.Path(scene.petzval_lens.look_file).write_text(look.to_json())
    mine = ours(scene, 32)
    lens = lens_export.read(pathlib.Path(__file__).resolve().parents[2] / "lenses/double-gauss.json")
    shader = bpy.data.texts.new("double-gauss.osl")
    shader.write(lens_export.osl(lens, "double-gauss", data.lens, 2.1, data.dof.focus_distance))
    data.type, data.custom_mode = "CUSTOM", "INTERNAL"
    data.custom_shader = shader
    truth = cycles(scene, 512)
    a, b = mine / (1 + mine), truth / (1 + truth)
    print(f"RESULT {bpy.app.version_string} | double-gauss f/2.1 | light {mine.sum() / truth.sum():.3f} | "
          f"{-10 * math.log10(((a - b) ** 2).mean()):.1f} dB")
    save("blender-lens.jpg", np.concatenate([truth, mine, np.abs(truth - mine) * 4], 1))


{"picture": compare, "film": film, "lens": traced}[sys.argv[-2]]()
