// The part "Your picture": a picture with depth through the lens of the page, live and developed. Loaded when asked for.
import { Frames } from "./frames.js";
import { GatherPass } from "./gather-pass.js";
import { builtInScene, shotOfFiles } from "./shots.js";
import { drawLight } from "./disc-view.js";
import { saveCanvas } from "./saving.js";

const $ = (id) => document.getElementById(id);
const STOPS = 9; // that the slider closes the lens by
const FAR_M = 1e5; // stands for infinity where a focus is asked for

/** The f-number that a lens opens to; lenses drawn as curves open to any. */
const widestOf = (facts) => (facts?.lens?.model === "curves" || !facts?.f_number ? 1 : facts.f_number);

export class PictureView {
  #frames = new Frames(); #pass = null; #wanted = null; #busy = null; #developing = null; #chosen; #exposure = 1;

  /** @param {() => {lens: object, facts: ?object, picture: {f_number: number, focus_m: number}}} chosen what the page has chosen
   *  @param {(change: object) => void} choose keeps a change of its `picture` */
  constructor(chosen, choose) {
    this.#chosen = chosen;
    this.choose = choose;
    this.#wire();
    try {
      this.#pass = new GatherPass($("picture-live"));
    } catch (error) {
      this.#tell(`Live is off: ${error.message}. Develop works without.`);
      this.broken = error.message;
    }
  }

  /** @returns {Promise} done when the first live picture is shown, or refused */
  async open(shot) {
    this.#cancel();
    this.shot = shot;
    $("picture-stage").style.aspectRatio = `${shot.width} / ${shot.height}`;
    $("picture-name").textContent = shot.told;
    const { width, height, pixels, depth_m, first, samples } = shot;
    await this.#frames.ask("shot", { width, height, pixels, depth_m, first, samples });
    await this.update();
  }

  /** The camera of this frame: the picture's own, but for what was chosen. */
  camera() {
    const { facts, picture } = this.#chosen(), own = this.shot.camera, widest = widestOf(facts);
    return { ...own, f_number: Math.max(picture.f_number || own.f_number, widest), focus_m: picture.focus_m || own.focus_m };
  }

