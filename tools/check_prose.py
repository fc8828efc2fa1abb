#!/usr/bin/env python3
"""Reports prose that a native engineer would stop at; the rules are those of CONTRIBUTING.md, "Style".

Usage: check_prose.py [--list | --tighten] [repository root]

Pages (every .md): words and forms of tools/prose_words.txt, lines over 100 columns, sentences over 35 words, more than
four numbers in a sentence outside tables, titles without a subject, paragraphs that break off. Comments of C++ and GLSL: the same words, and
blocks whose first word leaves their subject out. Texts in quotes of src and apps (help, messages, sheets): the same
words, except "no such". What was there before the rules is counted in
tools/prose_allowed.txt, per page and per folder of sources; a count may only fall. --list shows all findings,
--tighten stores lower counts. Subjects of new commits: at most 60 characters, and imperative.

Of Debian's linters, diction, codespell and proselint read neither Markdown nor comments and take no expressions.
"""
import pathlib
import re
import subprocess
import sys

COLUMNS, WORDS, NUMBERS, SUBJECT = 100, 35, 4, 60
HERE = pathlib.Path(__file__).resolve().parent
SOURCES = {".h", ".cpp", ".comp", ".glsl"}
# Pages or folders of pages that are spared a rule, with the reason.
SPARED = {
    ("columns", "docs/reference/command-line.md"): "generated rows",
    ("columns", "docs/reference/c-api.md"): "generated rows",
    ("end", "docs/reference/command-line.md"): "texts of the help, which have no full stop",
    ("end", "docs/reference/c-api.md"): "comments of the header",
    ("end", "docs/journal/"): "entries are not edited after their day",
    ("numbers", "docs/journal/"): "a journal may quote a run in a sentence",
    ("words", "CONTRIBUTING.md"): "quotes the words that it advises against",
}
HEADLESS = re.compile(r"(Of|What(ever)?|Whether|Who(ever|se)?|Which(ever)?|Where(ver)?|That|How|By|Than|But|Nor|As|From"
                      r"|Between|Beyond|Along|Among|So|Into|At)\b(?! most| least| once)")
# Eight words or more that begin a sentence and do not end one.
UNFINISHED = re.compile(r"(?=[A-Z\"“])(?:\S+\s+){7}.*[^.:!?…)\"”|]$", re.DOTALL)
QUESTION = re.compile(r"^(What|Whether|Who|Where|That|Of|By)\b")
FENCE = re.compile(r"^(```.*?^```|<!--.*?-->)", re.DOTALL | re.MULTILINE)
NUMBER = re.compile(r"(?<![\w.#/×-])[-−+±]?\d[\d,.]*(?: \d{3}\b)*(?:\s?[×x]\s?\d+)?")
QUOTED = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
COMMENT = re.compile(r"^\s*//+!?<? ?(.*)$")
NO_IMPERATIVE = set("what who whose whether where when which that a an the of in on at by for from to with no not all each "
                    "every some any among between as if it its there this these those one two three four more less only "
                    "also too other another everything nothing".split())
ENDS = re.compile(r"(?<!e)(?<!spe)ed$|ing$|[^su]s$")
FINE = {"need", "bring", "bias", "string", "alias", "canvas", "address", "focus", "shed", "embed"}


def words():
    rows = [line.split("\t") for line in (HERE / "prose_words.txt").read_text().splitlines() if line[:1] not in ("", "#")]
    return [(re.compile(pattern, re.IGNORECASE), instead) for pattern, instead in rows]


LISTED = words()


def blanked(pattern, text):
    """The text with matches emptied and line numbers kept."""
    return pattern.sub(lambda m: "\n" * m[0].count("\n"), text)


def plain(text):
    """Without code, links' targets and emphasis."""
    text = re.sub(r"`[^`]*`", "Code", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}", "", text)


def paragraphs(text):
    """(line, kind, text) of headings, table rows, list items and paragraphs."""
    start, kept, kept_kind = 0, [], "text"
    for number, line in enumerate((text + "\n\n").split("\n"), 1):
        stripped = line.strip()
        kind = ("heading" if re.match(r"#+ ", stripped) else "row" if stripped.startswith("|") else
                "item" if re.match(r"([-*]|\d+\.) ", stripped) else "text" if stripped else "end")
        if kept and kind != "text":
            yield start, kept_kind, " ".join(kept)
            kept = []
        if kind in ("heading", "row"):
            yield number, kind, stripped.lstrip("# ")
        elif kind in ("item", "text"):
            start, kept_kind = (start, kept_kind) if kept else (number, kind)
            kept.append(re.sub(r"^([-*]|\d+\.) ", "", stripped))


def sentences(text):
    return re.split(r"(?<=[.!?:;])[)\"”]?\s+(?=[\"“(]?[A-Z0-9])", plain(text))


def word_findings(text):
    for pattern, instead in LISTED:
        for match in pattern.finditer(text):
            yield "words", f"'{match[0]}': {instead}"


def sentence_findings(sentence):
    count = len(re.findall(r"[^\W\d_][\w'’-]*", sentence))
    if count > WORDS:
        yield "sentence", f"{count} words in one sentence: '{sentence[:40]}…'"
    count = len(NUMBER.findall(sentence))
    if count > NUMBERS:
        yield "numbers", f"{count} numbers in one sentence, use a table: '{sentence[:40]}…'"


