"""`measure` on runs that a person made by hand from our decks, changed or not, with the real engine."""

import json
import re
import shutil
import subprocess
import unittest

from trough_program import PATIENCE, EndToEndTest

CHANGES = {"measure.packings": 2}


class Measure(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.campaign = self.write_campaign(CHANGES)
        done = self.call("deck", self.campaign, "--output", self.folder / "decks")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.case = self.folder / "decks" / "case-001"

    def run_by_hand(self, packing, decks=("settle.liggghts", "in.liggghts")):
        for deck in decks:
            done = subprocess.run([shutil.which("liggghts"), "-in", deck], cwd=packing, capture_output=True, text=True,
                                  errors="replace", timeout=PATIENCE)  # fmt: skip
            self.assertIn("VIBROTROUGH", done.stdout, done.stdout[-2000:])

    def measure(self, folder, wanted, *options):
        done = self.call("measure", folder, "--json", *options)
        self.assertEqual(done.returncode, wanted, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def test_a_run_by_hand_is_measured_as_the_campaign_measures_it(self):
        self.run_campaign(self.campaign)
        (row,) = self.table()
        for number in (1, 2):
            self.run_by_hand(self.case / f"packing-{number}")
        found = self.measure(self.case, 0)
        # The same files give the same numbers, digit for digit.
        self.assertEqual(found["efficiency"], row["efficiency"])
        self.assertEqual(found["efficiency_half_width_statistics"], row["efficiency_half_width_statistics"])
        self.assertEqual(found["efficiency_theory"], row["efficiency_theory"])
        self.assertEqual(found["outcome"], "finished")
        self.assertEqual([one["mode"] for one in found["packings"]], [row["layer_mode"]] * 2)
        for one in found["packings"]:
            self.assertEqual(one["end"], "log.liggghts has the end marker")
            self.assertIsNone(one["fault"])
        # The campaign's own folder is such a folder, too.
        driven = self.measure(self.output / "cases" / row["case"], 0)
        self.assertEqual(driven["efficiency"], row["efficiency"])
        # One packing alone; text for people; nothing is written.
        before = sorted(path for path in self.case.rglob("*"))
        done = self.call("measure", ".", cwd=self.case / "packing-1")
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertRegex(done.stdout, r"  velocity efficiency: \d\.\d{4} \+- \d\.\d{4} \(95 %, from the scatter of its own cycles only\)\n")
        self.assertRegex(done.stdout, r"velocity efficiency: \d\.\d{4}, with an unbounded interval .*, from 1 packing of 18 cycles")
        self.assertIn(f": 18 cycles, mode {row['layer_mode']}\n", done.stdout)
        self.assertEqual(before, sorted(path for path in self.case.rglob("*")))

    def test_a_changed_deck_is_measured(self):
        packing = self.case / "packing-1"
        deck = packing / "in.liggghts"
        original = deck.read_text()
        # Another gravity and fewer steps per cycle: the run is measured, and what a campaign would say is said.
        steps = next(line for line in original.splitlines() if line.startswith("variable        n equal"))
        self.assertIn("gravity 9.81 vector", original)
        deck.write_text(original.replace("gravity 9.81 vector", "gravity 3.71 vector"))
        self.run_by_hand(packing)
        found = self.measure(packing, 1)
        (one,) = found["packings"]
        self.assertEqual((found["outcome"], one["fault"]), ("wrong-weight", "wrong-weight"))
        self.assertGreater(found["efficiency"], 0)
        text = self.call("measure", packing).stdout
        self.assertIn("a campaign would not count it: wrong-weight", text)
        # Another number of steps: the deck's own number counts.
        number = int(steps.split()[-1])
        halved = original.replace(steps, f"variable n equal {2 * number}")
        step = next(line for line in original.splitlines() if line.startswith("timestep"))
        halved = halved.replace(step, f"timestep {float(step.split()[1]) / 2!r}")
        for sample in (number // 100, 30 * number // 100):  # lines of phases.csv and snapshots
            halved = re.sub(rf"(?<= ){sample}(?= )", str(2 * sample), halved)
        deck.write_text(halved)
        self.run_by_hand(packing, ["in.liggghts"])
        found = json.loads(self.call("measure", packing, "--json").stdout)
        self.assertEqual(found["packings"][0]["cycles"], 18)
        self.assertIsNone(found["packings"][0]["fault"])

    def test_what_is_missing_is_named(self):
        packing = self.case / "packing-1"
        nothing = self.folder / "nothing"
        nothing.mkdir()
        for folder, parts in ((self.folder / "not there", ["is not a folder"]), (nothing, ["cycles.csv", "liggghts -in"]), (packing, ["cycles.csv"])):
            self.assert_one_line_error(self.call("measure", folder), 2, *parts)
        self.run_by_hand(packing)
        moved = self.folder / "moved"
        shutil.copytree(packing, moved)
        self.assert_one_line_error(self.call("measure", moved), 2, "scenario.toml", "--scenario")
        scenario = self.case / "scenario.toml"
        here, there = self.measure(packing, 1), self.measure(moved, 1, "--scenario", scenario)
        self.assertEqual(there["efficiency"], here["efficiency"])
        # One packing does not tell how packings differ: only its own cycles give an interval.
        self.assertEqual((here["outcome"], here["efficiency_half_width_statistics"]), ("not-precise", None))
        self.assertGreater(here["packings"][0]["own_half_width"], 0)
        # A run that was stopped is measured as far as it is.
        table = moved / "cycles.csv"
        lines = table.read_text().splitlines(keepends=True)
        table.write_text("".join(lines[:14]))
        stopped = self.call("measure", moved, "--scenario", scenario)
        self.assertIn(": 10 cycles", stopped.stdout)
        self.assertIn("a campaign would not count it: outputs-incomplete, phases.csv holds 18 cycles, cycles.csv 10", stopped.stdout)
        table.write_text("".join(lines[:3]))
        self.assert_one_line_error(self.call("measure", moved, "--scenario", scenario), 2, "whole cycles")
        table.write_text("nonsense\n")
        self.assert_one_line_error(self.call("measure", moved, "--scenario", scenario), 2)
        (moved / "phases.csv").unlink()
        shutil.copy(packing / "cycles.csv", table)
        without = self.measure(moved, 1, "--scenario", scenario)
        self.assertEqual(without["efficiency"], here["efficiency"])
        self.assertEqual(without["outcome"], "outputs-incomplete")


if __name__ == "__main__":
    unittest.main()
