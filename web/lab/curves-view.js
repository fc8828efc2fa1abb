// Longitudinal aberration: where the ray of each pupil zone crosses the axis, one curve a wavelength.
import { handle, line, shape, show, ticks } from "./drawing.js";

/** The class of a curve's colour: r, y, g, b, v. @param {number} um wavelength in micrometres */
const hue = (um) => (um > 0.62 ? "red" : um > 0.57 ? "yellow" : um > 0.5 ? "green" : um > 0.45 ? "blue" : "violet");

/** @param aberration `longitudinal_aberration_mm` of a lens's facts @param points that can be dragged, {zone, mm}
 *  @param {?number} kept half the width in mm, where it must not change @returns {number} half the width in mm */
export function drawCurves(svg, aberration, points = [], kept = null) {
  const zones = aberration?.pupil_zone ?? [];
  const curves = Object.entries(aberration?.axis_crossing_minus_primary_paraxial_focus ?? {});
  const shifts = curves.flatMap(([, mm]) => mm).filter((v) => v !== null);
  if (!shifts.length) {
    show(svg, [0, 0, 100, 40], "No aberration", [shape("text", { x: 50, y: 22, class: "tick middle" }, "A perfect lens: no aberration")]);
    return 1;
  }
  const span = kept ?? Math.max(1e-3, ...shifts.map(Math.abs)) * 1.1, size = 100;
  const at = (mm, zone) => [size / 2 + (mm / span) * (size / 2), size * (1 - zone)];
  show(svg, [-4, -6, size + 8, size + 18], "Longitudinal aberration by wavelength", [
    ...ticks(-span, span, 4).flatMap((mm) => [
      shape("path", { d: `M${at(mm, 0)[0]} 0V${size}`, class: mm === 0 ? "axis" : "grid" }),
      shape("text", { x: at(mm, 0)[0], y: size + 8, class: "tick middle" }, String(mm)),
    ]),
    ...curves.map(([um, mm]) =>
      shape("path", { d: line(mm.map((v, i) => [v, zones[i]]).filter(([v]) => v !== null).map(([v, zone]) => at(v, zone))), class: `curve ${hue(Number(um))}` },
            shape("title", {}, `${Math.round(um * 1000)} nm`))),
    shape("text", { x: 0, y: -1.5, class: "tick" }, "pupil's rim"),
    shape("text", { x: size, y: -1.5, class: "tick end" }, "mm along the axis"),
    ...points.map(({ zone, mm }, i) => handle(...at(mm, zone), 2.6, String(i), `Curve at ${Math.round(zone * 100)} % of the pupil`)),
  ]);
  return span;
}
