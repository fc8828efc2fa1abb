"""How much of the quality is left where depth has soft silhouettes: antialiased, or as depth maps of networks have them.

One table of dB, in Markdown, on stdout: exact depth, and both kinds of soft depth through --depth-edges keep and auto. Built-in
scenes get them from `scene make --depth-filter mean` and `scene make --depth-blur 2 --depth-bits 8`.

Usage: ./dev bench soft_depth [--scenes A,B] [--width N] [--samples N]
"""
import argparse

from engines import built_in, took
from quality import CACHE, machine, print_table, score

SOFT = ["--depth-blur", "2", "--depth-bits", "8"]
FILTERED = ["--depth-filter", "mean"]
KEEP, AUTO = ["--depth-edges", "keep"], ["--depth-edges", "auto"]
SCENES = "night,fence,table,bars,hair,post,meadow,tori,cutouts,lanterns"


def main():
    parser = argparse.ArgumentParser(prog="./dev bench soft_depth")
    parser.add_argument("--scenes", default=SCENES)
    parser.add_argument("--width", type=int, default=480)
    parser.add_argument("--samples", type=int, default=256)
    given = parser.parse_args()
    CACHE.mkdir(parents=True, exist_ok=True)
    out, body = CACHE / "soft_depth_out.exr", []
    for name in given.scenes.split(","):
        exact, filtered, soft = (built_in(name, given.width, given.samples, extra=extra) for extra in ([], FILTERED, SOFT))
        row = [name]
        for scene, flags in ((exact, []), (filtered, KEEP), (filtered, AUTO), (soft, KEEP), (soft, AUTO)):
            took(scene, flags, out, 1)
            row.append(score(exact, out)[0])
        body.append(row)
    print_table(["scene", "exact depth", "antialiased, keep", "antialiased, auto", "soft, keep", "soft, auto"], body)
    print(f"\n{given.width} px wide, truth of {given.samples} lens samples. {machine()}.")


if __name__ == "__main__":
    main()
