"""kill -9 at random moments of a campaign on Slurm: of the driver that waits, of engines, of tasks, with and without their shell. The
campaign comes out as if nothing had been.

The moments come from a generator with a fixed seed, but the machine's own timing decides what they hit; what is checked
holds for every moment.
"""

import collections
import os
import random
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from private_slurm import RUN_ON_SLURM, PrivateSlurm  # noqa: E402
from trough_program import PROGRAM, EndToEndTest, campaign_text, engines_in, fingerprint, wait_until, without_wall_time  # noqa: E402

KILLS = int(os.environ.get("VIBROTROUGH_KILLS", "6"))
SEED = int(os.environ.get("VIBROTROUGH_SEED", "1"))
# The fewest grains that settle and the fewest cycles that may be asked for: a packing takes less than a second. As many at first
# as at most, so that a packing that is finished gets no further cycles.
CHANGES = {"measure.packings": 2, "measure.min_cycles": 20, "measure.max_cycles": 20, "measure.half_width": 1.0}
SWEEP = {"layer.grains": [20, 24, 28, 32]}
PACKINGS = 8


def parent_of(process):
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


class SlurmKills(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.random = random.Random(SEED)
        self.slurm = PrivateSlurm.for_test(self, cpus=2)
        self.campaign = self.folder / "campaign.toml"
        self.campaign.write_text(campaign_text(CHANGES, SWEEP) + RUN_ON_SLURM)

    def start_waiting(self):
        command = [PROGRAM, *map(str, self.run_arguments(self.campaign)), "--wait"]
        driver = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(self.end, driver)
        return driver

    def task_of_an_engine(self):
        """(engine, work, shell) of a task that simulates or settles; None when there is none now."""
        engines = engines_in(self.output)
        if not engines:
            return None
        engine = self.random.choice(engines)
        try:
            work = parent_of(engine)
            return engine, work, parent_of(work)
        except (OSError, ValueError):
            return None  # ended meanwhile

    def kill(self, *victims):
        killed = False
        for victim in victims:
            try:
                os.kill(victim, signal.SIGKILL)
                killed = True
            except ProcessLookupError:
                pass
        return killed

    def strike(self, driver):
        """Kills somebody after a random time. @return who was killed, or None"""
        time.sleep(min(self.random.expovariate(1 / 0.7), 4))
        who = self.random.choice(("driver", "driver", "engine", "work", "task"))
        if who == "driver":
            return who if driver.poll() is None and self.kill(driver.pid) else None
        try:
            task = wait_until(lambda: driver.poll() is not None or self.task_of_an_engine(), "a task ran")
        except AssertionError:
            return None
        if task is True:
            return None
        engine, work, shell = task
        victims = {"engine": (engine,), "work": (work,), "task": (shell, work)}[who]
        if 1 in victims:
            return None  # the parent has ended meanwhile
        return who if self.kill(*victims) else None

    def finished_packings(self):
        markers = self.output.glob("cases/*/packing-*/packing.json")
        return {"/".join(marker.parts[-3:-1]): fingerprint(marker) for marker in markers}

    def wait_for_an_empty_queue(self):
        wait_until(lambda: not self.slurm.command("squeue", "-h").stdout.strip(), "no task was left in Slurm")

    def finish_campaign(self):
        for _ in range(10):  # a case that lost a task counts as failed in this run, and is tried again by the next
            self.wait_for_an_empty_queue()
            if self.start_waiting().wait() in (0, 1) and self.ask_json("status")["left"] == 0 and self.ask_json("status")["failed"] == 0:
                return
        self.fail(f"the campaign does not come to its end: {self.ask_json('status')}")

    def campaign_under_fire(self, most):
        """One campaign, struck until it is finished or `most` were killed, and then brought to its end."""
        killed = collections.Counter()
        kept = {}
        driver = None
        while sum(killed.values()) < most:
            if driver is None or driver.poll() is not None:
                driver = self.start_waiting()
            if who := self.strike(driver):
                killed[who] += 1
            now = self.finished_packings()
            for name, before in kept.items():
                self.assertEqual(now.get(name), before, f"{name} was finished and is not what it was")
            kept = now
            if len(list(self.output.glob("cases/*/result.h5"))) == len(SWEEP["layer.grains"]):
                break
        if driver.poll() is None:
            self.kill(driver.pid)
        driver.wait()
        self.finish_campaign()
        now = self.finished_packings()
        for name, before in kept.items():
            self.assertEqual(now.get(name), before, f"{name} was finished and is not what it was")
        self.assertEqual(len(now), PACKINGS)
        return killed

    def test_killed_at_random_moments(self):
        local = self.folder / "local.toml"
        local.write_text(campaign_text(CHANGES, SWEEP))
        undisturbed = self.folder / "undisturbed"
        self.call(*self.run_arguments(local, undisturbed))
        wanted = without_wall_time(self.table(undisturbed))
        self.assertNotIn(None, [row["efficiency"] for row in wanted], wanted)
        killed = collections.Counter()
        campaigns = 0
        while sum(killed.values()) < KILLS:
            campaigns += 1
            self.output = self.folder / f"runs-{campaigns}"
            killed += self.campaign_under_fire(KILLS - sum(killed.values()))
            self.assertEqual(without_wall_time(self.table()), wanted)
            left = [str(path) for path in self.output.rglob("*") if ".part-" in path.name]
            self.assertEqual(left, [], "nothing half-written stays")
        print(f"{sum(killed.values())} kills on Slurm in {campaigns} campaigns: {dict(killed)}")


if __name__ == "__main__":
    unittest.main()
