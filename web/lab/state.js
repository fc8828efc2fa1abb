// Everything that can be chosen in the lab, as one value; and that value as the fragment of a link.

/** Controls of the lens: a field of petzval's look, its range and what it does, in the order of the page. Of a field that holds
 *  more than one number, `key` tells its controls apart, `get` and `set` say where the number is. */
export const CONTROLS = [
  { group: "Aperture", field: "blades", label: "Blades", min: 0, max: 16, step: 1, value: 0, help: "0: round. 3 to 16: straight blades." },
  { group: "Aperture", field: "blade_rotation_deg", label: "Blade rotation", unit: "°", min: -180, max: 180, step: 1, value: 0,
    help: "Angle of the first corner, counter-clockwise from the right, in a background disc." },
  { group: "Aperture", field: "blade_curvature", label: "Blade curvature", min: 0, max: 1, step: 0.01, value: 0, help: "0: straight edges. 1: a circle." },
  { group: "Aperture", field: "iris_open", label: "Iris round at f/", min: 0, max: 16, step: 0.1, value: 0, help: "Blades show at larger f-numbers than this. 0: always." },
  { group: "Aperture", field: "squeeze", label: "Anamorphic squeeze", unit: "×", min: 0.5, max: 2, step: 0.05, value: 1, help: "Height of the disc divided by its width." },
  { group: "Aperture", field: "cats_eye", label: "Cat's eye", min: 0, max: 1, step: 0.01, value: 0, help: "Part of the pupil that the barrel covers towards the corners." },
  { group: "Aberrations", field: "spherical", label: "Spherical, factor", unit: "×", min: -2, max: 2, step: 0.05, value: 1, curveOnly: true,
    help: "Multiplies the spherical aberration of a lens drawn as curves." },
  { group: "Aberrations", field: "axial_colour", label: "Axial colour, factor", unit: "×", min: -2, max: 2, step: 0.05, value: 1, curveOnly: true,
    help: "Multiplies the axial colour of a lens drawn as curves." },
  { group: "Aberrations", field: "added_spherical_waves", label: "Spherical, added", unit: "waves", min: -10, max: 10, step: 0.1, value: 0,
    help: "Adds spherical aberration to any lens, as the ring of a defocus-control lens does." },
  { group: "Aberrations", field: "added_axial_colour_mm", label: "Axial colour, added", unit: "mm", min: -0.5, max: 0.5, step: 0.01, value: 0,
    help: "Distance of the blue focus behind the red one." },
  { group: "Aberrations", field: "added_lateral_colour_percent", label: "Lateral colour, added", unit: "%", min: -1, max: 1, step: 0.02, value: 0,
    help: "Size of the blue image relative to the red one." },
  { group: "Aberrations", field: "added_field_curvature_mm", label: "Field curvature, added", unit: "mm", min: -1, max: 1, step: 0.02, value: 0,
    help: "Distance of the corners' focus behind that of the middle." },
  { group: "Aberrations", field: "lateral_colour", label: "Lateral colour, factor", unit: "×", min: -2, max: 2, step: 0.05, value: 1,
    help: "Multiplies the lateral colour of a lens with surfaces." },
  { group: "Aberrations", field: "distortion", label: "Distortion", min: -0.3, max: 0.3, step: 0.01, value: 0, help: "Stretches the corners of the picture and their discs." },
  { group: "Aberrations", field: "coma", label: "Coma", min: -5, max: 5, step: 0.1, value: 0, help: "Tails that point outwards in the corners." },
  { group: "Aberrations", field: "astigmatism", label: "Astigmatism", min: -5, max: 5, step: 0.1, value: 0, help: "Discs in the corners become ellipses; positive values swirl." },
  { group: "Pupil", field: "dust", label: "Dust", min: 0, max: 1, step: 0.01, value: 0, help: "Specks on the glass, seen in large discs." },
  { group: "Pupil", field: "scratches", label: "Scratches", min: 0, max: 1, step: 0.01, value: 0, help: "Fine lines across the disc." },
  { group: "Pupil", field: "onion_rings", label: "Onion rings", min: 0, max: 1, step: 0.01, value: 0, help: "Turning marks of moulded aspheres." },
  { group: "Pupil", field: "texture_seed", label: "Pattern, number", min: 1, max: 30, step: 1, value: 1, help: "Another pattern of dust, scratches and rings." },
  ...["radius_mm", "distance_mm"].map((part, i) => ({
    group: "Barrel", field: "barrel", key: `barrel_${part}`, label: ["Rim, radius", "Rim, in front of the pupil"][i], unit: "mm", min: -80 * i, max: [40, 80][i], step: 0.5, value: 40 * i,
    help: ["A rim of the barrel that cuts discs towards the edges. 0: none.", "Negative: behind the pupil, it cuts the other side."][i],
    get: (look) => look.barrel?.[0]?.[part] ?? 40 * i,
    set: (look, value) => {
      const rim = { radius_mm: 0, distance_mm: 40, ...look.barrel?.[0], [part]: value };
      if (rim.radius_mm > 0) look.barrel = [rim];
      else delete look.barrel;
    },
  })),
  ...["left", "right", "top", "bottom"].map((side, i) => ({
    group: "Barrel", field: "barn_doors", key: `barn_doors_${side}`, label: `Barn door, ${side}`, min: 0, max: 1, step: 0.02, value: 0,
    help: "Depth to which a door of the matte box covers the pupil from this side, in pupil radii.",
    get: (look) => look.barn_doors?.[i] ?? 0,
    set: (look, value) => {
      const doors = Object.assign([...(look.barn_doors ?? [0, 0, 0, 0])], { [i]: value });
      if (doors.some((door) => door > 0)) look.barn_doors = doors;
      else delete look.barn_doors;
    },
  })),
  { group: "Light", field: "light", label: "Lamp", choices: ["daylight", "sodium", "mercury", "neon", "led"], value: "daylight", help: "Spectrum of the light. The lines of a lamp focus separately." },
  { group: "Light", field: "wavelengths", label: "Wavelengths", min: 0, max: 64, step: 1, value: 0, help: "Bands of the spectrum. 0: as many as the disc needs." },
  { group: "Light", field: "wave", label: "Wave optics", type: "check", value: false, help: "Diffraction: rings and the spikes of blades. Slow." },
];

