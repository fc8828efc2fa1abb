"""The kit's WGSL in headless Chromium's WebGPU, on SwiftShader: its frame is the Vulkan pass's.

Usage: kit_test.py PROGRAM PETZVAL. PROGRAM draws the frame to compare with (kit_frame.cpp), PETZVAL writes the lens. Ends
with 77, after the reason, where naga, the kit's compilers, Chromium, selenium, WebGPU or a Vulkan device is missing. /usr/bin/python3 runs this, because
selenium is Debian's.
"""
import array
import base64
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/browser"), str(ROOT / "tools")]
import web  # noqa: E402

STEPS = ("measure", "split", "reach", "gather", "combine_32")
AT_LEAST_DB = 45
CATS_EYE = 0.5  # its discs change over the frame
LENS = "--blades 5 --focal-length 50 --sensor-width 36 --fstop 1.4 --focus 2 --width 200 --height 120".split()  # that of kit_frame.cpp
DRAW = """
    const [frame, finish] = arguments;
    const bytes = async (name) => { frame[name] = await (await fetch(`${name}.bin`)).arrayBuffer(); };
    const text = (floats) => {
      let made = "";
      const all = new Uint8Array(floats.buffer);
      for (let i = 0; i < all.length; i += 32768) made += String.fromCharCode(...all.subarray(i, i + 32768));
      return btoa(made);
    };
    Promise.all(["lens", "colour", "radii"].map(bytes)).then(() => draw(frame))
        .then((floats) => finish(floats && text(floats)), (error) => finish(`refused: ${error.message}`));"""


def skip(reason):
    print(f"kit_test: skipped, {reason}")
    sys.exit(77)


def frame_of(folder, cats_eye):
    """Width, height and largest radius of the frame that the program left in the folder, with its lens."""
    program, petzval = sys.argv[1:]
    folder.mkdir()
    done = subprocess.run([program, folder, str(cats_eye)], stdout=subprocess.PIPE, text=True)
    if done.returncode == 77:
        skip("no Vulkan device")
    if done.returncode:
        sys.exit(f"kit_test: {program} ended with {done.returncode}")
    eye = ["--cats-eye", str(cats_eye)] if cats_eye else []
    subprocess.run([petzval, "lens", "buffer", "ideal", *LENS, *eye, "-o", folder / "lens.bin", "-q"], check=True)
    width, height, most_px = done.stdout.split()
    return {"width": int(width), "height": int(height), "mostPx": float(most_px)}


def kit_in(folder):
    for needed in ("naga", "glslc", "spirv-cross", "spirv-val", "glslangValidator"):
        if not shutil.which(needed):
            skip(f"{needed} is not installed")
    subprocess.run([sys.executable, ROOT / "tools/kit.py", folder], stdout=subprocess.DEVNULL, check=True)
    return json.loads((folder / "kit.json").read_text()), {step: (folder / "wgsl" / f"{step}.wgsl").read_text() for step in STEPS}


def answer(frame, folder):
    """The frame's floats as text, by Chromium, or why they were refused."""
    try:
        from chromium import browser
    except ImportError:
        skip("selenium is not installed")
    if not pathlib.Path("/usr/bin/chromedriver").exists():
        skip("Chromium is not installed")
    (folder / "kit.html").write_text(f"<!DOCTYPE html><script>{(ROOT / 'tests/kit/kit.js').read_text()}</script>")
    server = web.server_of(folder)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    window = browser("--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader")
    try:
        window.set_script_timeout(300)
        window.get(f"http://127.0.0.1:{server.server_port}/kit.html")
        made = window.execute_async_script(DRAW, frame)
    finally:
        window.quit()
        server.shutdown()
    if made is None:
        skip("this Chromium has no adapter for WebGPU")
    return made


def drawn(frame, folder):
    made = answer(frame, folder)
    if made.startswith("refused"):
        sys.exit(f"kit_test: {made}")
    return array.array("f", base64.b64decode(made))


def psnr_db(one, other):
    """Of linear light, cut at 1; alpha counts too."""
    squares = sum((min(a, 1.0) - min(b, 1.0)) ** 2 for a, b in zip(one, other))
    return 10 * math.log10(len(one) / max(squares, 1e-12))


def floats(path):
    return array.array("f", path.read_bytes())


def main():
    with tempfile.TemporaryDirectory(prefix="petzval-kit-") as name:
        even, varied = pathlib.Path(name) / "even", pathlib.Path(name) / "varied"
        frame = frame_of(even, 0)
        frame_of(varied, CATS_EYE)
        kit, programs = kit_in(pathlib.Path(name) / "kit")
        frame.update(programs=programs, kit=kit)
        expected, sharp, of_places = (floats(path) for path in (even / "expected.bin", even / "colour.bin", varied / "expected.bin"))
        made, by_places = drawn(frame, even), drawn(frame, varied)
        never = re.sub(r"\b256u\b", "100000u", programs["reach"])  # lamps that reach a tile before it merges its own
        assert never != programs["reach"]
        crowded = drawn({**frame, "programs": {**programs, "reach": never}}, even)
        older = bytearray((even / "lens.bin").read_bytes())
        older[16:20] = bytes(4)
        (even / "lens.bin").write_bytes(older)
        refusal = answer(frame, even)
    if refusal != f"refused: lens.bin is not for this kit: its bytes 16 to 19 are not {kit['lens_mark']}":
        sys.exit(f"kit_test: an older lens.bin is not refused: {refusal[:80]}")
    assert len(made) == len(by_places) == len(expected) == 4 * frame["width"] * frame["height"], len(made)
    blurred_db, found_db, places_db = psnr_db(expected, sharp), psnr_db(made, expected), psnr_db(by_places, of_places)
    print(f"kit_test: {found_db:.1f} dB from the Vulkan pass, which is {blurred_db:.1f} dB from the sharp picture")
    print(f"kit_test: {places_db:.1f} dB with 45 places of the lens, {psnr_db(made, of_places):.1f} dB with one")
    if not (blurred_db < 30 and min(found_db, places_db) >= AT_LEAST_DB):
        sys.exit(f"kit_test: {AT_LEAST_DB} dB are asked for")
    if psnr_db(made, of_places) > places_db - 6:
        sys.exit("kit_test: the places of the lens do not show")
    unmerged_db = psnr_db(crowded, expected)
    print(f"kit_test: {unmerged_db:.1f} dB without merging of lamps")
    if unmerged_db > found_db - 6:
        sys.exit("kit_test: the frame has no tile whose lamps are merged")


if __name__ == "__main__":
    main()
