// A second lens beside the first: its disc of the same light.
import { drawDisc } from "./disc-view.js";

const $ = (id) => document.getElementById(id);

export class Beside {
  #kernel; #facts = new Map();
  constructor(kernel) {
    this.#kernel = kernel;
  }

  list(lenses, name) {
    $("beside").replaceChildren(new Option("no other lens", ""), ...lenses.map((lens) => new Option(`${lens.name}: ${lens.title}`, lens.name)));
    $("beside").value = name ?? "";
  }

  async #factsOf(lens) {
    if (!this.#facts.has(lens.name)) this.#facts.set(lens.name, (await this.#kernel.ask("facts", { lens })).result);
    return this.#facts.get(lens.name);
  }

  /** @param {(facts: object) => object} camera of the same light, for a lens with these facts */
  async show(name, { look, coc_px, x, y, exposure, camera }) {
    $("disc-beside").hidden = $("beside-told").hidden = !name;
    $("disc").parentElement.classList.toggle("two", Boolean(name));
    if (!name) return;
    const lens = { name, text: null, look };
    try {
      const facts = await this.#factsOf({ ...lens, look: {} });
      const { result } = await this.#kernel.ask("disc", { lens, camera: camera(facts), coc_px, x, y }, "beside");
      drawDisc($("disc-beside"), result, coc_px, exposure);
      $("disc-beside").setAttribute("aria-label", `The disc of ${name}`);
      $("beside-told").textContent = `On the right: ${name}.`;
    } catch (error) {
      if (error.constructor.name !== "Replaced") $("beside-told").textContent = error.message;
    }
  }
}
