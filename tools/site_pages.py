"""Builds the static pages of docs/ with mkdocs-material; `./dev site` runs it.

Usage: site_pages.py PROGRAM [--no-gallery]. Leaves build/site/index.html. The generator is installed into build/site-venv from
PyPI, with its version pinned here. mkdocs-material was chosen because it builds plain Markdown without plug-ins, can be
used without other hosts, and installs; its successor Zensical reads the same tools/site/mkdocs.yml, but its wheel
zensical-ui did not install when this was written. Links that leave docs/ lead to copies under source/.
"""
import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCS, STAGE, SITE, VENV = ROOT / "docs", ROOT / "build/site-pages", ROOT / "build/site", ROOT / "build/site-venv"
PICTURES = ROOT / "build/site-gallery"
GENERATOR = "mkdocs-material==9.8.1"
LINK = re.compile(r"(\]\()([^)\s#]+)")
BARS = re.compile(r"`([^`\n]*\\\|[^`\n]*)`")
PAIRS = [("scatter against the sharp picture", "sharp", "ideal"), ("ideal lens, achromat", "ideal", "doublet"),
         ("ideal lens, Petzval portrait lens", "ideal", "petzval-portrait")]


def run(*command, **options):
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode:
        sys.exit(f"site: {' '.join(map(str, command))} failed\n{done.stdout}")
    return done.stdout


def generator():
    """The pinned generator, installed once."""
    mark = VENV / GENERATOR
    if not mark.exists():
        run(sys.executable, "-m", "venv", VENV)
        run(VENV / "bin/pip", "install", "--quiet", GENERATOR)
        mark.touch()
    return VENV / "bin/mkdocs"


def stage_pages():
    """Copies docs/ and every file outside that a page links to; the links lead to the copies."""
    shutil.rmtree(STAGE, ignore_errors=True)
    shutil.copytree(DOCS, STAGE)
    pages = [(page, DOCS / page.relative_to(STAGE)) for page in STAGE.rglob("*.md")]
    for page, home in pages:  # grows while it is walked

        def moved(match, page=page, home=home):
            target = (home.parent / match[2]).resolve()
            if re.match(r"[a-z]+:", match[2]) or not target.exists():
                return match[0]
            copy = STAGE / target.relative_to(DOCS) if target.is_relative_to(DOCS) else copied(target, pages)
            return match[1] + os.path.relpath(copy, page.parent)

        page.write_text(BARS.sub(as_code, LINK.sub(moved, page.read_text())))


def copied(target, pages):
    """The copy of a file outside docs/: a page, a list of a folder's files, or text."""
    copy = STAGE / "source" / target.relative_to(ROOT)
    copy.parent.mkdir(parents=True, exist_ok=True)
    if target.is_dir():
        copy = copy.with_suffix(".txt")
        copy.write_text("\n".join(sorted(p.name for p in target.iterdir())) + "\n")
    elif target.suffix == ".md":
        if not copy.exists():
            shutil.copy(target, copy)
            pages.append((copy, target))
    else:  # browsers show code as text
        copy = copy.with_name(copy.name + ".txt")
        shutil.copy(target, copy)
    return copy


def as_code(match):
    """Code with the escaped bars of a table: the generator shows their backslashes, GitHub does not."""
    return "<code>" + html.escape(match[1]).replace("\\|", "&#124;") + "</code>"


def nav():
    """The order of the start page: its sections, and under each its links."""
    found = [{"Start": "README.md"}, {"Gallery": "gallery.md"}]
    for section in re.split(r"^## ", (DOCS / "README.md").read_text(), flags=re.MULTILINE)[1:]:
        pages = [page for _, page in LINK.findall(section) if page.endswith(".md") and not page.startswith("..")]
        found.append({section.split("\n")[0]: pages})
    listed = {page for entry in found[2:] for pages in entry.values() for page in pages}
    missing = {p.relative_to(DOCS).as_posix() for p in DOCS.glob("*/*.md")} - listed
    if missing := sorted(page for page in missing if not page.startswith("journal/")):
        sys.exit(f"site: docs/README.md has no link to {', '.join(missing)}")
    return json.dumps(found)


def picture(program, name, *flags):
    """One picture of the gallery, made once."""
    path = PICTURES / f"{name}.png"
    if not path.exists():
        run(program, "defocus", PICTURES / "night.exr", "-o", path, "--exposure", "0.8", "--quality", "draft", "-q", *flags)
    return path


