# SPDX-License-Identifier: GPL-3.0-or-later
"""Camera numbers of Blender, in petzval's terms."""
import dataclasses
import math

from .refused import Refused

REFUSED = {"ORTHO": "an orthographic camera", "PANO": "a panoramic camera", "CUSTOM": "a camera of its own shader"}


@dataclasses.dataclass(frozen=True)
class Numbers:
    """A camera at one frame. sensor_width_mm is what the picture's width spans; shift_px moves the lens, y down."""

    width: int
    height: int
    focal_length_mm: float
    sensor_width_mm: float
    f_number: float
    focus_distance_m: float
    unit_m: float
    pixel_aspect: float = 1
    blades: int = 0
    blade_rotation_deg: float = 0
    squeeze: float = 1
    shift_px: tuple = (0, 0)

    @property
    def data_window(self):
        """The rendered pixels in the frame whose middle is the lens's axis."""
        x, y = self.shift_px
        return x, y, x + self.width, y + self.height

    @property
    def room_px(self):
        """Pixels of that frame beyond the rendered ones: ((above, below), (left, right))."""
        x, y = self.shift_px
        return (max(0, y), max(0, -y)), (max(0, x), max(0, -x))

    @property
    def look(self):
        """Fields of the look that the camera decides."""
        return {"lens.blades": self.blades, "lens.blade_rotation_deg": self.blade_rotation_deg,
                "lens.squeeze": self.squeeze}


def read(scene, depsgraph, unit_m=1.0):
    """The scene's camera as evaluated at this frame; a unit of the scene is unit_m metres. Raises Refused."""
    if scene.camera is None:
        raise Refused("the scene has no camera")
    camera = scene.camera.evaluated_get(depsgraph)
    data = camera.data
    if data.type != "PERSP":
        raise Refused(f"{scene.camera.name} is {REFUSED.get(data.type, data.type)}, which has no lens to imitate; "
                      "petzval takes perspective cameras")
    width, height = size(scene.render)
    aspect = scene.render.pixel_aspect_x / scene.render.pixel_aspect_y
    blades = data.dof.aperture_blades if data.dof.aperture_blades >= 3 else 0
    fitted = fitted_width_px(data.sensor_fit, width, height, aspect)
    return Numbers(width, height, data.lens, sensor_width_mm(data, width, height, aspect), data.dof.aperture_fstop,
                   focus_distance(camera, data.dof, depsgraph) * unit_m, unit_m, aspect, blades,
                   math.degrees(data.dof.aperture_rotation), data.dof.aperture_ratio,
                   (round(data.shift_x * fitted), -round(data.shift_y * fitted * aspect)))


def size(render):
    """(width, height) of the picture in pixels. Blender counts in whole numbers: 70 % of 720 are 504, not 503."""
    share = render.resolution_percentage
    return render.resolution_x * share // 100, render.resolution_y * share // 100


def fitted_width_px(fit, width, height, aspect):
    """The side that the sensor is fitted to, in pixel widths. AUTO: the longer side."""
    tall = height / aspect
    if fit == "AUTO":
        return max(width, tall)
    return width if fit == "HORIZONTAL" else tall


def sensor_width_mm(data, width, height, aspect):
    """The part of the sensor that the picture's width spans."""
    side = data.sensor_height if data.sensor_fit == "VERTICAL" else data.sensor_width
    return side * width / fitted_width_px(data.sensor_fit, width, height, aspect)


def focus_distance(camera, dof, depsgraph):
    """Along the axis, in units of the scene, as Cycles measures it."""
    if dof.focus_object is None:
        return dof.focus_distance
    thing = dof.focus_object.evaluated_get(depsgraph)
    place = thing.matrix_world
    if dof.focus_subtarget and thing.pose and dof.focus_subtarget in thing.pose.bones:
        place = place @ thing.pose.bones[dof.focus_subtarget].matrix
    distance = abs((camera.matrix_world.normalized().inverted() @ place.translation).z)
    if not distance > 0:
        raise Refused(f"the focus object {dof.focus_object.name} stands in the camera's own plane")
    return distance
