// A second lens beside the first: its disc of the same light.
import { drawDisc } from "./disc-view.js";
import { drawSection } from "./section-view.js";

const $ = (id) => document.getElementById(id);

export class Beside {
  #kernel; #facts = new Map();
  constructor(kernel) {
    this.#kernel = kernel;
  }

  async #factsOf(lens) {
    if (!this.#facts.has(lens.name)) this.#facts.set(lens.name, (await this.#kernel.ask("facts", { lens })).result);
    return this.#facts.get(lens.name);
  }

  /** @param {(facts: object) => object} camera of the same light, for a lens with these facts */
  async show(name, { look, coc_px, x, y, exposure, camera }) {
    $("disc-beside").hidden = $("beside-told").hidden = !name;
    $("section-beside").toggleAttribute("hidden", !name);
    $("disc").parentElement.classList.toggle("two", Boolean(name));
    if (!name) return;
    const lens = { name, text: null, look };
    try {
      const facts = await this.#factsOf({ ...lens, look: {} });
      const { result } = await this.#kernel.ask("disc", { lens, camera: camera(facts), coc_px, x, y }, "beside");
      drawDisc($("disc-beside"), result, coc_px, exposure);
      $("disc-beside").setAttribute("aria-label", `The disc of ${name}`);
      $("beside-told").textContent = `On the right, and in the second section: ${name}.`;
      const seen = camera(facts), cut = await this.#kernel.ask("section", { lens, camera: seen, depth_m: seen.light_m, x, y, rays: 21 }, "section-beside");
      drawSection($("section-beside"), cut.result, null);
    } catch (error) {
      if (error.constructor.name !== "Replaced") $("beside-told").textContent = error.message;
    }
  }
}
