# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes frames step by step: render, then petzval in a thread. The same steps serve a window and a script."""
import dataclasses
import os
import threading
import typing

import bpy

from . import camera, compositor, passes, versions
from .library import petzval
from .refused import Refused, reason

IMAGE = "petzval"  # the image datablock that shows the result


@dataclasses.dataclass(frozen=True)
class Wish:
    """Choices of the panel."""

    lens: str = ""
    preset: str = ""
    look_file: str = ""
    quality: str = "standard"
    cats_eye: float = 0
    unit_m: float = 1
    surface: bool = False
    foreground: typing.Any = None
    keep_passes: bool = False
    to_compositor: bool = False
    threads: int = 0


class Step:
    """A long operation. progress is the share done."""

    progress = 0.0

    def start(self, waiting):
        """Begins; returns at the end if `waiting`."""

    def done(self):
        return True

    def cancel(self):
        """Ends it early; returns when it has ended."""


class Render(Step):
    """Blender's own render of the scene, by its settings."""

    def __init__(self, scene, view_layer):
        self.names = {"scene": scene.name, "layer": view_layer.name}

    def start(self, waiting):
        try:
            bpy.ops.render.render("EXEC_DEFAULT" if waiting else "INVOKE_DEFAULT", write_still=True, **self.names)
        except RuntimeError as why:
            raise Refused(reason(why)) from None

    def done(self):
        return not bpy.app.is_job_running("RENDER")


class Defocus(Step):
    """A frame of petzval in a thread, which touches nothing of Blender's."""

    def __init__(self, session, shot, look, region=None):
        self._arguments, self._session, self._region = (shot, look), session, region
        self._cancelled, self._error, self._frame = False, None, None
        self._thread = threading.Thread(target=self._run, name="petzval lens")

    def _run(self):
        try:
            self._frame = self._session.defocus(*self._arguments, region=self._region,
                                                progress=self._report)
        except BaseException as error:  # raised again in frame()
            self._error = error

    def _report(self, share):
        self.progress = share
        return not self._cancelled

    def start(self, waiting):
        self._thread.start()
        if waiting:
            self._thread.join()

    def done(self):
        return not self._thread.is_alive()

    def cancel(self):
        self._cancelled = True
        if self._thread.ident is not None:
            self._thread.join()

    def frame(self):
        """The frame, once it is done. Raises the errors of petzval."""
        if self._error is not None:
            raise self._error
        return self._frame


class Kept:
    """The last frame's passes and the session with its kernels, so that another look needs no render."""

    session, threads = None, 0
    numbers = front = behind = None

    @classmethod
    def session_of(cls, threads):
        if cls.session is None or cls.threads != threads:
            cls._close()
            cls.session, cls.threads = petzval.Session(threads=threads), threads
        return cls.session

    @classmethod
    def forget(cls):
        cls._close()
        cls.numbers = cls.front = cls.behind = None

    @classmethod
    def _close(cls):
        if cls.session is not None:
            cls.session.close()
        cls.session = None


def chosen_look(wish):
    """The look of the panel's preset or file. Raises Refused, and the errors of petzval."""
    if wish.preset and wish.look_file:
        raise Refused("a preset and a look are both given; empty one of them")
    if wish.preset:
        return petzval.Look.preset(wish.preset)
    if not wish.look_file:
        return petzval.Look()
    try:
        with open(bpy.path.abspath(wish.look_file), encoding="utf-8") as file:
            return petzval.Look.from_json(file.read())
    except (OSError, UnicodeDecodeError, petzval.Error) as why:
        reason = getattr(why, "strerror", None) or str(why).removeprefix("look: ")
        raise Refused(f"the look {wish.look_file} cannot be read: {reason}") from None


def look_of(wish, numbers):
    """The look of the panel and of the camera. Raises Refused, and the errors of petzval."""
    look = chosen_look(wish)
    if wish.lens:
        look.lens = bpy.path.abspath(wish.lens)
    if wish.quality != "standard":
        look["quality"] = wish.quality
    if wish.cats_eye:
        look["lens.cats_eye"] = wish.cats_eye
    neutral = {"lens.blades": 0, "lens.blade_rotation_deg": 0, "lens.squeeze": 1}
    for field, value in numbers.look.items():
        if value != neutral[field]:
            look[field] = value
    return look


def render_frame(scene, view_layer, wish, report):
    """Steps that render the passes of the current frame into Kept."""
    numbers = _numbers(scene, view_layer, wish)
    _check_frame(scene, wish, numbers)
    kept_at = scene.render.frame_path(frame=scene.frame_current)
    front = _passes_path(kept_at if wish.keep_passes else None, "passes")
    Kept.numbers = Kept.front = Kept.behind = None  # a mapped file must not be written
    yield from _render(scene, view_layer, wish, front, [])
    behind = None
    if wish.foreground is not None:
        path = _passes_path(kept_at if wish.keep_passes else None, "behind")
        yield from _render(scene, view_layer, wish, path, passes.hidden_values(wish))
        behind = passes.Passes(path, view_layer.name, numbers)
    seen = passes.Passes(front, view_layer.name, numbers)
    if wish.surface:
        numbers = _on_surface(scene, numbers, seen)
        report({"INFO"}, f"focus on the surface at {numbers.focus_distance_m:.4g} m")
    Kept.numbers, Kept.front, Kept.behind = numbers, seen, behind


