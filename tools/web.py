"""Builds the lens lab into build/web: web/lab, petzval's rooms as WebAssembly, a scene, and a page per lens.

Usage: web.py PETZVAL [--serve]; --serve: then serves it on loopback.
"""
import functools
import http.server
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


def build(petzval):
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
    run(sys.executable, "tools/lens_pages.py", petzval, KERNEL / "lenses")
    shutil.copytree(KERNEL / "lenses", SITE / "lenses")


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
    if words not in ([], ["--serve"]):
        sys.exit("web: takes --serve or nothing")
    build(petzval)
    print(SITE, flush=True)
    if words:
        serve()
