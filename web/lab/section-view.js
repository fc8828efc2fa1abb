// The lens cut open, with the rays of the light that makes the disc. Rays near the clicked spot of the disc light up.
import { handle, line, shape, show } from "./drawing.js";

/** @param section as petzval_lens_section() gives it @param {?{x: number, y: number, reach: number}} spot of the disc, pixels
 *  @param {?number} focus_z_mm where the sensor's handle stands; null: nothing can be dragged */
export function drawSection(svg, section, spot, focus_z_mm = null) {
  const side = section.rays.filter((ray) => Math.abs(ray.off_plane) < 0.06);
  const lit = spot ? section.rays.filter((ray) => Math.hypot(ray.disc_px[0] - spot.x, ray.disc_px[1] - spot.y) <= spot.reach) : [];
  const points = [...section.glass.flatMap((g) => g.outline_mm), [section.sensor_z_mm, section.image_y_mm], [section.stop_z_mm, section.stop_radius_mm],
                  [section.stop_z_mm, -section.stop_radius_mm]];
  const z = points.map((p) => p[0]), y = points.map((p) => Math.abs(p[1]));
  const length = Math.max(...z) - Math.min(...z) || 1, reach = Math.max(...y) * 1.15 || 1;
  const left = Math.min(...z) - 0.25 * length, width = 1.3 * length;
  const ray = (which) => (r) => shape("path", { d: line(r.path_mm.map(([pz, py]) => [pz, -py])), class: which });
  const plane = (at, half, which) => shape("path", { d: `M${at} ${-half}V${half}`, class: which });
  show(svg, [left, -reach, width, 2 * reach], "Cross-section of the lens with rays", [
    shape("path", { d: `M${left} 0h${width}`, class: "axis" }),
    ...section.glass.map((g) => shape("path", { d: line(g.outline_mm.map(([pz, py]) => [pz, -py])) + "Z", class: g.is_flint ? "glass flint" : "glass" })),
    ...side.map(ray("ray")),
    ...lit.map(ray("ray lit")),
    shape("path", { d: `M${section.stop_z_mm} ${-reach}V${-section.stop_radius_mm}M${section.stop_z_mm} ${section.stop_radius_mm}V${reach}`, class: "stop" }),
    plane(section.sensor_z_mm, 0.9 * reach, "sensor"),
    ...(focus_z_mm === null ? [] : [-1, 1].map((side) => handle(section.stop_z_mm, side * section.stop_radius_mm, 0.018 * width, "stop", "Edge of the stop"))),
    ...(focus_z_mm === null ? [] : [handle(focus_z_mm, 0.75 * reach, 0.018 * width, "sensor", "Sensor, to focus")]),
  ]);
  return lit.length;
}
