"""A campaign whose engines work in the scratch folder of their node, through a real Slurm."""

import json
import os
import shutil
import signal
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from private_slurm import RUN_ON_SLURM, PrivateSlurm  # noqa: E402
from trough_program import EndToEndTest, campaign_text, engines_in, pause, wait_until, without_wall_time  # noqa: E402

# Long enough to be killed on the way, and then finished.
CHANGES = {"measure.packings": 2, "measure.max_packings": 2, "measure.half_width": 0.00001, "measure.max_cycles": 192, "output.checkpoint_cycles": 5}


def parent_of(process):
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


class ClusterScratch(EndToEndTest):
    def write(self, asked):
        path = self.folder / "campaign.toml"
        path.write_text(campaign_text(CHANGES) + asked.replace("[run]\n", '[run]\nscratch = "$TMPDIR"\n'))
        return path

    def catch_a_simulation(self, node):
        """Stops an engine that works on the node, after a checkpoint of it has come back."""

        def found():
            seals = [path for path in self.output.glob("cases/*/packing-*/checkpoint.json") if json.loads(path.read_text())["cycle"] < 150]
            for number in engines_in(node) if seals else []:
                try:
                    place = Path(os.readlink(f"/proc/{number}/cwd"))
                    if (place / "checkpoint.json").is_file() and pause(number):
                        return number, place
                except OSError:
                    pass  # ended meanwhile
            return None

        return wait_until(found, "an engine ran on the node, and a checkpoint had come back")

    def wait_for_the_end(self):
        def over():
            status = self.ask_json("status")
            return not {case["outcome"] for case in status["cases"]} & {"queued", "running", "unknown"} and status

        return wait_until(over, "no task was left")

    def lose_a_node_on_the_way(self, asked, node):
        campaign = self.write(asked)
        self.run_campaign(campaign)
        engine, place = self.catch_a_simulation(node)
        self.assertEqual(engines_in(self.output), [], "no engine works in the campaign's folder")
        work = parent_of(engine)
        for process in (parent_of(work), work, engine):
            self.assertGreater(process, 1)
            os.kill(process, signal.SIGKILL)
        wait_until(lambda: not Path(f"/proc/{engine}").exists() or engine not in engines_in(node), "the task was dead")
        shutil.rmtree(place)  # the disk of the node
        self.wait_for_the_end()
        self.take_starts()
        self.run_campaign(campaign)
        self.wait_for_the_end()
        self.run_campaign(campaign, wanted=None)  # what the next round wants, if there is one
        self.wait_for_the_end()
        campaign.write_text(campaign.read_text().partition("[run]")[0])
        self.run_campaign(campaign, output=self.folder / "local", wanted=None)
        self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(self.folder / "local")))
        self.assertEqual(list(node.rglob("vibrotrough-scratch-*")), [], "nothing is left on the node")

    def test_slurm(self):
        node = self.folder / "node"
        node.mkdir()
        os.environ["TMPDIR"] = str(node)  # sbatch hands it on
        self.addCleanup(os.environ.pop, "TMPDIR", None)
        PrivateSlurm.for_test(self, cpus=2)
        self.lose_a_node_on_the_way(RUN_ON_SLURM, node)


if __name__ == "__main__":
    unittest.main()
