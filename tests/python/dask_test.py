"""A campaign on a real Dask scheduler with two workers, one of which is killed in between."""

import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import distributed  # noqa: F401
    import numpy  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing} (python3-distributed)")
    sys.exit(77)

import campaign_case as case

SCHEDULER = "import sys; from distributed.cli.dask_scheduler import main; sys.exit(main())"
WORKER = "import sys; from distributed.cli.dask_worker import main; sys.exit(main())"


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class Dask(unittest.TestCase):
    def start(self, folder, code, *arguments):
        with open(os.path.join(folder, f"dask-{len(self.processes)}.log"), "w") as log:
            process = subprocess.Popen([sys.executable, "-B", "-c", code, *arguments], stdout=log, stderr=log, cwd=folder)
        self.processes.append(process)
        return process

    def tearDown(self):
        for process in self.processes:
            process.kill()
            process.wait()

    def setUp(self):
        self.processes = []

    def worker(self, folder, address):
        return self.start(folder, WORKER, address, "--nthreads", "1", "--no-nanny", "--no-dashboard",
                          "--local-directory", folder)  # fmt: skip

    def test_a_worker_killed_in_between_costs_nothing(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder, tempfile.TemporaryDirectory() as here:
            address = f"tcp://127.0.0.1:{free_port()}"
            self.start(folder, SCHEDULER, "--host", "127.0.0.1", "--port", address.rsplit(":", 1)[1], "--no-dashboard")
            first, _ = self.worker(folder, address), self.worker(folder, address)
            settings = dict(scene=case.scene(0.2))
            path = case.write(folder, **settings)
            running = subprocess.Popen(case.command(path, "--dask", address), stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)  # fmt: skip
            runs = os.path.join(folder, "campaign", "runs")
            while running.poll() is None and (not os.path.exists(runs) or len(os.listdir(runs)) < 3):
                time.sleep(0.02)
            before = len(os.listdir(runs))
            first.send_signal(signal.SIGKILL)
            self.worker(folder, address)
            said = running.communicate(timeout=300)
            self.assertEqual(running.returncode, 0, said)
            self.assertIn(before, range(3, 45), "nothing was killed in between")
            self.assertRegex(said[0], "^45 of 45 runs")
            self.assertEqual(case.run(case.write(here, **settings)).returncode, 0)
            self.assertEqual(case.table(folder), case.table(here))
            stamps = {f: os.stat(os.path.join(runs, f)).st_mtime_ns for f in os.listdir(runs)}
            again = case.run(path, "--dask", address)
            self.assertTrue(re.match("45 of 45", again.stdout), again)
            self.assertEqual(stamps, {f: os.stat(os.path.join(runs, f)).st_mtime_ns for f in os.listdir(runs)})

    def test_a_scheduler_killed_in_between_costs_what_was_running(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder, tempfile.TemporaryDirectory() as here:
            address = f"tcp://127.0.0.1:{free_port()}"
            place = ("--host", "127.0.0.1", "--port", address.rsplit(":", 1)[1], "--no-dashboard")
            scheduler = self.start(folder, SCHEDULER, *place)
            workers = [self.worker(folder, address) for _ in range(2)]
            settings = dict(scene=case.scene(0.2))
            path = case.write(folder, **settings)
            running = subprocess.Popen(case.command(path, "--dask", address), stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)  # fmt: skip
            runs = os.path.join(folder, "campaign", "runs")
            while running.poll() is None and (not os.path.exists(runs) or len(os.listdir(runs)) < 3):
                time.sleep(0.02)
            scheduler.send_signal(signal.SIGKILL)
            said = running.communicate(timeout=300)
            self.assertEqual(running.returncode, 4, said)
            self.assertRegex(said[1].splitlines()[-1], "^" + re.escape(address))
            stamps = {f: os.stat(os.path.join(runs, f)).st_mtime_ns for f in os.listdir(runs)}
            self.assertIn(len(stamps), range(3, 45), "nothing was killed in between")
            for worker in workers:
                worker.kill()
            self.start(folder, SCHEDULER, *place)
            for _ in range(2):
                self.worker(folder, address)
            again = case.run(path, "--dask", address)
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assertEqual(case.run(case.write(here, **settings)).returncode, 0)
            self.assertEqual(case.table(folder), case.table(here))
            for name, stamp in stamps.items():  # nothing that was done is done again
                self.assertEqual(os.stat(os.path.join(runs, name)).st_mtime_ns, stamp)


if __name__ == "__main__":
    unittest.main()
