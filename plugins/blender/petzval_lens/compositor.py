# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows the result inside Blender: as an image, and in the compositing nodes."""
import bpy
import numpy

from . import versions


def show(pixels, name):
    """The image of this name with these pixels, (height, width, 3 or 4), rows top-down."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.get(name)
    if image is not None and (tuple(image.size) != (width, height) or image.source != "GENERATED"):
        bpy.data.images.remove(image)
        image = None
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
    image.alpha_mode = "PREMUL"
    image.pixels.foreach_set(numpy.ascontiguousarray(pixels[::-1]).ravel())
    image.update()
    return image


def reveal(screens, image):
    """Shows the image in each image editor that shows the render, which has no blur."""
    for area in (area for screen in screens for area in screen.areas if area.type == "IMAGE_EDITOR"):
        space = area.spaces.active
        if space.image is not None and space.image.type == "RENDER_RESULT":
            space.image = image


def put(scene, image):
    """Shows the image in the compositing nodes. It replaces Render Layers if these were the output's only input."""
    tree = versions.compositor_tree(bpy, scene)
    node = tree.nodes.get(image.name)
    if node is None:
        node = tree.nodes.new("CompositorNodeImage")
        node.name = node.label = image.name
    node.image = image
    end = versions.compositor_output(bpy, tree)
    source = _source(tree, end)
    if source is None or source.bl_idname == "CompositorNodeRLayers":
        tree.links.new(node.outputs["Image"], end.inputs["Image"])
    return node


def _source(tree, node):
    """The node that feeds the first socket of this one, through reroutes; None if nothing does."""
    links = [link for link in tree.links if link.to_node == node and link.to_socket == node.inputs[0]]
    if not links:
        return None
    source = links[0].from_node
    return _source(tree, source) if source.bl_idname == "NodeReroute" else source
