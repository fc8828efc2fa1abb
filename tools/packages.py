#!/usr/bin/env python3
"""Builds the Debian packages from the files that git knows of.

Usage: tools/packages.py FOLDER            leaves the packages in FOLDER, with what lintian says of them
       tools/packages.py FOLDER --again    builds the same sources in another folder, without ccache, compares the bits

Build dependencies must be installed. Fails if lintian finds an error.
"""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Failed(Exception):
    """A build, or a package that breaks a rule."""


def version():
    """The version of the changelog, which must be that of the headers."""
    packaged = re.match(r"petzval \(([\d.]+)\)", (ROOT / "debian/changelog").read_text())[1]
    built = re.search(r'PETZVAL_VERSION "([\d.]+)"', (ROOT / "include/petzval/version.h").read_text())[1]
    if packaged != built:
        raise Failed(f"debian/changelog has version {packaged} and include/petzval/version.h {built}")
    return packaged


def tracked_files(to):
    """Copies the tracked files as they are now, with modes that do not depend on the umask."""
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, stdout=subprocess.PIPE, check=True).stdout
    for name in tracked.decode().rstrip("\0").split("\0"):
        source, target = ROOT / name, to / name
        if source.is_file():  # one that is removed but not yet committed is left out
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
            target.chmod(0o755 if os.access(source, os.X_OK) else 0o644)


def build(folder, copy_sources, **environment):
    """Builds in FOLDER/petzval-VERSION; the packages made, by name."""
    source = folder / f"petzval-{version()}"
    shutil.rmtree(folder, ignore_errors=True)
    copy_sources(source)
    # The build asks git for its revision; the repository around the folder is not that of the copy.
    settings = {**os.environ, "GIT_CEILING_DIRECTORIES": str(folder), **environment}
    log = folder / "build.log"
    with log.open("w") as file:
        status = subprocess.run(["dpkg-buildpackage", "--build=binary", "--no-sign"], cwd=source, env=settings, stdout=file,
                                stderr=subprocess.STDOUT).returncode
    if status:
        raise Failed("\n".join([*log.read_text().splitlines()[-25:], f"dpkg-buildpackage failed; see {log}"]))
    return {deb.name: deb for deb in sorted(folder.glob("*.deb"))}


def lint(debs):
    done = subprocess.run(["lintian", "--fail-on", "error", "--allow-root", *debs], stdout=subprocess.PIPE, text=True)
    print(done.stdout, end="")
    if done.returncode:
        raise Failed("lintian finds errors")


def show(debs):
    """Name, size and files of each package."""
    for deb in debs:
        print(f"\n{deb.name}, {deb.stat().st_size / 1e6:.1f} MB")
        listing = subprocess.run(["dpkg-deb", "--contents", deb], stdout=subprocess.PIPE, text=True, check=True).stdout
        for line in listing.splitlines():
            if not line.startswith("d"):
                print("  " + line.split(None, 5)[5][2:])


def compare(first, second):
    """Raises Failed if two builds differ, naming the packages."""
    digests = [{n: hashlib.sha256(p.read_bytes()).hexdigest() for n, p in debs.items()} for debs in (first, second)]
    different = sorted(n for n in digests[0].keys() | digests[1].keys() if digests[0].get(n) != digests[1].get(n))
    if different:
        raise Failed(f"two builds differ: {', '.join(different)}")
    print("\n".join(f"{digest}  {name}" for name, digest in digests[0].items()))
    print(f"two builds of {len(first)} packages have the same bits")


def packages(folder):
    """The packages of an earlier build, by name."""
    debs = {deb.name: deb for deb in sorted(folder.glob("*.deb"))}
    return debs or sys.exit(f"packages: {folder} holds none; ./dev packages builds them")


def main(folder, again):
    sources = folder / "sources"
    if again:
        made = build(folder / "work/elsewhere", lambda to: shutil.copytree(sources, to), CCACHE_DISABLE="1",
                     TZ="Asia/Tokyo", LC_ALL="C.UTF-8")
        compare(packages(folder), made)
        return
    shutil.rmtree(sources, ignore_errors=True)
    tracked_files(sources)
    # debhelper hides the home folder, where ccache keeps its objects.
    cache = os.environ.get("CCACHE_DIR", str(pathlib.Path.home() / ".cache/ccache"))
    made = build(folder / "work", lambda to: shutil.copytree(sources, to), CCACHE_DIR=cache)
    for old in folder.glob("*.deb"):
        old.unlink()
    debs = [pathlib.Path(shutil.copy2(deb, folder)) for deb in made.values()]
    show(debs)
    lint(debs)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--again"]):
        sys.exit(__doc__)
    try:
        main(pathlib.Path(sys.argv[1]).resolve(), len(sys.argv) == 3)
    except Failed as failed:
        sys.exit(f"packages: {failed}")
