"""ofx-check finds nothing in a sound plug-in, and names the broken rule for each fault that is planted into it."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

OFX_CHECK = os.environ["OFX_CHECK"]
PLANTED, PLANTED_EXPORT = (pathlib.Path(os.environ[name]).parents[2] for name in ("PLANTED", "PLANTED_EXPORT"))
# The rule that each fault breaks; others may break with it.
FAULTS = {
    "bad_identifier": "plugin.struct", "wrong_version": "plugin.struct", "crashes": "process.survives",
    "hangs": "process.returns", "wrong_status": "action.status", "render_default": "action.status",
    "unknown_ok": "action.unknown", "no_contexts": "describe.contexts", "no_depths": "describe.depths",
    "no_output": "clips.mandated", "no_components": "clips.components", "undeclared_clip": "clips.declared",
    "needs_mask": "clips.optional", "wrong_object": "property.object", "wrong_type": "property.type",
    "bad_index": "property.index", "bad_value": "property.value", "writes_host": "property.write",
    "stale_handle": "handles.valid", "undeclared_param": "params.declared", "param_twice": "params.once",
    "bad_default": "params.default", "sets_in_render": "params.write_action", "extreme": "params.extremes",
    "refuses_choice": "params.chosen", "leaks_image": "images.released", "releases_twice": "images.released", "fetch_in_identity": "images.action",
    "after_release": "images.after_release", "writes_input": "images.input", "overruns": "images.bounds",
    "misses_row": "render.complete", "beyond_window": "render.window", "random": "render.repeat",
    "filter_fails": "render.contexts", "positive_rows": "rows.negative", "ignores_row_bytes": "rows.padding",
    "same_bounds": "bounds.offset", "ignores_scale": "scale.half", "local_window": "window.part",
    "small_region": "regions.enough", "bad_region": "regions.valid", "bad_identity": "identity.valid",
    "never_aborts": "abort.obeyed", "shared_state": "instances.apart", "thread_unsafe": "threads.same",
    "no_reload": "reload.same", "leaves_thread": "reload.threads", "trusts_suites": "host.missing_suite", "trusts_format": "host.bad_image",
    "trusts_images": "host.no_image", "silent_failure": "errors.message",
    "trusts_properties": "host.null_handles", "load_resets": "host.loads_again", "overlay_crash": "overlay.survives",
}
# Faults that sleep: the checks that meet them.
ONLY = {"hangs": ["contexts"], "never_aborts": ["abort"]}


class Planted(unittest.TestCase):
    def check(self, bundle, fault="", checks=()):
        words = [word for check in checks for word in ("--check", check)]
        done = subprocess.run([OFX_CHECK, str(bundle), "--size", "64x48", "--timeout", "3" if fault == "hangs" else "60", *words],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, timeout=200,
                              env={**os.environ, "PLANTED_FAULT": fault})
        return done, re.findall(r"^BROKEN +(\S+) ", done.stdout, re.M)

    def test_nothing_is_found_in_the_sound_plug_in(self):
        done, broken = self.check(PLANTED)
        self.assertEqual((done.returncode, broken), (0, []), done.stdout)
        self.assertNotIn("not tried", done.stdout)

    def test_each_planted_fault_is_named(self):
        for fault, rule in FAULTS.items():
            with self.subTest(fault=fault):
                done, broken = self.check(PLANTED, fault, ONLY.get(fault, ()))
                self.assertIn(rule, broken, done.stdout)
                self.assertEqual(done.returncode, 1, done.stdout)

    def test_every_rule_has_a_planted_fault(self):
        rules = subprocess.run([OFX_CHECK, "--rules"], stdout=subprocess.PIPE, text=True, check=True).stdout
        named = {line.split()[0] for line in rules.splitlines()}
        tested = set(FAULTS.values()) | {"bundle.layout", "exports.only", "exports.required"}  # below
        self.assertEqual(named - tested, set())

    def test_a_name_too_many_is_found(self):
        done, broken = self.check(PLANTED_EXPORT)
        self.assertEqual(broken, ["exports.only"], done.stdout)
        self.assertIn("planted_helper", done.stdout)

    def test_a_bundle_of_another_name_and_a_library_without_the_functions_are_found(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="petzval-ofx-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        shutil.copytree(PLANTED, folder / "other.ofx.bundle")
        self.assertEqual(self.check(folder / "other.ofx.bundle")[1], ["bundle.layout"])
        empty = folder / "empty.ofx.bundle/Contents/Linux-x86-64/empty.ofx"
        empty.parent.mkdir(parents=True)
        empty.write_text("no library")
        self.assertIn("exports.required", self.check(empty.parents[2])[1])

    def test_what_cannot_be_checked_is_refused_in_one_line(self):
        for words in (["/none.ofx.bundle"], [], [str(PLANTED), "--size", "1x1"], [str(PLANTED), "--param", "x"],
                      [str(PLANTED), "--tomorrow", "1"], ["render", str(PLANTED)]):
            done = subprocess.run([OFX_CHECK, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            if words:
                self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), (words, done))


if __name__ == "__main__":
    unittest.main()
