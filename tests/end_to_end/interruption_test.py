"""A campaign that is killed, interrupted with Ctrl-C, or loses an engine continues where it stopped."""

import json
import os
import signal
import unittest
import unittest.mock
from pathlib import Path

from trough_program import WHOLE, EndToEndTest, count_cycles, engines_in, fingerprint, pause, processes_in, wait_until, without_wall_time

# Three packings and two engines at a time: when a case is finished, the next one has some of its packings. At night there is a case
# that has not begun, too.
SWEEP = {"layer.grains": [60, 70, 80] if WHOLE else [60, 70]}
CASES, PACKINGS = len(SWEEP["layer.grains"]), 3
# An engine that nobody stops would run for an hour, far longer than these tests are patient.
CHANGES = {"measure.packings": PACKINGS, "measure.max_cycles": 100000, "output.checkpoint_cycles": 5}


class Interruption(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.campaign = self.write_campaign(CHANGES, SWEEP)

    def wait_for_the_middle(self, driver):
        """Until a case is finished, another has a finished packing, and engines run; then the driver stands still."""

        def in_the_middle():
            whole = {path.parent.name for path in self.results()}
            begun = {name.split("/")[0] for name in self.finished_packings()} - whole
            return whole and begun and engines_in(self.output)

        def stopped_in_the_middle():
            if not in_the_middle() or not pause(driver.pid):
                return False
            if in_the_middle():
                return True
            driver.send_signal(signal.SIGCONT)
            return False

        wait_until(stopped_in_the_middle, "a case was finished, another begun, and engines ran", driver)

    def finished_packings(self):
        """Names of the packings that have their marker, e.g. "4f.../packing-1"."""
        return sorted("/".join(marker.parts[-3:-1]) for marker in self.output.glob("cases/*/packing-*/packing.json"))

    undisturbed = None  # the table of a run that nothing disturbs, made once

    def undisturbed_table(self):
        if Interruption.undisturbed is None:
            folder = self.folder / "undisturbed"
            self.run_campaign(self.campaign, output=folder)
            Interruption.undisturbed = without_wall_time(self.table(folder))
        return Interruption.undisturbed

    def assert_resumes(self, kept, done_before, digits="the same"):
        """The same command finishes the rest; `kept`: fingerprints of results, `done_before`: packings."""
        self.take_starts()
        self.run_campaign(self.campaign)
        for path, before in kept.items():
            self.assertEqual(fingerprint(path), before, f"{path} was written again")
        started = self.take_starts()
        self.assertEqual(len(started), len(set(started)), "a packing was started twice")
        self.assertEqual(len(started) + len(done_before), CASES * PACKINGS)
        self.assertEqual(set(started) & set(done_before), set(), "finished packings were run twice")
        table = self.table()
        self.assertEqual([row["outcome"] for row in table], ["finished"] * CASES)
        undisturbed = self.undisturbed_table()
        if digits == "the same":
            # The engine is deterministic and the number of cycles used depends on the cycles only: equal, bit for bit.
            self.assertEqual(without_wall_time(table), undisturbed)
            return
        # A run that goes on from a checkpoint which the undisturbed run did not make differs in rounding, which the collisions
        # amplify. Single packings of 24 cycles scatter by 0.03.
        for row, other in zip(without_wall_time(table), undisturbed):
            if self.output / "cases" / row["case"] / "result.h5" in kept:
                self.assertEqual(row, other)
            self.assertAlmostEqual(row["efficiency"], other["efficiency"], delta=0.15)

    def test_killed_driver(self):
        driver = self.start_campaign(self.campaign)
        self.wait_for_the_middle(driver)
        driver.send_signal(signal.SIGKILL)
        self.assertEqual(self.finish(driver)[0], -signal.SIGKILL)
        # The kernel ends the engines with their driver; nobody is left to do it.
        wait_until(lambda: not processes_in(self.output), "the killed driver's engines were gone")
        kept = {path: fingerprint(path) for path in self.results()}
        self.assertIn(len(kept), range(1, CASES), "the test is about a run that is cut in the middle")

        status = self.ask_json("status")
        self.assertEqual((status["finished"], status["left"]), (len(kept), CASES - len(kept)))
        self.assertEqual((status["running"], status["failed"]), (0, 0))
        outcomes = [row["outcome"] for row in self.table()]
        self.assertEqual(outcomes.count("finished"), len(kept))
        self.assertLessEqual(set(outcomes), {"finished", "interrupted", "open"})
        self.assert_resumes(kept, self.finished_packings())

    def test_ctrl_c(self):
        driver = self.start_campaign(self.campaign)
        self.wait_for_the_middle(driver)
        os.killpg(driver.pid, signal.SIGINT)  # as a terminal does it
        driver.send_signal(signal.SIGCONT)
        code, output, errors = self.finish(driver)
        self.assertEqual(processes_in(self.output), {}, "engines outlived their driver")
        self.assertEqual(code, 130, output + errors)
        self.assertIn("interrupted: the same command continues it", output)
        self.assertEqual(list(self.output.glob("cases/*/failure.json")), [], "an interruption is no failure")
        kept = {path: fingerprint(path) for path in self.results()}
        self.assertIn(f"{len(kept)} of {CASES} cases finished", output)
        # What is finished is in the table of the interrupted campaign already.
        self.assertTrue((self.output / "campaign.h5").is_file())
        self.assert_resumes(kept, self.finished_packings(), digits="others")

    def test_an_engine_leaves_nothing_behind(self):
        """Open MPI 5 (Debian 13) leaves a file in shared memory and a folder in the temporary folder after each engine without mpirun."""
        temporary = self.folder / "temporary"
        temporary.mkdir()
        with unittest.mock.patch.dict(os.environ, TMPDIR=str(temporary)):
            driver = self.start_campaign(self.write_campaign(CHANGES | {"measure.packings": 1}))
        # By its first cycle an engine has started MPI.
        begun = lambda: [path.parent for path in self.output.glob("cases/*/packing-1/cycles.csv") if count_cycles(path) > 1]  # noqa: E731
        engine = wait_until(lambda: next((one for one in begun() and engines_in(self.output) if pause(one)), None), "an engine ran", driver)
        used = Path(f"/proc/{engine}/maps").read_text().splitlines()
        self.assertEqual([line for line in used if "/dev/shm/" in line], [])
        os.kill(engine, signal.SIGCONT)
        driver.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(driver)[0], 130)
        self.assertEqual(list(temporary.iterdir()), [])

    def test_killed_engine(self):
        driver = self.start_campaign(self.campaign)
        victim = wait_until(lambda: next(filter(pause, engines_in(self.output / "cases")), None), "an engine ran", driver)
        packing = os.path.relpath(os.readlink(f"/proc/{victim}/cwd"), (self.output / "cases").resolve())
        os.kill(victim, signal.SIGKILL)
        code, output, errors = self.finish(driver)
        self.assertEqual(code, 1, output + errors)
        self.assertIn(f"{CASES - 1} of {CASES} cases finished, 1 failed", output)

        case, packing_name = packing.split("/")
        failure_file = self.output / "cases" / case / "failure.json"
        failure = json.loads(failure_file.read_text())
        self.assertEqual((failure["case"], failure["outcome"], failure["attempts"]), (case, "engine-crashed", 1))
        self.assertEqual(f"packing-{failure['packing']}", packing_name)
        self.assertIn("signal 9", failure["message"])
        self.assertRegex(errors, rf"case {case} .*engine-crashed: .*signal 9")

        row = next(row for row in self.table() if row["case"] == case)
        self.assertEqual(row["outcome"], "engine-crashed")
        self.assertIsNone(row["efficiency"])
        self.assertIsNotNone(row["efficiency_theory"])
        listed = next(one for one in self.ask_json("status")["cases"] if one["case"] == case)
        self.assertEqual(listed["message"], failure["message"])

        kept = {path: fingerprint(path) for path in self.results()}
        self.assertEqual(len(kept), CASES - 1)
        self.assert_resumes(kept, self.finished_packings())
        self.assertFalse(failure_file.exists(), "the failure is mended")


if __name__ == "__main__":
    unittest.main()
