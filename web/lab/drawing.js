// Line drawings as SVG.

const SVG = "http://www.w3.org/2000/svg";

/** An element of SVG. @param {Object<string, string|number>} attributes */
export function shape(name, attributes, ...children) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** A place that can be dragged, by the name of what it moves. */
export function handle(x, y, radius, name, title) {
  return shape("circle", { cx: x, cy: y, r: radius, class: "handle", tabindex: 0, role: "slider", "aria-label": title, "aria-valuenow": y.toFixed(2), "data-handle": name, "data-x": x, "data-y": y });
}

export const line = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(3)} ${y.toFixed(3)}`).join("");

/** Replaces a drawing; `title` is what screen readers say of it. */
export function show(svg, box, title, children) {
  svg.setAttribute("viewBox", box.map((v) => v.toFixed(3)).join(" "));
  svg.replaceChildren(shape("title", {}, title), ...children);
}

/** About n round numbers from low to high. */
export function ticks(low, high, n = 5) {
  const span = (high - low) / n || 1, power = 10 ** Math.floor(Math.log10(span));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= span);
  const found = [];
  for (let i = Math.ceil(low / step); i * step <= high + 1e-9 * step; i++) found.push(Number((i * step).toPrecision(6)));
  return found;
}
