// The story: figures that the kernel computes while their controls are moved.
import { Kernel, Replaced } from "./kernel.js";
import { drawDisc, drawLight } from "./disc-view.js";
import { drawCurves } from "./curves-view.js";
import { drawCaustic } from "./caustic-view.js";
import { drawTexture } from "./texture-view.js";

const kernel = new Kernel();
const WIDTH_PX = 1920, HEIGHT_PX = 1080, SENSOR_MM = 36, FOCAL_MM = 50;

/** A camera on which a light has this circle of confusion: in front of focus it looks to infinity, behind it the light is there. */
function cameraFor(coc_px, f_number) {
  const radius_mm = (Math.abs(coc_px) * SENSOR_MM) / WIDTH_PX, focus_m = coc_px > 0 ? (FOCAL_MM + FOCAL_MM ** 2 / (2 * f_number * radius_mm || 1e-9)) / 1000 : 0;
  return { focal_mm: FOCAL_MM, f_number, sensor_mm: SENSOR_MM, focus_m, width_px: WIDTH_PX, height_px: HEIGHT_PX };
}

const lensOf = (name, look = {}) => ({ name, text: null, look });
const AMOUNT = { min: -2, max: 2, step: 0.05, value: 1 };
const side = (coc_px) => `${Math.abs(coc_px)} px ${coc_px < 0 ? "in front of" : "behind"} focus`;

/** Of each figure: its knobs, and its views as functions of their values. */
const FIGURES = {
  aperture: {
    knobs: { coc_px: { label: "Distance from focus, px", min: -40, max: 40, step: 1, value: 30 }, blades: { label: "Blades", choices: [0, 5, 6, 7, 9], value: 5 } },
    views: (v) => [disc(lensOf("ideal", { blades: v.blades, blade_rotation_deg: 90 }), v.coc_px)],
  },
  curve: {
    knobs: { spherical: { label: "Spherical aberration", ...AMOUNT } },
    views: (v) => [curves(lensOf("uncorrected"), v.spherical), caustic(lensOf("uncorrected"), v.spherical)],
  },
  rims: {
    knobs: { spherical: { label: "Spherical aberration", ...AMOUNT } },
    views: (v) => [-30, 30].map((coc_px) => disc(lensOf("uncorrected", { spherical: v.spherical, axial_colour: 0 }), coc_px)),
  },
  colour: {
    knobs: { axial_colour: { label: "Axial colour", ...AMOUNT }, coc_px: { label: "Size, px", min: 4, max: 50, step: 1, value: 18 } },
    views: (v) => [-v.coc_px, v.coc_px].map((coc_px) => disc(lensOf("asphere", { axial_colour: v.axial_colour }), coc_px)),
  },
  doublet: {
    knobs: { coc_px: { label: "Size, px", min: 3, max: 60, step: 1, value: 16 }, f_number: { label: "F-number", min: 2, max: 8, step: 0.1, value: 2 } },
    views: (v) => [...[-v.coc_px, v.coc_px].map((coc_px) => disc(lensOf("doublet"), coc_px, { f_number: v.f_number })), curves(lensOf("doublet"))],
  },
  texture: {
    knobs: { lens: { label: "Lens", choices: ["doublet", "uncorrected", "doublet-overcorrected", "triplet", "asphere", "ideal"], value: "doublet" } },
    views: (v) => [texture(lensOf(v.lens))],
  },
  corner: {
    knobs: {
      place: { label: "Towards the corner", min: 0, max: 1, step: 0.02, value: 0.8 }, coma: { label: "Coma", min: -5, max: 5, step: 0.1, value: 2 },
      cats_eye: { label: "Cat's eye", min: 0, max: 1, step: 0.01, value: 0.5 },
    },
    views: (v) => [-25, 25].map((coc_px) => disc(lensOf("doublet", { coma: v.coma, cats_eye: v.cats_eye }), coc_px, { x: 0.87 * v.place, y: 0.49 * v.place })),
  },
  light: {
    knobs: { brightest: { label: "Brightest lamp, times white", min: 0, max: 12, step: 0.1, value: 10, told: (v) => Math.round(2 ** v) } },
    views: (v) => [false, true].map((coded) => lamps(2 ** v.brightest, coded)),
  },
};

function disc(lens, coc_px, { f_number = 2, x = 0, y = 0 } = {}) {
  return {
    kind: "canvas", caption: coc_px === 0 ? "in focus" : side(coc_px), call: "disc", args: { lens, camera: cameraFor(coc_px, f_number), coc_px, x, y },
    draw: (canvas, found) => drawDisc(canvas, found, coc_px, 0),
  };
}

/** A lens's longitudinal aberration with this many times its spherical part: how far each zone is from the axis's own focus. */
function corrected({ longitudinal_aberration_mm: own }, spherical) {
  const name = "axis_crossing_minus_primary_paraxial_focus", scaled = (mm) => mm.map((v) => (v === null ? null : mm[0] + spherical * (v - mm[0])));
  return { ...own, [name]: Object.fromEntries(Object.entries(own[name]).map(([um, mm]) => [um, scaled(mm)])) };
}

