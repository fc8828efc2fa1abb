#!/usr/bin/env python3
"""Packs the Python package and its libraries into one wheel for every Python 3 on x86-64 Linux.

Usage: tools/wheel.py FOLDER LIBPETZVAL [LIBRARY…]    writes FOLDER/petzval-VERSION-py3-none-linux_x86_64.whl

Libraries that LIBPETZVAL needs and that no Linux system surely has are packed beside it, found by its own search
path; LIBRARY… are further ones. The bytes of the wheel depend on its content alone. Needs no package of Python.
"""
import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "python/petzval"
TAG = "py3-none-linux_x86_64"
EVERYWHERE = re.compile(r"^(libc|libm|libdl|libpthread|librt|libgcc_s|libstdc\+\+|ld-linux-x86-64)\.so")
NOT_PACKED = re.compile(r"^libtbb")  # two copies in a host's process would share nothing: the portable build has none
DOCUMENTS = pathlib.Path("/usr/share/doc")  # where Debian keeps the licence of each library


class Refused(Exception):
    """A library that cannot be packed."""


def version():
    return re.search(r'PETZVAL_VERSION "([\d.]+)"', (ROOT / "include/petzval/version.h").read_text())[1]


def needed(library):
    """Names and paths of the libraries that a library loads and that may be missing elsewhere."""
    listing = subprocess.run(["ldd", library], stdout=subprocess.PIPE, text=True, check=True).stdout
    for name, path in re.findall(r"^\s*(\S+) => (\S+)", listing, re.M):
        if not EVERYWHERE.match(name):
            yield name, pathlib.Path(path)


def soname(library):
    listing = subprocess.run(["readelf", "-d", library], stdout=subprocess.PIPE, text=True, check=True).stdout
    found = re.search(r"SONAME.*\[(.*)\]", listing)
    return found[1] if found else pathlib.Path(library).name


def libraries(paths):
    """{name in the package: path} of all libraries to pack."""
    packed = {}
    for path in map(pathlib.Path, paths):
        packed[soname(path)] = path
        for name, found in needed(path):
            if NOT_PACKED.match(name):
                raise Refused(f"{path} needs {name}; build it with the preset portable")
            packed.setdefault(name, found)
    return packed


def content(paths):
    """{path in the wheel: bytes}, without the lists."""
    files = {f"petzval/{p.name}": p.read_bytes() for p in sorted(PACKAGE.iterdir())
             if p.suffix in (".py", ".pyi", ".typed")}
    for name, path in libraries(paths).items():
        files[f"petzval/{name}"] = path.read_bytes()
    info = f"petzval-{version()}.dist-info"
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: petzval\nRoot-Is-Purelib: false\nTag: {TAG}\n".encode()
    files[f"{info}/licenses/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    for name in libraries(paths):
        licence = DOCUMENTS / re.sub(r"\.so\.(\d+).*", r"\1", name) / "copyright"
        if licence.exists():
            files[f"{info}/licenses/{licence.parent.name}.txt"] = licence.read_bytes()
    return files, info


def metadata():
    return (f"Metadata-Version: 2.1\nName: petzval\nVersion: {version()}\n"
            "Summary: The depth of field of a real lens, for rendered pictures\n"
            "Requires-Python: >=3.7\nDescription-Content-Type: text/markdown\n\n"
            + (ROOT / "python/README.md").read_text())


def record(files, info):
    """The list of files with their hashes, as the wheel format asks for it."""
    rows = []
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{name},sha256={digest},{len(data)}")
    return "\n".join([*rows, f"{info}/RECORD,,"]) + "\n"


def write(folder, paths):
    files, info = content(paths)
    files[f"{info}/RECORD"] = record(files, info).encode()
    wheel = pathlib.Path(folder) / f"petzval-{version()}-{TAG}.whl"
    wheel.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o755 if ".so" in name else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return wheel


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        print(write(sys.argv[1], sys.argv[2:]))
    except Refused as refused:
        sys.exit(f"wheel: {refused}")
