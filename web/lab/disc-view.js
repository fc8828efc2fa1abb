// Light as pixels on a canvas.

/** sRGB codes of linear light 0…1 in 4096 steps (IEC 61966-2-1). */
const CODES = Uint8ClampedArray.from({ length: 4097 }, (_, i) => {
  const light = i / 4096;
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);
});

const coded = (light) => CODES[Math.max(0, Math.min(4096, Math.round(light * 4096)))];

/** The light of an even disc of this radius: the brightness that the pictures are shown at. */
export function evenLight(radius_px) {
  return 1 / (Math.PI * Math.max(0.5, Math.abs(radius_px)) ** 2);
}

/** Draws r, g, b, a floats with `white` as white. @param {HTMLCanvasElement} canvas gets the picture's size */
export function drawLight(canvas, { pixels, width, height, white, view }) {
  const image = new ImageData(width, height);
  const { x0 = 0, y0 = 0, stride = width } = view ?? {};
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const from = 4 * ((y + y0) * stride + x + x0), to = 4 * (y * width + x);
      for (let c = 0; c < 3; c++) image.data[to + c] = coded(pixels[from + c] / white);
      image.data[to + 3] = 255;
    }
  canvas.width = width;
  canvas.height = height;
  canvas.getContext("2d").putImageData(image, 0, 0);
}

/** A disc with a border around what it needs. @param {{size: number, needed: number, pixels: Float32Array}} disc */
export function drawDisc(canvas, disc, coc_px, exposure) {
  const side = Math.min(disc.size, disc.needed + 8), start = (disc.size - side) >> 1;
  drawLight(canvas, {
    pixels: disc.pixels, width: side, height: side, white: evenLight(coc_px) / (0.6 * 2 ** exposure),
    view: { x0: start, y0: start, stride: disc.size },
  });
  return side;
}
