// Files for the user, made in the page.

export function save(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

export const saveText = (text, name) => save(new Blob([text], { type: "application/json" }), name);
export const saveCanvas = (canvas, name) => canvas.toBlob((blob) => blob && save(blob, name), "image/png");
