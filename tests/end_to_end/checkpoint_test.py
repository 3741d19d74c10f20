"""Settled packings are made once; a killed run goes on from its last checkpoint, and gives the same numbers."""

import json
import os
import shutil
import signal
import unittest

from trough_program import EndToEndTest, engines_in, pause, processes_in, wait_until, without_wall_time

# One packing that runs to its last cycle, with a checkpoint every five.
LONG = {"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 24, "output.checkpoint_cycles": 5}


class Checkpoint(EndToEndTest):
    def packing(self):
        return next(iter(self.output.glob("cases/*/packing-1")))

    def sealed_cycle(self):
        for seal in self.output.glob("cases/*/packing-1/checkpoint.json"):
            return json.loads(seal.read_text())["cycle"]
        return 0

    def begun(self):
        """The cycle at which the last start of the engine began. (It says so again at each checkpoint.)"""
        said = (self.packing() / "engine.out").read_text()
        begins = [line for line in said.splitlines() if line.startswith("VIBROTROUGH BEGIN cycle ")]
        self.assertTrue(begins, f"{self.table()}\n{said}")
        return int(begins[0].split()[-1])

    def kill_in_the_middle(self, campaign, how=signal.SIGKILL, cycle=10):
        for _ in range(20):
            driver = self.start_campaign(campaign)
            wait_until(lambda: self.sealed_cycle() >= cycle or driver.poll() is not None, "a checkpoint was sealed")
            driver.send_signal(how)
            self.finish(driver)
            wait_until(lambda: not processes_in(self.output), "the engine was gone")
            if cycle <= self.sealed_cycle() < LONG["measure.max_cycles"]:
                return
            shutil.rmtree(self.output)  # the machine was so busy that the run ended first
        self.fail("no run could be cut in the middle")

    known = None  # the same for all tests

    def undisturbed(self, campaign):
        if Checkpoint.known is None:
            folder = self.folder / "undisturbed"
            self.run_campaign(campaign, output=folder, wanted=1)
            cycles = next(iter(folder.glob("cases/*/packing-1/cycles.csv"))).read_text()
            Checkpoint.known = without_wall_time(self.table(folder)), cycles
        return Checkpoint.known

    def numbers(self, text):
        return [line for line in text.splitlines() if line[:1].isdigit()]

    def test_a_killed_run_goes_on_and_gives_the_same_numbers(self):
        campaign = self.write_campaign(LONG)
        table, cycles = self.undisturbed(campaign)
        self.kill_in_the_middle(campaign)
        self.assertEqual(self.ask_json("status")["left"], 1)
        self.run_campaign(campaign, wanted=1)  # not as precise as asked
        self.assertGreaterEqual(self.begun(), 10)
        self.assertEqual(without_wall_time(self.table()), table)
        # Every cycle, digit for digit: a checkpoint is where the run itself starts again from its file.
        self.assertEqual(self.numbers((self.packing() / "cycles.csv").read_text()), self.numbers(cycles))
        # The case is not precise, so that its packing may be continued: only its last checkpoint is kept.
        self.assertEqual([path.name for path in self.packing().glob("checkpoint.*.restart")], ["checkpoint.24.restart"])

    def test_a_checkpoint_that_nobody_sealed_does_no_harm(self):
        """A killed driver may leave a later checkpoint of its engine. A slow machine gives the next driver time to look before its
        engine has read the sealed one."""
        campaign = self.write_campaign(LONG)
        table, _ = self.undisturbed(campaign)
        self.kill_in_the_middle(campaign)
        sealed = self.sealed_cycle()
        later = self.packing() / f"checkpoint.{sealed + 5}.restart"
        if not later.exists():
            later.write_bytes((self.packing() / f"checkpoint.{sealed}.restart").read_bytes())
            with open(self.packing() / "checkpoints.txt", "a") as names:
                names.write(f"{sealed + 5}\n")
        os.environ["VIBROTROUGH_TEST_BREAK"] = "sleep 2"
        self.run_campaign(campaign, wanted=1)
        self.assertEqual(self.begun(), sealed)
        self.assertEqual(without_wall_time(self.table()), table)

    def test_a_run_that_was_told_to_stop_goes_on(self):
        # The engine says that it caught a signal. What it writes after going on is shorter: nothing may be left of that.
        campaign = self.write_campaign(LONG)
        table, cycles = self.undisturbed(campaign)
        self.kill_in_the_middle(campaign, signal.SIGINT)
        last = (self.packing() / "checkpoints.txt").read_text().split()[-1]
        self.assertEqual(self.sealed_cycle(), int(last), "the checkpoint that Ctrl-C makes is sealed")
        # As if it had been dear until then: what an engine needs to start is more than that of all these cycles.
        note = self.packing() / "checkpoint.json"
        seal = json.loads(note.read_text())
        seal["core_time"] += 1000
        note.write_text(json.dumps(seal))
        self.run_campaign(campaign, wanted=1)
        begun = self.begun()
        self.assertGreaterEqual(begun, 10)
        # Ctrl-C makes a checkpoint at the end of the cycle in which it comes. The cycles before are the same, digit for digit; those
        # after it have other digits unless the undisturbed run wrote a checkpoint there, too (src/manual/simulated.md, checkpoints).
        spent = json.loads((self.packing() / "packing.json").read_text())["core_time"]
        self.assertGreaterEqual(spent, seal["core_time"], "what was spent before the checkpoint counts")
        now, before = (self.numbers(text) for text in ((self.packing() / "cycles.csv").read_text(), cycles))
        self.assertEqual(now[: begun + 1], before[: begun + 1])
        self.assertEqual(len(now), len(before))
        if begun in (10, 15, 20):
            self.assertEqual(without_wall_time(self.table()), table)
        else:
            self.assertEqual(self.table()[0]["outcome"], table[0]["outcome"])

    def test_a_checkpoint_is_verified_before_it_is_trusted(self):
        campaign = self.write_campaign(LONG)
        table, _ = self.undisturbed(campaign)
        self.kill_in_the_middle(campaign)
        seal = json.loads((self.packing() / "checkpoint.json").read_text())
        restart = self.packing() / seal["file"]
        damaged = bytearray(restart.read_bytes())
        damaged[len(damaged) // 2] ^= 1
        restart.write_bytes(damaged)
        self.run_campaign(campaign, wanted=1)
        self.assertEqual(self.begun(), 0)
        self.assertEqual(without_wall_time(self.table()), table)

    def test_a_checkpoint_of_lost_cycles_is_not_trusted(self):
        campaign = self.write_campaign(LONG)
        table, _ = self.undisturbed(campaign)
        self.kill_in_the_middle(campaign)
        (self.packing() / "cycles.csv").write_text("")
        self.run_campaign(campaign, wanted=1)
        self.assertEqual(self.begun(), 0)
        self.assertEqual(without_wall_time(self.table()), table)


class SettledPackings(EndToEndTest):
    def settles(self):
        return len(self.settles_file.read_text().splitlines()) if self.settles_file.exists() else 0

    def test_a_sweep_over_drives_settles_once(self):
        campaign = self.write_campaign({}, {"trough.throw_number": [1.8, 2.0, 2.4]})
        self.run_campaign(campaign)
        self.assertEqual(len(self.take_starts()), 6)
        self.assertEqual(self.settles(), 2)  # two packings
        # The same packings in another case: none is settled again. Other grains are.
        self.run_campaign(self.write_campaign({}, {"trough.throw_number": [2.2]}))
        self.assertEqual(self.settles(), 2)
        self.run_campaign(self.write_campaign({"grains.friction": 0.4}))
        self.assertEqual(self.settles(), 4)

    def test_a_damaged_packing_is_made_again(self):
        campaign = self.write_campaign({"measure.packings": 1})
        self.run_campaign(campaign)
        restart = next(iter(self.output.glob("packings/*/settled.restart")))
        restart.unlink()
        restart.write_bytes(b"damaged")
        self.run_campaign(self.write_campaign({"measure.packings": 1, "trough.throw_number": 2.4}))
        self.assertEqual(self.settles(), 2)
        self.assertNotEqual(restart.read_bytes(), b"damaged")

    def test_a_killed_settling_leaves_nothing_to_be_taken_for_whole(self):
        campaign = self.write_campaign({"measure.packings": 1})
        for how, wanted in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGINT, 130)):
            driver = self.start_campaign(campaign)
            engine = wait_until(lambda: next(filter(pause, engines_in(self.output / "packings")), None), "the engine settled a packing", driver)
            driver.send_signal(how)
            if how == signal.SIGINT:
                os.kill(engine, signal.SIGCONT)
            code, _, errors = self.finish(driver)
            self.assertEqual(code, wanted, errors)
            wait_until(lambda: not processes_in(self.output), "the engine was gone")
            self.assertEqual([*self.output.glob("packings/*.failed"), *self.output.rglob("failure.json")], [], "an interruption is no failure")
        self.run_campaign(campaign)
        self.assertEqual([row["outcome"] for row in self.table()], ["finished"])
        self.assertEqual([name for name in os.listdir(self.output / "packings") if "." in name], [])


if __name__ == "__main__":
    unittest.main()
