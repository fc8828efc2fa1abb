"""docs/command-line.md and the program name the same verbs, flags and choices."""
import pathlib
import re
import unittest

from program import CommandLineTest

PAGE = (pathlib.Path(__file__).resolve().parents[2] / "docs/command-line.md").read_text()
VERBS, DEFOCUS = PAGE.split("## `defocus`")[:2]
DEFOCUS = DEFOCUS.split("Camera numbers missing")[0]
NOT_YET = {"--device"}
FLAG = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
# Of every verb, and said once: in the rows "log" and "output".
COMMON = {"--help", "--output", "--quiet", "--verbose", "--update"}


def rows():
    """Verbs of a row of the first table, and the row."""
    for line in VERBS.splitlines():
        cells = line.split(" | ", 1)
        if line.startswith("| `"):
            spans = re.findall(r"`([a-z]+)((?: [a-z]+)?)", cells[0])
            yield [(a + b).strip() for a, b in spans], line


class DocumentedNames(CommandLineTest):
    def help(self, verb):
        return self.succeed(*verb.split(), "--help").out

    def test_every_verb_is_there_or_marked(self):
        seen = set()
        for verbs, line in rows():
            for verb in verbs:
                seen.add(verb.split()[0])
                if "*not there yet*" in line:
                    self.refuse(2, verb, "in.exr", says=["unknown verb " + verb])
                else:
                    self.help(verb)
        listed = re.search(r"\nVerbs\n(.*?)\n\n", self.help(""), re.DOTALL).group(1)
        self.assertEqual(set(re.findall(r"^  ([a-z]+)", listed, re.MULTILINE)) - seen, set())

    def test_every_flag_of_a_verb_is_in_its_help(self):
        for verbs, line in rows():
            if "*not there yet*" in line or verbs == ["defocus"]:
                continue
            known = set().union(*(FLAG.findall(self.help(verb)) for verb in verbs))
            # Flags that belong to another verb stand with its name: `lens report --all`, `defocus --engine …`.
            named = set(FLAG.findall(re.sub(r"`(?:\./dev|defocus|develop) [^`]*`", "", line)))
            self.assertEqual(named - known, set(), verbs)

    def test_the_page_and_the_help_of_defocus_name_the_same_flags(self):
        named, known = set(FLAG.findall(DEFOCUS)), set(FLAG.findall(self.help("defocus")))
        self.assertEqual(named - known, NOT_YET)
        self.assertEqual(known - named - COMMON, set())
        for flag in NOT_YET:
            place = next(line for line in DEFOCUS.splitlines() if flag in line)
            self.assertIn("*not there yet*", place)

    def test_every_choice_on_the_page_is_in_the_help_and_taken(self):
        page = self.help("defocus")
        checked = 0
        for flag, choices in re.findall(r"`(--[a-z-]+) ([a-z0-9-]+(?:\\\|[a-z0-9-]+)+)`", DEFOCUS):
            if flag in NOT_YET:
                continue
            for choice in choices.split("\\|"):
                self.assertIn(choice, page, flag)
                outcome = self.run_program("defocus", "none.exr", "-o", "out.exr", flag, choice)
                self.assertNotIn("not one of", outcome.err, flag + " " + choice)
                checked += 1
        self.assertGreater(checked, 40)
        self.refuse(2, "defocus", "none.exr", "-o", "out.exr", "--view", "lairs", says=["not one of"])


if __name__ == "__main__":
    unittest.main()
