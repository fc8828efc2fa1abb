// The page of articles: tori through one of three methods, with its controls and its buffers.
import { Kit } from "./gl-kit.js";
import { Tori } from "./tori.js";
import { Gather, HexaDrive, Wgld } from "./article-passes.js";

const $ = (id) => document.getElementById(id);

/** Of each method: its buffers with the factor and shift that make them visible, and its controls. */
const METHODS = {
  wgld: {
    make: Wgld, lamps: false,
    buffers: { result: "Result", index: "Depth as index", sharp: "Sharp", small: "Small blur", large: "Large blur", rows: "Temporary, rows blurred" },
    knobs: { offset: { label: "Depth offset", min: -0.5, max: 0.85, step: 0.01, value: 0.33 }, radius_px: { label: "Large blur, px", min: 2, max: 24, step: 1, value: 12 } },
  },
  gather: {
    make: Gather, lamps: true,
    buffers: { result: "Result", coc: "Circle of confusion", half: "Half size", disc: "Disc, near and far", tent: "After the tent", sharp: "Sharp" },
    knobs: {
      focus_m: { label: "Focus, m", min: 2, max: 30, step: 0.1, value: 7 }, radius_px: { label: "Largest radius, px", min: 2, max: 32, step: 1, value: 14 },
      taps: { label: "Taps", choices: [16, 22, 43, 71], value: 43 },
    },
  },
  hexadrive: {
    make: HexaDrive, lamps: true,
    buffers: { result: "Result", atlas: "Levels in one buffer (A)", sharp: "Sharp" },
    knobs: {
      focus_m: { label: "Focus, m", min: 2, max: 30, step: 0.1, value: 7 }, radius_px: { label: "Largest radius, px", min: 2, max: 40, step: 1, value: 20 },
      every: { label: "A sprite for squares of, px", choices: [1, 2, 4, 8], value: 1 },
    },
  },
};

class Articles {
  #kit; #tori; #show; #made = {};
  method = "wgld";
  buffer = "result";
  turns = 0.06;
  values = Object.fromEntries(Object.entries(METHODS).map(([name, { knobs }]) => [name, Object.fromEntries(Object.entries(knobs).map(([k, knob]) => [k, knob.value]))]));

  constructor(canvas) {
    this.#kit = new Kit(canvas);
    this.#tori = new Tori(this.#kit);
    this.#show = this.#kit.program(`
uniform sampler2D image;
uniform float scale, shift, is_light;
out vec4 code;
void main() {
  ivec2 size = textureSize(image, 0);
  vec3 light = clamp(texelFetch(image, ivec2(gl_FragCoord.x, float(size.y) - gl_FragCoord.y), 0).rgb * scale + shift, 0.0, 1.0);
  vec3 coded = mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
  code = vec4(mix(light, coded, is_light), 1);
}`);
  }

  /** Draws one frame. @returns {Object<string, object>} buffers by name */
  draw() {
    const { make, lamps } = METHODS[this.method], values = this.values[this.method];
    this.#made[this.method] ??= new make(this.#kit);
    this.scene = this.#tori.draw(this.turns, { lamps });
    this.drawn = this.#made[this.method].draw(this.scene, values);
    const image = this.drawn[this.buffer], { canvas } = this.#kit.gl;
    [canvas.width, canvas.height] = [image.width, image.height];
    canvas.parentElement.style.aspectRatio = `${image.width} / ${image.height}`;
    const how = this.buffer === "coc" ? { scale: 0.5 / values.radius_px, shift: 0.5, is_light: 0 } : { scale: 1, shift: 0, is_light: this.buffer === "index" ? 0 : 1 };
    this.#kit.draw(this.#show, [], { image, ...how });
    return this.drawn;
  }

  pixels(image) {
    return this.#kit.pixels(image);
  }
}

let articles = null, turning = false;

function redraw() {
  articles.draw();
  const { count } = articles.drawn;
  $("told").textContent = count ? `${count.toLocaleString("en")} sprites in one draw.` : "";
}

function knobOf(name, { label, choices, ...range }) {
  const made = document.createElement("label"), shown = Object.assign(document.createElement("span"), { className: "value" }), values = articles.values[articles.method];
  const input = document.createElement(choices ? "select" : "input");
  if (choices) input.append(...choices.map((choice) => new Option(choice, choice)));
  else Object.assign(input, { type: "range", min: range.min, max: range.max, step: range.step });
  Object.assign(input, { value: values[name], id: `knob-${name}` });
  const tell = () => (shown.textContent = choices ? "" : values[name]);
  input.oninput = () => ((values[name] = Number(input.value)), tell(), turning || redraw());
  tell();
  made.append(label, shown, input);
  return made;
}

function chooseMethod(name) {
  articles.method = name;
  articles.buffer = "result";
  const { buffers, knobs } = METHODS[name];
  $("buffers").replaceChildren(...Object.entries(buffers).map(([buffer, label]) => {
    const made = document.createElement("label"), input = Object.assign(document.createElement("input"), { type: "radio", name: "buffer", value: buffer, checked: buffer === "result" });
    input.onchange = () => ((articles.buffer = buffer), turning || redraw());
    made.append(input, ` ${label}`);
    return made;
  }));
  $("knobs").replaceChildren(...Object.entries(knobs).map(([knob, how]) => knobOf(knob, how)));
  redraw();
}

function turn(now, last = now) {
  if (!turning) return;
  articles.turns += Math.min(0.1, (now - last) / 1000) * 0.05;
  redraw();
  requestAnimationFrame((next) => turn(next, now));
}

function setTurning(on) {
  turning = on;
  $("turn").setAttribute("aria-pressed", on);
  $("turn").textContent = on ? "Hold still" : "Turn";
  if (on) requestAnimationFrame(turn);
}

function start() {
  try {
    articles = new Articles($("view"));
    chooseMethod("wgld");
  } catch (error) {
    articles = null;
    $("problem").textContent = `The pictures cannot be shown: ${error.message}.`;
    $("problem").hidden = false;
    return;
  }
  for (const input of document.querySelectorAll('[name="method"]')) input.onchange = () => chooseMethod(input.value);
  $("turn").onclick = () => setTurning(!turning);
  addEventListener("keydown", ({ key, target, ctrlKey, metaKey }) => {
    if (key.toLowerCase() !== "a" || ctrlKey || metaKey || articles.method !== "hexadrive" || /^(INPUT|SELECT)$/.test(target.tagName) && target.type !== "radio") return;
    const wanted = articles.buffer === "atlas" ? "result" : "atlas";
    document.querySelector(`[name="buffer"][value="${wanted}"]`).click();
  });
}

start();
// For the browser's console, and for tests.
globalThis.articles = { get view() { return articles; }, chooseMethod, setTurning, redraw };
