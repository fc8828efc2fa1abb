"""One law for every flag of every verb: it changes what the verb makes or says, or it is refused by name."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from pictures import camera_attributes, picture, read_exr, write_exr, write_png
from program import PETZVAL, CommandLineTest

# What each verb is asked without the flag. {o} is a folder of its own.
COMMANDS = {
    "defocus": "in.exr -o {o}/out.exr",
    "inspect": "in.exr",
    "scene make": "bars -o {o}/out.exr --width 32 --height 18 --pinhole-samples 2",
    "scene points": "glints -o {o}/out.csv --count 9",
    "compare": "in.exr other.exr",
    "develop": "in.exr -o {o}/out.png",
    "focus-track": "in.####.exr -o {o}/out.csv --at 14,3",
    "sheet": "in.####.exr -o {o}/out.png",
    "lens list": "", "devices": "",
    "lens show": "doublet", "lens check": "tessar",
    "lens psf": "doublet -o {o}/out.exr --width 480 --defocus 9",
    "lens table": "doublet -o {o}/out.exr --width 480 --columns 5 --defocus 9",
    "lens volume": "doublet -o {o}/out.exr --width 480 --slices 2 --side 17 --defocus 9",
    "lens atlas": "doublet -o {o} --width 480 --zones 2 --defocus 9",
    "lens buffer": "ideal -o {o}/out.bin --width 480 --quality draft",
    "lens report": "ideal -o {o}/out.html",
}
# Flags that say how a verb works and never what it makes; those that name the default.
HOW = {"--threads", "--progress", "--overwrite", "--max-memory", "--kernel-cache", "--help", "--verbose", "--quiet",
       "--no-clobber", "--update"}
VALUES = {
    "--layer": "more", "--view-name": "left", "--layers": "more", "--depth": "far.exr", "--depth-channel": "other",
    "--depth-kind": "ray", "--depth-range": "0.1,100", "--unit-scale": "0.5", "--plate": "plate.exr", "--merge": "front.exr",
    "--holdout": "front.exr", "--mask": "matte.exr", "--transfer": "linear", "--highlight-peak": "40", "--depth-edges": "snap",
    "--focal-length": "80mm", "--sensor-width": "24mm", "--fstop": "4", "--aperture-diameter": "9mm", "--focus": "1.3m",
    "--breathing": "on", "--focus-at": "20,12", "--focus-point": "1,0,2", "--permissible-radius": "3", "--focus-range": "1m,1.5m",
    "--focus-falloff": "0.3", "--near-scale": "0.5", "--far-scale": "0.5", "--max-radius": "2", "--look": "look.json", "--preset": "bubble",
    "--save-look": "{o}/saved.json", "--lens": "doublet", "--blades": "5", "--blade-rotation": "20", "--blade-curvature": "0.5",
    "--squeeze": "2", "--cats-eye": "0.8", "--focus-mode": "paraxial", "--focus-shift": "-0.2", "--spherical": "3",
    "--axial-colour": "4", "--lateral-colour": "30", "--add-spherical": "9", "--add-at-fstop": "4", "--add-axial-colour": "-0.5",
    "--add-field-curvature": "-2", "--add-lateral-colour": "3", "--coma": "2", "--astigmatism": "2", "--distortion": "0.2",
    "--light": "neon", "--wavelengths": "3", "--wave": None, "--iris-open": "1.5", "--barrel": "9,20", "--barn-doors": "0.5,0,0,0",
    "--aperture-image": "half.png", "--kernel-image": "half.png", "--dust": "1", "--scratches": "1", "--onion-rings": "1",
    "--texture-seed": "5", "--bloom": "0.2", "--bloom-radius": "0.3", "--bloom-threshold": "2", "--star": "0.3", "--star-radius": "0.9",
    "--star-quality": "draft", "--ghosts": "0.3", "--coating": "none", "--veil": "0.2", "--glare-threshold": "5", "--engine": "gather",
    "--quality": "draft", "--fill": "off", "--pupil-points": "16", "--seed": "7", "--gather-stage": "coc", "--gather-taps": "16",
    "--gather-tap-offset": "1", "--gather-pixel-size": "0.9", "--gather-blurred-from": "4", "--gather-coc": "extreme",
    "--gather-fill": "off", "--gaussian-style": "plain", "--focus-band": "2", "--depth-offset": "0.3", "--depth-along": "ray",
    "--depth-band-range": "0.5m,9m", "--background": "gaussian", "--find-points": "off", "--bright-factor": "90", "--points": "points.csv",
    "-o": "{o}/else.exr", "--view": "coc", "--overscan": "6", "--json": "{o}/report.json", "--frames": "1-2", "--missing": "skip",
    "--report": "{o}/report.jsonl", "--track": "track.csv", "--rack": "1:3,3", "--focus-speed": "0.1", "--temporal": "1",
    "--motion": "off", "--motion-scale": "2", "--exposure": "1", "--contrast": "2", "--tone": "none", "--ocio": "a,b",
    "--ocio-space": "a", "--device": "gpu:99", "--width": "24", "--height": "40", "--frame": "3", "--samples": "4",
    "--pinhole-samples": "3", "--scene-camera": "2", "--camera-at": "1,1,-1", "--look-at": "1,1,4", "--lit-in": "codes", "--depth-filter": "mean",
    "--depth-blur": "3", "--depth-bits": "8", "--truth": "{o}/truth.exr", "--horizon": "0.3", "--count": "5", "--bits": "16",
    "--at": "20,12", "--within": "20", "--smooth": "0", "--plot": "{o}/plot.svg", "--columns": "3", "--rate": "12",
    "--zones": "3", "--slices": "3", "--side": "21", "--lenses": "doublet", "--sort": "name", "--roi": "3,3,20,15", "--defocus": "5", "--field": "0.5,0.3", "--size": "31", "--rows-per-pixel": "2",
}
# By verb, where the value above would be the verb's own or means something else there.
VALUES_OF = {
    "scene make": {"--layers": "{o}/hidden.exr"}, "compare": {"--exposure": "2", "-o": "{o}/map.png"}, "scene points": {"--width": "300"},
    "lens table": {"--width": "960"}, "lens volume": {"--width": "960"}, "lens psf": {"--width": "960"},
    "lens buffer": {"-o": "{o}/else.bin", "--width": "960", "--quality": "standard"},
    "lens report": {"-o": "{o}/else.html"}, "lens atlas": {"-o": "{o}/else", "--width": "960"}, "focus-track": {"-o": "{o}/else.csv"}, "develop": {"-o": "{o}/else.png"},
    "sheet": {"-o": "{o}/else.png"}, "scene points": {"-o": "{o}/else.csv", "--width": "300", "--height": "300"},
}
# What else is said beside a flag, so that it has something to change.
BESIDE = {
    "--blade-rotation": "--blades 5", "--blade-curvature": "--blades 5", "--iris-open": "--blades 5", "--texture-seed": "--dust 1",
    "--add-at-fstop": "--add-spherical 9", "--wavelengths": "--lens uncorrected", "--light": "--lens uncorrected",
    "--spherical": "--lens uncorrected", "--axial-colour": "--lens uncorrected", "--focus-mode": "--lens uncorrected",
    "--focus-shift": "--lens uncorrected", "--lateral-colour": "--lens triplet-cooke --fstop 5.6",
    "--highlight-peak": "--expand-highlights", "--focus-falloff": "--focus-range 1m,1.5m", "--pupil-points": "--engine reference",
    "--bloom-radius": "--bloom 0.2", "--bloom-threshold": "--bloom 0.2", "--star": "--blades 5", "--star-radius": "--blades 5 --star 0.3",
    "--star-quality": "--blades 5 --star 0.3", "--coating": "--ghosts 0.3 --lens tessar --fstop 4", "--glare-threshold": "--ghosts 0.3",
    "--gather-taps": "--engine gather --gather-stage disc", "--gather-tap-offset": "--engine gather --gather-stage blur",
    "--gather-pixel-size": "--engine gather --gather-stage combine", "--gather-blurred-from": "--engine gather --gather-stage combine",
    "--gather-coc": "--engine gather --gather-stage combine", "--gather-stage": "--engine gather", "--gather-fill": "--engine gather",
    "--gaussian-style": "--engine gaussian", "--focus-band": "--engine gaussian", "--depth-offset": "--engine gaussian --gaussian-style wgld",
    "--depth-along": "--engine gaussian --gaussian-style wgld", "--depth-band-range": "--engine gaussian --gaussian-style wgld",
    "--background": "--engine sprites", "--find-points": "--engine gather", "--bright-factor": "--engine gather",
    "--points": "--engine sprites", "--permissible-radius": "--view focus", "--missing": "--frames 1-4",
}
BESIDE_OF = {
    "lens table": {"--focus": "--lens tessar"},
    "lens psf": {"--focus": "--lens tessar", "--height": "--field 0.7,0.4 --barrel 9,20", **{flag: "--field 0.7,0.4" for flag in ("--cats-eye", "--add-field-curvature", "--add-lateral-colour", "--coma",
                                                     "--astigmatism", "--distortion", "--barrel")}},
    "lens volume": {"--focus": "--lens tessar", "--field": "--cats-eye 0.8", "--height": "--field 0.7,0.4 --barrel 9,20", **{flag: "--field 0.7,0.4" for flag in ("--cats-eye", "--add-field-curvature", "--add-lateral-colour", "--coma",
                                                     "--astigmatism", "--distortion", "--barrel")}},
    "lens atlas": {"--focus": "--lens tessar", "--zones": "--cats-eye 0.8", "--height": "--barrel 9,20", **{flag: "--zones 1" for flag in (
        "--blades", "--squeeze", "--barn-doors", "--aperture-image", "--kernel-image", "--dust", "--scratches")},
                   **{flag: "--zones 1 --blades 5" for flag in ("--blade-rotation", "--blade-curvature", "--iris-open")}, "--texture-seed": "--zones 1 --dust 1"},
    "lens buffer": {"--focus": "--lens tessar", "--width": "--lens uncorrected", "--height": "--barrel 9,20"},
    "scene make": {"--samples": "--truth {o}/truth.exr"},
}


def content_of(path):
    """Pixels where they can be read: attributes hold what was typed, whether or not it had an effect."""
    if "report" in path or path.endswith("atlas.json") or os.path.isdir(path):
        return None
    try:
        return read_exr(path)
    except AssertionError:
        with open(path, "rb") as file:
            return file.read()


class EveryFlag(CommandLineTest):
    @classmethod
    def setUpClass(cls):
        said = subprocess.run([PETZVAL, "help", "--format", "md"], check=True, capture_output=True, text=True).stdout
        cls.flags = {}
        for section in said.split("### `petzval ")[1:]:
            verb = re.match(r"[a-z-]+(?: [a-z]+)?", section).group(0)
            rows = re.findall(r"^\| `(-[^`]*)` \|", section, re.M)
            cls.flags[verb] = [[word for word in row.replace(",", " ").split() if word.startswith("-")] for row in rows]

    def setUp(self):
        super().setUp()
        colour = lambda x, y: 30.0 if (x, y) == (6, 9) else (x * 7 + y * 3) % 11 / 11  # noqa: E731
        camera = camera_attributes(50, 36, 1.4, 2)
        main = picture(36, 24, colour, lambda x, y: 1.1 if x < 15 else 4 + 0.1 * y)
        main.update({"more." + c: [[v * 0.3 for v in row] for row in main[c]] for c in "RGB"})
        main["other"] = [[3.0] * 36 for _ in range(24)]
        write_exr(self.path("in.exr"), main, attributes=camera)
        write_exr(self.path("other.exr"), picture(36, 24, lambda x, y: 0.2), attributes=camera)
        for frame in (1, 2, 3):
            write_exr(self.path("in.%04d.exr" % frame), picture(36, 24, colour, lambda x, y: 1.1 + frame if x < 15 else 5 + y / 9),
                      attributes=camera)
        write_exr(self.path("far.exr"), picture(36, 24, 0.5, lambda x, y: 1 + y))
        write_exr(self.path("plate.exr"), picture(36, 24, 0.9, 8.0))
        front = picture(36, 24, 0.1, 0.7, lambda x, y: float(x < 9))
        write_exr(self.path("front.exr"), front)
        write_exr(self.path("matte.exr"), {"A": [[float(x < 18) for x in range(36)] for _ in range(24)]})
        write_png(self.path("half.png"), [[255 * (x > 4) for x in range(9) for _ in range(3)] for _ in range(9)])
        for name, text in (("look.json", '{"lens": {"blades": 5}}'), ("points.csv", "x,y,depth,r,g,b\n20,12,4,9,9,9\n"),
                           ("track.csv", "frame,focus\n1,1\n3,4\n")):
            with open(self.path(name), "w") as file:
                file.write(text)

    def made(self, verb, words):
        """Exit code, and all that a command makes: pixels, bytes of other files, what it says but for times."""
        folder = tempfile.mkdtemp(dir=self.folder)
        outcome = self.run_program(*verb.split(), *(word.replace("{o}", folder) for word in words))
        made = {}
        for name in sorted(os.listdir(folder)):
            path = os.path.join(folder, name)
            made[name] = content_of(path)
        shutil.rmtree(folder)
        said = re.sub(r"[\d.]+ (?:s|ms|MiB|M)\b|\d+%", "#", (outcome.out + outcome.err).replace(folder, ""))
        return outcome, (said, made)

    def words_of(self, verb, names):
        known = {**VALUES, **VALUES_OF.get(verb, {})}
        name = next((n for n in names if n in known), names[-1])
        value = known.get(name)
        beside = {**BESIDE, **BESIDE_OF.get(verb, {})}.get(name, "").split()
        base = COMMANDS[verb].split()
        if verb.startswith("lens ") and "--lens" in beside:  # there the lens is the argument
            at = beside.index("--lens")
            base[0] = beside[at + 1]
            del beside[at:at + 2]
        if name in base:  # said already: with another value
            at = base.index(name)
            return base, base[:at] + [name, value] + base[at + 2:]
        if name == "--at":
            return base, base[:-1] + [value]
        return base + beside, base + beside + [name] + ([value] if value is not None else [])

    def check(self, verb):
        changed, without = [], []
        before = {}
        for names in self.flags[verb]:
            if HOW & set(names):
                continue
            base, words = self.words_of(verb, names)
            if tuple(base) not in before:
                before[tuple(base)] = self.made(verb, base)
            plain, flagged = before[tuple(base)], self.made(verb, words)
            where = "petzval %s %s\n%s" % (verb, " ".join(words), flagged[0])
            if flagged[0].code == 0:
                (changed if flagged[1] != plain[1] else without).append(names[-1])
            else:
                self.assertIn(flagged[0].code, (1, 2, 3), where)
        self.assertEqual(without, [], "petzval " + verb)
        return changed

    def test_every_verb_is_asked(self):
        asked_elsewhere = {"view", "help", "scene list",  # a window; itself; a list
                           *(f"farm {verb}" for verb in ("write", "submit", "status", "collect"))}  # farm_test.py
        self.assertEqual(set(self.flags) - asked_elsewhere, set(COMMANDS))


def add_tests():
    for verb in COMMANDS:
        def test(self, verb=verb):
            changed = self.check(verb)
            print("%s: %d flags changed what it makes" % (verb, len(changed)))
        setattr(EveryFlag, "test_" + verb.replace(" ", "_").replace("-", "_"), test)


add_tests()

if __name__ == "__main__":
    unittest.main()
