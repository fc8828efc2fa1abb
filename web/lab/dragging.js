// Points of the curve and the edge of the stop, dragged.

/** The place of an event in a drawing's own units. */
function placeIn(svg, { clientX, clientY }) {
  return new DOMPoint(clientX, clientY).matrixTransform(svg.getScreenCTM().inverse());
}

/** Calls dragged(place, which) while a handle of the drawing is dragged; the drawing may be replaced meanwhile. */
export function dragHandles(svg, dragged, ended = () => {}) {
  let which = null;
  svg.addEventListener("pointerdown", (event) => {
    if (!event.target.dataset.handle) return;
    which = event.target.dataset.handle;
    svg.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  svg.addEventListener("pointermove", (event) => which !== null && dragged(placeIn(svg, event), which));
  for (const type of ["pointerup", "pointercancel"]) svg.addEventListener(type, () => which !== null && ((which = null), ended()));
  svg.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-2, 0], ArrowRight: [2, 0], ArrowUp: [0, -2], ArrowDown: [0, 2] }[event.key], { handle, x, y } = event.target.dataset;
    if (!step || !handle) return;
    event.preventDefault();
    dragged({ x: Number(x) + step[0], y: Number(y) + step[1] }, handle);
    ended();
    queueMicrotask(() => svg.querySelector(`[data-handle="${handle}"]`)?.focus());
  });
}

/** Shares of the pupil's rim at which a curve has a point to drag. */
export const ZONES = [0, 0.35, 0.55, 0.7, 0.85, 1];
const PRIMARIES = { R: 611, G: 549, B: 464 };
const MOVED = ", curve moved by hand";
const CROSSING = "axis_crossing_minus_primary_paraxial_focus";

/** A zone's crossing in mm on the curve nearest to a wavelength. */
function crossing({ pupil_zone, [CROSSING]: curves }, nm, zone) {
  const [, mm] = Object.entries(curves).reduce((best, curve) => (Math.abs(curve[0] * 1000 - nm) < Math.abs(best[0] * 1000 - nm) ? curve : best));
  const above = Math.max(1, pupil_zone.findIndex((z) => z >= zone - 1e-9)), below = above - 1;
  const share = (zone - pupil_zone[below]) / (pupil_zone[above] - pupil_zone[below]);
  return mm[below] + Math.min(1, share) * (mm[above] - mm[below]);
}

/** The points of a lens drawn as curves: one for each zone, on the green curve. */
export const pointsOf = (aberration) => ZONES.map((zone) => ({ zone, mm: crossing(aberration, PRIMARIES.G, zone) }));

/** The text of a lens file whose curves are this lens's, moved at one zone by so many mm in all colours. */
export function movedCurve({ lens, efl_mm, f_number, longitudinal_aberration_mm: aberration }, index, by_mm, sensor_mm) {
  const rim_mm = efl_mm / (2 * f_number), rounded = (v) => Number(v.toFixed(4));
  return JSON.stringify({
    name: `${(lens.title ?? lens.name).replace(MOVED, "")}${MOVED}`, focal_length_mm: efl_mm, f_number, sensor_width_mm: sensor_mm, units: "mm",
    pupil_height: ZONES.map((zone) => rounded(zone * rim_mm)),
    curves: Object.entries(PRIMARIES).map(([wavelength_nm, nm]) => ({
      wavelength_nm, shift: ZONES.map((zone, i) => rounded(crossing(aberration, nm, zone) + (i === index ? by_mm : 0))),
    })),
  });
}
