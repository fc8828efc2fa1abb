"""How well hidden surfaces are guessed: seeds of the scene `random`, our own scenes, and a branch with an exact answer.

One table, in Markdown, on stdout. Seeds that end in 0-4 are for tuning, those that end in 5-9 only for judging: they are never
looked at while a rule is made. `edges` counts the pixels that the blur of a silhouette reaches. Shake and pop are of three
frames (two seeds in five): the second difference in time against the truth's, and the largest change of an 8 x 8 block from
frame to frame beyond the truth's. CPU seconds are of drawing one frame of 320 x 180.

--save FILE.json keeps the numbers, --against FILE.json|BUILD compares with kept ones, or with those of another build folder
(the same sources of bench and scenes, another estimator). --sheets N: the N worst squares of the judging seeds as
build/bench/completion/worst.png: sharp, before (with --against BUILD), after, truth, three times as large.
--known supplies the scene's hidden layers. Compared with saved numbers, it shows the most that an estimate can gain. The
branch has no hidden layers and is left out.

--rules prints what each number of the estimate is worth (src/engine/samples/completion_model.h): the change of mean dB if the
number is switched off, halved or doubled. completion_rules.py explains the columns. --only a,b: these numbers alone.
--set a=1,b=2: other numbers throughout.

Usage: ./dev bench completion [--seeds 0-99] [--small] [--own] [--engine NAME] [--quality Q] [--save F] [--against F] [--sheets N]
                              [--known] [--rules [--only NAMES]] [--set NAME=VALUE,…]
--small: seeds 0-9 and the branch alone, about a minute once their truths are there. Truths are kept in
build/bench/completion until the sources of the scene change; a hundred seeds take ten minutes of two cores.
"""
import argparse
import hashlib
import json
import pathlib
import re
import subprocess
import sys

import completion_rules
from quality import CACHE, PROGRAM, ROOT, machine, print_table

BUILD = pathlib.Path(PROGRAM).parents[2]
OWN = ["night", "fence", "table", "slant", "bars", "dynamic-range", "lanterns", "hair", "post", "meadow", "tori", "cubes", "rows",
       "cutouts"]
BRANCH = [f"branch:{tilt}:{stop}" for stop in (0.7, 1.4, 5.6) for tilt in (8, 14, 22)]
GROUPS = ["tuning seeds", "judging seeds", "own scenes", "branch f/0.7", "branch f/1.4", "branch f/5.6"]


def group_of(shot):
    if shot.isdigit():
        return GROUPS[0] if int(shot) % 10 < 5 else GROUPS[1]
    return f"branch f/{shot.split(':')[2]}" if shot.startswith("branch") else GROUPS[2]


def shots_folder():
    """Where truths are kept; another one when what a seed looks like changes."""
    names = ["made_up/*", "dice.h", "world.*", "shapes.*", "textures.*", "built_in/plants.*", "pinhole.cpp", "truth.cpp", "tracing.*",
             "lamp_light.*", "sampling.*", "optics.h"]
    sources = sorted(p for name in names for p in (ROOT / "src/scene").glob(name) if "_test" not in p.name)
    code = "".join(re.sub(r"//.*|\s", "", p.read_text()) for p in sources)
    state = hashlib.sha1(code.encode()).hexdigest()[:8]
    return CACHE / "completion" / state


