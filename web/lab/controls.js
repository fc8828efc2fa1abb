// Sliders of the lens, made from the table of controls.

const changers = new Map();

function control({ field, label, unit, min, max, step, type, help, value }, changed) {
  const made = document.createElement("label"), input = document.createElement("input"), shown = document.createElement("output");
  made.title = help;
  input.dataset.field = field;
  if (type === "check") {
    input.type = "checkbox";
    input.oninput = () => changed(field, input.checked);
    made.append(input, ` ${label}`);
  } else {
    Object.assign(input, { type: "range", min, max, step });
    input.oninput = () => changed(field, Number(input.value));
    made.append(label, shown, input);
  }
  made.oncontextmenu = (event) => (event.preventDefault(), changed(field, value));
  changers.set(field, (now) => {
    if (type === "check") input.checked = now;
    else (input.value = now), (shown.textContent = `${now}${unit ? ` ${unit}` : ""}`);
    made.classList.toggle("changed", now !== value);
  });
  return made;
}

/** One fieldset a group. @param {(field: string, value: number|boolean) => void} changed */
export function buildControls(parent, controls, changed) {
  const groups = Map.groupBy ? Map.groupBy(controls, (c) => c.group) : controls.reduce((all, c) => all.set(c.group, [...(all.get(c.group) ?? []), c]), new Map());
  for (const [group, members] of groups) {
    const set = document.createElement("fieldset"), legend = document.createElement("legend");
    legend.textContent = group;
    set.append(legend, ...members.map((member) => control(member, changed)));
    parent.append(set);
  }
}

/** Puts every control where the state has it; what has no effect on this lens is switched off. */
export function showControls(state, facts) {
  for (const input of document.querySelectorAll("[data-field]")) {
    const { field } = input.dataset;
    changers.get(field)(state.lens.look[field] ?? (input.type === "checkbox" ? false : defaultOf(field)));
    input.disabled = ["spherical", "axial_colour"].includes(field) && facts?.lens?.model !== "curves";
  }
  const widest = facts?.f_number || 1, now = state.camera.f_number || widest;
  document.getElementById("f_number").value = Math.log2(now / widest) / 5;
  document.getElementById("f_number-value").textContent = `f/${now.toPrecision(2)}`;
  document.getElementById("focal_mm").value = state.camera.focal_mm || Math.round(facts?.efl_mm ?? 50);
  document.getElementById("sensor_mm").value = state.camera.sensor_mm;
}

const defaultOf = (field) => (["squeeze", "spherical", "axial_colour"].includes(field) ? 1 : 0);
