"""`jawari campaign` of the build tree: the package beside the program, its help, and what is said without a Python."""

import os
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401: what the package needs
except ImportError:
    print("SKIPPED: no NumPy here (python3-numpy)")
    sys.exit(77)

import campaign_case as case

PROGRAM = sys.argv.pop(1)


def run(*words, **changes):
    settings = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    settings.update(changes)
    return subprocess.run([PROGRAM, "campaign", *words], capture_output=True, text=True, env=settings)


class Command(unittest.TestCase):
    def test_it_runs_a_campaign(self):
        with tempfile.TemporaryDirectory() as folder:
            path = case.write(folder, axes={"duration_s": [0.001, 0.002]}, random={})
            done = run(path, "--jobs", "1")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(case.table(folder).count("\n"), 3)
            self.assertEqual(run(path, "--list").stdout.count("\n"), 2)

    def test_failures_keep_their_exit_codes(self):
        self.assertEqual(run("/nowhere.json").returncode, 4)
        self.assertEqual(run().returncode, 2)
        self.assertIn("usage: jawari campaign", run("--help").stdout)

    def test_without_python_it_says_so(self):
        said = run("x.json", JAWARI_PYTHON="/nowhere/python3")
        self.assertEqual((said.returncode, said.stderr.count("\n")), (4, 1))
        self.assertIn("/nowhere/python3", said.stderr)


if __name__ == "__main__":
    unittest.main()
