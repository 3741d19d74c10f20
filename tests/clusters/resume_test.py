"""A hundred times kill -9 at random moments, of the driver, of an engine, of both: the campaign comes out as if nothing had been.

The moments come from a generator with a fixed seed, but the machine's own timing decides what they hit; what is checked
holds for every moment.
"""

import hashlib
import json
import os
import random
import signal
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
import h5py  # noqa: E402
from trough_program import EndToEndTest, engines_in, fingerprint, processes_in, wait_until, without_wall_time  # noqa: E402

KILLS = int(os.environ.get("VIBROTROUGH_KILLS", "100"))
SEED = int(os.environ.get("VIBROTROUGH_SEED", "1"))
# The fewest grains that settle, as soft as they may be, and the fewest cycles that may be asked for: a packing takes half a second.
CHANGES = {"grains.youngs_modulus": "0.1 MPa", "measure.packings": 2, "measure.min_cycles": 20, "measure.max_cycles": 20, "measure.half_width": 1.0}
SWEEP = {"layer.grains": [20, 24, 28, 32, 36, 40]}
PACKINGS = 12
# Of one campaign, so that several come to their end, however busy the machine is.
MOST_KILLS = 12


class Resume(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.random = random.Random(SEED)
        self.campaign = self.write_campaign(CHANGES, SWEEP)

    def finished_packings(self, output):
        """{"id/packing-n": fingerprint} of the packings that are marked as finished, with their marks checked."""
        found = {}
        for marker in output.glob("cases/*/packing-*/packing.json"):
            cycles = (marker.parent / "cycles.csv").read_bytes()
            digest = json.loads(marker.read_text())["cycles_sha256"]
            self.assertEqual(digest, hashlib.sha256(cycles).hexdigest(), marker)
            found["/".join(marker.parts[-3:-1])] = fingerprint(marker)
        return found

    def assert_nothing_is_half(self, output):
        for result in output.glob("cases/*/result.h5"):
            with h5py.File(result) as file:
                self.assertEqual(file["case"]["packings"][0], 2)
        for path in [*output.glob("cases/*/failure.json"), *output.glob("engine.json"), *output.glob("cases/*/packing-*/packing.json")]:
            json.loads(path.read_text())

    def kill_at_random(self, driver):
        """Kills after random times until the driver is killed, too, or has ended: it notes an engine's failure and goes on with the
        others. The number of kills."""
        count = 0
        while driver.poll() is None:
            time.sleep(min(self.random.expovariate(1 / 0.6), 3))
            victims = self.random.choice(("driver", "engine", "both"))
            killed = False
            if victims != "driver":
                engines = engines_in(self.output)  # looked at once: the next look may find others
                for number in self.random.sample(engines, k=min(1, len(engines))):
                    try:
                        os.kill(number, signal.SIGKILL)
                        killed = True
                    except ProcessLookupError:
                        pass
            if victims != "engine" and driver.poll() is None:
                driver.send_signal(signal.SIGKILL)
                driver.wait()
                killed = True
            count += killed
        self.finish(driver)
        wait_until(lambda: not processes_in(self.output), "the killed driver's engines were gone")
        return count

    def simulated(self):
        return [name for name in self.take_starts() if "/packing-" in name]

    def finish_under_fire(self, kills):
        """Runs the campaign until it is finished or enough was killed; the number of kills."""
        kept = {}
        count = 0
        while count < kills:
            self.take_starts()
            driver = self.start_campaign(self.campaign)
            count += self.kill_at_random(driver)
            started = self.simulated()
            self.assertEqual(set(started) & set(kept), set(), "a finished packing was run again")
            now = self.finished_packings(self.output)
            for name, before in kept.items():
                self.assertEqual(now.get(name), before, f"{name} was finished and is not what it was")
            self.assert_nothing_is_half(self.output)
            kept = now
            if not (self.output / "campaign.toml").exists():
                continue  # killed before the campaign was frozen
            status = self.ask_json("status")
            self.assertEqual(status["cases_total"], 6)
            self.assertEqual(sum(case["packings_done"] for case in status["cases"]), len(now))
            if status["finished"] + status["unsure"] == 6:
                break
        return count

    def test_killed_at_random_moments(self):
        undisturbed = self.folder / "undisturbed"
        self.call(*self.run_arguments(self.campaign, undisturbed))
        wanted = without_wall_time(self.table(undisturbed))
        self.assertEqual({row["efficiency"] is None for row in wanted} & {True}, set(), wanted)
        kills = 0
        campaigns = 0
        while kills < KILLS:
            campaigns += 1
            self.output = self.folder / f"runs-{campaigns}"
            kills += self.finish_under_fire(min(KILLS - kills, MOST_KILLS))
            before = self.finished_packings(self.output)
            self.take_starts()
            done = self.call(*self.run_arguments(self.campaign))
            self.assertIn(done.returncode, (0, 1), done.stderr)  # 1: not as precise as asked
            started = self.simulated()
            self.assertEqual(len(started) + len(before), PACKINGS)
            self.assertEqual(set(started) & set(before), set(), "a finished packing was run again")
            # Bit for bit what an undisturbed run gives: no case is lost, none is made of halves.
            self.assertEqual(without_wall_time(self.table()), wanted)
            with h5py.File(self.output / "campaign.h5") as table:
                self.assertEqual(len(table["case"]), 6)
        print(f"{kills} kills in {campaigns} campaigns")

    def test_an_edited_campaign_runs_what_is_new(self):
        self.write_campaign(CHANGES, {"layer.grains": [28, 32, 36]})
        self.call(*self.run_arguments(self.campaign))
        before = {path: fingerprint(path) for path in self.results()}
        self.take_starts()
        self.write_campaign(CHANGES, {"layer.grains": [36, 40]})
        done = self.call(*self.run_arguments(self.campaign))
        self.assertIn("2 cases in ", done.stdout)
        self.assertIn("belong to an earlier version of the campaign and are not used", done.stdout)
        self.assertEqual(len(self.simulated()), 2, "only the new case is run")
        self.assertEqual(len(self.table()), 2)
        for path, old in before.items():
            self.assertEqual(fingerprint(path), old, f"{path} was touched")
        with h5py.File(self.output / "campaign.h5") as table:
            self.assertEqual(sorted(table["layer_grains"][()]), [36, 40])


if __name__ == "__main__":
    unittest.main()
