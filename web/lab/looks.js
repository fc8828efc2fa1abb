// Looks as the program saves them.
import { CONTROLS } from "./state.js";

const KNOWN = new Set(CONTROLS.map(({ field }) => field));

/** What `petzval defocus --look` reads. A lens of the user's own is in it as text. @param {{name: string, text: ?string, look: object}} lens */
export function lookText({ name, text, look }) {
  return JSON.stringify({ petzval_look: 1, lens: { name: text ?? name, ...look } }, null, 2) + "\n";
}

/** @returns {?{lens: {name: string, text: ?string, look: object}, left_out: string[]}} null where the text is not a look */
export function lensOfLook(text) {
  let told;
  try {
    told = JSON.parse(text);
  } catch {
    return null;
  }
  if (!told?.petzval_look) return null;
  const { name = "ideal", ...fields } = told.lens ?? {}, known = Object.entries(fields).filter(([field]) => KNOWN.has(field));
  const lens = /\n|^\{/.test(name) ? { name: "pasted", text: name } : { name, text: null };
  const left_out = [...Object.keys(fields).filter((field) => !KNOWN.has(field)).map((field) => `lens.${field}`), ...Object.keys(told).filter((key) => !["petzval_look", "lens"].includes(key))];
  return { lens: { ...lens, look: Object.fromEntries(known) }, left_out };
}
