"""Builds the lens lab into build/web: web/lab, petzval's rooms as WebAssembly, a scene, and a page per lens.

Usage: web.py PETZVAL [--serve | --short]; --serve: then serves it on loopback; --short: the lab alone, without the pages
of the lenses and the demo of three.js.
"""
import functools
import http.server
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
KERNEL, SITE = ROOT / "build/web-kernel", ROOT / "build/web"
# Debian's emscripten finds its own libraries unless EM_CACHE is set, and Debian's node modules only through NODE_PATH.
ENVIRONMENT = {**{k: v for k, v in os.environ.items() if k != "EM_CACHE"}, "NODE_PATH": "/usr/share/nodejs"}


def run(*command):
    done = subprocess.run(command, cwd=ROOT, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(done.stdout + f"web: {command[0]} failed")


def build(petzval, short=False):
    if not (KERNEL / "build.ninja").exists():
        run("emcmake", "cmake", "-S", "web/kernel", "-B", KERNEL, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            *([f"-DCMAKE_{language}_COMPILER_LAUNCHER=ccache" for language in ("C", "CXX")] if shutil.which("ccache") else []))
    run("cmake", "--build", KERNEL)
    shutil.rmtree(SITE, ignore_errors=True)
    shutil.copytree(ROOT / "web/lab", SITE)
    for name in ("lab", "picture"):
        for kind in ("js", "wasm"):
            shutil.copy(KERNEL / f"petzval-{name}.{kind}", SITE)
    (SITE / "lookup").mkdir()
    for path in ROOT.glob("examples/bokeh_texture/bokeh_texture.*"):
        shutil.copy(path, SITE / "lookup")
    scene = KERNEL / "night.bin.gz"
    if not scene.exists():  # Debian's Python: numpy is its package
        run("/usr/bin/python3", "tools/scene_textures.py", petzval, "night", "480", "270", scene)
    shutil.copy(scene, SITE)
    if short:
        return
    validator = pathlib.Path(petzval).parents[2] / "tests/lens_validation/petzval_validate_lenses"
    run(sys.executable, "tools/lens_pages.py", petzval, validator, KERNEL / "lenses")
    shutil.copytree(KERNEL / "lenses", SITE / "lenses")
    three_demo(petzval)


THREE = "three@0.187.0"  # of npm: the demo's copy, tested with this version
PMNDRS = "postprocessing@6.39.6"  # for the tests alone
DEMO_LENSES = {"petzval-portrait": [], "doublet": [], "double-gauss": [], "ideal": ["--cats-eye", "0.6"]}


def three_demo(petzval):
    """The page of web/three with a copy of three.js. Without npm the site has no such page."""
    if not shutil.which("npm"):
        print("web: npm not found: the site has no three/demo.html", file=sys.stderr)
        page = SITE / "index.html"
        page.write_text(page.read_text().replace('<a href="three/demo.html">Lenses in three.js</a> · ', ""))
        return
    npm, out = KERNEL / "npm", SITE / "three"
    if not (npm / "node_modules/three").exists():
        npm.mkdir(parents=True, exist_ok=True)
        (npm / "package.json").write_text('{"private": true}')
        run("npm", "install", "--silent", "--prefix", npm, THREE, PMNDRS)
    shutil.copytree(ROOT / "web/three", out, ignore=shutil.ignore_patterns("*.md", "*.json", "*.d.ts"))
    three, vendor = npm / "node_modules/three", out / "vendor"
    for name in ("three.module.js", "three.core.js"):
        vendor.mkdir(parents=True, exist_ok=True)
        shutil.copy(three / "build" / name, vendor)
    shutil.copy(three / "LICENSE", vendor)
    for name in ("postprocessing", "shaders"):
        shutil.copytree(three / "examples/jsm" / name, vendor / "addons" / name)
    shutil.copy(npm / "node_modules/postprocessing/build/index.js", vendor / "postprocessing.js")
    for lens, flags in DEMO_LENSES.items():
        if not (KERNEL / "atlases" / lens / "atlas.json").exists():
            run(petzval, "lens", "atlas", lens, "-o", KERNEL / "atlases" / lens, *flags)
    shutil.copytree(KERNEL / "atlases", out / "lenses")
    (out / "lenses/index.json").write_text(json.dumps(list(DEMO_LENSES)))


class Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm"}

    def log_request(self, *_):
        self.server.asked.append(self.path)

    def log_message(self, *_):
        pass


def server_of(folder):
    """A server of the folder on loopback, at a port that is free; `asked`: the paths that were asked for."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder))
    server.asked = []
    return server


def serve():
    server = server_of(SITE)
    print(f"http://127.0.0.1:{server.server_port}/ (Ctrl-C ends it)", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    petzval, *words = sys.argv[1:]
    if words not in ([], ["--serve"], ["--short"]):
        sys.exit("web: takes --serve, --short or nothing")
    build(petzval, short=words == ["--short"])
    print(SITE, flush=True)
    if words == ["--serve"]:
        serve()
