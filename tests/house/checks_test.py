"""The checks of the house find what they are there to find: each is shown a small tree with one fault."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
import check_density  # noqa: E402

LONG_BODY = "    step();\n" * 60


def result_of(check, files, *words):
    """Exit status and output of tools/CHECK over a tree of {path: text}."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = pathlib.Path(root) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        result = subprocess.run([sys.executable, TOOLS / check, *words, root], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True)
        return result.returncode, result.stdout


class Checks(unittest.TestCase):
    def assert_found(self, check, files, *words):
        status, output = result_of(check, files)
        self.assertEqual(status, 1, output)
        for word in words:
            self.assertIn(word, output)

    def assert_clean(self, check, files):
        status, output = result_of(check, files)
        self.assertEqual(status, 0, output)

    def test_a_dead_link_and_a_place_outside_of_the_clone_are_found(self):
        links = "../tests/docs/check_links.py"
        sound = {"docs/a.md": "# A b\n[b](b.md#the-b) `../README.md`\n", "docs/b.md": "# The b\n", "README.md": "\n"}
        self.assert_clean(links, sound)
        for line in ("[b](c.md)", "[b](b.md#the-c)", "[out](../../shared/a.md)", "see `../../scenes`",
                     "`Law.ThatNoTestHolds`", "`test_that_is_not_there`"):
            self.assert_found(links, sound | {"docs/a.md": line + "\n"}, "docs/a.md")
        start = {"docs/README.md": "[b](b.md)\n\n## Pages\n[a](a.md)\n", "docs/journal/c.md": "\n"}
        self.assert_found(links, sound | start, "no link to b.md")
        self.assert_clean(links, sound | start | {"docs/README.md": "\n## Pages\n[a](a.md) [b](b.md)\n"})

    def test_a_page_that_names_a_source_which_does_not_exist_is_found(self):
        links = "../tests/docs/check_links.py"
        files = {"docs/a.md": "\n", "src/engine/waist/plan.cpp": "", "lenses/a.json": "{}"}
        sound = "`src/engine/waist/plan.cpp` `engine/waist/plan` `engine/*/plan.cpp` `lenses/*.json` `src/engine/x/` `job/left` `src/theirs/a.c`\n"
        self.assert_clean(links, files | {"docs/a.md": sound})
        for path in ("src/engine/waist/gone.cpp", "engine/gone", "lenses/b.json", "engine/waist/gone.*"):
            self.assert_found(links, files | {"docs/a.md": f"`{path}`\n"}, f"docs/a.md: `{path}` is not in the repository")
        self.assert_clean(links, files | {"docs/journal/b.md": "`engine/gone`\n"})

    def test_an_upward_include_is_found(self):
        self.assert_found("check_layers.py", {"src/image/a.cpp": '#include "engine/b.h"\n'}, "src/image/a.cpp:1")
        self.assert_clean("check_layers.py", {"src/engine/waist/a.cpp": '#include "image/b.h"\n'})

    def test_an_engine_that_looks_into_another_is_found(self):
        self.assert_found("check_layers.py", {"src/engine/gather/a.cpp": '#include "engine/scatter/b.h"\n'},
                          "engine/gather must not include engine/scatter/b.h")
        self.assert_found("check_layers.py", {"src/engine/a.cpp": ""}, "stands in no room")

    def test_tests_may_make_a_lens_and_code_may_not(self):
        line = '#include "kernel/lenses/make_lens.h"\n'
        self.assert_found("check_layers.py", {"src/kernel/keep/bank.cpp": line}, "kernel/keep must not include")
        self.assert_clean("check_layers.py", {"src/kernel/keep/bank_test.cpp": line})

    def test_rooms_that_include_each_other_are_found(self):
        plan = {"src/device/cpu/a.cpp": '#include "glare/plan.h"\n', "src/glare/plan.h": '#include "device/a.h"\n'}
        self.assert_clean("check_layers.py", plan)
        self.assert_found("check_layers.py", {**plan, "src/glare/a.cpp": '#include "device/cpu/a.h"\n'},
                          "rooms include each other: device/cpu -> glare -> device/cpu")

    def test_two_types_of_one_name_are_found(self):
        named = "namespace petzval {\nstruct Surface {\n};\n}  // namespace petzval\n"
        hidden = "namespace petzval {\nnamespace {\nstruct Surface {\n};\n}  // namespace\n}  // namespace petzval\n"
        self.assert_found("check_layers.py", {"src/image/a.h": named, "src/optics/b.cpp": named}, "petzval::Surface is also")
        self.assert_clean("check_layers.py", {"src/image/a.h": named, "src/optics/b.cpp": hidden})

    def test_a_public_header_of_a_higher_room_is_found(self):
        self.assert_found("check_layers.py", {"src/image/a.cpp": '#include "petzval/defocus.h"\n'}, "petzval/defocus.h")

    def test_other_peoples_headers_stay_in_their_room(self):
        self.assert_found("check_layers.py", {"src/engine/waist/a.cpp": "#include <tbb/task_arena.h>\n"}, "workers")
        self.assert_found("check_layers.py", {"include/petzval/a.h": "#include <OpenEXR/ImfArray.h>\n"}, "files")

    def test_the_program_sees_public_headers_only(self):
        self.assert_found("check_layers.py", {"apps/cli/a.cpp": '#include "engine/b.h"\n'}, "petzval/ only")

    def test_a_library_that_speaks_of_flags_is_found(self):
        self.assert_found("check_layers.py", {"src/image/a.cpp": 'auto a = "give --fstop";\n'}, "names fields")
        self.assert_clean("check_layers.py", {"src/image/a.cpp": '// --fstop\nauto a = "give camera.f_number -- or b--c";\n',
                                              "src/image/a_test.cpp": 'auto a = "--fstop";\n',
                                              "apps/cli/a.cpp": 'auto a = "--fstop";\n'})

    def test_a_crowded_folder_is_found(self):
        files = {f"src/image/a{i}.cpp": "" for i in range(41)}
        self.assert_found("check_density.py", files, "files in src/image: 41, more than 40")
        files.pop("src/image/a0.cpp")
        self.assert_clean("check_density.py", files)

    def test_chains_of_commas_and_nested_ternaries_are_counted(self):
        for code, chained, nested in (("a = 1, b = 2;", 1, 0), ("if (c) x.a += f(1, 2), ++y;", 1, 0),
                                      ("int a = 1, b = 2;", 0, 0), ("f(a = 1, b);", 0, 0), ("a = {1, 2};", 0, 0),
                                      ("x = a ? b : c;", 0, 0), ("x = a ? b : c ? d : e;", 0, 1),
                                      ("f(a ? b : c, d ? e : g);", 0, 0), ('s = "?, a = 1, b = 2;";', 0, 0)):
            text = check_density.STRIP.sub("", f"void f() {{ {code} }}")
            self.assertEqual(check_density.chained(text), chained, code)
            self.assertEqual(check_density.nested_ternaries(text), nested, code)

    def test_a_long_function_is_found_in_any_form(self):
        for head in ("int long_one() {\n", "Result<A<B>> C::long_one(int a,\n          int b) const {\n",
                     "template <typename T>\nvoid long_one(T x) noexcept {\n",
                     "class C {\npublic:\n    C& long_one() {\n", "bool C::operator==(const C& long_one) {\n"):
            text = "// A comment, a quote's end.\nnamespace a {\n/* { */ const char* s = \"{\";\n"
            text += head + LONG_BODY + "}\n" + ("};\n" if "class" in head else "") + "}\n"
            self.assert_found("check_sizes.py", {"src/image/a.cpp": text}, "src/image/a.cpp", "lines, more than 60")
        self.assert_found("check_sizes.py", {"tools/a.py": "def f():\n" + LONG_BODY}, "f has 61 lines")

    def test_many_short_functions_are_fine(self):
        text = "namespace a {\n" + "void f() {\n    if (x) {\n        y();\n    }\n}\n" * 20 + "}\n"
        self.assert_clean("check_sizes.py", {"src/image/a.cpp": text})

    def test_a_long_file_is_found(self):
        self.assert_found("check_sizes.py", {"src/image/a.cpp": "int a;\n" * 501}, "501 lines")
        self.assert_clean("check_sizes.py", {"src/image/a_test.cpp": "int a;\n" * 501})

    def test_a_header_that_leans_on_others_is_found(self):
        self.assert_found("check_headers.py", {"include/petzval/a.h": "#pragma once\nstd::string name();\n"}, "a.h")
        self.assert_found("check_headers.py", {"include/petzval/a.h": "int twice = 0;\n"}, "a.h")
        self.assert_clean("check_headers.py", {"include/petzval/a.h": "#pragma once\n#include <string>\n"})

    def test_prose_that_hides_its_subject_is_found_in_pages(self):
        for line, word in (("The picture goes on.", "continue"), ("It is made of what lies there.", "name the thing"),
                           ("word " * 21, "105 columns"), ("It is\n" + "a word\n" * 17 + "long.", "37 words"),
                           ("From 1 to 2, 3, 4 or 5 px.", "5 numbers"), ("## What lies behind", "title"),
                           ("This page lists unusual files and options, with petzval's", "does not end")):
            self.assert_found("check_prose.py", {"docs/a.md": f"# A page\n\n{line}\n"}, "docs/a.md:", word)
        fine = "![A picture of a page with more than eight words](a.png)\n\n"
        fine += "| a table of 1 | 2 | 3 | 4 | 5 |\n```sh\n" + "goes on " * 30 + "\n```\n## What is a lens?\n`goes on`\n"
        self.assert_clean("check_prose.py", {"docs/a.md": fine, "docs/reference/command-line.md": "word " * 30})

    def test_prose_that_hides_its_subject_is_found_in_comments(self):
        for text in ("// What lies behind.\n", "int a; // fine\n// Of the batch.\n", "// A line\n// that goes on.\n"):
            self.assert_found("check_prose.py", {"src/image/a.cpp": text}, "src/image/a.cpp:")
        self.assert_clean("check_prose.py", {"src/image/a.cpp": "// Radius in pixels.\nint what = 1;  // Of it\n"})
        split = 'const char* text = "the blur goes "\n    "on";\n'
        self.assert_found("check_prose.py", {"apps/cli/a.cpp": split}, "apps/cli/a.cpp:1: 'goes on'")
        self.assert_clean("check_prose.py", {"apps/cli/a_test.cpp": split, "src/image/a.cpp": 'open("no such file");\n'})

    def test_a_count_of_findings_may_only_fall(self):
        source = {"src/image/a.cpp": "// What lies behind.\n\n// Of the batch.\n"}
        self.assert_clean("check_prose.py", source | {"tools/prose_allowed.txt": "2 src/image\n"})
        self.assert_clean("check_prose.py", source | {"tools/prose_allowed.txt": "3 src/image\n"})
        self.assert_found("check_prose.py", source | {"tools/prose_allowed.txt": "1 src/image\n"}, "2 findings, 1 are")

    def test_subjects_of_new_commits_are_found_and_those_of_a_clone_are_not(self):
        wrong = ("what is dark is averaged only where lights show", "docs: measured today", "a: lamps are moved",
                 "scatter: fix a tile that is as wide on one device as it is on another one")
        with tempfile.TemporaryDirectory() as folder:
            def run(*command):
                return subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            def commit(subject):
                run("git", "-C", "a", "-c", "user.name=n", "-c", "user.email=e", "commit", "--allow-empty", "-m", subject)
            def status(name):
                return run(sys.executable, TOOLS / "check_prose.py", pathlib.Path(folder) / name).returncode
            run("git", "init", "-b", "main", "a")
            commit("wrong before there were rules")
            run("git", "-C", "a", "switch", "-c", "work")
            for subject in wrong:
                commit("scatter, samples: skip dark pixels")
                self.assertEqual(status("a"), 0, subject)
                commit(subject)
                self.assertEqual(status("a"), 1, subject)
                run("git", "-C", "a", "branch", "-f", "main")
            run("git", "clone", "a", "full")
            run("git", "clone", "--depth", "1", "file://" + folder + "/a", "shallow")
            self.assertEqual([status("full"), status("shallow")], [0, 0])

    def test_a_page_of_tests_counts_them_and_refuses_tests_that_are_not_there(self):
        rows = "docs/a.md\n\n{counts}\n\n| fault | test |\n|---|---|\n| torn | `Law.HoldsLight` |\n| open one | |\n"
        test = {"src/a_test.cpp": "TEST(Law, HoldsLight) {}\n", "docs/b.md": ""}
        page = ("2 rows: 1 held, 1 open, by 1 tests.\n\n| fault | test | state |\n|---|---|---|\n"
                "| torn | `Law.HoldsLight` | held |\n| open one | | open |\n\n"
                "<!-- Generated by tools/test_pages.py from tests/index/a.txt; edit that file. -->\n")
        sound = test | {"tests/index/a.txt": rows, "docs/a.md": page}
        self.assertEqual(result_of("test_pages.py", sound, "--check")[0], 0)
        self.assertEqual(result_of("test_pages.py", sound | {"docs/a.md": "edited"}, "--check")[0], 1)
        self.assertEqual(result_of("test_pages.py", sound | {"src/a_test.cpp": ""}, "--check")[0], 1)


if __name__ == "__main__":
    unittest.main()
