"""What the tests of petzval view share: a display of their own, and a window that a script drives."""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

PETZVAL = os.environ.get("PETZVAL", "petzval")
TIME_LIMIT_S = 60


class Display:
    """An X server of our own, software rendered; `name` is None where none can be had."""

    def __init__(self):
        self.server, self.name = None, None
        if not shutil.which("Xvfb"):
            return
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1100x900x24"],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as says:
            number = says.readline().strip()
        self.name = ":" + number if number else None

    def close(self):
        if self.server:
            self.server.terminate()
            self.server.wait()


def png_codes(data):
    """Rows of (r, g, b) of an 8-bit RGB PNG."""
    at, chunks, width, height = 8, b"", 0, 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height = struct.unpack(">II", data[at + 8:at + 16])
        chunks += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += size + 12
    raw, rows, above = zlib.decompress(chunks), [], bytes(3 * width)
    for y in range(height):
        row = bytearray(raw[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)])
        for i in range(3 * width):
            left, up, corner = (row[i - 3] if i > 2 else 0), above[i], (above[i - 3] if i > 2 else 0)
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda value: abs(guess - value))
            row[i] = (row[i] + [0, left, up, (left + up) // 2, paeth][raw[y * (3 * width + 1)]]) & 255
        above = bytes(row)
        rows.append([tuple(row[3 * x:3 * x + 3]) for x in range(width)])
    return rows


DISPLAY = Display()


class WindowTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.mkdtemp(prefix="petzval-view-")
        subprocess.run([PETZVAL, "scene", "make", "table", "-o", "table.exr", "--width",
                       "320", "--height", "180", "--pinhole-samples", "4", "--truth", "truth.exr", "--samples", "4"],
                       cwd=cls.shared, check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared, ignore_errors=True)

    def contents(self, *names):
        for name in names:
            with open(os.path.join(self.shared, name), "rb") as file:
                yield file.read()

    def start(self, *arguments, display=None):
        env = {**os.environ, "PETZVAL_KERNEL_CACHE": "off", "DISPLAY": display or DISPLAY.name,
               "XDG_STATE_HOME": os.path.join(self.shared, "state")}
        window = subprocess.Popen([PETZVAL, "view", *arguments, "--window", "1000x850"], cwd=self.shared, env=env,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (window.kill(), window.communicate()))
        return window

    def finish(self, window, code=0):
        """Waits for its end; returns its standard output and standard error."""
        out, err = window.communicate(timeout=TIME_LIMIT_S)
        self.assertEqual(window.returncode, code, err)
        return out, err

    def do(self, script, *arguments, code=0):
        """Runs a script; returns its standard output and standard error."""
        with open(os.path.join(self.shared, "script.txt"), "w") as file:
            file.write(script)
        window = self.start(*(arguments or ["table.exr"]), "--script", "script.txt")
        out, err = self.finish(window, code)
        if code == 0:
            print(self.id().split(".")[-1] + ":", err.strip().splitlines()[-1])
        return out, err


def run():
    if not DISPLAY.name:
        print("SKIPPED: no display can be had (Xvfb is missing or does not start)")
        sys.exit(77)
    done = unittest.main(module="__main__", exit=False)
    DISPLAY.close()
    sys.exit(not done.result.wasSuccessful())