const ofFacts = (lens, spherical, caption, draw) => ({ kind: "svg", caption, call: "facts", args: { lens }, draw: (svg, facts) => draw(svg, corrected(facts, spherical)) });
const curves = (lens, spherical = 1) => ofFacts(lens, spherical, "Points where the light of each zone crosses the axis.", drawCurves);
const caustic = (lens, spherical) => ofFacts(lens, spherical, "Rays near focus. The left line is the sensor for a light in front of focus, the right line for a light behind focus.", drawCaustic);

function texture(lens) {
  return {
    kind: "canvas", wide: true, caption: "From 60 px in front of focus (left) to 60 px behind (right); the brightest point of each column is white.", call: "texture",
    args: { lens, camera: cameraFor(0, 2), columns: 257, largest_px: 60 }, draw: drawTexture,
  };
}

const LAMPS = [[60, 60], [180, 60], [60, 150], [180, 150]], LAMPS_SIZE = [240, 210], DARK = 0.02;
const toCode = (light) => (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);
const toLight = (code) => (code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4);

function lamps(brightest, coded) {
  return {
    kind: "canvas", caption: coded ? "Display codes, blurred." : "Light, blurred, then encoded.", call: "disc", args: disc(lensOf("doublet"), 20).args,
    draw: (canvas, { size, pixels }) => {
      const [width, height] = LAMPS_SIZE, out = new Float32Array(4 * width * height).fill(coded ? toCode(DARK) : DARK);
      LAMPS.forEach(([px, py], i) => {
        const light = brightest / 4 ** (3 - i), extra = coded ? toCode(Math.min(1, light)) - toCode(DARK) : light - DARK, half = size >> 1;
        for (let y = 0; y < size; y++)
          for (let x = 0; x < size; x++) {
            const u = px + x - half, v = py + y - half;
            if (u < 0 || v < 0 || u >= width || v >= height) continue;
            for (let c = 0; c < 3; c++) out[4 * (v * width + u) + c] += extra * pixels[4 * (y * size + x) + c];
          }
      });
      drawLight(canvas, { pixels: coded ? out.map((code) => toLight(Math.max(0, Math.min(1, code)))) : out, width, height, white: 1 });
    },
  };
}

class Figure {
  #spec; #values; #made = [];
  constructor(element, name) {
    this.name = name;
    this.#spec = FIGURES[name];
    this.#values = Object.fromEntries(Object.entries(this.#spec.knobs).map(([knob, { value }]) => [knob, value]));
    const views = Object.assign(document.createElement("div"), { className: "views" });
    this.#made = this.#spec.views(this.#values).map(({ kind, wide, caption: told }) => {
      const cell = document.createElement("div"), caption = Object.assign(document.createElement("p"), { className: "hint" });
      const drawing = kind === "svg" ? document.createElementNS("http://www.w3.org/2000/svg", "svg") : document.createElement("canvas");
      drawing.setAttribute("role", "img");
      drawing.setAttribute("aria-label", told ? `Figure: ${told}` : "Figure");
      cell.className = wide ? "view whole" : "view";
      cell.append(drawing, caption);
      views.append(cell);
      return { drawing, caption };
    });
    element.append(views, ...Object.entries(this.#spec.knobs).map(([knob, how]) => this.#knob(knob, how)));
  }

  #knob(knob, { label, choices, value, told = (v) => v, ...range }) {
    const made = document.createElement("label"), shown = Object.assign(document.createElement("span"), { className: "value" }), input = document.createElement(choices ? "select" : "input");
    if (choices) input.append(...choices.map((choice) => new Option(choice, choice)));
    else Object.assign(input, { type: "range", ...range });
    input.value = value;
    const tell = () => (shown.textContent = choices ? "" : told(this.#values[knob]));
    input.oninput = () => ((this.#values[knob] = typeof value === "number" ? Number(input.value) : input.value), tell(), this.update());
    tell();
    made.append(label, shown, input);
    return made;
  }

  /** Asks for every view; of a view only the newest question is answered. */
  update() {
    return Promise.all(this.#spec.views(this.#values).map(async ({ call, args, draw, caption }, i) => {
      const { drawing, caption: shown } = this.#made[i];
      try {
        const { result } = await kernel.ask(call, args, `${this.name} ${i}`);
        draw(drawing, result);
        shown.textContent = caption;
        drawing.setAttribute("aria-label", caption);
      } catch (error) {
        if (!(error instanceof Replaced)) shown.textContent = error.message;
      }
    }));
  }
}

async function start() {
  const figures = [...document.querySelectorAll("[data-figure]")].map((element) => [element, new Figure(element, element.dataset.figure)]);
  globalThis.story = Object.fromEntries(figures.map(([, figure]) => [figure.name, figure]));
  try {
    await kernel.ready;
  } catch (error) {
    document.getElementById("problem").textContent = `This browser cannot compute the figures (${error.message}); the text is below.`;
    document.getElementById("problem").hidden = false;
    return;
  }
  // Figures are computed when they come near.
  const coming = new IntersectionObserver((entries) => entries.filter((entry) => entry.isIntersecting).forEach(({ target }) => {
    coming.unobserve(target);
    figures.find(([element]) => element === target)[1].update();
  }), { rootMargin: "300px" });
  figures.forEach(([element]) => coming.observe(element));
  document.getElementById("tale").setAttribute("aria-busy", "false");
}

start();
