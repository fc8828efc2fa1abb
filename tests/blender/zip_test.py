"""Both zips: the rules of Blender's extension platform, and the same bytes from the same sources.

Usage: zip_test.py LIBPETZVAL.SO

Rules: docs.blender.org/manual, "Extensions", and developer.blender.org, "Add-on Guidelines", read in November 2026.
"""
import ast
import pathlib
import re
import sys
import tempfile
import tomllib
import unittest
import zipfile

import zips

PERMISSIONS = {"files", "network", "clipboard", "camera", "microphone"}
TAGS = {"3D View", "Add Curve", "Add Mesh", "Animation", "Bake", "Camera", "Compositing", "Development", "Game Engine",
        "Geometry Nodes", "Grease Pencil", "Import-Export", "Lighting", "Material", "Modeling", "Mesh", "Node", "Object",
        "Paint", "Pipeline", "Physics", "Render", "Rigging", "Scene", "Sculpt", "Sequencer", "System", "Text Editor",
        "Tracking", "User Interface", "UV"}
OTHER_PROGRAMS = {"subprocess", "multiprocessing", "socket", "urllib", "requests", "http", "ftplib", "pip", "ensurepip"}
library = ""


def broken_rules(path):
    """Sentences about each rule that an extension breaks."""
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
        sources = {name: archive.read(name).decode() for name in names if name.endswith(".py")}
    found = [*_of_manifest(manifest), *_of_files(names, manifest)]
    for name, text in sources.items():
        found += [f"{name}: {rule}" for rule in _of_source(text)]
    return found


def _of_manifest(manifest):
    for key in ("schema_version", "id", "version", "name", "tagline", "maintainer", "type", "blender_version_min",
                "license"):
        if not manifest.get(key):
            yield f"manifest: {key} is missing"
    if not re.fullmatch(r"\d+\.\d+\.\d+", manifest.get("version", "")):
        yield "manifest: the version is not major.minor.patch"
    if "blender" in (manifest.get("name", "") + manifest.get("id", "")).lower():
        yield "manifest: the name contains Blender"
    tagline = manifest.get("tagline", "")
    if len(tagline) > 64 or not tagline[-1:].isalnum():
        yield "manifest: the tagline is over 64 characters or ends in punctuation"
    if manifest.get("license") != ["SPDX:GPL-3.0-or-later"]:
        yield "manifest: the licence is not SPDX:GPL-3.0-or-later"
    if not set(manifest.get("tags", ())) <= TAGS:
        yield "manifest: a tag is unknown"
    for name, reason in manifest.get("permissions", {}).items():
        if name not in PERMISSIONS or not 0 < len(reason) <= 64 or reason.endswith("."):
            yield f"manifest: permission {name} needs a known name and a reason of up to 64 characters"


def _of_files(names, manifest):
    listed = {wheel.removeprefix("./") for wheel in manifest.get("wheels", ())}
    if listed != {name for name in names if name.endswith(".whl")}:
        yield "files: the wheels are not those of the manifest"
    for wheel in listed:
        if not re.fullmatch(r"wheels/[\w.]+-[\w.]+(-\w+){3}\.whl", wheel):
            yield f"files: {wheel} is not a name of a wheel"
        if wheel.endswith("linux_x86_64.whl") and manifest.get("platforms") != ["linux-x64"]:
            yield "files: the platforms are not those of the wheels"
    for name in ("__init__.py", "LICENSE"):
        if name not in names:
            yield f"files: {name} is missing"
    for name in names:
        if re.search(r"__pycache__|\.pyc$|(^|/)\.|\.(so|exe|dll|zip|blend1)$", name):
            yield f"files: {name} does not belong in an extension"


