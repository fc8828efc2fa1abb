#!/usr/bin/env python3
"""Writes a prescription for renderers: an OSL camera for Cycles (Blender 4.5 and later), or a lens file of pbrt.

Usage: tools/lens_export.py LENS.json OUT.osl|OUT.dat [FOCAL_MM F_NUMBER FOCUS_M]

The three numbers are needed for OSL: the lens is scaled to the focal length, its iris set to the f-number, and its
sensor moved to the paraxial focus of a point so far from the entrance pupil. The picture spans what Blender's own
camera of that focal length shows at that distance; its middle has that camera's brightness, its corners the lens's. Spherical surfaces with nd and Vd only; others are refused.
"""
import json
import math
import pathlib
import sys

FRAUNHOFER_D, FRAUNHOFER_F, FRAUNHOFER_C = 0.5875618, 0.4861327, 0.6562725  # micrometres
CHANNELS_UM = (0.610, 0.550, 0.465)  # one wavelength each for red, green, blue
PUPIL_ROOM = 1.2  # rays aim at a disc so much wider than the paraxial exit pupil


class Refused(Exception):
    """A lens or number that cannot be exported."""


def read(path):
    """[(radius, thickness, nd behind, Cauchy's B, semi-aperture, is_stop)], front to rear, in mm; radius 0 is flat."""
    try:
        data = json.loads(pathlib.Path(path).read_text())
        if data.get("units", "mm") != "mm":
            raise Refused(f"{path}: units are {data['units']}; mm are needed")
        surfaces = [_surface(s, f"{path}: surface {i + 1}") for i, s in enumerate(data["surfaces"])]
    except (OSError, ValueError, KeyError) as why:
        raise Refused(f"{path} is not a prescription: {why}") from None
    if sum(s[5] for s in surfaces) != 1:
        raise Refused(f"{path}: one stop is needed")
    return surfaces


def _surface(given, name):
    if "semi_aperture" not in given or "thickness" not in given:
        raise Refused(f"{name} has no semi_aperture or thickness")
    unknown = set(given) - {"radius", "thickness", "medium", "semi_aperture", "stop"}
    if unknown:
        raise Refused(f"{name} has {', '.join(sorted(unknown))}; only spheres can be exported")
    medium = given.get("medium", "air")
    if medium == "air":
        nd, slope = 1.0, 0.0
    elif isinstance(medium, dict) and medium.get("nd") and medium.get("Vd"):
        nd = medium["nd"]
        slope = (nd - 1) / medium["Vd"] / (FRAUNHOFER_F ** -2 - FRAUNHOFER_C ** -2)
    else:
        raise Refused(f"{name}: the glass {medium} has no nd and Vd")
    return (given["radius"] or 0.0, given["thickness"] or 0.0, nd, slope, given["semi_aperture"],
            bool(given.get("stop")))


def traced(surfaces, height, slope):
    """Paraxial ray at every surface: (height there, slope behind it)."""
    index, found = 1.0, []
    for radius, thickness, nd, *_ in surfaces:
        power = (nd - index) / radius if radius else 0.0
        slope = (index * slope - height * power) / nd
        index = nd
        found.append((height, slope))
        height += slope * thickness
    return found


def first_order(surfaces):
    """Focal length, entrance pupil behind the front vertex, its radius, exit pupil behind the last, its radius."""
    focal = -1 / traced(surfaces, 1, 0)[-1][1]
    stop = next(i for i, s in enumerate(surfaces) if s[5])
    along, across = traced(surfaces, 1, 0)[stop][0], traced(surfaces, 0, 1)[stop][0]
    entrance = across / along
    height, slope = traced(surfaces, -entrance, 1)[-1]
    radius = surfaces[stop][4] / along
    return focal, entrance, radius, -height / slope, abs(radius / slope)


