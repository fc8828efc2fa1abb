"""What the program says of its verbs, in every form: help, docs/reference/command-line.md, a manual page, completions."""
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from program import PETZVAL, CommandLineTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/reference/command-line.md").read_text()
NOT_YET = re.search(r"\nThe verbs? (.*) (?:is|are) reserved and refused", PAGE).group(1)
FLAG = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
VERBS = ["defocus", "inspect", "scene list", "scene make", "scene points", "compare", "develop", "lens list", "lens show",
         "lens psf", "lens table", "lens report", "devices", "farm write", "help"]


class Help(CommandLineTest):
    def form(self, name):
        return self.succeed("help", "--format", name).out

    def file(self, form):
        self.succeed("help", "--format", form, "--save", form)
        return self.path(form)

    def check(self, tool, *args):
        """Runs a tool on a form of the help, where there is one; returns what it wrote."""
        if not shutil.which(tool):
            self.skipTest(f"{tool} is not installed")
        done = subprocess.run([tool, *args], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_the_page_is_what_the_program_says(self):
        done = subprocess.run([sys.executable, ROOT / "tools/command_line.py", "--check", PETZVAL], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_prose_of_the_page_names_flags_that_there_are(self):
        known = set(FLAG.findall(self.form("md")))
        prose = PAGE.split("\n## Verbs\n")[0]
        self.assertEqual(set(FLAG.findall(prose)) - known - {"--help", "--help-all"}, set(FLAG.findall(NOT_YET)))

    def test_what_is_not_there_yet_is_refused(self):
        for flag in FLAG.findall(NOT_YET):
            self.refuse(2, "defocus", "in.exr", "-o", "out.exr", flag, "1", says=["unknown flag " + flag])
        for verb in re.findall(r"`([a-z]+)`", NOT_YET):
            self.refuse(2, verb, "in.exr", says=["unknown verb " + verb])

    def test_every_form_has_every_flag_of_every_verb(self):
        forms = {name: self.form(name) for name in ("md", "man", "bash", "zsh", "fish")}
        for verb in VERBS:
            for flag in set(FLAG.findall(self.succeed(*verb.split(), "--help-all").out)):
                for name, text in forms.items():
                    if not flag.startswith("--help") or name != "md":
                        self.assertRegex(text, re.escape(flag if name != "fish" else " -l " + flag[2:]) + r"(?![\w-])", (verb, name))

    def test_short_help_fits_a_screen_and_names_the_long_one(self):
        short, whole = (self.succeed("defocus", flag).out for flag in ("--help", "--help-all"))
        self.assertLessEqual(short.count("\n"), 48)
        self.assertLessEqual(max(map(len, short.split("Common flags")[1].split("\n"))), 100)
        self.assertIn("--help-all", short)
        for flag in ("--depth", "--plate", "--fstop", "--focus-at", "--lens", "--frames"):
            self.assertIn(f"  {flag}", short)
        self.assertGreater(len(FLAG.findall(whole)), 2 * len(FLAG.findall(short)))
        self.assertRegex(self.succeed("lens", "psf", "--help").out, r"(?s)--defocus .*--field ")

    def test_an_output_that_may_be_left_out_is_in_brackets(self):
        for verb, usage in (("compare", "REF TEST [-o FILE.png] [flags]"), ("defocus", "IN -o OUT [flags]"),
                            ("lens report", "LENS [-o PATH] [flags]")):
            self.assertIn(f"\npetzval {verb} {usage}\n", self.succeed(*verb.split(), "--help").out)

    def test_the_manual_page_is_clean(self):
        self.assertEqual(self.check("mandoc", "-T", "lint", self.file("man")), "")

    def test_completions_are_understood_by_their_shells(self):
        for shell in ("bash", "zsh", "fish"):
            with self.subTest(shell):
                self.check(shell, "-n", self.file(shell))

    def test_bash_completes_verbs_flags_and_values(self):
        script = self.file("bash")
        for typed, expected in ((["de"], "defocus develop devices"), (["lens", ""], "list"), (["defocus", "a.exr", "--en"], "--engine"),
                                (["defocus", "--engine", ""], "scatter gather"), (["defocus", "--lens", "double"], "double-gauss"),
                                (["lens", "psf", "doublet", "--defo"], "--defocus"), (["defocus", "--look", ""], "")):
            words = " ".join(f"'{w}'" for w in ["petzval", *typed])
            said = self.check("bash", "-c", f"source {script}; COMP_WORDS=({words}); COMP_CWORD={len(typed)}; _petzval; "
                                            "echo \"${COMPREPLY[@]}\"")
            self.assertTrue(expected in said if expected else said.strip() == "", (typed, said))


if __name__ == "__main__":
    unittest.main()
