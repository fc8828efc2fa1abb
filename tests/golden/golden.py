"""Small pictures, stored: nothing changes what the program makes without somebody meaning it.

Usage: golden.py run|accept PROGRAM. `run` makes every picture again in build/golden and compares it with the stored
one; `accept` stores the new ones, and the commit says why they changed. The tolerance leaves room for other
processors, which round otherwise; a change of method is far above it.
"""
import json
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
NEW = HERE.parents[1] / "build/golden"
MIN_PSNR_DB = 60  # both measures: linear, clipped to 1, and logarithmic up to 64
SIZE = ["--width", "96", "--height", "54"]
SCENES = ["night", "fence", "table", "slant", "bars"]
# name of the picture -> the scene it is made of and the flags of `petzval defocus`
DEFOCUSED = {
    **{f"{scene}_scatter": (scene, ["--engine", "scatter"]) for scene in SCENES},
    "table_reference": ("table", ["--engine", "reference", "--pupil-points", "256"]),
    "night_five_blades": ("night", ["--blades", "5", "--blade-rotation", "18"]),
    "night_cats_eye": ("night", ["--cats-eye", "0.7"]),
}


def petzval(program, *words):
    result = subprocess.run([program, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if result.returncode:
        sys.exit(f"golden: petzval {' '.join(map(str, words))}\n{result.stderr}")
    return result.stdout


def make_all(program):
    """Every picture, new, in build/golden; their names."""
    shutil.rmtree(NEW, ignore_errors=True)
    NEW.mkdir(parents=True)
    for scene in SCENES:
        petzval(program, "scene", "make", scene, "-o", NEW / f"{scene}.exr", *SIZE, "-q")
    for name, (scene, flags) in DEFOCUSED.items():
        petzval(program, "defocus", NEW / f"{scene}.exr", "-o", NEW / f"{name}.exr", *flags, "-q")
    return [*SCENES, *DEFOCUSED]


def difference(program, name):
    """What is wrong with a picture, or nothing."""
    if not (HERE / f"{name}.exr").exists():
        return "no picture is stored; ./dev golden accept stores it"
    found = json.loads(petzval(program, "compare", HERE / f"{name}.exr", NEW / f"{name}.exr", "--json", "-"))
    worst_db = min(found["psnr_lin"], found["psnr_log"])
    if worst_db >= MIN_PSNR_DB:
        return None
    return (f"{worst_db:.1f} dB, at least {MIN_PSNR_DB} are asked; largest error {found['max_error']} "
            f"at {found['max_error_x']},{found['max_error_y']}; new picture: {NEW / name}.exr")


def main(verb, program):
    names = make_all(program)
    if verb == "accept":
        for name in names:
            shutil.copy(NEW / f"{name}.exr", HERE / f"{name}.exr")
        print(f"golden: {len(names)} pictures stored in {HERE}; say why in the commit")
        return
    wrong = {name: what for name in names if (what := difference(program, name))}
    print("\n".join(f"{name}: {what}" for name, what in wrong.items()) or f"golden: {len(names)} pictures as stored")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main(*sys.argv[1:])
