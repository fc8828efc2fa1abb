// Before and after: the range under two pictures moves the border between them, by mouse, finger or arrow keys.
for (const box of document.querySelectorAll(".compare")) {
  const handle = box.querySelector("input");
  handle.addEventListener("input", () => box.style.setProperty("--cut", handle.value + "%"));
}
// A flag is never broken after its dashes.
for (const code of document.querySelectorAll("article code")) {
  if (code.textContent.length < 30) code.style.whiteSpace = "nowrap";
}