/** A control's value in a look. */
export const valueIn = (look, { field, value, get }) => (get ? get(look) : (look[field] ?? value));

/** Puts a value into a look, which holds what differs from the default. */
export function setIn(look, { field, value: usual, set }, value) {
  if (set) set(look, value);
  else if (value === usual) delete look[field];
  else look[field] = value;
}

const isNumbers = (value) => Object.values(value).every(Number.isFinite);
const FITS = {
  barrel: (value) => Array.isArray(value) && value.every((rim) => rim && typeof rim === "object" && isNumbers(rim)),
  barn_doors: (value) => Array.isArray(value) && value.length === 4 && isNumbers(value),
};

/** The camera: millimetres, metres and pixels; 0 stands for what the lens was built for. */
export const CAMERA = { focal_mm: 0, sensor_mm: 36, f_number: 0, focus_m: 0, width_px: 1920, height_px: 1080 };

/** Where the light stands: signed radius of its circle of confusion, and its place in half diagonals. */
export const LIGHT = { coc_px: 40, x: 0, y: 0 };

/** The picture of the page: 0 stands for the scene's own. */
export const PICTURE = { f_number: 0, focus_m: 0 };

/** @typedef {{name: string, text: ?string, look: Object<string, number|boolean>}} LensChoice */

export function freshState() {
  return { lens: { name: "doublet", text: null, look: {} }, camera: { ...CAMERA }, light: { ...LIGHT }, picture: { ...PICTURE }, beside: null };
}

const VERSION = 1;

const toBase64Url = (text) =>
  btoa(String.fromCharCode(...new TextEncoder().encode(text))).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");

const fromBase64Url = (text) =>
  new TextDecoder("utf-8", { fatal: true }).decode(
    Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0)),
  );

const differing = (value, usual) => Object.fromEntries(Object.entries(value).filter(([key, v]) => v !== usual[key]));

/** The fragment of a link, without "#": "lens=1." and base64url of JSON that holds what differs from the default. */
export function toFragment(state) {
  const told = { lens: state.lens, camera: differing(state.camera, CAMERA), light: differing(state.light, LIGHT), picture: differing(state.picture, PICTURE), ...(state.beside ? { beside: state.beside } : {}) };
  return `lens=${VERSION}.${toBase64Url(JSON.stringify(told))}`;
}

/** @returns {{state: object, problem: ?string}} the default and a sentence where the fragment is damaged */
export function fromFragment(fragment) {
  const usual = { state: freshState(), problem: null };
  if (!fragment) return usual;
  const refused = (why) => ({ ...usual, problem: `This link has no readable lens (${why}), so the page starts with the doublet.` });
  const match = /^lens=(\d+)\.([\w-]+)$/.exec(fragment);
  if (!match) return refused("it is cut off or from elsewhere");
  if (Number(match[1]) > VERSION) return refused(`version ${match[1]} is newer than this page`);
  try {
    return { state: checked(JSON.parse(fromBase64Url(match[2]))), problem: null };
  } catch (error) {
    return refused(error instanceof BadState ? error.message : "it is damaged");
  }
}

class BadState extends Error {}

/** Numbers within the camera's, the light's and the picture's fields; everything else is refused. */
function checked(told) {
  const numbers = (given, usual) => {
    for (const [key, value] of Object.entries(given ?? {}))
      if (!(key in usual) || !Number.isFinite(value)) throw new BadState(`'${key}' is not a number of this page`);
    return { ...usual, ...given };
  };
  const lens = told.lens ?? {};
  if (typeof lens.name !== "string" || !(lens.text == null || typeof lens.text === "string")) throw new BadState("it names no lens");
  const known = new Map(CONTROLS.map((control) => [control.field, control]));
  for (const [field, value] of Object.entries(lens.look ?? {}))
    if (!known.has(field) || !(FITS[field]?.(value) ?? typeof value === typeof known.get(field).value)) throw new BadState(`'${field}' is not a control of this page`);
  return {
    lens: { name: lens.name, text: lens.text ?? null, look: lens.look ?? {} },
    camera: numbers(told.camera, CAMERA),
    light: numbers(told.light, LIGHT),
    picture: numbers(told.picture, PICTURE),
    beside: typeof told.beside === "string" ? told.beside : null,
  };
}