def measured(build, shots, given, folder, keep=None):
    """{shot: numbers} of one build's program."""
    program = build / "bench/petzval_bench_completion"
    if not program.exists():
        sys.exit(f"bench: {program} is missing; build the target petzval_bench_completion there, or save its numbers")
    flags = [*(["--keep", keep] if keep else []), *(["--known"] if given.known else []),
             *(["--set", given.set] if given.set and build == BUILD else [])]
    words = [program, folder, "--engine", given.engine, "--quality", given.quality, *flags, *shots]
    found = {}
    with subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE, text=True) as running:
        for line in running.stdout:
            numbers = json.loads(line)
            found[numbers["shot"]] = numbers
            print(f"\r{build.name}: {len(found)} of {len(shots)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    if running.returncode:
        sys.exit(running.returncode)
    return found


def mean(values):
    return sum(values) / len(values) if values else float("nan")


def summary(group, now, before):
    """One row: what is better and worse than before in a group of shots."""
    shots = [shot for shot in now if group_of(shot) == group]
    if not shots:
        return None
    moving = [now[s] for s in shots if "shake" in now[s]]
    worst = min(shots, key=lambda s: now[s]["edges_db"])
    row = [group, str(len(shots)), f"{mean([now[s]['db'] for s in shots]):.2f}",
           f"{mean([now[s]['edges_db'] for s in shots]):.2f}", f"{worst}: {now[worst]['edges_db']:.1f}",
           f"{mean([m['shake'] for m in moving]):.3f}" if moving else "",
           f"{max(m['pop'] for m in moving):.3f}" if moving else "", f"{mean([now[s]['cpu_s'] for s in shots]):.3f}"]
    if before:
        both = [s for s in shots if s in before]
        if not both:
            return [*row, "", "", "", ""]
        change = {s: now[s]["db"] - before[s]["db"] for s in both}
        edges = {s: now[s]["edges_db"] - before[s]["edges_db"] for s in both}
        lost = min(both, key=change.get)
        cpu = sum(now[s]["cpu_s"] for s in both) / sum(before[s]["cpu_s"] for s in both)
        row += [f"{mean(list(change.values())):+.2f}", f"{mean(list(edges.values())):+.2f}", f"{lost}: {change[lost]:+.2f}",
                f"{cpu:.2f}"]
    return row


def sheets(now, before, folders, count):
    """The worst squares of the judging seeds side by side."""
    squares = [(crop[2], shot, crop) for shot, numbers in now.items() if group_of(shot) == GROUPS[1]
               for crop in numbers["crops"]]
    lines = []
    for _, shot, (x, y, _) in sorted(squares, reverse=True)[:count]:
        numbers = now[shot]
        files = [numbers["sharp"], *(folder / f"{shot}.{numbers['frame']}.exr" for folder in folders), numbers["truth"]]
        lines.append(" ".join(map(str, [x, y, numbers["exposure"], *files])))
        print(f"  {shot} at {x},{y}" + (f" (before {before[shot]['edges_db']:.1f}, now {numbers['edges_db']:.1f} dB)"
                                       if before and shot in before else ""), file=sys.stderr)
    out = CACHE / "completion/worst.png"
    listed = out.with_suffix(".txt")
    listed.write_text("\n".join(lines) + "\n")
    subprocess.run([BUILD / "bench/petzval_bench_sheet", out, listed], check=True)
    print(out, file=sys.stderr)


def parsed():
    parser = argparse.ArgumentParser(prog="./dev bench completion")
    parser.add_argument("--seeds", default="0-99", help="first-last, or some with commas")
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--own", action="store_true", help="also our own scenes")
    parser.add_argument("--engine", default="scatter")
    parser.add_argument("--quality", default="standard")
    parser.add_argument("--save", type=pathlib.Path)
    parser.add_argument("--against", type=pathlib.Path)
    parser.add_argument("--sheets", type=int, default=0)
    parser.add_argument("--known", action="store_true", help="supply the scene's hidden layers")
    parser.add_argument("--rules", action="store_true", help="what each number of the estimate is worth")
    parser.add_argument("--only", help="with --rules: numbers, with commas")
    parser.add_argument("--set", help="other numbers of the estimate: NAME=VALUE,…")
    given = parser.parse_args()
    first, _, last = given.seeds.partition("-")
    given.shots = given.seeds.split(",") if not last else [str(i) for i in range(int(first), int(last) + 1)]
    if given.small:
        given.shots = [str(i) for i in range(10)]
    given.shots += (OWN if given.own else []) + ([] if given.known else BRANCH)
    return given


def main():
    given = parsed()
    folder = shots_folder()
    keep = {which: folder.parent / which for which in ("before", "after")} if given.sheets else {}
    for place in [folder, *keep.values()]:
        place.mkdir(parents=True, exist_ok=True)
    command = f"{machine()}; command: ./dev bench completion {' '.join(sys.argv[1:])}".rstrip() + "."
    if given.rules:
        words = [BUILD / "bench/petzval_bench_completion", folder, "--engine", given.engine, "--quality", given.quality, "--rules",
                 *(["--only", given.only] if given.only else []), *(["--set", given.set] if given.set else []), *given.shots]
        print_table(*completion_rules.table(completion_rules.measured(words), group_of))
        return print(f"\n{given.engine}, {given.quality}. {command}")
    now = measured(BUILD, given.shots, given, folder, keep.get("after"))
    before, folders = None, [keep.get("after")]
    if given.against and given.against.is_dir():
        before, folders = measured(given.against, given.shots, given, folder, keep.get("before")), list(keep.values())
    elif given.against:
        before = json.loads(given.against.read_text())
    head = ["shots", "count", "dB", "edges dB", "worst edges", "shake", "worst pop", "CPU s"]
    head += ["dB gained", "edges gained", "most lost", "CPU times"] if before else []
    print_table(head, [row for row in (summary(group, now, before) for group in GROUPS) if row])
    print(f"\n{given.engine}, {given.quality}. {command}")
    if given.save:
        given.save.write_text(json.dumps(now, indent=0) + "\n")
    if given.sheets:
        sheets(now, before, folders, given.sheets)


if __name__ == "__main__":
    main()
