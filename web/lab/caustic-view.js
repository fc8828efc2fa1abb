// Rays near focus, from the longitudinal aberration: each zone's rays cross the axis where the curve says.
import { line, shape, show } from "./drawing.js";

/** @param aberration `longitudinal_aberration_mm` of a lens's facts */
export function drawCaustic(svg, aberration) {
  const zones = aberration?.pupil_zone ?? [], curves = Object.entries(aberration?.axis_crossing_minus_primary_paraxial_focus ?? {});
  const [, middle] = curves.reduce((best, curve) => (Math.abs(curve[0] - 0.55) < Math.abs(best[0] - 0.55) ? curve : best), curves[0] ?? [0, []]);
  const shifts = middle.filter((v) => v !== null), span = Math.max(0.05, ...shifts.map(Math.abs)), reach = 2.2 * span, rays = [];
  const count = 24;
  for (let k = 1; k <= count; k++) {
    const zone = k / count, i = zones.findIndex((z) => z >= zone);
    const at = i < 0 ? zones.length - 1 : i;
    if (middle[at] == null) continue;
    for (const height of [zones[at], -zones[at]]) {
      const y = (t) => (-height * (t - middle[at])) / reach;
      rays.push(shape("path", { d: line([[-1, -reach], [1, reach]].map(([x, t]) => [100 * x, 60 * y(t)])), class: "ray" }));
    }
  }
  const plane = (x) => shape("path", { d: `M${x} -75V75`, class: "sensor" });
  show(svg, [-100, -80, 200, 160], "Rays near focus", [shape("path", { d: "M-100 0H100", class: "axis" }), ...rays, plane(-80), plane(80)]);
}
