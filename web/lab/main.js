// The page: what is chosen goes to the kernel, and what the kernel gives is drawn.
import { Kernel, Replaced } from "./kernel.js";
import { CONTROLS, LIGHT, freshState, fromFragment, setIn, toFragment } from "./state.js";
import { drawDisc } from "./disc-view.js";
import { drawSection } from "./section-view.js";
import { drawCurves } from "./curves-view.js";
import { buildControls, showControls } from "./controls.js";
import { dragHandles, movedCurve, pointsOf } from "./dragging.js";
import { saveCanvas, saveText } from "./saving.js";

const $ = (id) => document.getElementById(id);
const STRIP_PX = [-60, -40, -20, -8, 8, 20, 40, 60];
const kernel = new Kernel();

let { state, problem } = fromFragment(location.hash.slice(1));
let lenses = [], facts = null, factsAsked = null, section = null, disc = null, spot = null, exposure = 0, picture = null, curveSpan = null, isDragged = false, textureLater = 0, beside = null;

function complain(sentence) {
  $("problem").textContent = sentence ?? "";
  $("problem").hidden = !sentence;
}

const summaryOf = (name) => lenses.find((lens) => lens.name === name);

/**
 * The camera that the lens is seen on: 0 stands for the lens's own numbers. It is focused so that a light of this circle of
 * confusion exists: in front of focus the camera looks to infinity, behind it the light is as far as the stars.
 */
function camera(coc_px, scale = 1, own = facts ?? {}) {
  const { camera: c } = state;
  const focal_mm = c.focal_mm || own.efl_mm || 50, f_number = Math.max(c.f_number, own === facts ? 0 : own.f_number ?? 0) || own.f_number || 2;
  const radius_mm = (Math.abs(coc_px) * c.sensor_mm) / c.width_px, far_m = (focal_mm + (focal_mm * focal_mm) / (2 * f_number * radius_mm || 1e-9)) / 1000;
  return {
    focal_mm, f_number, sensor_mm: c.sensor_mm, focus_m: coc_px > 0 ? far_m : 0, light_m: coc_px > 0 ? Infinity : far_m,
    width_px: Math.round(c.width_px * scale), height_px: Math.round(c.height_px * scale),
  };
}

/** Asks, draws, and tells what went wrong; a call that a newer one replaced is none of our business any more. */
async function drawn(slot, call, args, draw, tell = complain) {
  try {
    const { result, ms } = await kernel.ask(call, args, slot);
    draw(result, ms);
    return true;
  } catch (error) {
    if (!(error instanceof Replaced)) tell(error.message);
    return false;
  }
}

const discArgs = (coc_px, scale = 1) => ({ lens: state.lens, camera: camera(coc_px, scale), coc_px: coc_px * scale, x: state.light.x, y: state.light.y });

function showDisc(found, ms, scale) {
  disc = { ...found, coc_px: state.light.coc_px * scale, scale, side: drawDisc($("disc"), found, state.light.coc_px * scale, exposure) };
  const sums = [0, 1, 2].map((c) => found.pixels.reduce((sum, v, i) => (i % 4 === c ? sum + v : sum), 0));
  $("told").textContent = scale < 1 ? "Coarse preview." : `${found.needed} px wide, light ${sums.map((v) => v.toFixed(4)).join(" ")}, ${ms.toFixed(0)} ms.`;
  $("disc").setAttribute("aria-label", `The disc of one light, ${Math.abs(state.light.coc_px)} pixels ${state.light.coc_px < 0 ? "in front of" : "behind"} focus`);
}

/** A coarse disc at once, then the exact one; then the drawing of the lens and the strip. */
async function update({ lensChanged = false } = {}) {
  complain(null);
  history.replaceState(null, "", "#" + toFragment(state));
  showControls(state, facts);
  showPlace();
  if (lensChanged) factsAsked = askFacts();
  await factsAsked;
  const coarse = Math.abs(state.light.coc_px) > 16 ? 0.25 : 0;
  if (coarse) drawn("disc", "disc", discArgs(state.light.coc_px, coarse), (found, ms) => showDisc(found, ms, coarse), () => {});
  drawn("exact", "disc", discArgs(state.light.coc_px), (found, ms) => showDisc(found, ms, 1), (sentence) => ($("told").textContent = sentence));
  askSection();
  showBeside();
  showTexture();
  const live = picture?.update({ moving: !lensChanged });
  STRIP_PX.forEach((px, i) => drawn(`strip${i}`, "disc", discArgs(px / 2, 0.5), (found) => drawDisc($("strip").children[i].firstChild, found, px / 4, exposure), () => {}));
  return live;
}

