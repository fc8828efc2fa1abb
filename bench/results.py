"""Runs the commands that stand in docs/results and puts what they print in their place, with commit, date and machine.

A table of a page lies between two marks. The first is the command, as a user types it:

    <!-- ./dev bench quality --width 480 -->
    <!-- end -->

Usage: ./dev bench results [--list] [REGEX]
REGEX chooses among "PAGE: COMMAND" (default: all, which takes an hour); --list prints them. A command that fails leaves
its table as it was. Seconds mean something on a quiet machine only.
"""
import pathlib
import re
import shlex
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent

PAGES = ROOT / "docs/results"
BLOCK = re.compile(r"(?<=<!-- )(\./dev bench [^>]*?|tools/[^>]*?)( -->\n)(.*?)(?=<!-- end -->)", re.DOTALL)


def arguments(command):
    """What runs a marked command here: the bench itself, since ./dev has built already."""
    words = shlex.split(command)
    if words[0] == "./dev":
        return [sys.executable, ROOT / f"bench/{words[2]}.py", *words[3:]]
    return [sys.executable, ROOT / words[0], *words[1:]]


def block(command, printed):
    """Tables as they are; the command and all other lines below them, at most 98 columns wide."""
    tables = "\n".join(line if line.startswith("|") else "" for line in printed.strip().split("\n"))
    notes = [line for line in printed.split("\n") if line.strip() and not line.startswith("|")]
    folded = [textwrap.fill(line, 98, break_on_hyphens=False, break_long_words=False) for line in ["$ " + command, *notes]]
    return "\n" + "\n".join([re.sub("\n{2,}", "\n\n", tables.strip()), "", "```text", *folded, "```"]) + "\n\n"


def made(command):
    print(command, file=sys.stderr)
    done = subprocess.run(list(map(str, arguments(command))), cwd=ROOT, stdout=subprocess.PIPE, text=True)
    return block(command, done.stdout) if done.returncode == 0 else None


def main(words):
    chosen = re.compile(next((w for w in words if w != "--list"), ""))
    failed = []
    for page in sorted(PAGES.glob("*.md")):
        for command in [match[1] for match in BLOCK.finditer(page.read_text())]:
            name = f"{page.name}: {command}"
            if not chosen.search(name):
                continue
            if "--list" in words:
                print(name)
                continue
            text = made(command)
            if text is None:
                failed.append(name)
                continue
            kept = page.read_text()  # anew: others may have written meanwhile
            page.write_text(BLOCK.sub(lambda m: m[1] + m[2] + (text if m[1] == command else m[3]), kept))
    if failed:
        sys.exit("bench: failed, tables left as they were:\n" + "\n".join(failed))


if __name__ == "__main__":
    main(sys.argv[1:])
