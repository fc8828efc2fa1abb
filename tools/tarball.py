#!/usr/bin/env python3
"""Packs program, window, C libraries and OpenFX plug-in with all that they load into one archive for Linux.

Usage: tools/tarball.py FOLDER BUILD    leaves FOLDER/petzval-VERSION-linux-x86_64.tar.xz

It may be unpacked anywhere. It needs what every system has: glibc of Debian 12 or later, libstdc++ and zlib. Libraries
find each other beside themselves; the plug-in's bundle holds its own and may be moved alone.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import wheel  # noqa: E402

ROOT = wheel.ROOT
LEFT_OUT = re.compile(r"^(libz\.so|linux-vdso)")  # of the system: a driver for the display may need a newer one


def output(*command):
    return subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, text=True, check=True).stdout


def loaded_by(binaries):
    """{name: path} of the libraries to pack, found by the dynamic loader."""
    found = {}
    for binary in binaries:
        found.update({name: path for name, path in wheel.needed(binary) if not LEFT_OUT.match(name)})
    return {name: path for name, path in sorted(found.items()) if not name.startswith("libpetzval")}


def pack(libraries, folder, licences):
    """Copies libraries, and the licence of each from the Debian package that it came from."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, path in libraries.items():
        shutil.copy(path.resolve(), folder / name)
        (folder / name).chmod(0o755)
        look_beside(folder / name, "$ORIGIN")
        package = owner(path)
        shutil.copy(wheel.DOCUMENTS / package / "copyright", licences / f"{package}.txt")


def owner(path):
    for candidate in (path, path.resolve()):
        done = subprocess.run(["dpkg-query", "-S", candidate], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        if not done.returncode:
            return done.stdout.split(":")[0]
    # Debian 12 keeps /lib in /usr/lib, and dpkg remembers some paths without /usr.
    return output("dpkg-query", "-S", str(path.resolve()).removeprefix("/usr")).split(":")[0]


def look_beside(binary, where):
    subprocess.run(["patchelf", "--set-rpath", where, binary], check=True)


def install(build, prefix):
    """What the build installs, without what needs other packages to be linked."""
    subprocess.run(["cmake", "--install", build, "--prefix", prefix, "--strip"], stdout=subprocess.DEVNULL, check=True)
    for library in [p for p in prefix.glob("lib/**/*") if p.suffix in (".a", ".so") or ".so." in p.name]:
        target = prefix / "lib" / library.name
        if library.suffix == ".a" or library.parent.name == "gegl-0.4":
            library.unlink()
        elif library != target:
            library.rename(target)
    for rest in ("cmake", "pkgconfig", "gegl-0.4"):
        for folder in prefix.glob(f"lib/**/{rest}"):
            shutil.rmtree(folder)
    headers = prefix / "include/petzval"
    for header in headers.rglob("*"):
        if header.is_file() and not header.name.endswith("_c.h"):
            header.unlink()
    shutil.move(prefix / "lib/OFX", prefix / "OFX")
    for empty in sorted(prefix.glob("**/"), reverse=True):
        if not any(empty.iterdir()):
            empty.rmdir()


def fill(prefix, build):
    install(build, prefix)
    licences = prefix / "share/doc/petzval/licenses"
    licences.mkdir(parents=True)
    shutil.copy(ROOT / "LICENSE", prefix / "share/doc/petzval/LICENSE")
    programs = sorted((prefix / "bin").iterdir())
    own = [p for p in (prefix / "lib").iterdir() if not p.is_symlink()]
    pack(loaded_by([*programs, *own]), prefix / "lib", licences)
    for program in programs:
        look_beside(program, "$ORIGIN/../lib")
    for library in own:
        look_beside(library, "$ORIGIN")
    plugin = prefix / "OFX/Plugins/petzval.ofx.bundle/Contents/Linux-x86-64/petzval.ofx"
    subprocess.run(["strip", plugin], check=True)
    pack(loaded_by([plugin]), plugin.parent / "lib", licences)
    look_beside(plugin, "$ORIGIN/lib")


def main(folder, build):
    name = f"petzval-{wheel.version()}-linux-x86_64"
    archive = pathlib.Path(folder).resolve() / f"{name}.tar.xz"
    archive.parent.mkdir(parents=True, exist_ok=True)
    stamp = output("dpkg-parsechangelog", "-l", ROOT / "debian/changelog", "-S", "Timestamp").strip()
    with tempfile.TemporaryDirectory(prefix="petzval-tarball-") as work:
        fill(pathlib.Path(work) / name, build)
        subprocess.run(["tar", "--create", "--xz", "--file", archive, "--sort=name", f"--mtime=@{stamp}", "--owner=0",
                        "--group=0", "--numeric-owner", "--mode=u+rw,go+r,go-w", "-C", work, name], check=True)
    print(output("tar", "--list", "--file", archive), end="")
    print(f"{archive}, {archive.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
