"""Each kind of machine on a cluster: an own trough, an open one, which is fed with a mixture or in stages, a mixture, a drive in stages,
screens with a batch and with a feed, and what has files of its own, wear and impacts. A Slurm is killed an engine and the driver under; the campaign comes out as it does on this
machine, and its frames, its table and its archive are those of that kind.
"""

import json
import os
import re
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
import fed_screen_test  # noqa: E402
import impacts_test  # noqa: E402
import mixture_test  # noqa: E402
import open_trough_test  # noqa: E402
import own_trough_test  # noqa: E402
import screen_test  # noqa: E402
import stages_test  # noqa: E402
import wear_test  # noqa: E402
from private_slurm import RUN_ON_SLURM, PrivateSlurm  # noqa: E402
from trough_program import PROGRAM, EndToEndTest, campaign_text, engines_in, wait_until, without_wall_time  # noqa: E402

# One packing with one frame per cycle. What is frequent enough that a kill costs cycles, and rare enough that it costs some.
SHARED = {"measure.packings": 1, "measure.max_packings": 1, "output.frames_per_cycle": 1, "output.checkpoint_cycles": 6}
# Of each kind: changes of the smallest campaign, text after it, and which columns of the table must have a number.
KINDS = {
    "own trough": ({**own_trough_test.CHANGES, "trough.mesh": "own.stl"}, "", ["efficiency"]),
    "open": (open_trough_test.OPEN, "", ["outflow_t_per_h", "residence_time_s"]),
    "fed mixture": (open_trough_test.OPEN, open_trough_test.MATERIALS, ["outflow_t_per_h", "segregation"]),
    "fed stages": ({**open_trough_test.OPEN, "measure.min_cycles": None, "measure.max_cycles": None}, open_trough_test.STAGES, ["outflow_t_per_h", "stage_speed_m_per_s"]),
    "mixture": (mixture_test.LAYER, mixture_test.MATERIALS, ["segregation"]),
    "stages": ({**stages_test.DRIVE, **stages_test.PLAN}, stages_test.STAGES, ["stage_speed_m_per_s"]),
    "screen": (screen_test.SCREEN, "", ["screening_efficiency"]),
    "fed screen": (fed_screen_test.FED_SCREEN, "", ["screening_efficiency", "outflow_t_per_h"]),
    "wear": (wear_test.SHORT, "", ["specific_wear_j_per_t_m"]),
    "impacts": (impacts_test.SHORT, "", ["impact_power_w_per_kg", "trough_impact_power_w_per_kg"]),
}
WITHOUT_MOST = ("stages", "screen", "fed stages")  # these refuse measure.max_packings


class Kinds(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.slurm = PrivateSlurm.for_test(self, cpus=2)
        (self.folder / "own.stl").write_bytes(own_trough_test.stl(own_trough_test.FLOOR + own_trough_test.WALLS))

    def write_kind(self, kind, end=""):
        changes, text, _ = KINDS[kind]
        path = self.folder / "campaign.toml"
        written = campaign_text({**changes, **SHARED}).replace("max_packings = 1\n", "" if kind in WITHOUT_MOST else "max_packings = 1\n")
        path.write_text(written + text + end)
        return path

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

    def check_frames(self):
        """A frame of each cycle, of grains and of the trough, and of walls where the trough has some of its own."""
        done = self.call("export", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        (case,) = self.output.glob("cases/*")
        frames = len(list((case / "packing-1" / "dump").glob("frames.*.dump")))
        self.assertGreater(frames, 15)
        walls = [name for name in ("left", "right", "back", "end") if (case / "packing-1" / f"{name}.stl").exists()]
        for name in ("grains", "trough", *(["walls"] if walls else [])):
            collection = (case / "frames" / f"{name}.pvd").read_text()
            self.assertEqual(len(re.findall("<DataSet", collection)), frames, name)
            self.assertEqual(len(list((case / "frames" / name).glob("*.vtp"))), frames, name)

    def check_bundle(self, row):
        again = self.row_of_bundle()
        again.pop("bundle", None)
        self.assertEqual({name: again.get(name) for name in row}, row)

    def check_kind(self, kind):
        self.output = self.folder / f"{kind} at home"
        self.run_campaign(self.write_kind(kind), wanted=None)
        wanted = without_wall_time(self.table())
        for column in KINDS[kind][2]:
            self.assertIsNotNone(wanted[0][column], f"{kind}: {json.dumps(wanted[0])}")
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
