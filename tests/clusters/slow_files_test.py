"""200 tasks at once in a folder in which each operation takes 20 ms, as on a file system that a busy cluster shares: what the program itself
costs for each case, with a stub in place of the engine.
"""

import os
import subprocess
import time
import unittest

from many_cases import DRIVER_OPTIONS, ManyCases
from trough_program import PROGRAM

CASES = 200
DELAY = 20_000  # us
LIMIT = 0.05  # s of the clock for each case


class SlowFiles(ManyCases):
    def setUp(self):
        super().setUp()
        # Nothing else than the campaign's folder is slow.
        self.slow = {"LD_PRELOAD": os.environ["VIBROTROUGH_SLOW_LIBRARY"], "VIBROTROUGH_SLOW_BELOW": str(self.output.resolve()), "VIBROTROUGH_SLOW_DELAY": str(DELAY)}

    def start(self, name, *words):
        """`name` is that of the list of its operations."""
        environment = dict(os.environ, **self.slow, VIBROTROUGH_SLOW_LOG=str(self.folder / f"{name}.operations"))
        return subprocess.Popen([PROGRAM, *map(str, words)], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def take(self, name, *all_words):
        """Runs the commands at the same time. @return s for each case: of the clock, and of waiting for operations"""
        begin = time.monotonic()
        processes = [self.start(name, *words) for words in all_words]
        for process in processes:
            said, _ = process.communicate()
            self.assertEqual(process.returncode, 0, said[-2000:])
        taken = (time.monotonic() - begin) / CASES
        operations = len((self.folder / f"{name}.operations").read_text().splitlines())
        print(f"{name}: {1000 * taken:.1f} ms and {operations / CASES:.1f} operations a case", flush=True)
        self.assertGreater(operations, 0, "the folder is slow")
        return taken, operations / CASES * DELAY / 1e6 / len(all_words)

    def test_the_program_itself_takes_less_than_50_ms_a_case(self):
        campaign = self.write_many("spheres", CASES)
        options = [option for option in DRIVER_OPTIONS if option != "--quiet"]
        tasks = self.folder / "tasks"
        shared = [campaign, "--output", self.output, "--liggghts", self.engine, *options]
        taken = {"prepare": self.take("prepare", ["prepare", *shared, "--task-list", tasks])}
        count = len(tasks.read_text().splitlines())
        self.assertEqual(count, CASES)
        work = [["work", self.output, "--task-list", tasks, "--index", i] for i in range(count)]
        self.call(*work[0])  # settles the packing that all share
        taken["work"] = self.take("work", *work)
        taken["run"] = self.take("run", ["run", *shared, "--quiet"])
        taken["status"] = self.take("status", ["status", self.output])
        taken["compare"] = self.take("compare", ["compare", self.output])
        self.assertEqual(len(self.results()), CASES)
        # The processor time of 200 processes that share the cores of a test's machine is not what this is about: a cluster has more of
        # them, and a real task works for minutes.
        for name, (seconds, waiting) in taken.items():
            self.assertLess(waiting if name == "work" else seconds, LIMIT, name)


if __name__ == "__main__":
    unittest.main()
