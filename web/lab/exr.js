// Reads EXR pictures with depth: one part, scan lines, uncompressed or ZIP, halves or floats (openexr.com, "OpenEXR File Layout").
// Everything else is refused with a sentence.

export class Unreadable extends Error {}

const MAGIC = 20000630, MOST_PIXELS = 34e6;
const LINES = { 0: 1, 2: 1, 3: 16 };
const COMPRESSIONS = ["none", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A", "DWAA", "DWAB"];

const HALVES = new Float32Array(65536);
for (let code = 0; code < 65536; code++) {
  const sign = code & 0x8000 ? -1 : 1, exponent = (code >> 10) & 31, fraction = code & 1023;
  HALVES[code] = sign * (exponent === 0 ? fraction * 2 ** -24 : exponent === 31 ? (fraction ? NaN : Infinity) : (1 + fraction / 1024) * 2 ** (exponent - 15));
}

function headerOf(view) {
  if (view.byteLength < 8 || view.getUint32(0, true) !== MAGIC) throw new Unreadable("it is not an EXR");
  const flags = view.getUint32(4, true) >>> 8;
  if (flags & 0x18) throw new Unreadable("it is deep or has several parts; the page reads one flat part");
  if (flags & 0x02) throw new Unreadable("it is tiled; the page reads scan lines");
  const attributes = {};
  let at = 8;
  const word = () => {
    const from = at;
    while (view.getUint8(at)) at++;
    return String.fromCharCode(...new Uint8Array(view.buffer, from, at++ - from));
  };
  for (let name; (name = word()); ) {
    const type = word(), size = view.getInt32(at, true);
    if (size < 0 || at + 4 + size > view.byteLength) throw new RangeError();
    attributes[name] = { type, view: new DataView(view.buffer, at + 4, size) };
    at += 4 + size;
  }
  return { attributes, at };
}

function channelsOf({ view }) {
  const channels = [];
  for (let at = 0; view.getUint8(at); at += 17) {
    const from = at;
    while (view.getUint8(at)) at++;
    const name = new TextDecoder().decode(new Uint8Array(view.buffer, view.byteOffset + from, at - from)), type = view.getInt32(at + 1, true);
    if (view.getInt32(at + 9, true) !== 1 || view.getInt32(at + 13, true) !== 1) throw new Unreadable(`its channel ${name} is subsampled`);
    channels.push({ name, bytes: type === 1 ? 2 : 4, type });
  }
  return channels;
}

/** Red, green, blue, alpha and depth among the channels: of the plainest layer that has all three colours. */
function chosen(channels) {
  const names = channels.map((channel) => channel.name);
  const layers = names.filter((n) => /(^|\.)R$/.test(n)).map((n) => n.slice(0, -1)).filter((l) => names.includes(`${l}G`) && names.includes(`${l}B`));
  const layer = layers.sort((a, b) => a.length - b.length)[0];
  if (layer === undefined) throw new Unreadable("it has no channels R, G and B");
  const depths = names.filter((n) => /(^|\.)(Z|depth|Depth)$/.test(n) || /[Dd]epth\.[VYR]$/.test(n)).sort((a, b) => a.length - b.length);
  if (!depths.length) throw new Unreadable("it has no depth (a channel Z, depth or Depth.Z)");
  return { R: `${layer}R`, G: `${layer}G`, B: `${layer}B`, A: names.includes(`${layer}A`) ? `${layer}A` : null, Z: depths[0] };
}

async function unpacked(packed, size) {
  if (packed.length === size) return packed;
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const raw = new Uint8Array(size), reader = stream.getReader();
  let length = 0;
  for (let part; !(part = await reader.read()).done; length += part.value.length) {
    if (length + part.value.length > size) throw new RangeError();
    raw.set(part.value, length);
  }
  if (length !== size) throw new RangeError();
  for (let i = 1; i < size; i++) raw[i] += raw[i - 1] - 128;
  const out = new Uint8Array(size), middle = (size + 1) >> 1;
  for (let i = 0; i < size; i++) out[i] = raw[i & 1 ? middle + (i >> 1) : i >> 1];
  return out;
}

function boxOf(attribute) {
  return [0, 4, 8, 12].map((at) => attribute.view.getInt32(at, true));
}

function numberOf(attributes, name) {
  const kept = attributes[name];
  return kept && (kept.type === "float" || kept.type === "v2f") ? kept.view.getFloat32(0, true) : null;
}

/** Planes of floats by the channel's part: {width, height, R, G, B, A?, Z, camera}. @throws {Unreadable} @param {ArrayBuffer} buffer */
export async function readExr(buffer) {
  try {
    return await read(buffer);
  } catch (error) {
    if (error instanceof Unreadable) throw error;
    throw new Unreadable("it is damaged or cut off");
  }
}

async function read(buffer) {
  const view = new DataView(buffer), { attributes, at } = headerOf(view);
  const compression = attributes.compression.view.getUint8(0);
  if (!(compression in LINES)) throw new Unreadable(`it is packed as ${COMPRESSIONS[compression] ?? compression}; the page reads ZIP, ZIPS and none`);
  const data = boxOf(attributes.dataWindow), width = data[2] - data[0] + 1, height = data[3] - data[1] + 1;
  if (width < 1 || height < 1) throw new RangeError();
  if (width * height > MOST_PIXELS) throw new Unreadable(`it is ${width} × ${height}; the page reads up to ${MOST_PIXELS / 1e6} million pixels`);
  if (boxOf(attributes.displayWindow).join() !== data.join()) throw new Unreadable("its data window is not its display window");
  const channels = channelsOf(attributes.channels), parts = chosen(channels), planes = {};
  for (const [part, name] of Object.entries(parts)) if (name) planes[part] = new Float32Array(width * height);
  const line = channels.reduce((sum, channel) => sum + channel.bytes * width, 0), lines = LINES[compression];
  for (let block = 0; block * lines < height; block++) {
    const start = Number(view.getBigUint64(at + 8 * block, true)), y = view.getInt32(start, true) - data[1], size = view.getInt32(start + 4, true);
    const rows = Math.min(lines, height - y);
    if (y < 0 || rows < 1 || size < 0) throw new RangeError();
    const bytes = await unpacked(new Uint8Array(buffer, start + 8, size), rows * line);
    copyRows(new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), { y, rows, width, channels, parts }, planes);
  }
  const [focal_mm, sensor_mm, f_number, focus_m] = ["pinholeFocalLength", "sensorOverallDimensions", "aperture", "focus"].map((n) => numberOf(attributes, n));
  return { width, height, ...planes, camera: { focal_mm, sensor_mm, f_number, focus_m } };
}

function copyRows(view, { y, rows, width, channels, parts }, planes) {
  let at = 0;
  for (let row = y; row < y + rows; row++)
    for (const { name, bytes, type } of channels) {
      for (const part of Object.keys(parts).filter((p) => parts[p] === name))
        for (let x = 0; x < width; x++)
          planes[part][row * width + x] = type === 1 ? HALVES[view.getUint16(at + 2 * x, true)] : type === 2 ? view.getFloat32(at + 4 * x, true) : view.getUint32(at + 4 * x, true);
      at += bytes * width;
    }
}