def _check_frame(scene, wish, numbers):
    """Raises before the render what would be refused after it."""
    if wish.surface:
        _focus_object(scene)
    Kept.session_of(wish.threads).defocus(passes.blank_shot(numbers), look_of(wish, numbers))


def _numbers(scene, view_layer, wish):
    view_layer.update()
    return camera.read(scene, view_layer.depsgraph, wish.unit_m)


def _focus_object(scene):
    target = scene.camera.data.dof.focus_object
    if target is None:
        raise Refused("focus on a surface needs a focus object in the camera's depth of field")
    return target


def _on_surface(scene, numbers, seen):
    distance = seen.surface_distance(_focus_object(scene).name)
    return dataclasses.replace(numbers, focus_distance_m=distance * numbers.unit_m)


def _passes_path(output, what):
    """File of passes: beside the output if they are kept, else in Blender's own folder for temporary files."""
    base = os.path.splitext(output)[0] if output else os.path.join(bpy.app.tempdir, "petzval")
    return f"{base}_{what}.exr"


def _render(scene, view_layer, wish, path, more):
    if os.path.exists(path):
        os.remove(path)
    with versions.changed(passes.render_values(scene, view_layer, wish, path) + more):
        yield Render(scene, view_layer)
    if not os.path.exists(path):
        raise Refused("the render was cancelled, or failed for the reason that Blender reports")


def develop(scene, wish, report):
    """A step that makes the frame of the kept passes; afterwards the image shows it."""
    if Kept.front is None:
        raise Refused("nothing has been rendered for petzval yet: render a still first")
    step = Defocus(Kept.session_of(wish.threads), passes.shot(Kept.numbers, Kept.front, Kept.behind),
                   look_of(wish, Kept.numbers), Kept.numbers.data_window)
    yield step
    frame = step.frame()
    for warning in frame.warnings:
        report({"WARNING"}, warning)
    image = compositor.show(frame.image, IMAGE)
    compositor.reveal(bpy.data.screens, image)
    if wish.to_compositor:
        compositor.put(scene, image)


def again(scene, view_layer, wish, report):
    """Steps of the last frame through the lens as it is set now. Raises Refused if the camera frames differently."""
    if Kept.front is not None:
        numbers = _numbers(scene, view_layer, wish)
        for field in ("width", "height", "focal_length_mm", "sensor_width_mm", "shift_px", "unit_m"):
            if getattr(numbers, field) != getattr(Kept.numbers, field):
                raise Refused(f"the {field.split('_')[0]} has changed since the last render: render a still first")
        Kept.numbers = _on_surface(scene, numbers, Kept.front) if wish.surface else numbers
    yield from develop(scene, wish, report)


def save(scene, path):
    """Writes the image in the scene's own format."""
    with versions.changed(versions.picture_file_values(scene)):
        try:
            bpy.data.images[IMAGE].save_render(path, scene=scene)
        except RuntimeError as why:
            raise Refused(f"{path} cannot be written: {reason(why)}") from None


def still(scene, view_layer, wish, report, write):
    """Steps of one frame; with `write` its file is written as well."""
    _ready(scene, wish, report)
    path = bpy.path.ensure_ext(bpy.path.abspath(scene.render.filepath), scene.render.file_extension)
    yield from render_frame(scene, view_layer, wish, report)
    yield from develop(scene, wish, report)
    if write:
        save(scene, path)


def animation(scene, view_layer, wish, report):
    """Steps of every frame of the scene; each one's file is written. Existing ones stay if the scene says so."""
    _ready(scene, wish, report)
    if versions.writes_movies(scene):
        raise Refused("the output is a film; petzval writes a picture per frame, so choose PNG or OpenEXR")
    before = scene.frame_current
    try:
        for frame in range(scene.frame_start, scene.frame_end + 1, scene.frame_step):
            path = scene.render.frame_path(frame=frame)
            if not scene.render.use_overwrite and os.path.exists(path):
                continue
            scene.frame_set(frame)
            yield from render_frame(scene, view_layer, wish, report)
            yield from develop(scene, wish, report)
            save(scene, path)
    finally:
        scene.frame_set(before)


def _ready(scene, wish, report):
    chosen_look(wish)  # refused before the render
    passes.check(scene, wish)
    for warning in passes.warnings(scene):
        report({"WARNING"}, warning)
