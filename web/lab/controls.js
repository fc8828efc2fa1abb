// Sliders of the lens, made from the table of controls.
import { valueIn } from "./state.js";

const changers = new Map();

function control(how, changed) {
  const { field, key = field, label, unit, min, max, step, type, choices, help, value } = how;
  const made = document.createElement("label"), input = document.createElement(choices ? "select" : "input"), shown = Object.assign(document.createElement("span"), { className: "value" });
  made.title = help;
  input.dataset.field = key;
  if (type === "check") {
    input.type = "checkbox";
    input.oninput = () => changed(how, input.checked);
    made.append(input, ` ${label}`);
  } else if (choices) {
    input.append(...choices.map((choice) => new Option(choice, choice)));
    input.oninput = () => changed(how, input.value);
    made.append(label, input);
  } else {
    Object.assign(input, { type: "range", min, max, step });
    input.oninput = () => changed(how, Number(input.value));
    made.append(label, shown, input);
  }
  made.oncontextmenu = (event) => (event.preventDefault(), changed(how, value));
  changers.set(key, (look) => {
    const now = valueIn(look, how);
    if (type === "check") input.checked = now;
    else (input.value = now), (shown.textContent = `${now}${unit ? ` ${unit}` : ""}`);
    made.classList.toggle("changed", now !== value);
  });
  return made;
}

/** Groups that are open at first, where there is room for them. */
const isOpen = (group) => group === "Aperture" || (group === "Aberrations" && matchMedia("(min-width: 720px)").matches);

/** One part that opens for each group. @param {(how: object, value: number|boolean|string) => void} changed */
export function buildControls(parent, controls, changed) {
  const groups = Map.groupBy ? Map.groupBy(controls, (c) => c.group) : controls.reduce((all, c) => all.set(c.group, [...(all.get(c.group) ?? []), c]), new Map());
  for (const [group, members] of groups) {
    const set = Object.assign(document.createElement("details"), { open: isOpen(group) }), summary = document.createElement("summary");
    summary.textContent = group;
    set.append(summary, ...members.map((member) => control(member, changed)));
    parent.append(set);
  }
}

/** Puts every control where the state has it; what has no effect on this lens is switched off. */
export function showControls(state, facts) {
  for (const input of document.querySelectorAll("[data-field]")) {
    const { field } = input.dataset;
    changers.get(field)(state.lens.look);
    const isDrawn = facts?.lens?.model === "curves", isTraced = facts?.lens?.model === "prescription";
    input.disabled = (["spherical", "axial_colour"].includes(field) && !isDrawn) || (field === "lateral_colour" && !isTraced);
  }
  const widest = facts?.f_number || 1, now = state.camera.f_number || widest;
  document.getElementById("f_number").value = Math.log2(now / widest) / 5;
  document.getElementById("f_number-value").textContent = `f/${now.toPrecision(2)}`;
  document.getElementById("focal_mm").value = state.camera.focal_mm || Math.round(facts?.efl_mm ?? 50);
  document.getElementById("sensor_mm").value = state.camera.sensor_mm;
}
