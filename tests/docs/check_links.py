"""Every relative link of the pages leads somewhere in the clone, every test and source that they name exists, and no
page names a place outside of it.

Usage: check_links.py [FOLDER]. Looks at every .md of the repository: [text](target#heading), `paths` in code, tests as
`Suite.WhatItHolds` and `test_what_it_holds`. Sources may be named from src/ on and without their ending:
`engine/scatter/plan`. Entries of the journal name the sources of their day.
"""
import fnmatch
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"`([^`\n]+)`")
UPWARDS = re.compile(r"(?:\.\./)+[\w./-]*")
SOURCE = re.compile(r"[A-Za-z_][\w.*-]*(?:/[\w.*-]+)+/?")
PLACEHOLDER = re.compile(r"(^|/)x(/|\.|$)")  # `src/engine/x/` stands for any engine
TEST = re.compile(r"[A-Z]\w+\.(?:[A-Z][a-z0-9]*){3,}|test_\w+")
DECLARED = re.compile(r"^(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)|^\s+def (test_\w+)", re.MULTILINE)
FENCE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)


def anchors(page):
    """The names of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", FENCE.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def tests_of(root):
    files = [p for folder in ("src", "tests") for p in (root / folder).rglob("*_test.*") if p.suffix in (".cpp", ".py")]
    found = [match for file in files for match in DECLARED.findall(file.read_text())]
    return {python or f"{suite}.{name}" for suite, name, python in found}


class Sources:
    """The files and folders of the repository, as pages may name them."""

    def __init__(self, root):
        listed = subprocess.run(["git", "-C", root, "ls-files", "-z"], stdout=subprocess.PIPE, text=True)
        names = listed.stdout.split("\0") if listed.returncode == 0 else [
            str(p.relative_to(root)) for p in root.rglob("*") if p.is_file()]
        files = [pathlib.PurePosixPath(name) for name in names if name]
        self._all = {str(place) for file in files for place in (file, file.with_suffix(""), *file.parents)}
        self._first = {file.parts[0] for file in files if len(file.parts) > 1}
        self._rooms = {file.parts[1] for file in files if file.parts[0] == "src" and len(file.parts) > 2}

    def is_missing(self, path):
        """True if the path begins with a folder of the repository or a room of src/, and does not exist. Other folders of
        src/ belong to other projects."""
        path = path.rstrip("/")
        first, *rest = path.split("/")
        is_theirs = first == "src" and rest and rest[0] not in self._rooms
        if (not SOURCE.fullmatch(path) or PLACEHOLDER.search(path) or is_theirs
                or first not in self._first | self._rooms):
            return False
        names = [path] * (first in self._first) + [f"src/{path}"] * (first in self._rooms)
        return not any(name in self._all or fnmatch.filter(self._all, name) for name in names)


def wrong_links(root, page, tests, sources):
    text = FENCE.sub("", page.read_text())
    for target in LINK.findall(text):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, heading = target.partition("#")
        place = (page.parent / path).resolve() if path else page
        if not place.is_relative_to(root):
            yield f"({target}) leads out of the repository"
        elif not place.exists():
            yield f"({target}) leads nowhere"
        elif heading and place.suffix == ".md" and heading not in anchors(place):
            yield f"({target}): {place.name} has no such heading"
    for code in CODE.findall(LINK.sub("", text)):
        if TEST.fullmatch(code) and code not in tests:
            yield f"`{code}` is not a test"
        if page.parent.name != "journal" and sources.is_missing(code):
            yield f"`{code}` is not in the repository"
        for path in UPWARDS.findall(code):
            if not (page.parent / path).resolve().is_relative_to(root):
                yield f"`{path}` is not in the repository"


def unlisted(root, pages):
    """Pages of docs/ that no section of the start page lists, so that the site has no place for them; a journal has a
    list of its own."""
    start = root / "docs/README.md"
    if not start.exists():
        return
    sections = start.read_text().partition("\n## ")[2]
    listed = {(start.parent / target.partition("#")[0]).resolve() for target in LINK.findall(sections)}
    for page in pages:
        if page.is_relative_to(start.parent) and page not in listed | {start} and page.parent.name != "journal":
            yield f"docs/README.md: no link to {page.relative_to(start.parent)}"


def pages_of(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z", "*.md"], stdout=subprocess.PIPE, text=True)
    names = listed.stdout.split("\0") if listed.returncode == 0 else []
    found = [root / name for name in names if name and (root / name).exists()]
    return found or [p for p in root.rglob("*.md") if "build" not in p.relative_to(root).parts]


def main(folder=None):
    root = pathlib.Path(folder or pathlib.Path(__file__).parents[2]).resolve()
    pages, tests, sources = pages_of(root), tests_of(root), Sources(root)
    found = [f"{page.relative_to(root)}: {what}" for page in pages for what in wrong_links(root, page, tests, sources)]
    found += unlisted(root, pages)
    print("\n".join(found) or f"docs: every link of {len(pages)} pages leads somewhere")
    sys.exit(bool(found))


if __name__ == "__main__":
    main(*sys.argv[1:])
