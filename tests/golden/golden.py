"""Small pictures, stored: what the program makes stays close to the truth, and does not change unless meant.

Usage: golden.py truth|run|accept PROGRAM. Every picture is made again in build/golden, from the built-in scenes.
  truth   compares those of the ideal lens with the stored truth of their scene, what a lens sampled by a ray tracer
          recorded: each may be better than it was, or worse by at most TRUTH_TOLERANCE_DB (ctest runs this)
  run     that, and compares those of scatter and of other lenses with themselves as they were stored
  accept  stores truths, pictures and how close they are; the commit says why they changed
"""
import json
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
NEW = HERE.parents[1] / "build/golden"
TRUTH_TOLERANCE_DB = 0.5
# Against itself, linear and logarithmic: room for processors that round otherwise; a change of method is far above.
SAME_DB = 60
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
WITH_TRUTH, STORED = SCATTER | ALL_KNOWN, SCATTER | LENSES


def petzval(program, *words):
    result = subprocess.run([program, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if result.returncode:
        sys.exit(f"golden: petzval {' '.join(map(str, words))}\n{result.stderr}")
    return result.stdout


def scene_of(name):
    return name.split("_")[0]


def make(program, pictures, with_truth):
    """The pictures, new, in build/golden."""
    shutil.rmtree(NEW, ignore_errors=True)
    NEW.mkdir(parents=True)
    for scene in SCENES:
        truth = ["--truth", NEW / f"{scene}_truth.exr", "--samples", "2048"] if with_truth else []
        petzval(program, "scene", "make", scene, "-o", NEW / f"{scene}.exr", *truth, *SIZE, "-q")
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


def changed(program):
    """The same for pictures that are not as they were stored."""
    wrong = {}
    for name in STORED:
        found = compared(program, HERE / f"{name}.exr", name)
        worst_db = min(found["psnr_lin"], found["psnr_log"])
        if worst_db < SAME_DB:
            wrong[name] = (f"{worst_db:.1f} dB from the stored picture, at least {SAME_DB} are asked; largest error "
                           f"{found['max_error']} at {found['max_error_at']}; new picture: {NEW / name}.exr")
    return wrong


def accept(program):
    closeness = {name: compared(program, NEW / f"{scene_of(name)}_truth.exr", name)["psnr_lin"] for name in WITH_TRUTH}
    (HERE / "golden.json").write_text(json.dumps({n: round(db, 2) for n, db in closeness.items()}, indent=4) + "\n")
    for name in [*STORED, *(f"{scene}_truth" for scene in SCENES)]:
        shutil.copy(NEW / f"{name}.exr", HERE / f"{name}.exr")
    print(f"golden: {len(STORED)} pictures and {len(SCENES)} truths stored in {HERE}; say why in the commit")


def main(verb, program):
    pictures = WITH_TRUTH if verb == "truth" else WITH_TRUTH | STORED
    make(program, pictures, with_truth=verb == "accept")
    if verb == "accept":
        return accept(program)
    wrong = list(farther_from_truth(program).items())
    if verb == "run":
        wrong += changed(program).items()
    print("\n".join(f"{name}: {what}" for name, what in wrong) or f"golden: {len(pictures)} pictures as they should be")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main(*sys.argv[1:])
