// A thread in which petzval makes frames. One makes plans that the page draws live; another, started for each picture to be
// developed, runs the engine "scatter": ending it cancels. Messages: {id, call, args}.
import createPicture from "./petzval-picture.js";

let handed = {}, running = 0, kernel = null, held = [];
const waiting = [];

class Refused extends Error {}

function allocated(bytes) {
  const pointer = kernel._malloc(bytes);
  if (!pointer) throw new Refused("the browser gives no more memory");
  return pointer;
}

function copied(array) {
  const pointer = allocated(array.byteLength);
  kernel.HEAPU8.set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), pointer);
  return pointer;
}

function textAt(text) {
  if (text == null) return 0;
  const bytes = kernel.lengthBytesUTF8(text) + 1, pointer = allocated(bytes);
  kernel.stringToUTF8(text, pointer, bytes);
  return pointer;
}

let size = null;

const calls = {
  /** The picture of all frames: r, g, b, a; metres; samples of hidden layers, 6 words each, and where those of a pixel begin. */
  shot({ width, height, pixels, depth_m, first, samples }) {
    held.forEach((pointer) => kernel._free(pointer));
    held = [copied(pixels), copied(depth_m)];
    size = { width, height };
    kernel._picture_shot(held[0], held[1], width, height);
    if (!samples) return;
    held.push(copied(first), copied(samples));
    kernel._picture_deep(held[2], held[3], samples.length / 6);
  },
  /** Plans of a live frame by name, or the pixels of a developed one; the report of either. */
  frame({ look, lens, camera, is_live }) {
    const texts = [JSON.stringify(look), lens.name, lens.text ?? null].map(textAt);
    const out = allocated(16 * size.width * size.height);
    handed = {};
    try {
      const told = kernel._picture_frame(...texts, camera.focal_mm, camera.sensor_mm, camera.f_number, camera.focus_m, is_live ? 1 : 0, out);
      if (!told) throw new Refused(kernel.UTF8ToString(kernel._petzval_error_text()));
      const report = JSON.parse(kernel.UTF8ToString(told));
      kernel._picture_close(told);
      return is_live ? { report, handed } : { report, pixels: kernel.HEAPF32.slice(out / 4, out / 4 + 4 * size.width * size.height) };
    } finally {
      [...texts, out].forEach((pointer) => kernel._free(pointer));
    }
  },
};

function answer({ id, call, args }) {
  const start = performance.now();
  running = id;
  try {
    const result = calls[call](args);
    const moved = result ? [...Object.values(result.handed ?? {}), ...(result.pixels ? [result.pixels] : [])].map((array) => array.buffer) : [];
    postMessage({ id, result, ms: performance.now() - start }, moved);
  } catch (error) {
    postMessage({ id, error: error instanceof Refused ? error.message : `the program failed: ${error.message}` });
  }
}

onmessage = ({ data }) => {
  if (!kernel) waiting.push(data);
  else answer(data);
};

createPicture({
  handed: (name, words) => (handed[name] = words),
  progressed: (done) => postMessage({ id: running, done }),
})
  .then((made) => {
    kernel = made;
    waiting.forEach(answer);
  })
  .catch((error) => postMessage({ broken: error.message }));
