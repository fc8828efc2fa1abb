// The bokeh texture: the discs of all sizes, a column each.
import { drawLight } from "./disc-view.js";

/** @param found a column for each distance, rows from the middle of the disc outwards: the other half is its mirror image */
export function drawTexture(canvas, { columns, used, pixels }) {
  const height = 2 * used - 1, out = new Float32Array(4 * columns * height);
  for (let y = 0; y < height; y++) {
    const from = 4 * columns * Math.abs(y - used + 1);
    out.set(pixels.subarray(from, from + 4 * columns), 4 * columns * y);
  }
  drawLight(canvas, { pixels: out, width: columns, height, white: 1 });
}
