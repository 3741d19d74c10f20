"""Several packings at once inside one task of a real Slurm."""

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
        """Runs the campaign in one task. @return s, from the first word of the task to its last"""
        self.output = self.folder / output
        campaign = self.folder / "campaign.toml"
        campaign.write_text(campaign_text(CHANGES, SWEEP) + RUN_ON_SLURM + asked)
        done = self.run_campaign(campaign)
        self.job = re.search(r"8 packings submitted as job (\d+)\n", done.stdout)[1]
        batch = self.output / "slurm" / "0001"
        self.assertEqual(len((batch / "tasks.txt").read_text().splitlines()), 1)
        wait_until((batch / "task-0.ended").is_file, "the task ended")
        self.assertEqual(self.ask_json("status")["finished"], 2)
        return (batch / "task-0.ended").stat().st_mtime - (batch / "task-0.started").stat().st_mtime

    def test_two_engines_in_one_task_take_half_the_time_of_one_after_the_other(self):
        slurm = self.start_slurm(cpus=4)
        # Each engine also waits, so that the time does not depend on what else the machine does.
        os.environ["VIBROTROUGH_TEST_BREAK"] = "sleep 4"
        one = self.run_in("one", "minutes_per_task = 600\n")
        self.take_starts()
        two = self.run_in("two", "minutes_per_task = 600\ncores_per_task = 2\n")
        self.assertEqual(self.take_starts(), sorted({f"{row['case']}/packing-{n}" for row in self.table() for n in range(1, 5)}), "each packing once")
        print(f"8 packings in one task: {one:.1f} s one after the other, {two:.1f} s two at once")
        self.assertLess(two, 0.65 * one)
        self.assertGreater(two, 0.4 * one)
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
