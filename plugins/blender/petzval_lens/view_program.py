# SPDX-License-Identifier: GPL-3.0-or-later
"""A button that opens kept passes in `petzval view`, where that program is installed. Not part of the extension."""
import os
import shutil
import subprocess

import bpy

from . import job
from .library import petzval
from .refused import Refused


def command(program, path, layer, numbers, look):
    """The words that open passes with the camera's numbers and the look in a file."""
    words = [program, "view", path, "--layer", f"{layer}.Combined", "--depth-channel", f"{layer}.Depth.Z",
             "--focal-length", f"{numbers.focal_length_mm}mm", "--sensor-width", f"{numbers.sensor_width_mm}mm",
             "--fstop", f"{numbers.f_number}", "--focus", f"{numbers.focus_distance_m}m", "--look", look]
    return words if numbers.unit_m == 1 else words + ["--unit-scale", f"{numbers.unit_m}"]


class PETZVAL_LENS_OT_view(bpy.types.Operator):
    """Open the last rendered passes in petzval view"""

    bl_idname, bl_label = "petzval_lens.view", "Open in petzval view"

    @classmethod
    def poll(cls, _context):
        return job.Kept.front is not None and shutil.which("petzval") is not None

    def execute(self, context):
        path = job.Kept.front.path
        if not os.path.exists(path):
            self.report({"ERROR"}, "the passes are gone: render a still first")
            return {"CANCELLED"}
        look = os.path.join(bpy.app.tempdir, "petzval_look.json")
        try:
            chosen = job.look_of(context.scene.petzval_lens.wish(context.scene), job.Kept.numbers).to_json()
        except (Refused, petzval.Error) as why:
            self.report({"ERROR"}, str(why))
            return {"CANCELLED"}
        with open(look, "w", encoding="utf-8") as file:
            file.write(chosen)
        subprocess.Popen(command(shutil.which("petzval"), path, context.view_layer.name, job.Kept.numbers, look),
                         start_new_session=True)
        return {"FINISHED"}


def register():
    bpy.utils.register_class(PETZVAL_LENS_OT_view)


def unregister():
    bpy.utils.unregister_class(PETZVAL_LENS_OT_view)
