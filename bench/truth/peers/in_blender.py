"""Started by blender.py with a Python that has bpy 5.0 or later: PICTURE.exr DEPTH.exr OUT.exr FOCAL_MM SENSOR_MM FSTOP FOCUS_M LARGEST_PX

The node's f-stop is metric: on the scene table f/1.4 gives 39.8 dB, f/2.8 32.0 dB (Blender 5.0.1; 3.4.1 blurred 27.8 times as far).
"""
import pathlib
import shutil
import sys

import bpy

sharp, depth, out = (str(pathlib.Path(p).resolve()) for p in sys.argv[1:4])
focal_mm, sensor_mm, fstop, focus_m, largest_px = map(float, sys.argv[4:9])
scene = bpy.context.scene
picture = bpy.data.images.load(sharp)
picture.colorspace_settings.name = "Linear Rec.709"
scene.render.resolution_x, scene.render.resolution_y = picture.size
scene.render.resolution_percentage = 100
camera = scene.camera.data
camera.lens, camera.sensor_width, camera.sensor_fit = focal_mm, sensor_mm, "HORIZONTAL"
camera.dof.use_dof, camera.dof.focus_distance = True, focus_m

tree = bpy.data.node_groups.new("defocus", "CompositorNodeTree")
scene.compositing_node_group = tree
nodes, links = tree.nodes, tree.links
source, distance = nodes.new("CompositorNodeImage"), nodes.new("CompositorNodeImage")
source.image, distance.image = picture, bpy.data.images.load(depth)
distance.image.colorspace_settings.name = "Non-Color"
defocus = nodes.new("CompositorNodeDefocus")
defocus.scene, defocus.use_zbuffer, defocus.bokeh = scene, True, "CIRCLE"
defocus.f_stop, defocus.blur_max = fstop, largest_px
links.new(source.outputs["Image"], defocus.inputs["Image"])
links.new(distance.outputs["Image"], defocus.inputs["Z"])

folder = pathlib.Path(out).with_suffix(".blender")
output = nodes.new("CompositorNodeOutputFile")
output.directory, output.file_name = str(folder), "frame"
output.format.media_type, output.format.file_format, output.format.color_depth = "IMAGE", "OPEN_EXR", "32"
output.file_output_items.new("RGBA", "Image")
links.new(defocus.outputs["Image"], output.inputs[0])
tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
links.new(defocus.outputs["Image"], nodes.new("NodeGroupOutput").inputs[0])
bpy.ops.render.render(write_still=False)
written = sorted(folder.glob("**/*.exr"))
if not written:
    sys.exit("Blender wrote nothing")
pathlib.Path(written[0]).replace(out)
shutil.rmtree(folder)
