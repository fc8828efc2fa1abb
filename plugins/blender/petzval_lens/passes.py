# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of a render: the settings that make them, and the shot for petzval that they become."""
import numpy

from . import cryptomatte, exr, versions
from .library import petzval
from .refused import Refused

MISS = 1e9  # Blender writes 1e10 where nothing was hit
ENGINES_WITH_PASSES = ("CYCLES", "BLENDER_EEVEE", "BLENDER_EEVEE_NEXT")


def check(scene, wish):
    """Raises Refused for settings under which passes and picture would not fit together."""
    render = scene.render
    if render.engine not in ENGINES_WITH_PASSES:
        raise Refused(f"the render engine {render.engine} has no depth pass; petzval takes Cycles and EEVEE")
    if render.use_multiview:
        raise Refused("stereoscopy is on; petzval renders one view, so switch it off")
    if render.use_border:
        raise Refused("a render region is set; petzval needs the whole picture, so switch the region off")
    if wish.foreground is not None and render.engine != "CYCLES":
        raise Refused("hidden layers are rendered by Cycles alone; clear the foreground collection or use Cycles")
    if wish.surface and render.engine != "CYCLES":
        raise Refused("focus on a surface needs Cryptomatte of Cycles; focus by the camera or use Cycles")


def warnings(scene):
    """Sentences about settings that petzval cannot follow."""
    found = []
    if scene.render.use_motion_blur:
        found.append("motion blur is on: its smeared edges are blurred by the depth of the sharp ones")
    return found


def render_values(scene, view_layer, wish, path):
    """(owner, property, value) under which a render writes the passes to a file. Depth of field is off."""
    values = [(scene.camera.data.dof, "use_dof", False), (scene.render, "use_compositing", False),
              (scene.render, "use_sequencer", False), (view_layer, "use_pass_combined", True),
              (view_layer, "use_pass_z", True)]
    if wish.keep_passes and not scene.render.use_motion_blur:  # Cycles has vectors or motion blur
        values.append((view_layer, "use_pass_vector", True))
    if wish.surface:
        values.append((view_layer, "use_pass_cryptomatte_object", True))
    return values + versions.pass_file_values(scene, path)


def hidden_values(wish):
    """(owner, property, value) that hide the foreground from the camera, and leave its shadows and reflections."""
    return [(thing, "visible_camera", False) for thing in wish.foreground.all_objects]


class Passes:
    """The passes of one render: colour as four planes, depth in units of the scene with +infinity for a miss."""

    def __init__(self, path, layer, numbers):
        self.path, self._channels, self._layer = path, exr.read(path), layer
        self.colour = [self._channel(f"Combined.{letter}") for letter in "RGBA"]
        depth = self._channel("Depth.Z")
        if depth.shape != (numbers.height, numbers.width):
            raise Refused(f"the render has {depth.shape[1]} x {depth.shape[0]} pixels and not the "
                          f"{numbers.width} x {numbers.height} of the scene")
        self.depth = numpy.where(depth > MISS, numpy.float32(numpy.inf), depth)

    def _channel(self, name):
        try:
            return self._channels[f"{self._layer}.{name}"]
        except KeyError:
            raise Refused(f"the render has no pass {self._layer}.{name}") from None

    def surface_distance(self, name):
        """Median depth of the visible surface of the object with this name. Raises Refused if it is not in sight."""
        distance = cryptomatte.median_depth(self._channels, self._layer, name, self.depth)
        if distance is None:
            raise Refused(f"the focus object {name} is not in sight, so its surface has no distance")
        return distance

    def as_deep(self, numbers):
        """The pass as hidden layer: one sample in each pixel that is not empty."""
        rgba = numpy.stack([_filled(plane, numbers) for plane in self.colour], axis=-1)
        there = rgba[..., 3] > 0
        samples = numpy.empty((int(there.sum()), 6), numpy.float32)
        samples[:, :4] = rgba[there]
        samples[:, 4] = samples[:, 5] = _filled(self.depth, numbers)[there] * numbers.unit_m
        first = numpy.zeros(there.size + 1, numpy.uint64)
        numpy.cumsum(there.ravel(), out=first[1:])
        return petzval.Deep(there.shape[1], there.shape[0], first, samples)


def _filled(plane, numbers):
    """The plane, mirrored into pixels that a shifted lens has and the render has not: empty pixels would darken it."""
    return numpy.pad(plane, numbers.room_px, mode="symmetric") if numbers.shift_px != (0, 0) else plane


def _camera(numbers):
    return petzval.Camera(numbers.focal_length_mm, numbers.sensor_width_mm, numbers.f_number, numbers.focus_distance_m)


def blank_shot(numbers):
    """A shot of this camera with one black pixel, in focus: petzval refuses it for the reasons of the whole picture."""
    black = numpy.zeros((1, 1), numpy.float32)
    return petzval.Shot([black] * 4, depth_m=black + numpy.float32(numbers.focus_distance_m), camera=_camera(numbers),
                        display_window=(0, 0, numbers.width, numbers.height), data_window=(0, 0, 1, 1),
                        pixel_aspect=numbers.pixel_aspect)


def shot(numbers, front, behind=None):
    """A shot of passes, with hidden layers if they were rendered."""
    (above, below), (left, right) = numbers.room_px
    x0, y0, x1, y1 = numbers.data_window
    return petzval.Shot([_filled(plane, numbers) for plane in front.colour],
                        depth_m=_filled(front.depth, numbers) * numpy.float32(numbers.unit_m), camera=_camera(numbers),
                        behind=None if behind is None else behind.as_deep(numbers),
                        display_window=(0, 0, numbers.width, numbers.height),
                        data_window=(x0 - left, y0 - above, x1 + right, y1 + below),
                        pixel_aspect=numbers.pixel_aspect)