  #frame(engine, is_live, quality = "standard") {
    const { lens } = this.#chosen(), { name, text, look } = lens;
    return { is_live, camera: this.camera(), lens: { name, text }, look: { petzval_look: 1, engine, quality, lens: { ...(text ? {} : { name }), ...look } } };
  }

  /** Draws the newest choice live; what came while one was drawn is drawn next. */
  update({ moving = false } = {}) {
    if (!this.shot) return Promise.resolve();
    this.#cancel();
    this.#showControls();
    this.#wanted = moving ? "draft" : "standard";
    this.#busy ??= this.#drawLive().finally(() => (this.#busy = null));
    return this.#busy;
  }

  async #drawLive() {
    while (this.#wanted) {
      const quality = this.#wanted;
      this.#wanted = null;
      if (this.broken) continue;
      try {
        const { result, ms } = await this.#frames.ask("frame", this.#frame("gather", true, quality));
        this.#pass.draw(result.handed);
        this.#pass.show(this.#exposure);
        this.report = result.report;
        this.#tell([`Live: planned in ${ms.toFixed(0)} ms.`, ...(result.report.warnings ?? [])].join(" "));
      } catch (error) {
        this.#tell(error.message);
        this.refused = error.message;
      }
    }
  }

  /** The final picture, by the engine "scatter" in a thread of its own. */
  async develop() {
    if (this.#developing) return;
    const frames = (this.#developing = new Frames()), { width, height, pixels, depth_m, first, samples } = this.shot;
    const progressed = (done) => ($("picture-progress").value = done);
    for (const id of ["picture-progress", "picture-cancel"]) $(id).hidden = false;
    progressed(0);
    this.#tell("Developing …");
    try {
      await frames.ask("shot", { width, height, pixels, depth_m, first, samples });
      const { result, ms } = await frames.ask("frame", this.#frame("scatter", false), progressed);
      this.developed = result.pixels;
      this.#showDeveloped();
      this.#tell([`Developed in ${(ms / 1000).toFixed(1)} s.`, ...(result.report.warnings ?? [])].join(" "));
    } catch (error) {
      this.#tell(error.message);
    } finally {
      frames.end("ended");
      if (this.#developing === frames) this.#developing = null;
      for (const id of ["picture-progress", "picture-cancel"]) $(id).hidden = true;
    }
  }

  #showDeveloped() {
    const { width, height } = this.shot;
    drawLight($("picture-developed"), { pixels: this.developed, width, height, white: 2 ** -this.#exposure });
    $("picture-developed").hidden = false;
  }

  /** What was developed is of other choices. */
  #cancel() {
    this.#developing?.end("Cancelled.");
    this.developed = null;
    $("picture-developed").hidden = true;
  }

  #tell(sentence) {
    $("picture-told").textContent = sentence;
  }

  #showControls() {
    const { f_number, focus_m } = this.camera(), widest = widestOf(this.#chosen().facts);
    $("picture-f").value = Math.log2(f_number / widest) * 2 / STOPS;
    $("picture-f-value").textContent = `f/${f_number.toPrecision(2)}`;
    $("picture-focus-value").textContent = focus_m >= FAR_M ? "infinity" : `${focus_m.toPrecision(3)} m`;
  }

  /** Focuses on what is seen at a pixel. */
  focusAt(x, y) {
    const { width, height, depth_m } = this.shot, clamped = (v, size) => Math.max(0, Math.min(size - 1, Math.floor(v)));
    this.choose({ focus_m: Math.min(FAR_M, depth_m[clamped(y, height) * width + clamped(x, width)]) });
    return this.update();
  }

  #clicked({ clientX, clientY }) {
    if (!this.shot) return;
    const box = $("picture-stage").getBoundingClientRect(), { width, height } = this.shot;
    this.focusAt(((clientX - box.left) / box.width) * width, ((clientY - box.top) / box.height) * height);
  }

  #keyed(event) {
    const share = { ArrowUp: 1.05, ArrowDown: 1 / 1.05, ArrowRight: 1.05, ArrowLeft: 1 / 1.05 }[event.key];
    if (!share || !this.shot) return;
    event.preventDefault();
    this.choose({ focus_m: Math.min(FAR_M, this.camera().focus_m * share) });
    this.update({ moving: true });
  }

  #wire() {
    $("picture-stage").onclick = (event) => this.#clicked(event);
    $("picture-stage").onkeydown = (event) => this.#keyed(event);
    const moved = (moving) => {
      this.choose({ f_number: Number((widestOf(this.#chosen().facts) * 2 ** ((Number($("picture-f").value) * STOPS) / 2)).toPrecision(3)) });
      this.update({ moving });
    };
    $("picture-f").oninput = () => moved(true);
    $("picture-f").onchange = () => moved(false);
    $("picture-exposure").oninput = () => {
      this.#exposure = Number($("picture-exposure").value);
      $("picture-exposure-value").textContent = `${this.#exposure > 0 ? "+" : ""}${this.#exposure.toFixed(1)} stops`;
      if (this.developed) this.#showDeveloped();
      else if (this.#pass?.picture) this.#pass.show(this.#exposure);
    };
    $("picture-develop").onclick = () => this.develop();
    $("picture-cancel").onclick = () => this.#developing?.end("Cancelled.");
    $("picture-save").onclick = () => saveCanvas($(this.developed ? "picture-developed" : "picture-live"), `${this.shot.name}-${this.#chosen().lens.name}.png`);
    $("picture-file").onchange = () => this.openFiles([...$("picture-file").files]);
    $("picture-night").onclick = () => this.openNight().catch((error) => this.#tell(error.message));
    const stage = $("picture-stage");
    stage.ondragover = (event) => event.preventDefault();
    stage.ondrop = (event) => (event.preventDefault(), this.openFiles([...event.dataTransfer.files]));
  }

  async openNight() {
    this.choose({ f_number: 0, focus_m: 0 });
    await this.open(await builtInScene("night"));
  }

  /** One EXR with depth, or a photograph and its depth map. What cannot be read changes nothing. */
  async openFiles(files) {
    try {
      const depths = { nearest_m: Number($("picture-nearest").value), farthest_m: Number($("picture-farthest").value) };
      const shot = await shotOfFiles(files, depths);
      this.choose({ f_number: 0, focus_m: 0 });
      await this.open(shot);
    } catch (error) {
      this.#tell(error.message);
    }
  }

  /** r, g, b, a of the live picture. */
  livePixels() {
    return this.#pass.pixels();
  }
}

export async function openPicture(chosen, choose) {
  const view = new PictureView(chosen, choose);
  await view.open(await builtInScene("night"));
  return view;
}
