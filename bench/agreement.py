"""Does a GPU draw what the CPU draws? Every built-in scene through every engine on both, and how far apart they are.

Usage: ./dev bench agreement [--scenes A,B] [--engines A,B] [--devices gpu:0,gpu:1] [--width N]
One row a scene, one column an engine on a device: the smaller of the PSNR in linear light and of sRGB, dB; equal: every
value of the files is. Below, how far the sum of light is off at most. Ends with 1 where a scene is below 45 dB.
"""
import argparse
import json
import sys

from quality import CACHE, engine_names, machine, petzval, print_table, scene_state

LEAST_DB = 45


def told(*words):
    return json.loads(petzval(*words, "--json", "-"))


def picture(scene, width):
    path = CACHE / f"{scene}_{width}_{scene_state()}_agreement.exr"
    if not path.exists():
        petzval("scene", "make", scene, "-o", path, "--width", width, "--height", width * 9 // 16, "-q")
    return path


def drawn(sharp, engine, device):
    out = CACHE / f"agreement_{device.replace(':', '_')}.exr"
    report = told("defocus", sharp, "-o", out, "--engine", engine, "--device", device, "-q")
    if not report["device"].startswith(device):
        sys.exit(f"bench agreement: {engine} was drawn by {report['device']}, not by {device}")
    return out


def compared(sharp, engine, devices):
    """Of each device: dB, and by how much the sum of light is off."""
    cpu = drawn(sharp, engine, "cpu")
    for device in devices:
        found = told("compare", cpu, drawn(sharp, engine, device))
        least = [found[name] for name in ("psnr_lin", "psnr_srgb") if isinstance(found[name], (int, float))]
        yield min(least, default=float("inf")), abs(found["energy_ratio"] - 1)


def main():
    here = [d["name"] for d in told("devices")["devices"] if d["name"] != "cpu" and not d["lacks"]]
    listed = [s["name"] for s in told("scene", "list")["scenes"]]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=lambda s: s.split(","), default=listed)
    parser.add_argument("--engines", type=lambda s: s.split(","), default=[e for e in engine_names() if e != "reference"])
    parser.add_argument("--devices", type=lambda s: s.split(","), default=here)
    parser.add_argument("--width", type=int, default=128)
    given = parser.parse_args()
    if not given.devices:
        sys.exit(f"bench agreement: {told('devices')['no_gpu']}")
    CACHE.mkdir(parents=True, exist_ok=True)
    body, worst_light = [], 0
    for scene in given.scenes:
        sharp = picture(scene, given.width)
        found = [f for engine in given.engines for f in compared(sharp, engine, given.devices)]
        body.append([scene, *(f"{db:.1f}" if db < float("inf") else "equal" for db, _ in found)])
        worst_light = max(worst_light, *(light for _, light in found))
        print(*body[-1], file=sys.stderr, flush=True)
    columns = [f"{e}, {d}" for e in given.engines for d in given.devices]
    print_table(["scene", *columns], body)
    least = min((float(v), row[0], c) for row in body for v, c in zip(row[1:], columns) if v != "equal")
    print(f"\nLeast: {least[0]} dB ({least[1]}, {least[2]}); light is off by {worst_light:.1e} at most. "
          f"{given.width} px wide. {machine()}.")
    sys.exit(int(least[0] < LEAST_DB))


if __name__ == "__main__":
    main()