def lenses(program):
    return json.loads(run(program, "lens", "list", "--json", "-"))["lenses"]


def make_gallery(program):
    """(lens, f-number) of every lens whose picture is there now."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    if not (PICTURES / "night.exr").exists():
        run(program, "scene", "make", "night", "-o", PICTURES / "night.exr", "--width", 480, "--height", 270, "-q")
    picture(program, "sharp", "--fstop", "inf")
    for lens in lenses(program):
        f_number = max(lens["f_number"] or 2, 1)
        picture(program, lens["name"], "--lens", lens["name"], "--fstop", f"{f_number * 1.0001:.5f}")
        yield lens["name"], f_number
    if shutil.which("ffmpeg") and not (PICTURES / "pull.mp4").exists():
        make_pull(program)


def make_pull(program):
    track = PICTURES / "pull.csv"
    track.write_text("frame,focus\n1,3\n24,8\n48,3\n")
    run(program, "defocus", PICTURES / "night.exr", "-o", PICTURES / "pull-##.png", "--track", track, "--lens", "doublet",
        "--engine", "gather", "--exposure", "0.8", "--frames", "1-48", "-q")
    run("ffmpeg", "-y", "-loglevel", "error", "-framerate", "24", "-i", PICTURES / "pull-%02d.png", "-pix_fmt", "yuv420p",
        PICTURES / "pull.mp4")


def slider(title, left, right):
    return (f'<div class="compare"><img src="gallery/{left}.png" alt="{left}"><img src="gallery/{right}.png" alt="{right}">'
            f'<input type="range" value="50" aria-label="{title}: border between {left} and {right}"></div>\n')


def write_gallery(program, wanted):
    lines = ["# Gallery\n", "The built-in scene night, made by `./dev site`.\n"]
    if wanted:
        made = list(make_gallery(program))
        (STAGE / "gallery").mkdir()
        for path in [*PICTURES.glob("*.png"), *PICTURES.glob("*.mp4")]:
            if not path.name.startswith("pull-"):
                shutil.copy(path, STAGE / "gallery")
        lines += [f"## {title[0].upper() + title[1:]}\n\n{slider(title, left, right)}" for title, left, right in PAIRS]
        if (PICTURES / "pull.mp4").exists():
            lines += ["## A focus pull\n", '<video src="gallery/pull.mp4" controls loop muted playsinline></video>\n']
        lines += ["## Every lens, wide open\n", '<div class="lens-grid">']
        lines += [f'<figure><img src="gallery/{name}.png" alt="Night through {name}" loading="lazy">'
                  f"<figcaption>{name}, f/{f_number:.3g}</figcaption></figure>" for name, f_number in made]
        lines += ["</div>"]
    (STAGE / "gallery.md").write_text("\n".join(lines) + "\n")


def faults(site):
    """Links that lead nowhere, and anything that a page loads from another host."""
    for page in site.rglob("*.html"):
        text = page.read_text()
        for tag, attribute, target in re.findall(r'<(\w+)[^>]*?\b(href|src)="([^"]*)"', text):
            path = urllib.parse.unquote(target.partition("#")[0])
            if re.match(r"(?:[a-z]+:)?//|mailto:|data:", target):
                if tag != "a":
                    yield f"{page.relative_to(site)} loads {target}"
            elif path and page.name != "404.html" and not (page.parent / path).exists():
                yield f"{page.relative_to(site)}: {target} leads nowhere"


def main(program, *words):
    order = nav()  # a page without a link ends the run here, before the pictures are made
    mkdocs = generator()
    stage_pages()
    write_gallery(pathlib.Path(program).resolve(), "--no-gallery" not in words)
    for name in ("site.css", "site.js"):
        shutil.copy(ROOT / "tools/site" / name, STAGE)
    settings = (ROOT / "tools/site/mkdocs.yml").read_text().replace("STAGE", str(STAGE)).replace("SITE", str(SITE))
    settings = settings.replace("NAV", order)
    (ROOT / "build/site.yml").write_text(settings)
    run(mkdocs, "build", "--quiet", "--clean", "--config-file", ROOT / "build/site.yml",
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1", "DISABLE_MKDOCS_2_WARNING": "true"})
    if wrong := sorted(set(faults(SITE))):
        sys.exit("\n".join(wrong))
    print(SITE / "index.html")


if __name__ == "__main__":
    main(*sys.argv[1:])
