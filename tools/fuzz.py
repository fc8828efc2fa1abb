"""Runs readers under libFuzzer for some seconds each and records what was counted in docs/results/fuzz.md.

Usage: fuzz.py FOLDER [CORPUS…] --seconds N. FOLDER holds the targets (tests/fuzz of the preset fuzz). New inputs
that reach new code stay in FOLDER/found/CORPUS and are used again; inputs that fail lie in FOLDER/failing.
"""
import argparse
import datetime
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CORPORA = ROOT / "tests/fuzz/corpus"
PAGE = ROOT / "docs/results/fuzz.md"
PICTURES = ("exr", "png", "jpeg", "tiff")
COLUMNS = "Corpus | Date | Seconds | Executions | Edges covered | Inputs kept | Findings"


def target_of(corpus):
    return "picture" if corpus in PICTURES else corpus


def fuzzed(folder, corpus, seconds):
    """Runs one target; the row of the table."""
    found, failing = folder / "found" / corpus, folder / "failing"
    for path in (found, failing):
        path.mkdir(parents=True, exist_ok=True)
    before = set(failing.glob(f"{corpus}-*"))
    command = [folder / f"fuzz_{target_of(corpus)}", f"-max_total_time={seconds}", "-max_len=16384", "-timeout=600",
               "-report_slow_units=600", "-rss_limit_mb=2048", "-print_final_stats=1",
               f"-artifact_prefix={failing}/{corpus}-", found, CORPORA / corpus]
    print("+ " + " ".join(map(str, command)), file=sys.stderr, flush=True)
    done = subprocess.run(command, preexec_fn=lambda: os.nice(10), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env={**os.environ, "PETZVAL_KERNEL_CACHE": "off", "ASAN_OPTIONS": "quarantine_size_mb=64"},
                          text=True, errors="replace")
    (folder / f"{corpus}.log").write_text(done.stdout)
    new = sorted(set(failing.glob(f"{corpus}-*")) - before)
    if done.returncode:
        print(f"{corpus}: stopped, see {folder}/{corpus}.log; inputs: {' '.join(map(str, new))}", file=sys.stderr)
    return row_of(corpus, done.stdout, len(new) or int(done.returncode != 0)), done.returncode == 0


def row_of(corpus, log, findings):
    edges = re.findall(r" cov: (\d+) ", log) or ["–"]
    corpus_size = re.findall(r" corp: (\d+)/", log) or ["–"]
    executions = re.findall(r"number_of_executed_units: *(\d+)", log) or re.findall(r"^#(\d+)", log, re.M)[-1:] or ["0"]
    seconds = re.findall(r"in (\d+) second", log) or ["until it failed"]
    return [corpus, datetime.date.today().isoformat(), seconds[-1], executions[-1], edges[-1], corpus_size[-1],
            str(findings)]


def record(rows):
    """Rows of corpora that were run replace theirs; what stands before the table stays."""
    text = PAGE.read_text()
    head, _, table = text.partition(f"| {COLUMNS} |\n")
    old = {line.split("|")[1].strip(): line for line in table.splitlines()[1:] if line.startswith("|")}
    old.update({row[0]: "| " + " | ".join(row) + " |" for row in rows})
    rule = "|" + "---|" * (COLUMNS.count("|") + 1)
    PAGE.write_text(head + "\n".join([f"| {COLUMNS} |", rule, *(old[k] for k in sorted(old))]) + "\n")


def main():
    known = sorted(p.name for p in CORPORA.iterdir())
    parser = argparse.ArgumentParser(prog="./dev fuzz", usage="./dev fuzz [CORPUS…] [--seconds N]")
    parser.add_argument("folder", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("corpora", nargs="*", metavar="CORPUS", help=", ".join(known))
    parser.add_argument("--seconds", type=int, default=120, help="for each; default 120")
    words = parser.parse_args()
    if unknown := set(words.corpora) - set(known):
        parser.error(f"no corpus {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    clean = True
    for corpus in words.corpora or known:
        row, passed = fuzzed(words.folder, corpus, words.seconds)
        record([row])
        clean &= passed
    sys.exit(not clean)


if __name__ == "__main__":
    main()
