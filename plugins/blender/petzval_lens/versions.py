# SPDX-License-Identifier: GPL-3.0-or-later
"""Every difference between the versions of Blender, from 3.4 on. No other module asks for a version."""
import contextlib


def pass_file_values(scene, path):
    """(owner, property, value) in the order to set them: renders go to an uncompressed multilayer EXR, 32 bit."""
    output, render = scene.render.image_settings, scene.render
    values = []
    if hasattr(output, "media_type"):  # 5.0: chosen before the file format
        values.append((output, "media_type", "MULTI_LAYER_IMAGE"))
    values += [(output, "file_format", "OPEN_EXR_MULTILAYER"), (output, "color_depth", "32"),
               (output, "exr_codec", "NONE")]
    if hasattr(output, "use_exr_interleave"):  # 5.0 writes a part per pass without it
        values.append((output, "use_exr_interleave", True))
    return values + [(render, "filepath", path), (render, "use_file_extension", True), (render, "use_overwrite", True),
                     (render, "use_placeholder", False)]


def picture_file_values(scene):
    """(owner, property, value) that let a single picture be saved in the scene's format; empty if it can be already."""
    output = scene.render.image_settings
    if output.file_format != "OPEN_EXR_MULTILAYER":
        return []
    media = [(output, "media_type", "IMAGE")] if hasattr(output, "media_type") else []
    return media + [(output, "file_format", "OPEN_EXR")]


def writes_movies(scene):
    """True if the scene's output is a film rather than a picture per frame."""
    output = scene.render.image_settings
    return scene.render.is_movie_format if hasattr(scene.render, "is_movie_format") else (
        output.file_format in {"FFMPEG", "AVI_JPEG", "AVI_RAW"})


@contextlib.contextmanager
def changed(values):
    """Sets properties given as (owner, name, value). Afterwards, also after a failure, each has its old value."""
    before = [(owner, name, getattr(owner, name)) for owner, name, _ in values]  # one may change the next
    try:
        for owner, name, value in values:
            setattr(owner, name, value)
        yield
    finally:
        _put_back(before)


def _put_back(before):
    """In the order they were set: a file format decides which depths of colour it accepts."""
    failed = None
    for owner, name, value in before:
        try:
            setattr(owner, name, value)
        except Exception as why:  # the others are put back all the same
            failed = failed or why
    if failed:
        raise failed


def compositor_tree(bpy, scene):
    """The scene's compositing nodes, made if there are none."""
    if hasattr(scene, "compositing_node_group"):  # 5.0
        if scene.compositing_node_group is None:
            tree = bpy.data.node_groups.new("petzval", "CompositorNodeTree")
            tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
            tree.nodes.new("NodeGroupOutput")
            scene.compositing_node_group = tree
        return scene.compositing_node_group
    scene.use_nodes = True
    return scene.node_tree


def compositor_output(bpy, tree):
    """The node that ends the compositing nodes."""
    for node in tree.nodes:
        if node.bl_idname in ("CompositorNodeComposite", "NodeGroupOutput"):
            return node
    return tree.nodes.new("CompositorNodeComposite" if hasattr(bpy.types, "CompositorNodeComposite") else
                          "NodeGroupOutput")
