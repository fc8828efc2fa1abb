#!/usr/bin/env python3
"""Installs packages and archive in a bare Debian 12 and uses them there.

Usage: tools/packages_test.py FOLDER [--without-blender]    FOLDER: of ./dev packages, with the archive of ./dev tarball

Needs root and Debian's mirror. The archive runs in a Debian of required packages alone; then every package is
installed with its dependencies: program, man page, desktop file, MIME type, C, Python, OpenFX, GEGL, Blender.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FRAME = """
set -e
cd /tmp
{bin}petzval scene make night -o sharp.exr --width 160 --height 90 --pinhole-samples 8 --overwrite
{bin}petzval defocus sharp.exr -o {name}.exr --lens doublet --overwrite
{bin}petzval develop {name}.exr -o {name}.png --overwrite
if {bin}petzval compare sharp.exr {name}.exr --json - | grep '"max_error": 0.0,'; then exit 1; fi
{bin}petzval view --help > /dev/null
{bin}ofx-check {plugin} --param focalLength=200 > ofx.txt || {{ grep BROKEN ofx.txt; exit 1; }}
grep -c '^ok' ofx.txt
"""
INSTALLED = """
set -e
cd /tmp
zcat /usr/share/man/man1/petzval.1.gz | grep -q 'Nm petzval'
desktop-file-validate /usr/share/applications/petzval.desktop
grep -q 'x-petzval-look' /usr/share/mime/packages/petzval.xml
update-mime-database /usr/share/mime
petzval defocus sharp.exr -o again.exr --save-look a-look --overwrite
test "$(gio info -a standard::content-type a-look | sed -n 's/.*content-type: //p')" = application/x-petzval-look+json
bash -ic '. /usr/share/bash-completion/completions/petzval; complete -p petzval' 2> /dev/null
cc -std=c99 shot_program.c -o shot_program $(pkg-config --cflags --libs petzval-files-c)
./shot_program sharp.exr /tmp/lens.json 1.7 from-c.exr
petzval defocus sharp.exr -o line.exr --lens /tmp/lens.json --focal-length 85 --sensor-width 36 --fstop 2 --focus 1.7m
petzval compare line.exr from-c.exr --json - | grep '"max_error": 0.0,'
python3 -c '
import numpy, petzval
shot = petzval.read_shot("sharp.exr")
camera = petzval.Camera(85, 36, 2, 1.7)
shot.write_like("from-python.exr", petzval.defocus(numpy.array(shot.colour), depth_m=numpy.array(shot.depth_m), camera=camera,
                                                   look=petzval.Look(lens="/tmp/lens.json")).image)
'
petzval compare line.exr from-python.exr --json - | grep '"max_error": 0.0,'
"""
GEGL = """
set -e
cd /tmp
python3 -c '
import numpy, petzval, pictures
shot = petzval.read_shot("sharp.exr")
colour, depth = numpy.asarray(shot.colour), numpy.asarray(shot.depth_m).tolist()
light = {c: colour[..., i].tolist() for i, c in enumerate("RGBA")}
pictures.write_exr("floats.exr", {**light, "Z": depth})
pictures.write_exr("light.exr", light)
pictures.write_exr("depth.exr", {"Y": depth})
'
petzval defocus floats.exr -o floats-line.exr --lens /tmp/lens.json --focal-length 85 --sensor-width 36 --fstop 2 --focus 1.7m
gegl light.exr -o gegl.exr -- petzval:defocus focal-length=85 sensor-width=36 f-number=2 focus-distance=1.7 lens=/tmp/lens.json \\
    aux=[ gegl:load path=depth.exr ]
petzval compare floats-line.exr gegl.exr --json - | grep '"max_error": 0.0,'
"""
BLENDER = """
set -e
cd /tmp
blender -b --factory-startup --python-exit-code 3 --python-expr '
import subprocess, bpy
bpy.ops.preferences.addon_enable(module="petzval_lens")
scene = bpy.context.scene
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 4, False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 160, 90, 100
scene.camera.data.dof.focus_distance, scene.camera.data.dof.aperture_fstop = 5, 0.2
scene.render.filepath, scene.render.image_settings.file_format = "/tmp/blender", "OPEN_EXR"
scene.render.image_settings.color_depth, scene.petzval_lens.keep_passes = "32", True
scene.petzval_lens.lens, scene.camera.data.dof.aperture_blades = "doublet", 6
bpy.ops.petzval_lens.still(write_still=True)
from petzval_lens import job, view_program
look = job.look_of(scene.petzval_lens.wish(scene), job.Kept.numbers)
open("/tmp/blender-look.json", "w").write(look.to_json())
words = view_program.command("petzval", job.Kept.front.path, bpy.context.view_layer.name, job.Kept.numbers,
                             "/tmp/blender-look.json")
