// Pictures with depth, from wherever they come, as the worker of frames takes them:
// {width, height, pixels (r, g, b, a), depth_m, first?, samples?, camera, name}.

const DEEP_WORDS = 6;

async function unzipped(response) {
  // A server may have undone the compression already.
  const bytes = new Uint8Array(await response.arrayBuffer());
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes.buffer;
  if (!globalThis.DecompressionStream) throw new Error("this browser cannot unpack the scene");
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

/** Planes of tools/scene_textures.py. */
function samplesAt(bytes, at, count) {
  const plane = (i) => bytes.subarray(at + i * count, at + (i + 1) * count);
  const [red, green, blue, exponent, low, high] = [0, 1, 2, 3, 4, 5].map(plane);
  const colours = new Float32Array(4 * count), depth_m = new Float32Array(count);
  for (let i = 0; i < count; i++) {
    const scale = 2 ** (exponent[i] - 136), code = low[i] + 256 * high[i];
    colours.set([red[i] * scale, green[i] * scale, blue[i] * scale, 1], 4 * i);
    depth_m[i] = code === 65535 ? Infinity : 2 ** (code / 4096 - 4);
  }
  return { colours, depth_m };
}

/** A built-in scene, packed when the site was built. */
export async function builtInScene(name) {
  const response = await fetch(new URL(`./${name}.bin.gz`, import.meta.url));
  if (!response.ok) throw new Error(`the scene could not be loaded (${response.status})`);
  const buffer = await unzipped(response), bytes = new Uint8Array(buffer), length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const { width, height, hidden, camera } = header, count = width * height, body = 4 + length, mask = body + 6 * count;
  const seen = samplesAt(bytes, body, count), behind = samplesAt(bytes, mask + Math.ceil(count / 8), hidden);
  const first = new BigUint64Array(count + 1), samples = new Float32Array(DEEP_WORDS * hidden);
  for (let i = 0, s = 0; i < count; i++) {
    if ((bytes[mask + (i >> 3)] >> (i & 7)) & 1) {
      samples.set(behind.colours.subarray(4 * s, 4 * s + 4), DEEP_WORDS * s);
      samples.fill(behind.depth_m[s], DEEP_WORDS * s + 4, DEEP_WORDS * s + 6);
      s++;
    }
    first[i + 1] = BigInt(s);
  }
  return { name, width, height, pixels: seen.colours, depth_m: seen.depth_m, first, samples, camera, told: `The scene ${name}, with one layer of hidden background.` };
}

const MOST_WIDE = 960, MOST_HIGH = 640, MOST_BYTES = 600e6;
const USUAL_CAMERA = { focal_mm: 50, sensor_mm: 36, f_number: 2 };

/** sRGB codes 0…255 as light. */
const LIGHT = Float32Array.from({ length: 256 }, (_, code) => {
  const v = code / 255;
  return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
});

const middleOf = (depth_m) => Float32Array.from(depth_m).filter(Number.isFinite).sort()[Math.floor(depth_m.length / 2)] ?? 5;

/** Means of light over squares of pixels and the depth of their middle, so that a page can work with it. */
function reduced({ width, height, light, depth_m }) {
  const step = Math.max(1, Math.ceil(width / MOST_WIDE), Math.ceil(height / MOST_HIGH));
  const wide = Math.floor(width / step), high = Math.floor(height / step), middle = step >> 1;
  if (!wide || !high) throw new Error(`${width} × ${height} is not a picture to look at`);
  const pixels = new Float32Array(4 * wide * high), depths = new Float32Array(wide * high);
  for (let y = 0; y < high; y++)
    for (let x = 0; x < wide; x++) {
      depths[y * wide + x] = depth_m((y * step + middle) * width + x * step + middle);
      for (let v = 0; v < step; v++) for (let u = 0; u < step; u++) light((y * step + v) * width + x * step + u, pixels, 4 * (y * wide + x), 1 / (step * step));
    }
  return { width: wide, height: high, pixels, depth_m: depths };
}

async function shotOfExr(file) {
  const { readExr } = await import("./exr.js");
  const exr = await readExr(await file.arrayBuffer());
  const small = reduced({
    ...exr,
    depth_m: (i) => (exr.Z[i] > 0 && exr.Z[i] < 1e9 ? exr.Z[i] : Infinity),
    light: (i, into, at, share) => ["R", "G", "B", "A"].forEach((part, c) => (into[at + c] += share * (exr[part]?.[i] ?? 1))),
  });
  const known = Object.fromEntries(Object.entries(exr.camera).filter(([, value]) => value > 0 && Number.isFinite(value)));
  return { ...small, name: file.name, camera: { ...USUAL_CAMERA, focus_m: middleOf(small.depth_m), ...known }, told: toldOf(file, exr, small) };
}

const toldOf = ({ name }, whole, { width, height }) => `${name}, ${whole.width} × ${whole.height}${whole.width === width ? "" : `, shown at ${width} × ${height}`}. It stays on this machine.`;

async function codesOf(file, size = null) {
  let bitmap;
  try {
    bitmap = await createImageBitmap(file, { colorSpaceConversion: "none" });
  } catch {
    throw new Error(`${file.name} is not a picture that this browser reads`);
  }
  const { width, height } = size ?? bitmap, canvas = new OffscreenCanvas(width, height), pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.drawImage(bitmap, 0, 0, width, height);
  return { width, height, codes: pen.getImageData(0, 0, width, height).data };
}

/** A photograph and a depth map: light is near, between the distances given, in even steps of 1/distance. */
async function shotOfPhotograph([photograph, map], { nearest_m, farthest_m }) {
  if (!(nearest_m > 0 && farthest_m > nearest_m)) throw new Error("The nearest distance must be above 0 and below the farthest.");
  const whole = await codesOf(photograph), depth = await codesOf(map, whole);
  const small = reduced({
    ...whole,
    depth_m: (i) => 1 / (1 / farthest_m + (depth.codes[4 * i] / 255) * (1 / nearest_m - 1 / farthest_m)),
    light: (i, into, at, share) => {
      for (let c = 0; c < 3; c++) into[at + c] += share * LIGHT[whole.codes[4 * i + c]];
      into[at + 3] += share;
    },
  });
  return { ...small, name: photograph.name, camera: { ...USUAL_CAMERA, focus_m: middleOf(small.depth_m) }, told: toldOf(photograph, whole, small) };
}

/** @param {File[]} files one EXR with depth, or a photograph and its depth map @throws {Error} with a sentence */
export async function shotOfFiles(files, depths) {
  const large = files.find((file) => file.size > MOST_BYTES);
  if (large) throw new Error(`${large.name} holds ${(large.size / 1e6).toFixed(0)} MB; the page reads up to ${MOST_BYTES / 1e6} MB.`);
  if (files.length === 1 && !/^image\/(?!.*exr)/.test(files[0].type)) {
    return shotOfExr(files[0]).catch((error) => {
      throw new Error(`${files[0].name} was not opened: ${error.message}.`);
    });
  }
  if (files.length === 1) throw new Error(`${files[0].name} has no depth: choose an EXR with depth, or the photograph and its depth map together.`);
  if (files.length !== 2) throw new Error("Choose an EXR with depth, or a photograph and its depth map.");
  const isMap = (file) => /depth|disparity|zmap/i.test(file.name);
  return shotOfPhotograph(isMap(files[0]) && !isMap(files[1]) ? [files[1], files[0]] : files, depths);
}