/** The texture takes longer than a disc: it waits until nothing moves. */
function showTexture() {
  clearTimeout(textureLater);
  if (!$("texture-details").open) return;
  textureLater = setTimeout(async () => {
    const { drawTexture } = await import("./texture-view.js");
    await factsAsked;
    drawn("texture", "texture", { lens: state.lens, camera: camera(0), columns: 193, largest_px: 60 }, (found) => drawTexture($("texture"), found));
  }, 300);
}

async function showBeside() {
  if (!state.beside && !beside) return;
  beside ??= new (await import("./beside.js")).Beside(kernel);
  const { coc_px, x, y } = state.light;
  beside.show(state.beside, { look: state.lens.look, coc_px, x, y, exposure, camera: (own) => camera(coc_px, 1, own) });
}

/** The curves, with points to drag where the lens is drawn by them. */
function showCurves() {
  const isDrawn = facts?.lens?.model === "curves" && facts.longitudinal_aberration_mm;
  $("curve-hint").hidden = !isDrawn;
  curveSpan = drawCurves($("curves"), facts?.longitudinal_aberration_mm, isDrawn ? pointsOf(facts.longitudinal_aberration_mm) : [], isDragged ? curveSpan : null);
}

/** A point of the curve goes to x of the drawing, 0 to 100; the lens becomes one of the user's own. */
function curveDragged({ x }, index) {
  const point = pointsOf(facts.longitudinal_aberration_mm)[index], mm = ((Math.max(0, Math.min(100, x)) - 50) / 50) * curveSpan;
  isDragged = true;
  const name = state.lens.text ? state.lens.name : `${state.lens.name}-drawn`;
  state.lens = { name, text: movedCurve(facts, Number(index), mm - point.mm, facts.sensor_width_mm ?? 36), look: state.lens.look };
  listLenses();
  return update({ lensChanged: true });
}

/** Where the sensor stands whose light has this circle of confusion, if the image stays: the handle of the section. */
function focusOf({ sensor_z_mm, coc_px, f_number }, of_px = coc_px) {
  const mm = (px) => (2 * f_number * px * state.camera.sensor_mm) / state.camera.width_px;
  return sensor_z_mm - mm(Math.max(0, coc_px)) + mm(of_px);
}

/** The edge of the stop goes to this height: the f-number follows; or the sensor goes to this place along the axis. */
function sectionDragged({ x, y }, which) {
  if (which === "sensor") {
    const per_px = focusOf(section, 1) - focusOf(section, 0);
    state.light.coc_px = Math.max(-60, Math.min(60, Math.round((x - focusOf(section, 0)) / per_px)));
    update();
    return;
  }
  const widest = facts?.f_number || 1, now = state.camera.f_number || widest, wide = Math.max(Math.abs(y), section.stop_radius_mm / 8, 1e-3);
  state.camera.f_number = Number(Math.max(widest, Math.min(64, (now * section.stop_radius_mm) / wide)).toPrecision(3));
  update();
}

async function askFacts() {
  await drawn("facts", "facts", { lens: { ...state.lens, look: {} } }, (found) => (facts = found));
  showControls(state, facts);
  const told = facts?.lens ?? {};
  $("about").textContent = [told.title, told.year, facts?.efl_mm ? `${facts.efl_mm.toPrecision(3)} mm` : null,
    facts?.f_number ? `f/${facts.f_number.toPrecision(2)}` : null].filter(Boolean).join(", ") + (told.history ? `. ${told.history}` : ".");
  showCurves();
  const length = state.lens.text && facts?.efl_mm ? [`Focal length ${facts.efl_mm.toFixed(2)} mm.`] : [];
  notes([...(facts?.warnings ?? []), ...length]);
}

function askSection() {
  const { x, y, coc_px } = state.light, seen = camera(coc_px);
  drawn("section", "section", { lens: state.lens, camera: seen, depth_m: seen.light_m, x, y, rays: 21 }, (found) => {
    section = { ...found, coc_px, f_number: seen.f_number };
    spot = null;
    drawSection($("section"), section, null, focusOf(section));
  });
}

function lightUp(event) {
  if (!section || !disc) return;
  const box = $("disc").getBoundingClientRect(), scale = disc.side / box.width / disc.scale;
  spot = { x: (event.clientX - box.left - box.width / 2) * scale, y: (event.clientY - box.top - box.height / 2) * scale, reach: Math.max(2, 0.08 * Math.abs(state.light.coc_px)) };
  const lit = drawSection($("section"), section, spot, focusOf(section));
  $("lit").textContent = lit ? `${lit} of ${section.rays.length} rays land there.` : "No drawn ray lands there; click inside the disc.";
}