words[1] = "defocus"
subprocess.run([*words, "-o", "/tmp/blender-line.exr", "--overwrite"], check=True)
'
petzval compare blender-line.exr blender.exr --json - | grep '"max_error": 0.0,'
petzval develop blender.exr -o blender.png --overwrite
blender -b --factory-startup --python-exit-code 3 --python blender/in_blender_test.py -- packaged packaged > in-blender.log 2>&1 \
    || { tail -n 40 in-blender.log; exit 1; }
"""


class Debian:
    """A folder with a Debian 12; everything below it goes away at the end."""

    def __init__(self, folder):
        self.root = folder
        subprocess.run(["mmdebstrap", "--quiet", "--variant=minbase", "--mode=root", "bookworm", folder], check=True)

    def run(self, script):
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8",
                       "DEBIAN_FRONTEND": "noninteractive", "PETZVAL_KERNEL_CACHE": "off"}
        # The dynamic loader and Blender ask /proc; the mount ends with the command.
        inside = 'mount -t proc proc "$1/proc" && exec chroot "$1" sh -c "$2"'
        subprocess.run(["unshare", "--mount", "sh", "-c", inside, "sh", self.root, script], env=environment, check=True)

    def install(self, *packages):
        self.run(f"apt-get -qq update && apt-get -qq install -y --no-install-recommends {' '.join(packages)} > /tmp/apt.log 2>&1"
                 " || { tail -n 20 /tmp/apt.log; exit 1; }")


def archive_runs(system, archive):
    subprocess.run(["tar", "-xf", archive, "-C", f"{system.root}/opt"], check=True)
    name = archive.name.removesuffix(".tar.xz")
    shutil.move(f"{system.root}/opt/{name}", f"{system.root}/opt/elsewhere")
    system.run(FRAME.format(bin="/opt/elsewhere/bin/", plugin="/opt/elsewhere/OFX/Plugins/petzval.ofx.bundle", name="archive"))
    shutil.rmtree(f"{system.root}/opt/elsewhere")
    print(f"{archive.name}: runs in a bare Debian 12", flush=True)


def packages_run(system, debs, with_blender):
    for deb in debs:
        shutil.copy(deb, f"{system.root}/tmp")
    shutil.copy(ROOT / "tests/c/shot_program.c", f"{system.root}/tmp")
    shutil.copy(ROOT / "lenses/petzval-laikin.json", f"{system.root}/tmp/lens.json")
    shutil.copy(ROOT / "tests/cli/pictures.py", f"{system.root}/tmp")
    shutil.copytree(ROOT / "tests/blender", f"{system.root}/tmp/blender")
    blender = [d.name for d in debs if d.name.startswith("blender-petzval")]
    system.install(*(f"/tmp/{d.name}" for d in debs if d.name not in blender), "gcc", "libc6-dev", "pkg-config",
                   "desktop-file-utils", "shared-mime-info", "libglib2.0-bin", "bash-completion", "gegl")
    system.run(FRAME.format(bin="", plugin="/usr/OFX/Plugins/petzval.ofx.bundle", name="package"))
    system.run(INSTALLED)
    system.run(GEGL)
    print("packages: installed and used", flush=True)
    if with_blender:
        system.install(*(f"/tmp/{name}" for name in blender))
        system.run(BLENDER)
        print("blender-petzval: installed and used", flush=True)


def main(folder, with_blender):
    debs, archives = sorted(folder.glob("*.deb")), sorted(folder.glob("*.tar.xz"))
    if not debs or not archives or os.geteuid():
        sys.exit("packages-test: needs root, and the results of ./dev packages and ./dev tarball")
    with tempfile.TemporaryDirectory(prefix="petzval-debian-") as work:
        system = Debian(f"{work}/root")
        archive_runs(system, archives[-1])
        packages_run(system, debs, with_blender)
        for picture in pathlib.Path(f"{system.root}/tmp").glob("*.png"):
            shutil.copy(picture, folder)
    print("packages-test: ok")


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[2:] not in ([], ["--without-blender"]):
        sys.exit(__doc__)
    try:
        main(pathlib.Path(sys.argv[1]).resolve(), len(sys.argv) == 2)
    except subprocess.CalledProcessError as failed:
        sys.exit(f"packages-test: {failed.cmd[0]} failed with {failed.returncode}")
