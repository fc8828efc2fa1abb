"""Runs the built program as a user does. PETZVAL names it; each test has a folder of its own."""
import json
import os
import resource
import shutil
import signal
import subprocess
import tempfile
import unittest

PETZVAL = os.environ.get("PETZVAL", "petzval")
# A program with a sanitizer is slow and reserves terabytes of addresses, which ulimit -v would refuse.
SANITIZED = "PETZVAL_SANITIZED" in os.environ
TIME_LIMIT_S = 300 if SANITIZED else 60
CAMERA = ["--focal-length", "50mm", "--sensor-width", "36mm", "--fstop", "1.4", "--focus", "2m"]


def address_space(mebibytes):
    """For run_program(limits=…): ulimit -v, without core files."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if not SANITIZED:
            resource.setrlimit(resource.RLIMIT_AS, (mebibytes << 20,) * 2)
    return limit


class Outcome:
    def __init__(self, code, out, err):
        self.code, self.out, self.err = code, out, err
        self.lines = err.splitlines()

    def __str__(self):
        return "exit %d\nstdout: %s\nstderr: %s" % (self.code, self.out[:2000], self.err[:2000])


class CommandLineTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="petzval-test-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def content(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def run_program(self, *args, limits=None, stdout=subprocess.PIPE, env=None):
        """limits: called in the child before the program starts."""
        def before():
            signal.signal(signal.SIGINT, signal.SIG_DFL)
            if limits:
                limits()
        done = subprocess.run([PETZVAL, *args], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=stdout,
                              stderr=subprocess.PIPE, timeout=TIME_LIMIT_S, preexec_fn=before,
                              env={**os.environ, "PETZVAL_KERNEL_CACHE": "off", **(env or {})})
        return Outcome(done.returncode, (done.stdout or b"").decode(), done.stderr.decode())

    def succeed(self, *args, **options):
        outcome = self.run_program(*args, **options)
        self.assertEqual(outcome.code, 0, "petzval %s\n%s" % (" ".join(args), outcome))
        return outcome

    def refuse(self, code, *args, says=(), **options):
        """One line that says what is wrong, the right exit code, and nothing new on disk or standard output."""
        before = sorted(os.listdir(self.folder))
        outcome = self.run_program(*args, **options)
        where = "petzval %s\n%s" % (" ".join(args), outcome)
        self.assertEqual(outcome.code, code, where)
        self.assertEqual(outcome.out, "", where)
        errors = [l for l in outcome.lines if l.startswith("petzval: ") and not l.startswith("petzval: warning")]
        self.assertEqual(len(errors), 1, where)
        self.assertEqual(outcome.lines[-1], errors[0], where)
        self.assertTrue(outcome.err.endswith("\n"), where)
        self.assertLess(len(errors[0]), 500, where)
        for word in says:
            self.assertIn(word, errors[0], where)
        self.assertEqual(sorted(os.listdir(self.folder)), before, where)
        return outcome

    def report(self, *args, **options):
        """The --json report of a command."""
        return json.loads(self.succeed(*args, "--json", "-", **options).out)