def pbrt(surfaces, title):
    """Lens file of pbrt: radius, thickness, index behind, aperture diameter; the stop has radius 0 and index 0."""
    rows = [f"{0 if stop else radius:g}\t{thickness:g}\t{0 if stop else nd:g}\t{2 * semi:g}"
            for radius, thickness, nd, _, semi, stop in surfaces]
    return f"# {title}\n# radius, thickness, index, diameter; mm\n" + "\n".join(rows) + "\n"


def osl(surfaces, title, focal_mm, f_number, focus_m):
    """Source of a camera shader for Cycles."""
    numbers, columns = camera(surfaces, focal_mm, f_number, focus_m)
    text = f"/* {title}: {focal_mm:g} mm f/{f_number:g}, focus {focus_m:g} m. Lengths in mm. */\n"
    text += "".join(f"#define {name} {value:.9g}\n" for name, value in numbers.items())
    arrays = "".join(f"  float {name}[COUNT] = {{{', '.join(f'{v:.9g}' for v in values)}}};\n"
                     for name, values in columns.items())
    return text + SHADER.replace("ARRAYS\n", arrays).replace("RED_GREEN_BLUE", "%g, %g, %g" % CHANNELS_UM)


def camera(surfaces, focal_mm, f_number, focus_m):
    """Numbers of the shader, and columns of the surfaces from the sensor outwards; z grows towards the scene."""
    scale = focal_mm / first_order(surfaces)[0]
    surfaces = [(r * scale, t * scale, nd, b, semi * scale, stop) for r, t, nd, b, semi, stop in surfaces]
    focal, entrance, radius, exit_at, exit_radius = first_order(surfaces)
    closed = focal / (2 * f_number) / radius
    if closed > 1.001:
        raise Refused(f"the lens opens to f/{focal / (2 * radius):.3g} only")
    front = focus_m * 1000 - entrance
    if front <= 0:
        raise Refused("the focus distance lies inside the lens")
    height, slope = traced(surfaces, front, 1)[-1]
    sensor_at = -height / slope
    height, slope = traced(surfaces, -entrance, 1)[-1]
    places = [sum(s[1] for s in surfaces[i:-1]) for i in range(len(surfaces))]
    rows = list(zip(surfaces, places))[::-1]
    pupil_radius = exit_radius * closed * PUPIL_ROOM
    columns = {"radius": [s[0] for s, _ in rows], "place": [z for _, z in rows],
               "clear": [s[4] * (closed if s[5] else 1) for s, _ in rows],
               "nd": [([1.0] + [s[2] for s in surfaces])[i] for i in reversed(range(len(surfaces)))],
               "cauchy": [([0.0] + [s[3] for s in surfaces])[i] for i in reversed(range(len(surfaces)))]}
    numbers = {"COUNT": len(rows), "FOCAL": focal, "APERTURE": 1 / (2 * f_number), "SENSOR": -sensor_at,
               "SPAN": height + slope * sensor_at, "PUPIL": -exit_at, "ENTRANCE": places[0] - entrance,
               "PUPIL_RADIUS": pupil_radius,
               "GAIN": 3 / axial_light(columns, -sensor_at, -exit_at, pupil_radius)}
    return numbers, columns


def axial_light(columns, sensor_z, pupil_z, pupil_radius, rings=2000):
    """Of light from the sensor's middle to the pupil's disc, the share that leaves the lens, weighted as by the shader."""
    passed = 0.0
    for ring in range(rings):
        along, weight = aimed((0, 0, sensor_z), (0, (ring + 0.5) / rings * pupil_radius, pupil_z))
        if leaves(columns, (0, 0, sensor_z), along):
            passed += (2 * ring + 1) / rings ** 2 * weight
    return passed


def aimed(at, to):
    """The direction between two points, and cos^4 of its angle to the axis."""
    way = [b - a for a, b in zip(at, to)]
    length = math.hypot(*way)
    return tuple(w / length for w in way), (way[2] / length) ** 4


