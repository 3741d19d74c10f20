"""The virtual friction test: layers and blocks shaken along a level trough by the real engine."""

import json
import math
import unittest

from trough_program import EndToEndTest

MU = 0.23


class FrictionTest(EndToEndTest):
    def shake(self, campaign, *arguments, wanted=0):
        command = ["friction-test", campaign, "--output", self.output, "--jobs", 2, "--liggghts", self.engine]
        done = self.call(*command, *arguments)
        self.assertEqual(done.returncode, wanted, done.stdout + done.stderr)
        return json.loads((self.output / "friction.json").read_text())["layers"], done.stdout

    def block(self, **changes):
        return self.write_campaign(
            {"layer.grains": None, "layer.block": "point", "grains.diameter_spread": None, "measure.packings": 1,
             "measure.half_width": 0.002} | changes
        )  # fmt: skip

    def test_a_block_gives_its_friction_back(self):
        (test,), _ = self.shake(self.block(**{"trough.friction": 0.18}))
        # Friction is Coulomb's to the last step of a slide; its damped end takes 1/3000 of the cycle.
        self.assertAlmostEqual(test["friction"], 0.18, delta=0.01 * 0.18)
        self.assertEqual(test["mode"], "PN")
        self.assertLess(abs(test["creep_per_cycle"]), 0.01)
        self.assertLessEqual(test["friction_low"], test["friction"])
        self.assertLessEqual(test["friction"], test["friction_high"])

    def test_a_block_that_does_not_slide_says_so(self):
        (test,), told = self.shake(self.block(), "--machine-number", 0.2, wanted=1)
        self.assertIsNone(test["friction"])
        self.assertIn("larger K", test["message"])
        self.assertIn("no friction coefficient", told)

    def test_a_layer(self):
        campaign = self.write_campaign({"measure.half_width": 0.1}, {"trough.throw_number": [1.5, 2.0]})
        (test,), told = self.shake(campaign)
        self.assertEqual(len(self.take_starts()), 2, "two packings are shaken, whatever the drives")
        self.assertGreater(test["machine_number"], MU * math.hypot(1, math.pi / 2))
        # Grains roll and the layer shears: less than grain on trough, and not nothing.
        self.assertGreater(test["friction"], 0.3 * MU)
        self.assertLess(test["friction"], 1.05 * MU)
        self.assertIn("effective friction", told)

        again, _ = self.shake(campaign)
        self.assertEqual(self.take_starts(), [], "a finished test is not run again")
        self.assertEqual(again, [test])

        self.run_campaign(campaign, wanted=None)  # two packings are not precise; that is not the question
        for row in self.table():
            self.assertEqual(row["friction_layer"], test["friction"])
            self.assertEqual(row["friction"], MU)
            self.assertNotEqual(row["efficiency_theory_layer"], row["efficiency_theory"])
            self.assertTrue(row["mode_theory_layer"])
        shown = self.call("compare", self.output)
        self.assertIn(f"{test['friction']:.3f}", shown.stdout)

    def test_without_a_test_there_is_no_column_filled(self):
        self.run_campaign(self.write_campaign({"measure.packings": 1}))
        (row,) = self.table()
        self.assertIsNone(row["friction_layer"])
        self.assertIsNone(row["efficiency_theory_layer"])

    def test_wrong_input_is_one_line(self):
        wrong = self.write_campaign({"grains.diameter": "3"})
        self.assert_one_line_error(self.call("friction-test", wrong, "--output", self.output), 2, "grains.diameter")
        self.assert_one_line_error(self.call("friction-test", self.folder / "none.toml"), 2, "no such file")


if __name__ == "__main__":
    unittest.main()
