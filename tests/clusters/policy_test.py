"""A policy that adds a packing to every case and a case to the campaign, while the campaign runs: on this machine and through a
real Slurm, killed on the way, and with the same table at the end.
"""

import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from private_slurm import RUN_ON_SLURM, PrivateSlurm  # noqa: E402
from trough_program import EndToEndTest, campaign_text, engines_in, fingerprint, wait_until, without_wall_time  # noqa: E402

GROWING = os.environ["VIBROTROUGH_GROWING_POLICY"]
# One case with two packings in the campaign file; the policy makes it two cases with three each.
CHANGES = {"measure.packings": 2, "measure.half_width": 0.2}


class GrowingPolicy(EndToEndTest):
    def setUp(self):
        super().setUp()
        # The program finds the engine on the PATH; this one counts its starts.
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "liggghts").symlink_to(self.engine)
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}

    def start(self, campaign, output):
        return subprocess.Popen([GROWING, "run", campaign, output], env=self.environment, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)  # fmt: skip

    def finish(self, campaign, output):
        process = self.start(campaign, output)
        said, errors = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 0, said + errors)
        self.assertRegex(said, "2 cases, 2 finished, 0 failed")

    def check_growth(self, output):
        table = self.table(output)
        self.assertEqual([row["packings"] for row in table], [3, 3])
        self.assertEqual(sorted(row["friction"] for row in table), [0.115, 0.23])
        self.assertEqual(len(list(Path(output).glob("added/*/scenario.toml"))), 1, "the case is added once")
        return without_wall_time(table)

    def write(self, text=""):
        path = self.folder / "campaign.toml"
        path.write_text(campaign_text(CHANGES) + text)
        return path

    def kill_and_finish(self, campaign, output):
        """Kills the driver three times: with the first packings, with the added packing, and with the added case."""
        moments = [
            lambda: engines_in(output),
            lambda: list(Path(output).glob("cases/*/packing-3/cycles.csv")),
            lambda: list(Path(output).glob("added/*/scenario.toml")),
        ]
        for moment in moments:
            process = self.start(campaign, output)
            wait_until(lambda: moment() or process.poll() is not None, "the moment to kill came")
            process.send_signal(signal.SIGKILL)
            process.communicate()
        kept = {path: fingerprint(path) for path in Path(output).glob("cases/*/packing-*/packing.json")}
        self.finish(campaign, output)
        for path, before in kept.items():
            self.assertEqual(fingerprint(path), before, f"{path} was run again")

    def test_a_signal_before_the_engine_begins_is_an_interruption(self):
        """Where nothing ran yet there is nothing to interrupt, but a scheduler's signal must not end the process without a word."""
        output = self.folder / "stopped"
        tasks = self.folder / "tasks.txt"
        done = self.call("prepare", self.write(), "--output", output, "--liggghts", self.engine, "--task-list", tasks)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.starts_file.write_text("")  # those of the engine's test are not meant
        stopped = subprocess.run([GROWING, "stop", output, "--task-list", tasks, "--index", "0"], env=self.environment, capture_output=True, text=True)
        self.assertEqual((stopped.returncode, stopped.stdout), (130, "the run was interrupted\n"), stopped.stderr)
        self.assertEqual(self.starts_file.read_text(), "", "no engine was started")

    def test_on_both_executors_and_after_kills(self):
        campaign = self.write()
        undisturbed = self.folder / "undisturbed"
        self.finish(campaign, undisturbed)
        expected = self.check_growth(undisturbed)
        # What the policy added stays part of the campaign for every command.
        self.assertEqual(self.ask_json("status", undisturbed)["cases_total"], 2)

        killed = self.folder / "killed"
        self.kill_and_finish(campaign, killed)
        self.assertEqual(self.check_growth(killed), expected)

        self.environment["SLURM_CONF"] = PrivateSlurm.for_test(self, cpus=2).environment["SLURM_CONF"]
        on_cluster = self.folder / "cluster"
        self.kill_and_finish(self.write(RUN_ON_SLURM), on_cluster)
        self.assertEqual(self.check_growth(on_cluster), expected)


if __name__ == "__main__":
    unittest.main()
