# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a still, an animation, or the last passes again. In a window they run beside it; Escape ends them."""
import bpy

from . import job
from .library import petzval
from .refused import Refused

EXPECTED = (Refused, petzval.Error, OSError, RuntimeError, MemoryError)


class Now:
    """The step that runs in this window, for the panel."""

    step = None


class Stepped:
    """An operator made of steps. Subclasses have steps(context)."""

    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return Now.step is None and context.scene is not None

    def execute(self, context):
        try:
            for step in self.steps(context):
                step.start(waiting=True)
        except EXPECTED as why:
            self.report({"ERROR"}, str(why))
            return {"CANCELLED"}
        return {"FINISHED"}

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        self._steps, Now.step, self._escaped = self.steps(context), job.Step(), False
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and isinstance(Now.step, job.Defocus):
            return self._end(context, "cancelled")
        if event.type == "ESC":  # Blender ends its render itself, unless that is about to finish
            self._escaped = True
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        context.workspace.status_text_set(f"petzval: {Now.step.progress:.0%}  (Esc ends it)")
        if not Now.step.done():
            return {"PASS_THROUGH"}
        if self._escaped:
            return self._end(context, "cancelled")
        try:
            Now.step = next(self._steps)
            Now.step.start(waiting=False)
        except StopIteration:
            return self._end(context, None)
        except EXPECTED as why:
            return self._end(context, str(why))
        return {"PASS_THROUGH"}

    def _end(self, context, why):
        """Ends what runs; the steps put all settings back when they are closed."""
        Now.step.cancel()
        self._steps.close()
        Now.step = None
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)
        for area in context.screen.areas:
            area.tag_redraw()
        if why is None:
            return {"FINISHED"}
        self.report({"WARNING" if why == "cancelled" else "ERROR"}, why)
        return {"CANCELLED"}

    def cancel(self, context):
        """Blender closes the window or loads another file."""
        self._end(context, "cancelled")


class RenderStill(Stepped, bpy.types.Operator):
    """Render this frame without depth of field, then through the lens"""

    bl_idname, bl_label = "petzval_lens.still", "Render Still"
    write_still: bpy.props.BoolProperty(name="Write", description="Write the picture to the scene's output path")

    def steps(self, context):
        scene = context.scene
        wish = scene.petzval_lens.wish(scene)
        return job.still(scene, context.view_layer, wish, self.report, self.write_still)


class RenderAnimation(Stepped, bpy.types.Operator):
    """Render all frames through the lens, and write each to the scene's output path"""

    bl_idname, bl_label = "petzval_lens.animation", "Render Animation"

    def steps(self, context):
        scene = context.scene
        return job.animation(scene, context.view_layer, scene.petzval_lens.wish(scene), self.report)


class Develop(Stepped, bpy.types.Operator):
    """Take the last rendered passes through the lens as it is set now, without a render"""

    bl_idname, bl_label = "petzval_lens.develop", "Lens Again"

    def steps(self, context):
        scene = context.scene
        return job.again(scene, context.view_layer, scene.petzval_lens.wish(scene), self.report)


CLASSES = RenderStill, RenderAnimation, Develop


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)


def unregister():
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