def _of_source(text):
    if not text.startswith("# SPDX-License-Identifier: GPL-3.0-or-later\n"):
        yield "the licence is not named"
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            modules = [alias.name.split(".")[0] for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            modules = [(node.module or "").split(".")[0]] if not node.level else []
        elif isinstance(node, ast.Attribute) and ast.unparse(node) in ("sys.path", "os.system", "os.popen", "os.execv"):
            yield f"uses {ast.unparse(node)}"
            continue
        elif isinstance(node, ast.Name) and node.id in ("__file__", "eval", "exec"):
            yield f"uses {node.id}"
            continue
        else:
            continue
        yield from (f"imports {name}" for name in modules if name in OTHER_PROGRAMS | {"petzval_lens"})


class Zips(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.extension, cls.addon = zips.made(cls.folder.name, library)

    def test_the_extension_keeps_the_rules_of_the_platform(self):
        self.assertEqual(broken_rules(self.extension), [])

    def test_broken_rules_are_found(self):
        planted = {
            "imports subprocess": ("job.py", b"import os", b"import subprocess"),
            "uses sys.path": ("job.py", b"import os", b"import sys\nsys.path.append('x')"),
            "uses __file__": ("job.py", b"import os", b"import os\nhere = __file__"),
            "imports petzval_lens": ("job.py", b"from . import camera", b"from petzval_lens import camera"),
            "licence is not named": ("job.py", b"# SPDX", b"# SPD"),
            "name contains Blender": ("blender_manifest.toml", b'name = "petzval', b'name = "Blender petzval'),
            "ends in punctuation": ("blender_manifest.toml", b'real lens"', b'real lens."'),
            "maintainer is missing": ("blender_manifest.toml", b"maintainer", b"keeper"),
            "wheels are not those": ("blender_manifest.toml", b"wheels = [", b"wheels = ['./wheels/a-1-py3-none-any.whl',"),
            "platforms are not those": ("blender_manifest.toml", b"linux-x64", b"windows-x64"),
            "permission phone": ("blender_manifest.toml", b"files = ", b"phone = "),
        }
        for rule, (name, old, new) in planted.items():
            path = self.changed(name, lambda data, old=old, new=new: data.replace(old, new))
            self.assertTrue(any(rule in found for found in broken_rules(path)), rule)

    def changed(self, name, change):
        """The extension with one file changed."""
        path = pathlib.Path(self.folder.name) / "planted.zip"
        with zipfile.ZipFile(self.extension) as archive, zipfile.ZipFile(path, "w") as made:
            for entry in archive.namelist():
                data = archive.read(entry)
                if entry == name:
                    self.assertNotEqual(change(data), data)
                    data = change(data)
                made.writestr(entry, data)
        return path

    def test_the_self_hosted_zip_is_one_package_with_bl_info_and_the_library(self):
        with zipfile.ZipFile(self.addon) as archive:
            names = archive.namelist()
            self.assertIn(b"bl_info", archive.read("petzval_lens/__init__.py"))
        self.assertEqual({name.split("/")[0] for name in names}, {"petzval_lens"})
        for needed in ("LICENSE", "view_program.py", "petzval/__init__.py", "petzval/libpetzval.so.0",
                       "petzval/licenses/LICENSE"):
            self.assertIn(f"petzval_lens/{needed}", names)
        self.assertFalse([name for name in names if "toml" in name])

    def test_versions_agree(self):
        with zipfile.ZipFile(self.extension) as archive:
            version = tomllib.loads(archive.read("blender_manifest.toml").decode())["version"]
            said = re.search(r'"version": \((\d+), (\d+), (\d+)\)', archive.read("__init__.py").decode())
        self.assertEqual(version, ".".join(said.groups()))
        self.assertEqual(version, zips.packer.version())

    def test_their_bytes_depend_on_their_content_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            for first, second in zip((self.extension, self.addon), zips.made(folder, library)):
                self.assertEqual(first.read_bytes(), second.read_bytes())


if __name__ == "__main__":
    library = sys.argv.pop(1)
    unittest.main(verbosity=2)
