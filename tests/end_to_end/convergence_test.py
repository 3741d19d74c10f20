"""The numerical error of a campaign: a small layer and blocks with their settings nearer to the limit, by the real engine."""

import json
import math
import os
import signal
import unittest

import h5py

from trough_program import EndToEndTest, wait_until

# A rigid block: seconds per case, and almost no scatter.
BLOCK = {"layer.grains": None, "layer.block": "point", "grains.diameter_spread": None, "measure.packings": 1,
         "measure.half_width": 0.01}  # fmt: skip
# The softest contact, with a tenth of the steps: where its error does not matter.
SOFT_BLOCK = BLOCK | {"solver.block_stiffness": 30}


class Convergence(EndToEndTest):
    def study(self, campaign, *arguments, wanted=0, output=True):
        where = ["--output", self.output] if output else []
        done = self.call("convergence", campaign, *where, "--jobs", 2, "--liggghts", self.engine, *arguments)
        self.assertEqual(done.returncode, wanted, done.stdout + done.stderr)
        return done

    def budgets(self):
        text = json.loads((self.output / "numerics.json").read_text())
        self.assertEqual((text["format"], text["schema_version"]), ("vibrotrough numerics", 1))
        return text["cases"]

    def test_a_layer_from_study_to_table(self):
        # Wide intervals keep it short: what is tested is the way of the numbers, not their size.
        campaign = self.write_campaign({"measure.half_width": 0.5, "measure.packings": 1})
        self.run_campaign(campaign)
        self.take_starts()
        done = self.study(self.output, output=False)
        (budget,) = self.budgets()
        (row,) = self.table()
        self.assertEqual(budget["case"], row["case"])
        self.assertEqual([one["setting"] for one in budget["settings"]], ["youngs_modulus", "time_step", "length", "width"])
        self.assertEqual(len(set(self.take_starts())), 5, "five variations beside the case, which has a result; a long run starts its engine again at each pause")
        total, squares = 0.0, 0.0
        for setting in budget["settings"]:
            finest = setting["variations"][-1]
            error = budget["default"]["efficiency"] - finest["efficiency"]
            half_width = math.hypot(budget["default"]["efficiency_half_width_statistics"], finest["efficiency_half_width_statistics"])
            self.assertAlmostEqual(finest["error"], error, delta=1e-12)
            self.assertAlmostEqual(finest["error_half_width"], half_width, delta=1e-12)
            self.assertLessEqual(setting["error_half_width"], min(half_width, setting["expected_half_width"]))
            total += setting["error"]
            squares += setting["error_half_width"] ** 2
        whole = math.sqrt(squares)
        self.assertAlmostEqual(budget["numerical_error"], max(whole, abs(total) + 0.84 * whole), delta=1e-12)
        self.assertIn(f"counted with {budget['numerical_error']:.4f}", done.stdout)

        self.assertEqual(row["efficiency_numerics"], budget["numerical_error"])
        self.assertEqual(row["numerics_source"], "convergence")
        larger = "numerical" if budget["numerical_error"] > row["efficiency_half_width_statistics"] else "statistical"
        self.assertEqual(row["larger_error"], larger)
        shown = self.call("compare", self.output, "--budget").stdout
        wanted = f"{row['efficiency']:.3f} +- {row['efficiency_half_width_statistics']:.3f} +- {budget['numerical_error']:.3f}"
        self.assertIn(wanted, shown)
        with h5py.File(self.output / "campaign.h5") as file:
            self.assertEqual(file["efficiency_numerics"][0], budget["numerical_error"])
            self.assertEqual(file["numerics_source"].asstr()[0], "convergence")

        self.study(self.output, output=False)
        self.assertEqual(self.take_starts(), [], "a finished study is not run again")
        self.assertEqual(self.budgets(), [budget])

    def test_blocks_before_the_campaign_is_run(self):
        """A study needs no campaign that was run. A block has one setting."""
        campaign = self.write_campaign(BLOCK, {"trough.throw_number": [1.5, 2.0, 2.2, 3.0]})
        done = self.study(campaign, "--case", self.plan_ids(campaign)[1])
        self.assertIn("after 'vibrotrough run'", done.stdout)
        self.assertIn("left out: a block has a contact of its own", done.stdout)
        (budget,) = self.budgets()
        stiffness = budget["settings"][0]
        self.assertEqual(stiffness["setting"], "block_stiffness")
        self.assertEqual([one["value"] for one in stiffness["variations"]], [600, 1200])
        self.assertEqual({one["verdict"] for one in budget["settings"][1:]}, {"left-out"})
        # A softer contact ends later; validation/history finds blocks within 0.007 of the theory.
        self.assertLess(budget["numerical_error"], 0.02)

    def plan_ids(self, campaign):
        answer = self.call("plan", campaign, "--output", self.output, "--liggghts", self.engine, "--json")
        return [case["case"] for case in json.loads(answer.stdout)["cases"]]

    def test_an_interrupted_study_continues(self):
        campaign = self.write_campaign(SOFT_BLOCK)
        process = self.start_study(campaign)
        wait_until(lambda: list(self.output.glob("convergence/cases/*/packing-1/cycles.csv")), "an engine runs", process)
        os.kill(process.pid, signal.SIGINT)
        code, output, _ = self.finish(process)
        self.assertEqual(code, 130, output)
        self.assertIn("the same command continues it", output)
        self.assertFalse((self.output / "numerics.json").exists(), "half a budget is none")
        self.study(campaign)
        self.assertIsNotNone(self.budgets()[0]["numerical_error"])

    def start_study(self, campaign):
        arguments = self.run_arguments
        self.run_arguments = lambda *given: ["convergence", *(word for word in arguments(*given)[1:] if word != "--accept-findings")]
        try:
            return self.start_campaign(campaign)
        finally:
            self.run_arguments = arguments

    def test_a_part_that_fails_leaves_the_sum_unknown(self):
        campaign = self.write_campaign(SOFT_BLOCK)
        os.environ["VIBROTROUGH_TEST_BREAK"] = 'grep -q "block_stiffness = 120" ../scenario.toml && exit 1; true'
        done = self.study(campaign, wanted=1)
        self.assertIn("all together             unknown", done.stdout)
        self.assertIsNone(self.budgets()[0]["numerical_error"])
        self.assertEqual(self.budgets()[0]["settings"][0]["verdict"], "unknown")
        os.environ["VIBROTROUGH_TEST_BREAK"] = ""
        self.study(campaign)
        self.assertIsNotNone(self.budgets()[0]["numerical_error"])

    def test_wrong_input_is_one_line(self):
        campaign = self.write_campaign(SOFT_BLOCK)
        common = ["--output", self.output, "--liggghts", self.engine]
        self.assert_one_line_error(self.call("convergence", campaign, *common, "--case", "0123"), 2, "has no case", "0123")
        self.assert_one_line_error(self.call("convergence", self.folder / "none.toml"), 2, "no such file")
        self.assert_one_line_error(self.call("convergence", self.folder), 2, "not a campaign folder")
        self.assertFalse(self.output.exists(), "nothing was begun")
        self.run_campaign(campaign)
        self.assert_one_line_error(self.call("convergence", self.output, "--output", self.output), 2, "--output")
        (row,) = self.table()
        self.assertIsNone(row["efficiency_numerics"])
        self.assertIsNone(row["larger_error"])
        (self.output / "numerics.json").write_text("{")
        self.assert_one_line_error(self.call("compare", self.output), 2, "numerics.json is damaged")


if __name__ == "__main__":
    unittest.main()
