"""Several packings at once inside one task of a real Slurm."""

import itertools
import os
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from private_slurm import RUN_ON_SLURM, PrivateSlurm  # noqa: E402
from trough_program import EndToEndTest, campaign_text, wait_until, without_wall_time  # noqa: E402

CHANGES = {"measure.packings": 4}
SWEEP = {"layer.grains": [60, 70]}


class Allocation(EndToEndTest):
    def start_slurm(self, **settings):
        return PrivateSlurm.for_test(self, **settings)

    def run_in(self, output, asked):
        """Runs the campaign in one task."""
        self.output = self.folder / output
        campaign = self.folder / "campaign.toml"
        campaign.write_text(campaign_text(CHANGES, SWEEP) + RUN_ON_SLURM + asked)
        done = self.run_campaign(campaign)
        self.job = re.search(r"8 packings submitted as job (\d+)\n", done.stdout)[1]
        batch = self.output / "slurm" / "0001"
        self.assertEqual(len((batch / "tasks.txt").read_text().splitlines()), 1)
        wait_until((batch / "task-0.ended").is_file, "the task ended")
        self.assertEqual(self.ask_json("status")["finished"], 2)

    def most_at_once(self, output, asked):
        """Runs the campaign in one task. @return the most engines that ran at the same time"""
        log = self.folder / f"{output}.log"
        # Each engine also waits, so that two that run at once are seen to, however busy the machine is.
        os.environ["VIBROTROUGH_TEST_BREAK"] = f'echo "$(date +%s.%N) 1" >> "{log}"; sleep 2; echo "$(date +%s.%N) -1" >> "{log}"'
        self.run_in(output, asked)
        changes = sorted((float(time), int(change)) for time, change in map(str.split, log.read_text().splitlines()))
        return max(itertools.accumulate(change for _, change in changes))

    def test_two_engines_run_at_once_in_one_task(self):
        slurm = self.start_slurm(cpus=4)
        self.assertEqual(self.most_at_once("one", "minutes_per_task = 600\n"), 1)
        self.take_starts()
        self.assertEqual(self.most_at_once("two", "minutes_per_task = 600\ncores_per_task = 2\n"), 2)
        self.assertEqual(self.take_starts(), sorted({f"{row['case']}/packing-{n}" for row in self.table() for n in range(1, 5)}), "each packing once")
        job = slurm.command("scontrol", "show", "job", self.job).stdout
        self.assertIn("NumCPUs=2", job)
        self.assertRegex(job, r"TimeLimit=00:40:00", "eight packings of ten minutes on two cores")
        self.assertRegex(job, r"[Mm]em=400M", "two packings of 200 MB")
        self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(self.folder / "one")))

    def test_a_task_gets_a_packing_for_each_of_its_cores(self):
        slurm = self.start_slurm(cpus=4)
        campaign = self.folder / "campaign.toml"
        campaign.write_text(campaign_text(CHANGES | {"measure.packings": 6}) + RUN_ON_SLURM + "cores_per_task = 4\n")
        job = re.search(r"6 packings submitted as job (\d+)\n", self.run_campaign(campaign).stdout)[1]
        sizes = [len(line.split()) // 2 for line in (self.output / "slurm" / "0001" / "tasks.txt").read_text().splitlines()]
        self.assertEqual(sizes, [4, 2])
        self.assertIn("NumCPUs=4", slurm.command("scontrol", "show", "job", job).stdout)
        wait_until(lambda: self.ask_json("status")["finished"] == 1, "the case was finished")


if __name__ == "__main__":
    unittest.main()
