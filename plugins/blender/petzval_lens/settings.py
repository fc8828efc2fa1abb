# SPDX-License-Identifier: GPL-3.0-or-later
"""The user's choices, stored with the scene."""
import functools

import bpy

from .job import Kept, Wish
from .library import petzval


@functools.lru_cache(maxsize=None)
def _lenses():
    return [(lens["name"], lens["title"]) for lens in petzval.lens_list()]


def _found_presets(_self, _context, text):
    return [name for name in petzval.preset_names() if text.lower() in name.lower()]


def _found(_self, _context, text):
    return [row for row in _lenses() if text.lower() in " ".join(row).lower()]


class Settings(bpy.types.PropertyGroup):
    lens: bpy.props.StringProperty(
        name="Lens", description="Name of a lens, or a lens file; if empty, the look's lens or an ideal lens", search=_found,
        search_options={"SUGGESTION"})
    preset: bpy.props.StringProperty(
        name="Preset", description="Name of a built-in look, or NAME.json in your folder of presets",
        search=_found_presets, search_options={"SUGGESTION"})
    look_file: bpy.props.StringProperty(
        name="Look", description="File of artistic choices, as petzval defocus --save-look writes it",
        subtype="FILE_PATH")
    quality: bpy.props.EnumProperty(
        name="Quality", description="Accuracy of the blur, not its size", default="standard",
        items=[("draft", "Draft", "Fastest"), ("standard", "Standard", "Final frames"), ("final", "Final", "Slow")])
    cats_eye: bpy.props.FloatProperty(
        name="Cat's Eye", description="Optical vignetting: cuts discs towards the corners", min=0, max=1)
    unit: bpy.props.EnumProperty(
        name="Unit", description="Length of a unit of the scene", default="SCENE",
        items=[("SCENE", "Scene's", "The unit scale of the scene"),
               ("METRE", "1 m", "As Cycles counts for its own depth of field")])
    focus: bpy.props.EnumProperty(
        name="Focus", description="Where the lens focuses", default="CAMERA",
        items=[("CAMERA", "Camera's", "Focus distance or origin of the focus object, as Cycles does"),
               ("SURFACE", "Surface", "Middle of the visible surface of the focus object, by Cryptomatte")])
    foreground: bpy.props.PointerProperty(
        name="Foreground", type=bpy.types.Collection,
        description="A second render without these objects shows what they hide; their shadows stay")
    keep_passes: bpy.props.BoolProperty(
        name="Keep Passes", description="Leave the passes beside the output, as multilayer EXR with motion vectors")
    to_compositor: bpy.props.BoolProperty(
        name="Compositor", description="Show the result in the compositing nodes")

    def wish(self, scene):
        """The choices as plain values."""
        threads = scene.render.threads if scene.render.threads_mode == "FIXED" else 0
        unit_m = scene.unit_settings.scale_length if self.unit == "SCENE" else 1.0
        return Wish(self.lens.strip(), self.preset.strip(), self.look_file, self.quality, self.cats_eye, unit_m,
                    self.focus == "SURFACE", self.foreground, self.keep_passes, self.to_compositor, threads)


def register():
    bpy.utils.register_class(Settings)
    bpy.types.Scene.petzval_lens = bpy.props.PointerProperty(type=Settings)


def unregister():
    Kept.forget()
    del bpy.types.Scene.petzval_lens
    bpy.utils.unregister_class(Settings)
