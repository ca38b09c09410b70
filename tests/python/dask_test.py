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


def stamps(folder):
    """When each file there was last written."""
    return {name: os.stat(os.path.join(folder, name)).st_mtime_ns for name in os.listdir(folder)}


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

    def scheduler(self, folder, port):
        return self.start(folder, SCHEDULER, "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")

    def begin(self, path, address):
        """A campaign that has finished a few of its runs, and the folder of these."""
        running = subprocess.Popen(case.command(path, "--dask", address), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)  # fmt: skip
        runs = os.path.join(os.path.dirname(path), "campaign", "runs")
        while running.poll() is None and (not os.path.exists(runs) or len(os.listdir(runs)) < 3):
            time.sleep(0.02)
        return running, runs

    def assert_whole(self, folder, settings):
        """The table is that of a campaign that was left alone."""
        with tempfile.TemporaryDirectory() as here:
            self.assertEqual(case.run(case.write(here, **settings)).returncode, 0)
            self.assertEqual(case.table(folder), case.table(here))

    def test_a_worker_killed_in_between_costs_nothing(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            port = free_port()
            address = f"tcp://127.0.0.1:{port}"
            self.scheduler(folder, port)
            first, _ = self.worker(folder, address), self.worker(folder, address)
            settings = dict(scene=case.scene(0.2))
            path = case.write(folder, **settings)
            running, runs = self.begin(path, address)
            before = len(os.listdir(runs))
            first.send_signal(signal.SIGKILL)
            self.worker(folder, address)
            said = running.communicate(timeout=300)
            self.assertEqual(running.returncode, 0, said)
            self.assertIn(before, range(3, 45), "nothing was killed in between")
            self.assertRegex(said[0], "^45 of 45 runs")
            self.assert_whole(folder, settings)
            done = stamps(runs)
            again = case.run(path, "--dask", address)
            self.assertTrue(re.match("45 of 45", again.stdout), again)
            self.assertEqual(done, stamps(runs))

    def test_a_scheduler_killed_in_between_costs_what_was_running(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            port = free_port()
            address = f"tcp://127.0.0.1:{port}"
            scheduler = self.scheduler(folder, port)
            workers = [self.worker(folder, address) for _ in range(2)]
            settings = dict(scene=case.scene(0.2))
            path = case.write(folder, **settings)
            running, runs = self.begin(path, address)
            scheduler.send_signal(signal.SIGKILL)
            said = running.communicate(timeout=300)
            self.assertEqual(running.returncode, 4, said)
            self.assertRegex(said[1].splitlines()[-1], "^" + re.escape(address))
            done = stamps(runs)
            self.assertIn(len(done), range(3, 45), "nothing was killed in between")
            for worker in workers:
                worker.kill()
            self.scheduler(folder, port)
            for _ in range(2):
                self.worker(folder, address)
            again = case.run(path, "--dask", address)
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assert_whole(folder, settings)
            now = stamps(runs)
            self.assertEqual(done, {name: now[name] for name in done})  # nothing that was done is done again


if __name__ == "__main__":
    unittest.main()
