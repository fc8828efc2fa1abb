"""How long the kernels of one 4K frame take: every lens of a list, all image cells, all radii up to a largest one.

Usage: ./dev bench kernels [--radius 64] [--repeat 3]. CPU seconds are user + system of the process, the least of the
repeats: what others do on the machine only adds to them; half of them is what two idle cores need. Nothing is read
from a cache.
"""
import argparse
import pathlib
import subprocess
import sys

BENCH = pathlib.Path(__file__).resolve().parents[1] / "build/release/bench/petzval_bench_kernels"
# Lens, f-number, cat's eye, CPU seconds asked for (twice the wall seconds on two cores).
LENSES = [("ideal", 2, 0.5, 3), ("uncorrected", 2, 0, 3), ("uncorrected", 2, 0.5, 3), ("doublet", 1.4, 0.5, 3),
          ("petzval-portrait", 4, 0, 8), ("triplet-cooke", 4, 0, 8), ("tessar", 4.5, 0, 8),
          ("double-gauss", 2.1, 0, 8), ("takumar", 1.4, 0, 8), ("phone", 3.5, 0, 8), ("petzval-laikin", 1.4, 0, 8)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--radius", default="64")
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    print(f"3840×2160, 9×6 cells, radii −{options.radius}…{options.radius} px, least of {options.repeat}\n")
    print("| lens | f/ | cat's eye | kernels | MiB | CPU s | / 2 | asked, wall |\n|---|---|---|---|---|---|---|---|")
    for lens, f_number, cats_eye, asked in LENSES:
        best = None
        for _ in range(options.repeat):
            done = subprocess.run([BENCH, lens, "3840", "2160", options.radius, str(f_number), str(cats_eye), "2"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            if done.returncode:
                print(f"{lens}: {done.stderr.strip()}", file=sys.stderr)
                break
            words = done.stdout.split()
            values = dict(zip(words[1::2], words[2::2]))
            if best is None or float(values["cpu"]) < float(best["cpu"]):
                best = values
        if best:
            cpu = float(best["cpu"])
            print(f"| {lens} | {f_number} | {cats_eye or ''} | {best['kernels']} | {best['MiB']} | {cpu:.2f} | "
                  f"{cpu / 2:.2f} | {asked / 2} |", flush=True)


if __name__ == "__main__":
    main()
