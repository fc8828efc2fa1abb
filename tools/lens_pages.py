"""Writes one page per lens that ships, readable without script: its numbers, its source, its discs and a link into the lab.

Usage: lens_pages.py PETZVAL VALIDATOR FOLDER. Pages need lab.css one folder up. Discs newer than their lens file stay.
"""
import base64
import concurrent.futures
import html
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Signed radius of the circle of confusion in pixels of 1920 x 1080, field position, file name, caption.
DISCS = ((-40, "0,0", "front", "40 px in front of focus"), (-12, "0,0", "front-12", "12 px in front"),
         (12, "0,0", "behind-12", "12 px behind"), (40, "0,0", "behind", "40 px behind focus"),
         (-40, "0.6,0.35", "corner-front", "in front, towards the corner"), (40, "0.6,0.35", "corner-behind", "behind, towards the corner"))
NUMBERS = (("efl_mm", "focal length", "mm"), ("f_number", "f-number, wide open", ""), ("bfl_mm", "back focal length", "mm"),
           ("entrance_pupil_diameter_mm", "entrance pupil, diameter", "mm"), ("exit_pupil_diameter_mm", "exit pupil, diameter", "mm"),
           ("vertex_length_mm", "length between outer vertices", "mm"), ("petzval_radius_mm", "Petzval radius", "mm"), ("field_deg", "half field", "degrees"))


def told(petzval, *words):
    return json.loads(subprocess.run([petzval, *words, "--json", "-"], check=True, capture_output=True, text=True).stdout)


def lab_link(name):
    state = json.dumps({"lens": {"name": name, "look": {}}}, separators=(",", ":"))
    return "../index.html#lens=1." + base64.urlsafe_b64encode(state.encode()).decode().rstrip("=")


def row_of(tag, cells):
    return "<tr>" + "".join(f"<{tag}>{html.escape(str(cell))}</{tag}>" for cell in cells) + "</tr>"


def table(head, rows):
    return f"<table><thead>{row_of('th', head)}</thead><tbody>{''.join(row_of('td', row) for row in rows)}</tbody></table>"


def page(title, body):
    return (f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f'<title>{html.escape(title)}</title><link rel="stylesheet" href="../lab.css"><link rel="icon" href="../icon.svg"></head>\n<body><header><h1>{html.escape(title)}</h1></header>\n'
            f'<main class="page">{body}</main></body></html>\n')


def published(validator):
    """Of each lens the sentence of its sources and a row for each number that they print: quantity, theirs, ours, difference, allowed, reproduced."""
    found, rows = {}, []
    for line in subprocess.run([validator], check=True, capture_output=True, text=True).stdout.splitlines():
        if line.startswith("### "):
            rows = []
            found[line[4:]] = {"sources": "", "rows": rows}
        elif line.startswith("| ") and found and not line.startswith("| quantity"):
            rows.append([cell.strip() for cell in line.strip("|").split("|")])
        elif "Sources: " in line and found:
            found[[*found][-1]]["sources"] = line[line.index("Sources: "):]
    return found


def published_part(told_of_it, source):
    if not told_of_it:
        why = "This lens was made for petzval; nothing is published about it." if source.startswith("DERIVED") else "The source prints no number that these surfaces reproduce; the notes above say why."
        return f"<h2>Published numbers</h2><p>{why}</p>"
    return (f'<h2>Published numbers</h2><div class="rows">{table(("quantity", "published", "petzval", "difference", "allowed", "reproduced"), told_of_it["rows"])}</div>'
            f'<p class="hint">{html.escape(told_of_it["sources"])}</p>')


def lens_page(lens, facts, told_of_it):
    name, title = lens["name"], lens["title"]
    numbers = [(label, f"{facts[key]:.4g} {unit}".strip()) for key, label, unit in NUMBERS if facts.get(key)]
    discs = "".join(f'<figure><img src="{name}-{file}.png" alt="Disc {caption}" loading="lazy"><figcaption>{caption}</figcaption></figure>'
                    for _, _, file, caption in DISCS)
    paragraphs = [lens["history"], f"Source: {lens['source']}" if lens["source"] else None, *facts.get("notes", []), *facts.get("warnings", [])]
    text = "".join(f"<p>{html.escape(words)}</p>" for words in paragraphs if words)
    return page(f"{name}: {title}", f'<section><p><a href="{lab_link(name)}">Open it in the lab</a> · <a href="index.html">All lenses</a></p>{text}'
                f'{table(("number", "value"), numbers)}</section><section><h2>Discs</h2><div class="discs">{discs}</div>{published_part(told_of_it, lens["source"]) if facts["lens"]["model"] == "prescription" else ""}</section>')


def draw(petzval, folder, name, disc):
    coc, field, file, _ = disc
    path = folder / f"{name}-{file}.png"
    source = ROOT / "lenses" / f"{name}.json"
    if not path.exists() or (source.exists() and path.stat().st_mtime < source.stat().st_mtime):
        subprocess.run([petzval, "lens", "psf", name, "--defocus", str(coc), "--field", field, "-o", path, "--quiet", "--overwrite"], check=True, capture_output=True)


def write_pages(petzval, validator, folder):
    folder.mkdir(parents=True, exist_ok=True)
    lenses = told(petzval, "lens", "list")["lenses"]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda work: draw(petzval, folder, *work), [(lens["name"], disc) for lens in lenses for disc in DISCS]))
    numbers = published(validator)
    for lens in lenses:
        (folder / f"{lens['name']}.html").write_text(lens_page(lens, told(petzval, "lens", "show", lens["name"]), numbers.get(lens["name"])))
    cards = "".join(f'<figure><a href="{lens["name"]}.html"><img src="{lens["name"]}-behind.png" alt="Its disc behind focus" loading="lazy"></a>'
                    f'<figcaption><a href="{lens["name"]}.html">{lens["name"]}</a>: {html.escape(lens["title"])}</figcaption></figure>' for lens in lenses)
    (folder / "index.html").write_text(page("The lenses of petzval", f'<section class="whole"><p><a href="../index.html">The lens lab</a></p><div class="discs">{cards}</div></section>'))


if __name__ == "__main__":
    write_pages(sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]))