def leaves(columns, at, along):
    """True if a ray from the sensor passes all surfaces, by the rules of the shader, at the d line."""
    index = 1.0
    for radius, place, clear, nd in zip(*(columns[name] for name in ("radius", "place", "clear", "nd"))):
        middle = (0, 0, place - radius)
        if radius:
            off = [a - m for a, m in zip(at, middle)]
            half = _dot(off, along)
            square = half * half - _dot(off, off) + radius * radius
            if square < 0:
                return False
            far = math.copysign(math.sqrt(square), radius) - half
        else:
            far = (place - at[2]) / along[2]
        at = tuple(a + far * w for a, w in zip(at, along))
        if at[0] ** 2 + at[1] ** 2 > clear ** 2:
            return False
        facing = [(a - m) / radius for a, m in zip(at, middle)] if radius else (0, 0, -1)
        cosine, ratio = abs(_dot(facing, along)), index / nd
        if _dot(facing, along) > 0:
            facing = [-f for f in facing]
        under = 1 - ratio * ratio * (1 - cosine * cosine)
        if under < 0:
            return False
        along = tuple(ratio * w + (ratio * cosine - math.sqrt(under)) * f for w, f in zip(along, facing))
        index = nd
    return True


def _dot(a, b):
    return sum(x * y for x, y in zip(a, b))


SHADER = """
shader petzval_camera(output point position = 0, output vector direction = 0, output color throughput = 0)
{
ARRAYS
  float wavelengths[3] = {RED_GREEN_BLUE};
  vector sensor;
  getattribute("cam:sensor_size", sensor);
  point seen = camera_shader_raster_position() - point(0.5);
  point pupil;
  getattribute("cam:aperture_position", pupil); /* radius 1 / (2 N); depth of field must be on */
  float chance = noise("hash", seen * 7919, 7907 * (pupil[0] + 3 * pupil[1]) / APERTURE);
  int channel = min(2, (int)(3 * chance));
  float per_um2 = 1 / pow(wavelengths[channel], 2) - 1 / pow(0.5875618, 2);
  point at = point(-seen[0] * sensor[0] * SPAN / FOCAL, -seen[1] * sensor[1] * SPAN / FOCAL, SENSOR);
  vector along = normalize(point(pupil[0] / APERTURE * PUPIL_RADIUS, pupil[1] / APERTURE * PUPIL_RADIUS, PUPIL) - at);
  float from = 1, aslant = pow(along[2], 4); /* the pupil seen from there, and the sensor lit aslant */
  for (int i = 0; i < COUNT; i++) {
    vector facing = vector(0, 0, -1);
    if (radius[i] == 0) {
      at += along * ((place[i] - at[2]) / along[2]);
    } else {
      point centre = point(0, 0, place[i] - radius[i]);
      float half = dot(at - centre, along);
      float root = half * half - dot(at - centre, at - centre) + radius[i] * radius[i];
      if (root < 0) return;
      at += along * ((radius[i] > 0 ? sqrt(root) : -sqrt(root)) - half);
      facing = normalize(at - centre);
      if (dot(facing, along) > 0) facing = -facing;
    }
    if (at[0] * at[0] + at[1] * at[1] > clear[i] * clear[i]) return;
    float to = nd[i] + cauchy[i] * per_um2;
    float ratio = from / to, cosine = -dot(facing, along);
    float under = 1 - ratio * ratio * (1 - cosine * cosine);
    if (under < 0) return;
    along = normalize(ratio * along + (ratio * cosine - sqrt(under)) * facing);
    from = to;
  }
  position = (at - point(0, 0, ENTRANCE)) * 0.001;
  direction = along;
  throughput = GAIN * aslant * color(channel == 0, channel == 1, channel == 2);
}
"""


def main(source, out, *numbers):
    surfaces, title = read(source), f"{pathlib.Path(source).stem}, written by petzval's tools/lens_export.py"
    if out.endswith(".dat") and not numbers:
        text = pbrt(surfaces, title)
    elif out.endswith(".osl") and len(numbers) == 3:
        text = osl(surfaces, title, *map(float, numbers))
    else:
        raise Refused("OUT ends in .dat, or in .osl and three numbers follow")
    pathlib.Path(out).write_text(text)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (Refused, ValueError) as why:
        sys.exit(f"lens_export: {why}")
