"""Small pictures, stored: what the program makes stays close to the truth, and does not change unless meant.

Usage: golden.py run|accept PROGRAM. Every picture is made again in build/golden.
The sharp pictures that they are made of are stored too: ray tracing rounds otherwise on other processors.
  run     compares those of the ideal lens with the stored truth of their scene, what a lens sampled by a ray tracer
          recorded: each may be better than it was, or worse by at most TRUTH_TOLERANCE_DB; and those of every engine
          and of other lenses with themselves as they were stored: the same bits, but for SAME_STEPS (ctest runs this)
  accept  stores truths, pictures and how close they are; the commit says why they changed
"""
import json
import pathlib
import shutil
import struct
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cli"))
from pictures import read_exr  # noqa: E402
NEW = HERE.parents[1] / "build/golden"
TRUTH_TOLERANCE_DB = 0.5
# Against itself, in steps of a half float: a processor with other instructions rounds otherwise in the last bits of
# 32, which now and then carries a stored value across to its neighbour. Measured from AVX-512, with which the
# pictures were stored: AVX2 none of 228,096 values, SSE4 and a build without SIMD 3 of them, each by one step.
SAME_STEPS = 1
SAME_SHARE = 1e-3  # of the values of one picture may lie that one step beside
SIZE = ["--width", "96", "--height", "54"]
OVERSCAN_PX = "8"
SCENES = ["night", "fence", "table", "slant", "bars"]
KNOWN = ["--behind", "{scene}_behind.exr"]  # of the picture with overscan
# name of the picture -> the picture it is made of and the flags of `petzval defocus`
SCATTER = {f"{scene}_scatter": (scene, []) for scene in SCENES}
ALL_KNOWN = {
    **{f"{scene}_scatter_known": (f"{scene}_wide", KNOWN) for scene in ("night", "fence")},
    **{f"{scene}_reference_known": (f"{scene}_wide", ["--engine", "reference", "--pupil-points", "1024", *KNOWN])
       for scene in SCENES},
}
# The truth has no such lenses.
LENSES = {
    "night_five_blades": ("night", ["--blades", "5", "--blade-rotation", "18"]),
    "night_cats_eye": ("night", ["--cats-eye", "0.7"]),
    "night_doublet": ("night", ["--lens", "doublet"]),
}
ENGINES = {f"night_{engine}": ("night", ["--engine", engine]) for engine in ("gather", "gaussian", "sprites")}
WITH_TRUTH, STORED = SCATTER | ALL_KNOWN, SCATTER | LENSES | ENGINES


def petzval(program, *words):
    result = subprocess.run([program, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if result.returncode:
        sys.exit(f"golden: petzval {' '.join(map(str, words))}\n{result.stderr}")
    return result.stdout


def scene_of(name):
    return name.split("_")[0]


def make(program, pictures, anew):
    """The pictures, new, in build/golden. anew: also the sharp pictures and the truths."""
    shutil.rmtree(NEW, ignore_errors=True)
    NEW.mkdir(parents=True)
    for scene in SCENES:
        if anew:
            petzval(program, "scene", "make", scene, "-o", NEW / f"{scene}.exr", "--truth", NEW / f"{scene}_truth.exr",
                    "--samples", "2048", *SIZE, "-q")
        else:
            shutil.copy(HERE / f"{scene}.exr", NEW)
        petzval(program, "scene", "make", scene, "-o", NEW / f"{scene}_wide.exr", "--overscan", OVERSCAN_PX,
                "--layers", NEW / f"{scene}_behind.exr", *SIZE, "-q")
    for name, (given, flags) in pictures.items():
        flags = [str(NEW / word.format(scene=scene_of(name))) if "{" in word else word for word in flags]
        petzval(program, "defocus", NEW / f"{given}.exr", "-o", NEW / f"{name}.exr", *flags, "-q")


def compared(program, reference, name):
    return json.loads(petzval(program, "compare", reference, NEW / f"{name}.exr", "--json", "-"))


def farther_from_truth(program):
    """What is wrong, by the name of the picture."""
    stored = json.loads((HERE / "golden.json").read_text())
    wrong = {}
    for name in WITH_TRUTH:
        found_db = compared(program, HERE / f"{scene_of(name)}_truth.exr", name)["psnr_lin"]
        if name not in stored:
            wrong[name] = "golden.json does not know it; ./dev golden accept stores it"
        elif not found_db >= stored[name] - TRUTH_TOLERANCE_DB:
            wrong[name] = f"{found_db:.2f} dB from the truth, where it was {stored[name]:.2f} dB"
    return wrong


def half_numbers(rows):
    """The place of every value among all half floats, so that neighbours are 1 apart."""
    values = [value for row in rows for value in row]
    codes = struct.unpack(f"<{len(values)}h", struct.pack(f"<{len(values)}e", *values))
    return [code if code >= 0 else -(code & 0x7fff) for code in codes]


def steps_between(stored, new):
    """Of each value of two pictures: how many half floats lie between what it was and what it is."""
    before, after = read_exr(stored)[0], read_exr(new)[0]
    return [abs(a - b) for channel in "RGBA"
            for a, b in zip(half_numbers(before[channel]), half_numbers(after[channel]))]


def changed(program):
    """The same for pictures that are not as they were stored."""
    wrong = {}
    for name in STORED:
        if not (HERE / f"{name}.exr").exists():
            wrong[name] = "no picture of this name is stored; ./dev golden accept stores it"
            continue
        steps = steps_between(HERE / f"{name}.exr", NEW / f"{name}.exr")
        others = sum(step > 0 for step in steps)
        if max(steps) > SAME_STEPS or others > SAME_SHARE * len(steps):
            found = compared(program, HERE / f"{name}.exr", name)
            wrong[name] = (f"{others} of {len(steps)} values are not as stored, up to {max(steps)} half floats beside; "
                           f"{found['psnr_lin']:.1f} dB; largest error {found['max_error']:.3g} at "
                           f"{found['max_error_at']}; new picture: {NEW / name}.exr")
    return wrong


def accept(program):
    closeness = {name: compared(program, NEW / f"{scene_of(name)}_truth.exr", name)["psnr_lin"] for name in WITH_TRUTH}
    (HERE / "golden.json").write_text(json.dumps({n: round(db, 2) for n, db in closeness.items()}, indent=4) + "\n")
    for name in [*STORED, *SCENES, *(f"{scene}_truth" for scene in SCENES)]:
        shutil.copy(NEW / f"{name}.exr", HERE / f"{name}.exr")
    print(f"golden: {len(STORED)} pictures and {len(SCENES)} scenes with truths stored in {HERE}; say why in the commit")


def main(verb, program):
    pictures = WITH_TRUTH | STORED
    make(program, pictures, anew=verb == "accept")
    if verb == "accept":
        return accept(program)
    wrong = [*farther_from_truth(program).items(), *changed(program).items()]
    print("\n".join(f"{name}: {what}" for name, what in wrong) or f"golden: {len(pictures)} pictures as they should be")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main(*sys.argv[1:])