function showPlace() {
  const { x, y, coc_px } = state.light, { width_px: w, height_px: h } = state.camera, diagonal = Math.hypot(w, h);
  $("spot").style.left = `${50 + (50 * x * diagonal) / w}%`;
  $("spot").style.top = `${50 - (50 * y * diagonal) / h}%`;
  const place = x === 0 && y === 0 ? "in the middle" : `${Math.round(Math.hypot(x, y) * 100)} % towards the corner`;
  $("frame").setAttribute("aria-valuetext", place);
  $("frame").setAttribute("aria-valuenow", Math.round(Math.hypot(x, y) * 100));
  $("coc").value = coc_px;
  $("coc-value").textContent = coc_px === 0 ? "in focus" : `${Math.abs(coc_px)} px ${coc_px < 0 ? "in front of" : "behind"} focus`;
}

function place(x, y) {
  const { width_px: w, height_px: h } = state.camera, diagonal = Math.hypot(w, h);
  const within = (v, end) => Math.max(-end, Math.min(end, v));
  state.light.x = within(x, w / diagonal);
  state.light.y = within(y, h / diagonal);
  update();
}

function dragged(event) {
  if (event.type === "pointerdown") $("frame").setPointerCapture(event.pointerId);
  else if (!$("frame").hasPointerCapture(event.pointerId)) return;
  const box = $("frame").getBoundingClientRect(), { width_px: w, height_px: h } = state.camera, diagonal = Math.hypot(w, h);
  place((((event.clientX - box.left) / box.width) * 2 - 1) * (w / diagonal), (1 - ((event.clientY - box.top) / box.height) * 2) * (h / diagonal));
}

function moved(event) {
  const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
  if (!step) return;
  event.preventDefault();
  place(state.light.x + step[0] * 0.05, state.light.y + step[1] * 0.05);
}

function listLenses() {
  const wanted = $("search").value.trim().toLowerCase();
  const found = lenses.filter((lens) => !wanted || `${lens.name} ${lens.names.join(" ")} ${lens.title} ${lens.class} ${lens.year} ${lens.history}`.toLowerCase().includes(wanted));
  $("lens").replaceChildren(...(state.lens.text ? [new Option(`${state.lens.name} (yours)`, "")] : []), ...found.map((lens) => new Option(`${lens.name}: ${lens.title}`, lens.name)));
  $("lens").value = state.lens.text ? "" : state.lens.name;
  $("save-lens").hidden = !state.lens.text;
}

function use(lens) {
  state = { ...state, lens, camera: { ...state.camera, focal_mm: 0, f_number: 0 } };
  facts = null;
  listLenses();
  return update({ lensChanged: true });
}

function notes(sentences) {
  $("paste-notes").replaceChildren(...sentences.map((sentence) => Object.assign(document.createElement("li"), { textContent: sentence })));
}

async function useText(text, name) {
  try {
    const { lensOfLook } = await import("./looks.js");
    const look = lensOfLook(text), lens = look?.lens ?? { name, text, look: {} };
    await kernel.ask("facts", { lens }); // a text that is not a lens changes nothing
    await use(lens);
    if (look?.left_out.length) complain(`This page has no controls for ${look.left_out.join(", ")}; these fields are left out.`);
  } catch (error) {
    notes([error.message]);
    complain(error.message);
  }
}

/** Loads the part "Your picture", which most visitors of a lens do not need. */
async function showPicture() {
  $("picture-open").disabled = true;
  try {
    const { openPicture } = await import("./picture.js");
    $("picture").hidden = false;
    picture = await openPicture(() => ({ lens: state.lens, facts, picture: state.picture }), (change) => {
      Object.assign(state.picture, change);
      history.replaceState(null, "", "#" + toFragment(state));
    });
    $("picture-offer").hidden = true;
  } catch (error) {
    $("picture").hidden = true;
    $("picture-open").disabled = false;
    complain(`The picture cannot be shown: ${error.message}.`);
  }
}

/** A file of numbers; the writer of files is loaded with the first one. */
async function exported(file, args) {
  try {
    await (await import("./exporting.js"))[file](kernel, args);
  } catch (error) {
    complain(error.message);
  }
}

