// Discs and tables as EXR: scan lines of floats, uncompressed (openexr.com, "OpenEXR File Layout").
import { save } from "./saving.js";

const COLUMNS = 512, LARGEST_PX = 64, ROWS_PER_PX = 4, CHANNELS = [["B", 2], ["G", 1], ["R", 0]];

class Bytes {
  #parts = [];

  raw(...bytes) {
    this.#parts.push(Uint8Array.from(bytes));
    return this;
  }

  text(words) {
    return this.raw(...new TextEncoder().encode(words), 0);
  }

  numbers(kind, ...values) {
    const view = new DataView(new ArrayBuffer(4 * values.length));
    values.forEach((value, i) => view[`set${kind}`](4 * i, value, true));
    this.#parts.push(new Uint8Array(view.buffer));
    return this;
  }

  attribute(name, type, { all }) {
    this.text(name).text(type).numbers("Int32", all.length);
    this.#parts.push(all);
    return this;
  }

  get all() {
    const out = new Uint8Array(this.#parts.reduce((sum, part) => sum + part.length, 0));
    this.#parts.reduce((at, part) => (out.set(part, at), at + part.length), 0);
    return out;
  }
}

function headerOf(width, height, texts) {
  const bytes = () => new Bytes(), channels = bytes(), box = bytes().numbers("Int32", 0, 0, width - 1, height - 1);
  for (const [name] of CHANNELS) channels.text(name).numbers("Int32", 2, 0, 1, 1);
  const head = bytes().numbers("Int32", 20000630, 2).attribute("channels", "chlist", channels.raw(0)).attribute("compression", "compression", bytes().raw(0))
    .attribute("dataWindow", "box2i", box).attribute("displayWindow", "box2i", box).attribute("lineOrder", "lineOrder", bytes().raw(0))
    .attribute("pixelAspectRatio", "float", bytes().numbers("Float32", 1)).attribute("screenWindowCenter", "v2f", bytes().numbers("Float32", 0, 0))
    .attribute("screenWindowWidth", "float", bytes().numbers("Float32", 1));
  for (const [name, words] of Object.entries(texts)) head.attribute(name, "string", bytes().raw(...new TextEncoder().encode(words)));
  return head.raw(0).all;
}

/** @param {Float32Array} pixels r, g, b, a of whole rows @param {Object<string, string>} texts attributes @returns {Uint8Array} */
export function exrBytes(width, height, pixels, texts) {
  const head = headerOf(width, height, texts), line = 8 + 4 * CHANNELS.length * width;
  const out = new Uint8Array(head.length + (8 + line) * height), view = new DataView(out.buffer);
  out.set(head);
  for (let y = 0; y < height; y++) {
    let at = head.length + 8 * height + line * y;
    view.setBigUint64(head.length + 8 * y, BigInt(at), true);
    view.setInt32(at, y, true);
    view.setInt32(at + 4, line - 8, true);
    at += 8;
    for (const [, c] of CHANNELS) for (let x = 0; x < width; x++, at += 4) view.setFloat32(at, pixels[4 * (y * width + x) + c], true);
  }
  return out;
}

const saved = (bytes, name) => save(new Blob([bytes], { type: "image/x-exr" }), name);

/** The disc in linear light; each channel sums to 1. */
export async function discExr(kernel, args) {
  const { size, pixels } = (await kernel.ask("disc", args)).result;
  saved(exrBytes(size, size, pixels, { "petzval:lens": args.lens.name }), `${args.lens.name}-${args.coc_px}px.exr`);
}

/** The bokeh texture with the attributes that `petzval lens table` gives it. */
export async function tableExr(kernel, { lens, camera, title }) {
  const { used, pixels } = (await kernel.ask("texture", { lens, camera, columns: COLUMNS, largest_px: LARGEST_PX, for_eyes: 0 })).result;
  const texts = {
    lens: title, coc: "signed radius, px, + is far", columns: COLUMNS, columnSpacing: "square root of the radius", largestRadius: LARGEST_PX,
    rowsPerPixel: ROWS_PER_PX, pictureWidth: camera.width_px, focalLength: camera.focal_mm, fNumber: camera.f_number, sensorWidth: camera.sensor_mm,
  };
  const attributes = Object.fromEntries(Object.entries(texts).map(([name, value]) => [`petzval:${name}`, `${value}`]));
  saved(exrBytes(COLUMNS, used, pixels, attributes), `${lens.name}-table.exr`);
}
