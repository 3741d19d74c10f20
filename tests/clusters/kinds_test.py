"""Each kind of machine (end_to_end/kinds_of_machines_test.py) on a cluster. A Slurm is killed an engine and the driver under; the campaign comes out as
it does on this machine, and its frames, its table and its archive are those of that kind.
"""

import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from kinds_of_machines_test import KINDS, KindTest  # noqa: E402
from private_slurm import RUN_ON_SLURM, PrivateSlurm  # noqa: E402
from trough_program import PROGRAM, engines_in, wait_until, without_wall_time  # noqa: E402


class KindsOnSlurm(KindTest):
    def setUp(self):
        super().setUp()
        self.slurm = PrivateSlurm.for_test(self, cpus=2)

    def start_waiting(self, campaign):
        command = [PROGRAM, *map(str, self.run_arguments(campaign)), "--wait"]
        driver = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        self.addCleanup(self.end, driver)
        return driver

    def strike(self, campaign):
        """kill -9 of an engine beyond its first checkpoint and of the driver that waits."""
        driver = self.start_waiting(campaign)
        wait_until(lambda: driver.poll() is not None or list(self.output.glob("cases/*/packing-1/checkpoint.json")), "a checkpoint was written")
        engines = engines_in(self.output)
        for engine in engines:
            os.kill(engine, signal.SIGKILL)
        driver.kill()
        driver.wait()
        wait_until(lambda: not self.slurm.command("squeue", "-h").stdout.strip(), "no task was left in Slurm")
        return len(engines)

    def finish_campaign(self, campaign):
        for _ in range(5):  # a case that lost a task counts as failed in this run, and is tried again by the next
            self.start_waiting(campaign).wait()
            state = self.ask_json("status")
            if state["left"] == 0 and state["failed"] == 0:
                return
        self.fail(f"the campaign does not come to its end: {state}")

    def check_kind(self, kind):
        wanted = [self.run_kind(kind)]
        self.output = self.folder / f"{kind} on Slurm"
        campaign = self.write_kind(kind, RUN_ON_SLURM)
        killed = self.strike(campaign)
        self.finish_campaign(campaign)
        self.assertEqual(without_wall_time(self.table()), wanted)
        self.check_frames()
        self.check_bundle(self.table()[0])
        return killed

    def test_each_kind_survives_kills_on_slurm(self):
        killed = {}
        for kind in KINDS:
            with self.subTest(kind):
                killed[kind] = self.check_kind(kind)
        print("engines that were killed:", killed)
        self.assertGreater(sum(killed.values()), len(KINDS) // 2)


if __name__ == "__main__":
    unittest.main()
