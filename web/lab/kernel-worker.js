// The one thread in which petzval's kernels run. Messages: {id, call, args, slot}; of the calls that wait in a slot only the
// newest is made, so that a drag never queues up.
import createKernel from "./petzval-lab.js";

const waiting = [];
let kernel = null;
const lenses = new Map();

class Refused extends Error {}

/** Calls f with each text as a C string. */
function withText(texts, f) {
  const pointers = texts.map((text) => {
    if (text === null) return 0;
    const bytes = kernel.lengthBytesUTF8(text) + 1;
    const pointer = kernel._malloc(bytes);
    kernel.stringToUTF8(text, pointer, bytes);
    return pointer;
  });
  try {
    return f(...pointers);
  } finally {
    pointers.forEach((pointer) => kernel._free(pointer));
  }
}

function accepted(value) {
  if (!value) throw new Refused(kernel.UTF8ToString(kernel._petzval_error_text()));
  return value;
}

/** The text at a pointer that the caller owns. JSON of petzval writes infinity as 1e999, which JSON.parse reads as it. */
function taken(pointer) {
  const text = kernel.UTF8ToString(accepted(pointer));
  kernel._lab_free(pointer);
  return JSON.parse(text);
}

/** The lens of a choice, kept while choices repeat. @param {{name: string, text: ?string, look: object}} choice */
function lensOf(choice) {
  const key = JSON.stringify(choice);
  const known = lenses.get(key);
  if (known) return known;
  const look = JSON.stringify({ petzval_look: 1, lens: choice.look });
  const lens = accepted(withText([choice.name, choice.text, look], (...texts) => kernel._lab_lens(...texts)));
  lenses.set(key, lens);
  if (lenses.size > 8) {
    const [oldest, pointer] = lenses.entries().next().value;
    kernel._lab_close(pointer);
    lenses.delete(oldest);
  }
  return lens;
}

function mount({ focal_mm, sensor_mm, f_number, focus_m, width_px, height_px }) {
  kernel._lab_camera(focal_mm, sensor_mm, f_number, focus_m, width_px, height_px);
}

/** Floats that a call fills, as a copy of their own. */
function filled(count, call) {
  const pointer = kernel._malloc(count * 4);
  if (!pointer) throw new Refused("the browser gives no more memory");
  try {
    const result = accepted(call(pointer));
    return [result, kernel.HEAPF32.slice(pointer / 4, pointer / 4 + count)];
  } finally {
    kernel._free(pointer);
  }
}

const calls = {
  list: () => taken(kernel._lab_list()),
  version: () => kernel.UTF8ToString(kernel._petzval_version()),
  facts: ({ lens }) => taken(kernel._lab_facts(lensOf(lens))),
  section({ lens, camera, depth_m, x, y, rays }) {
    mount(camera);
    return taken(kernel._lab_section(lensOf(lens), depth_m, x, y, rays));
  },
  /** {size, needed, pixels}: r, g, b, a of a square; each channel sums to 1. */
  disc({ lens, camera, coc_px, x, y }) {
    mount(camera);
    const handle = lensOf(lens);
    const size = accepted(kernel._lab_disc_size(handle, coc_px, x, y));
    if (size > 1025) throw new Refused(`the disc is ${size} pixels wide; the lab draws up to 1025`);
    const [needed, pixels] = filled(size * size * 4, (out) => kernel._lab_disc(handle, coc_px, x, y, out, size));
    return { size, needed, pixels };
  },
  /** The bokeh texture: for eyes, or as `petzval lens table` writes it. */
  texture({ lens, camera, columns, largest_px, for_eyes = 1 }) {
    mount(camera);
    const handle = lensOf(lens);
    const rows = accepted(kernel._lab_texture_rows(handle, columns, largest_px, for_eyes));
    const [used, pixels] = filled(columns * rows * 4, (out) => kernel._lab_texture(handle, columns, largest_px, for_eyes, out, rows));
    return { columns, rows, used, pixels };
  },
};

function answer({ id, call, args }) {
  const start = performance.now();
  try {
    const result = calls[call](args);
    const moved = result && result.pixels ? [result.pixels.buffer] : [];
    postMessage({ id, result, ms: performance.now() - start }, moved);
  } catch (error) {
    postMessage({ id, error: error instanceof Refused ? error.message : `the kernel failed: ${error.message}` });
  }
}

function next() {
  const message = waiting.shift();
  if (!message) return;
  answer(message);
  if (waiting.length) setTimeout(next, 0); // messages that came meanwhile may replace what waits
}

/** What is dragged comes first: the coarse disc, then the exact one. */
const FIRST = ["facts", "disc", "exact"];
const rank = ({ slot }) => (FIRST.includes(slot) ? FIRST.indexOf(slot) : FIRST.length);

onmessage = ({ data }) => {
  const same = data.slot ? waiting.findIndex((other) => other.slot === data.slot) : -1;
  if (same >= 0) {
    postMessage({ id: waiting[same].id, replaced: true });
    waiting[same] = data;
  } else {
    const later = waiting.findIndex((other) => rank(other) > rank(data));
    waiting.splice(later < 0 ? waiting.length : later, 0, data);
    if (waiting.length === 1 && kernel) setTimeout(next, 0);
  }
};

createKernel()
  .then((made) => {
    kernel = made;
    postMessage({ ready: true });
    next();
  })
  .catch((error) => postMessage({ broken: error.message }));
