"""Runs inside Blender, started by peers.py: its Defocus node on one picture with depth.

Usage: blender --background --factory-startup --python _peers_blender.py -- JSON
JSON: sharp (EXR: R G B A, and Z in planar metres), out (EXR), width, height, focal_length_mm, sensor_width_mm,
focus_distance_m, f_stop (as the node counts it), largest_px, threads.
"""
import json
import pathlib
import shutil
import sys

import bpy

job = json.loads(sys.argv[sys.argv.index("--") + 1])
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = job["width"], job["height"]
scene.render.resolution_percentage = 100
scene.render.threads_mode, scene.render.threads = "FIXED", job["threads"]
# Nothing is rendered: no node asks for a rendered layer. The camera says what the node needs to know of it.
scene.use_nodes = True
camera = scene.camera.data
camera.lens, camera.sensor_width, camera.sensor_fit = job["focal_length_mm"], job["sensor_width_mm"], "HORIZONTAL"
camera.dof.use_dof, camera.dof.focus_distance = True, job["focus_distance_m"]

nodes, links = scene.node_tree.nodes, scene.node_tree.links
nodes.clear()
source = nodes.new("CompositorNodeImage")
source.image = bpy.data.images.load(job["sharp"])
source.image.colorspace_settings.name = "Linear"
defocus = nodes.new("CompositorNodeDefocus")
defocus.scene, defocus.use_zbuffer, defocus.use_preview, defocus.bokeh = scene, True, False, "CIRCLE"
defocus.f_stop, defocus.blur_max, defocus.use_gamma_correction = job["f_stop"], job["largest_px"], False
links.new(source.outputs["Image"], defocus.inputs["Image"])
links.new(source.outputs["Depth"], defocus.inputs["Z"])

folder = pathlib.Path(job["out"]).with_suffix(".blender")
output = nodes.new("CompositorNodeOutputFile")
output.base_path, output.file_slots[0].path = str(folder), "frame"
output.format.file_format, output.format.color_depth, output.format.color_mode = "OPEN_EXR", "32", "RGBA"
links.new(defocus.outputs["Image"], output.inputs[0])
# Blender renders only scenes with a composite.
links.new(defocus.outputs["Image"], nodes.new("CompositorNodeComposite").inputs["Image"])
bpy.ops.render.render(write_still=False)
written, = folder.glob("frame*.exr")
written.replace(job["out"])
shutil.rmtree(folder)
