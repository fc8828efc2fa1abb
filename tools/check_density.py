"""Fails when code becomes denser: files per folder, statements chained by commas, nested ternaries.

Usage: check_density.py [repository root]. Each count has a limit below. Where there is more today than the rule allows,
the limit is today's count: it may fall and never rises. Whoever brings a count down lowers its limit.
"""
import pathlib
import re
import sys

FILES_IN_A_FOLDER = 40
# Folders with more. Paths of public headers stay as they are.
CROWDED = {
    "include/petzval": 60,
}
CHAINED = 760
NESTED = 71

STRIP = re.compile(r'//[^\n]*|"(\\.|[^"\\])*"|\'(\\.|[^\'\\])\'|/\*.*?\*/|^\s*#[^\n]*', re.DOTALL | re.MULTILINE)
HEAD = re.compile(r"^((else|do) ?)?((if|for|while) ?)?")
# Something is changed, without a type before it.
CHANGES = re.compile(r"^(\+\+|--|\*)?[\w.:]+(->[\w.]+)* ?(([-+*/%&|^]|<<|>>)?=(?!=)|\+\+|--|$)")


def levels(text):
    """The text of a file bracket by bracket: what stands in round and square ones, then what is left without them."""
    for inside in (re.compile(r"\(([^()]*)\)"), re.compile(r"\[([^\[\]]*)\]")):
        while inside.search(text):
            yield from inside.findall(text)
            text = inside.sub(" ", text)
    yield text


def chained(text):
    """How many statements change several things, one after the other, by commas."""
    count = 0
    for statement in re.split(r"[;{}:]", list(levels(text))[-1])[:-1]:
        parts = [" ".join(part.split()) for part in HEAD.sub("", " ".join(statement.split())).split(",")]
        count += len(parts) > 1 and all(CHANGES.match(part) for part in parts) and any("=" in part for part in parts)
    return count


def nested_ternaries(text):
    """How many expressions choose again where they chose."""
    return sum(part.count("?") > 1 for level in levels(text) for part in re.split(r"[;{},]", level))


def code_files(root):
    for folder in ("include", "src", "apps", "plugins"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in {".h", ".cpp", ".comp", ".glsl"} and not path.name.endswith("_test.cpp"):
                yield path


def counts(root):
    """{what is counted: (count, limit)}"""
    found = {}
    for folder in sorted({p.parent for p in code_files(root)}):
        name = folder.relative_to(root).as_posix()
        files = sum(p.is_file() for p in folder.iterdir())
        found[f"files in {name}"] = (files, CROWDED.get(name, FILES_IN_A_FOLDER))
    texts = [STRIP.sub("", path.read_text()) for path in code_files(root)]
    found["statements chained by commas"] = (sum(map(chained, texts)), CHAINED)
    found["nested ternaries"] = (sum(map(nested_ternaries, texts)), NESTED)
    return found


def complaints(root):
    for what, (count, limit) in counts(root).items():
        if count > limit:
            yield f"{what}: {count}, more than {limit}: which ideas are they?"


if __name__ == "__main__":
    found = list(complaints(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "density: ok")
    sys.exit(bool(found))