def page_findings(text):
    """(line, rule, message) of a page."""
    bare = blanked(FENCE, text)
    for number, line in enumerate(bare.split("\n"), 1):
        if len(line) > COLUMNS and not re.match(r"\s*\||\S*\[.*\]\(\S+\)\S*$|!\[", line.strip()):
            yield number, "columns", f"{len(line)} columns"
    for number, kind, paragraph in paragraphs(bare):
        if kind == "heading" and QUESTION.match(paragraph) and not paragraph.endswith("?"):
            yield number, "title", f"the title '{paragraph}' does not name its subject"
        for found in word_findings(plain(paragraph)):
            yield number, *found
        is_prose = kind == "text" and not paragraph.startswith("![") and " · " not in paragraph
        if is_prose and UNFINISHED.match(plain(paragraph)):
            yield number, "end", f"the paragraph '{paragraph[:40]}…' does not end with its sentence"
        for sentence in sentences(paragraph) if kind in ("item", "text") else ():
            for found in sentence_findings(sentence):
                yield number, *found


def comment_blocks(text):
    """(line, text) of runs of // comments that stand on lines of their own."""
    start, kept = 0, []
    for number, line in enumerate(text.split("\n") + [""], 1):
        match = COMMENT.match(line)
        if match:
            start = start if kept else number
            kept.append(match[1])
        elif kept:
            yield start, " ".join(kept)
            kept = []


def comment_findings(text):
    for line, block in comment_blocks(text):
        if HEADLESS.match(block) and not block.split("(")[0].rstrip().endswith("?"):
            yield line, "subject", f"the comment '{block[:40]}…' does not name its subject"
        for found in word_findings(block):
            yield line, *found


def quoted_texts(text):
    """(line, text) of the string literals with a space in them, neighbours joined."""
    bare = re.sub(r"(?m)(?:^|\s)//.*$", "", text)
    for match in QUOTED.finditer(bare):
        joined = re.sub(r'"\s*"', "", match[0])
        if " " in joined:
            yield bare.count("\n", 0, match.start()) + 1, joined


def quote_findings(text):
    for line, quoted in quoted_texts(text):
        for found in word_findings(quoted.replace("no such", "no")):
            yield line, *found


def source_findings(name, text):
    """(line, rule, message) of a source."""
    yield from comment_findings(text)
    if name.startswith(("src/", "apps/")) and not name.endswith("_test.cpp"):
        yield from quote_findings(text)


def files_of(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    names = listed.stdout.split("\0") if listed.returncode == 0 else [
        p.relative_to(root).as_posix() for p in root.rglob("*")]
    kinds = SOURCES | {".md"}
    return [name for name in sorted(names) if pathlib.Path(name).suffix in kinds and (root / name).is_file()
            and not name.startswith(("build/", "bench/results/"))]


def findings(root):
    """{place that is counted: ["file:line: message"]}"""
    found = {}
    for name in files_of(root):
        page = name.endswith(".md")
        text = (root / name).read_text(errors="replace")
        place = name if page else name.rsplit("/", 1)[0]
        for line, rule, message in page_findings(text) if page else source_findings(name, text):
            if not any(rule == r and name.startswith(p) for r, p in SPARED):
                found.setdefault(place, []).append(f"{name}:{line}: {message}")
    return found


def git(root, *command):
    result = subprocess.run(["git", "-C", root, *command], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return result.stdout.splitlines() if result.returncode == 0 else []


def new_subjects(root):
    """Subjects of commits that neither main nor a remote has; on a main that no remote has, of the last one."""
    head = git(root, "rev-parse", "HEAD")
    if git(root, "branch", "--remotes", "--contains", "HEAD"):
        return []
    known = ["--remotes"] + (["main"] if git(root, "rev-parse", "--verify", "main") not in ([], head) else [])
    only_one = [] if "main" in known else ["-1"]
    return git(root, "log", "--no-merges", "--format=%s", *only_one, "HEAD", "--not", *known)


def subject_findings(subject):
    if len(subject) > SUBJECT:
        yield f"commit '{subject}': {len(subject)} characters, more than {SUBJECT}"
    said = re.sub(r"^[\w/., -]{1,40}: ", "", subject).lower().split()
    first = re.sub(r"\W", "", said[0]) if said else ""
    if first in NO_IMPERATIVE or (ENDS.search(first) and first not in FINE) or {"is", "are", "was", "were"} & set(said[1:4]):
        yield f"commit '{subject}': does not start with an imperative (add, fix, remove, …)"


def allowed(root):
    path = root / "tools/prose_allowed.txt"
    rows = [line.split() for line in path.read_text().splitlines() if line[:1] not in ("", "#")] if path.exists() else []
    return {place: int(count) for count, place in rows}


def tighten(root, found):
    old = allowed(root) or {place: len(lines) for place, lines in found.items()}
    rows = [f"{min(len(found[place]), old[place]):5} {place}" for place in sorted(found) if place in old]
    head = "# Findings of tools/check_prose.py from before its rules. A count may only fall; --tighten stores lower ones.\n"
    (root / "tools/prose_allowed.txt").write_text(head + "\n".join(rows) + "\n")


def main(words):
    root = pathlib.Path(next((w for w in words if not w.startswith("--")), HERE.parent)).resolve()
    found, limit = findings(root), allowed(root)
    if "--tighten" in words:
        tighten(root, found)
        limit = allowed(root)
    if "--list" in words:
        sys.exit(print("\n".join(line for place in found.values() for line in place)))
    wrong = []
    for place, lines in found.items():
        if len(lines) > limit.get(place, 0):
            wrong += lines + [f"{place}: {len(lines)} findings, {limit.get(place, 0)} are allowed"]
    wrong += [line for subject in new_subjects(root) for line in subject_findings(subject)]
    fewer = sum(len(found.get(place, [])) < count for place, count in limit.items())
    total = sum(map(len, found.values()))
    note = f"; {fewer} places have fewer, store that with tools/check_prose.py --tighten" if fewer else ""
    print("\n".join(wrong) or f"prose: ok ({total} findings from before{note})")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main(sys.argv[1:])
