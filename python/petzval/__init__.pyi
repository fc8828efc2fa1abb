# Written by tools/python_stubs.py; not edited.
"""petzval: the depth of field of a real lens, for rendered pictures.

    frame = petzval.defocus(colour, depth_m=depth, camera=petzval.Camera(50, 36, 1.4, 2), look=petzval.Look(lens="doublet"))

Pictures are scene-linear, premultiplied, rows top-down. Signs and units are those of docs/conventions.md.
"""
from ._library import library as _library
from .arrays import Array
from .camera import Camera
from .comparison import compare
from .errors import Cancelled, Error, Internal, InvalidArgument, InvalidFile, OutOfMemory, OutputFailed, ReadFailed, Unsupported
from .files import FileShot, inspect, make_scene, read_shot
from .lens import Lens, lens_list, lens_names
from .look import Look, preset_names
from .run import ShotRun
from .session import Codes, Frame, Session, defocus, device_names, engine_names
from .shot import Deep, Layer, Light, Shot
__all__ = ['Array', 'Camera', 'Cancelled', 'Codes', 'Deep', 'Error', 'FileShot', 'Frame', 'Internal', 'InvalidArgument', 'InvalidFile', 'Layer', 'Lens', 'Light', 'Look', 'OutOfMemory', 'OutputFailed', 'ReadFailed', 'Session', 'Shot', 'ShotRun', 'Unsupported', 'compare', 'defocus', 'device_names', 'engine_names', 'inspect', 'lens_list', 'lens_names', 'make_scene', 'preset_names', 'read_shot', 'version']

def version() -> str:
    """Version of the library that is loaded, as "0.1.0"."""
