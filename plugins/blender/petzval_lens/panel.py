# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels in the properties of renders and of cameras."""
import bpy

from . import camera
from .operators import Now
from .refused import Refused


class Panel:
    bl_label = "petzval lens"
    bl_space_type, bl_region_type = "PROPERTIES", "WINDOW"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        scene, layout = context.scene, self.layout
        layout.use_property_split = True
        self._facts(layout, context)
        for name in ("lens", "preset", "look_file", "quality", "cats_eye", "focus", "unit", "foreground",
                     "keep_passes", "to_compositor"):
            layout.prop(scene.petzval_lens, name)
        if scene.petzval_lens.unit == "SCENE" and scene.unit_settings.scale_length != 1:
            layout.label(text="Cycles itself counts a unit as 1 m", icon="INFO")
        row = layout.row()
        row.operator("petzval_lens.still", icon="RENDER_STILL")
        row.operator("petzval_lens.animation", icon="RENDER_ANIMATION")
        layout.operator("petzval_lens.develop", icon="FILE_REFRESH")
        if hasattr(bpy.types, "PETZVAL_LENS_OT_view"):
            layout.operator("petzval_lens.view", icon="WINDOW")
        if Now.step is not None:
            layout.label(text=f"{Now.step.progress:.0%}, Esc ends it", icon="TIME")

    def _facts(self, layout, context):
        scene = context.scene
        try:
            numbers = camera.read(scene, context.evaluated_depsgraph_get(), scene.petzval_lens.wish(scene).unit_m)
        except Refused as why:
            layout.label(text=str(why), icon="ERROR")
            return
        layout.label(text=f"{numbers.focal_length_mm:.4g} mm f/{numbers.f_number:.3g}, picture spans "
                          f"{numbers.sensor_width_mm:.4g} mm, focus {numbers.focus_distance_m:.4g} m", icon="CAMERA_DATA")


class PETZVAL_LENS_PT_render(Panel, bpy.types.Panel):
    bl_context = "render"


class PETZVAL_LENS_PT_camera(Panel, bpy.types.Panel):
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return context.camera is not None


CLASSES = PETZVAL_LENS_PT_render, PETZVAL_LENS_PT_camera


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)


def unregister():
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
