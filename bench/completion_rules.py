"""The table of `./dev bench completion --rules`: what each number of the estimate of hidden surfaces is worth.

One row per number and variant (off, half, double; left out where it would leave the number's range). Columns: the change of the
mean dB of each group of shots, of `edges dB` for the branch, the shot that changes most for the worse, the change of mean shake,
and CPU times. A rule whose row `off` loses nothing has no reason to be there.
"""
import json
import subprocess
import sys

SETS = ["tuning seeds", "judging seeds", "own scenes", "branch"]


def measured(words):
    """{(number, variant): {shot: numbers}}; the program as it is has the key ("", "")."""
    found = {}
    with subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE, text=True) as running:
        for line in running.stdout:
            add(found, json.loads(line))
            if len(next(reversed(found.values()))) == 1:
                print("\rcompletion:", *next(reversed(found)), end=20 * " ", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    if running.returncode:
        sys.exit(running.returncode)
    return found


def add(found, numbers):
    found.setdefault((numbers.get("number", ""), numbers.get("variant", "")), {})[numbers["shot"]] = numbers


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else float("nan")


def by_number(found):
    order = list(dict.fromkeys(number for number, _ in found))
    return sorted(found.items(), key=lambda item: order.index(item[0][0]))


def table(found, group_of):
    """Head and rows for print_table()."""
    usual = found[("", "")]
    rows = [row(key, now, usual, group_of) for key, now in by_number(found) if key != ("", "")]
    return ["number", "variant", *SETS, "most lost", "shake", "CPU times"], rows


def row(key, now, usual, group_of):
    cells = [*key]
    for name in SETS:
        field = "edges_db" if name == "branch" else "db"
        cells.append(f"{mean(now[s][field] - usual[s][field] for s in now if group_of(s).startswith(name)):+.3f}")
    change = {s: now[s]["db"] - usual[s]["db"] for s in now}
    lost = min(change, key=change.get)
    shake = mean(now[s]["shake"] - usual[s]["shake"] for s in now if "shake" in now[s])
    cpu = sum(now[s]["cpu_s"] for s in now) / sum(usual[s]["cpu_s"] for s in now)
    return [*cells, f"{lost}: {change[lost]:+.2f}" if change[lost] < 0 else "", f"{shake:+.3f}", f"{cpu:.2f}"]