function wire() {
  buildControls($("controls"), CONTROLS, (how, value) => (setIn(state.lens.look, how, value), update()));
  $("strip").replaceChildren(...STRIP_PX.map((px) => {
    const button = document.createElement("button");
    button.type = "button";
    button.ariaLabel = `${Math.abs(px)} pixels ${px < 0 ? "in front of" : "behind"} focus`;
    button.append(document.createElement("canvas"));
    button.onclick = () => ((state.light.coc_px = px), update());
    return button;
  }));
  $("coc").oninput = () => ((state.light.coc_px = Number($("coc").value)), update());
  $("exposure").oninput = () => {
    exposure = Number($("exposure").value);
    $("exposure-value").textContent = `${exposure > 0 ? "+" : ""}${exposure.toFixed(1)} stops`;
    if (disc) drawDisc($("disc"), disc, disc.coc_px, exposure);
    showBeside();
  };
  dragHandles($("curves"), curveDragged, () => ((isDragged = false), factsAsked?.then(showCurves)));
  dragHandles($("section"), sectionDragged);
  $("beside").onchange = () => ((state.beside = $("beside").value || null), update());
  $("picture-open").onclick = showPicture;
  $("search").oninput = listLenses;
  $("lens").onchange = () => $("lens").value && use({ name: $("lens").value, text: null, look: {} });
  $("disc").onclick = lightUp;
  for (const type of ["pointerdown", "pointermove"]) $("frame").addEventListener(type, dragged);
  $("frame").onkeydown = moved;
  $("f_number").oninput = () => {
    const widest = facts?.f_number || 1;
    state.camera.f_number = Number((widest * 2 ** (5 * Number($("f_number").value))).toPrecision(3));
    update();
  };
  for (const field of ["focal_mm", "sensor_mm"]) $(field).onchange = () => ((state.camera[field] = Number($(field).value)), update());
  $("reset").onclick = () => ((state.lens.look = {}), (state.light = { ...LIGHT }), (state.camera = freshState().camera), update());
  $("link").onclick = async () => {
    await navigator.clipboard?.writeText(location.href);
    $("link").textContent = "Copied";
    setTimeout(() => ($("link").textContent = "Copy link"), 1500);
  };
  $("png").onclick = () => saveCanvas($("disc"), `${state.lens.name}-${state.light.coc_px}px.png`);
  $("exr").onclick = () => exported("discExr", discArgs(state.light.coc_px));
  $("table").onclick = () => exported("tableExr", { lens: state.lens, camera: camera(0), title: [state.lens.name, facts.lens.title].filter(Boolean).join(": ") });
  $("save").onclick = async () => saveText((await import("./looks.js")).lookText(state.lens), `${state.lens.name}-look.json`);
  $("save-lens").onclick = () => saveText(state.lens.text, `${state.lens.name}.${state.lens.text.startsWith("{") ? "json" : "txt"}`);
  $("texture-details").ontoggle = showTexture;
  $("file").onchange = async () => {
    const [file] = $("file").files;
    if (file && file.size > 1 << 20) complain(`${file.name} has ${file.size} bytes, too many for a lens.`);
    else if (file) useText(await file.text(), file.name.replace(/\.[^.]*$/, ""));
  };
  $("use-paste").onclick = () => useText($("paste").value, "pasted");
  addEventListener("hashchange", () => {
    ({ state, problem } = fromFragment(location.hash.slice(1)));
    listLenses();
    $("beside").value = state.beside ?? "";
    update({ lensChanged: true }).then(() => problem && complain(problem));
  });
}

async function start() {
  try {
    await kernel.ready;
  } catch (error) {
    complain(`This browser cannot run the lab (${error.message}). The pages of the lenses work without it.`);
    return;
  }
  lenses = (await kernel.ask("list")).result;
  $("version").textContent = (await kernel.ask("version")).result;
  if (!state.lens.text && !summaryOf(state.lens.name)) {
    problem = `The link names the lens '${state.lens.name}', which this page does not have, so it starts with the doublet.`;
    state = freshState();
  }
  wire();
  listLenses();
  $("beside").append(new Option("no other lens", ""), ...lenses.map((lens) => new Option(`${lens.name}: ${lens.title}`, lens.name)));
  $("beside").value = state.beside ?? "";
  performance.mark("interactive");
  await update({ lensChanged: true });
  if (problem) complain(problem);
  $("lab").setAttribute("aria-busy", "false");
}

// For the browser's console, and for tests.
globalThis.lab = { kernel, use, useText, place, discArgs, showPicture, get state() { return state; }, get picture() { return picture; }, get disc() { return disc; } };
start();
