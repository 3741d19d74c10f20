"""Tasks of a real Slurm that are warned before their end, and tasks that are not: what they have simulated is kept."""

import os
import re
import signal
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from private_slurm import RUN_ON_SLURM, PrivateSlurm  # noqa: E402
from trough_program import EndToEndTest, campaign_text, count_cycles, engines_in, wait_until  # noqa: E402

WARNED = 'extra = ["--requeue", "--signal=B:USR1@60"]\n'
# Nobody would stop this for an hour.
ENDLESS = {"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 1000000}


class Requeue(EndToEndTest):
    def start_slurm(self, **settings):
        return PrivateSlurm.for_test(self, **settings)

    def submit(self, asked):
        campaign = self.folder / "campaign.toml"
        campaign.write_text(campaign_text(ENDLESS) + asked)
        self.campaign = campaign
        return re.search(r"submitted as job (\d+)\n", self.run_campaign(campaign).stdout)[1]

    def cycles(self):
        files = list(self.output.glob("cases/*/packing-1/cycles.csv"))
        return count_cycles(files[0]) if files else 0

    def checkpoint(self):
        """The cycle of the sealed checkpoint."""
        files = list(self.output.glob("cases/*/packing-1/checkpoint.json"))
        match = re.search(r'"cycle": *(\d+)', files[0].read_text()) if files else None
        return int(match[1]) if match else 0

    def continued_engine(self):
        """The cycle from which an engine that runs now was continued; None while there is none."""
        for process in engines_in(self.output):
            try:
                words = Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if b"done" in words:
                return int(words[words.index(b"done") + 1])
        return None

    def outcome(self):
        (case,) = self.ask_json("status")["cases"]
        return case["outcome"]

    def test_a_warned_task_writes_a_checkpoint_and_is_queued_again(self):
        slurm = self.start_slurm(cpus=1, requeue_delay=20)
        job = self.submit(RUN_ON_SLURM + WARNED)
        wait_until(lambda: self.cycles() > 30, "some cycles were simulated")
        begin = time.monotonic()
        self.assertEqual(slurm.command("scancel", "--batch", "--signal=USR1", f"{job}_0").returncode, 0)
        wait_until(lambda: "PENDING" in slurm.command("squeue", "-h", "-j", job, "-o", "%T").stdout, "the task was queued again")
        print(f"from the warning to the queue: {time.monotonic() - begin:.1f} s")
        reached = self.cycles()
        self.assertEqual(self.checkpoint(), reached, "no cycle is lost")
        self.assertEqual(self.outcome(), "queued")
        self.assertFalse((self.output / "slurm" / "0001" / "task-0.ended").exists())
        self.assertRegex(self.run_campaign(self.campaign).stdout, r"1 packings are in Slurm's queue already\n")

        self.assertEqual(wait_until(self.continued_engine, "the task went on"), reached)
        self.assertEqual(self.outcome(), "running")
        # A person who cancels it means it.
        slurm.command("scancel", job)
        wait_until(lambda: self.outcome() == "interrupted", "the task had ended")

    def test_a_task_is_warned_before_its_time_is_over(self):
        """Slurm sends the warning up to a minute earlier than asked for. A layer that had not settled by then would begin anew."""
        slurm = self.start_slurm(cpus=1, requeue_delay=20)
        self.submit(RUN_ON_SLURM.replace("10 minutes", "3 minutes") + WARNED)
        reached = wait_until(lambda: slurm.command("squeue", "-h", "-o", "%T").stdout.startswith("PENDING") and self.cycles() and self.checkpoint(), "it was queued again")
        self.assertEqual(wait_until(self.continued_engine, "the task went on"), reached)
        self.assertEqual(self.outcome(), "running")

    def test_killed_at_the_limit_without_a_warning_it_goes_on_from_its_checkpoint(self):
        slurm = self.start_slurm(cpus=1)
        # The program ends a packing before Slurm does; where it cannot, Slurm kills it.
        self.submit(RUN_ON_SLURM.replace("10 minutes", "1 minute"))
        engine = wait_until(lambda: self.checkpoint() > 0 and self.continued_engine() and engines_in(self.output)[0], "a checkpoint was sealed")
        work = int(Path(f"/proc/{engine}/stat").read_text().rpartition(")")[2].split()[1])
        os.kill(work, signal.SIGSTOP)
        wait_until(lambda: not slurm.command("squeue", "-h").stdout.strip(), "Slurm has ended the task")
        kept = self.checkpoint()
        self.assertGreater(kept, 0)
        wait_until(lambda: self.outcome() == "time-limit", "Slurm said how the task ended")

        self.run_campaign(self.campaign)
        self.assertGreaterEqual(wait_until(self.continued_engine, "the packing went on"), kept)


if __name__ == "__main__":
    unittest.main()
