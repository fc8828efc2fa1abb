"""A small scene inside Blender: lamps and a post in front of a wall, seen by a camera with depth of field."""
import math

import bpy


def empty():
    """An empty file with a Cycles scene of 160 x 90 pixels."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)  # keeps add-ons enabled
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 16
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 160, 90, 100
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.view_settings.view_transform = "Standard"
    return scene


def shining(name, rgb, strength):
    """A material that shines and reflects nothing."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    light, out = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    light.inputs["Color"].default_value = (*rgb, 1)
    light.inputs["Strength"].default_value = strength
    material.node_tree.links.new(light.outputs[0], out.inputs["Surface"])
    return material


def thing(scene, name, kind, material, **arguments):
    """A mesh primitive with a material."""
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**arguments)
    made = bpy.context.object
    made.name = name
    made.data.materials.append(material)
    return made


def place_camera(scene, lens=85, fstop=1.0, focus=1.5):
    """At the origin, looking along +y."""
    data = bpy.data.cameras.new("Camera")
    camera = bpy.data.objects.new("Camera", data)
    scene.collection.objects.link(camera)
    camera.rotation_euler = (math.pi / 2, 0, 0)
    data.lens, data.dof.use_dof, data.dof.aperture_fstop, data.dof.focus_distance = lens, True, fstop, focus
    scene.camera = camera
    return camera


def lamps():
    """Lamps at 8 m, a dim wall at 12 m, a post at 1.5 m; focus on the post."""
    scene = empty()
    place_camera(scene)
    thing(scene, "wall", "plane", shining("grey", (0.2, 0.25, 0.3), 1), size=40, location=(0, 12, 0),
          rotation=(math.pi / 2, 0, 0))
    for i, rgb in enumerate([(1, 0.6, 0.3), (0.4, 0.7, 1), (0.5, 1, 0.5)]):
        thing(scene, f"lamp{i}", "uv_sphere", shining(f"lamp{i}", rgb, 60), radius=0.04,
              location=(-1 + 0.9 * i, 8, 0.5 - 0.4 * i))
    thing(scene, "post", "cube", shining("red", (0.5, 0.05, 0.03), 1), size=1, location=(0.12, 1.54, 0),
          scale=(0.08, 0.08, 2))
    return scene
