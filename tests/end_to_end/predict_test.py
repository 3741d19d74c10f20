"""What the atlas says of the cases of a campaign file, before anything is simulated."""

import csv
import io
import json
import unittest

from trough_program import EndToEndTest

DEEPER = {"layer.grains": 100}  # 3.6 diameters
CUBES = {"grains.shape": "cube", "grains.diameter_spread": 0}


class Predict(EndToEndTest):
    def predict(self, changes, *words, sweep=None):
        done = self.call("predict", self.write_campaign(changes, sweep), *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_every_case_of_the_file(self):
        sweep = {"trough.throw_number": [1.5, 2.0, 3.5]}
        cases = json.loads(self.predict(DEEPER, "--json", sweep=sweep))
        self.assertEqual([case["case"] for case in cases], ["throw_number 1.5", "throw_number 2", "throw_number 3.5"])
        self.assertEqual([case["inside"] for case in cases], [True, True, False])
        self.assertEqual(cases[2]["outside"], ["throw_number"])
        for case in cases:
            self.assertGreater(case["half_width"], 0)
            if case["inside"]:
                self.assertTrue(0 < case["added_mass_fraction"] < 1, case)
                self.assertRegex(case["layer_mode"], r"^[FPNR']+$")
                self.assertTrue(0.2 <= case["layer_mode_share"] <= 1, case)
                self.assertTrue(0 <= case["several_cycles_share"] <= 1, case)
            self.assertLess(case["power_per_area_half_width_w_per_m2"], case["power_per_area_w_per_m2"])
            self.assertGreater(case["speed_m_per_s"], 0)
        # More throw, more speed; and beyond the atlas it is less sure.
        self.assertLess(cases[0]["efficiency"], cases[1]["efficiency"])
        self.assertGreater(cases[2]["half_width"], cases[1]["half_width"])
        rows = list(csv.DictReader(io.StringIO(self.predict(DEEPER, "--csv", sweep=sweep))))
        self.assertEqual([float(row["efficiency"]) for row in rows], [case["efficiency"] for case in cases])
        text = self.predict(DEEPER, sweep=sweep)
        self.assertIn(f"{cases[0]['efficiency']:.3f} +- {cases[0]['half_width']:.3f}", text)
        self.assertIn(f"{cases[1]['power_per_area_w_per_m2']:.3f} +- {cases[1]['power_per_area_half_width_w_per_m2']:.3f}", text)
        self.assertIn("outside: throw_number 3.5 (the atlas has 0.7 to 3.2)", text)

    def test_another_kind_of_layer_is_not_predicted(self):
        (cubes,) = json.loads(self.predict(CUBES, "--json"))
        self.assertEqual((cubes["efficiency"], cubes["inside"], cubes["outside"]), (None, False, ["grains.shape"]))
        self.assertEqual((cubes["damping"], cubes["power_per_area_w_per_m2"]), (None, None))
        self.assertIn("outside: grains of the shape cube", self.predict(CUBES))

    def test_a_feed_makes_its_depth(self):
        """The mass flow of the layer is that of the feed: Q = rho_b b h v."""
        feed = {"layer.grains": None, "layer.length": "200 mm", "trough.side_wall_friction": 0, "feed.mass_flow": "0.2 t/h", "feed.length": "20 mm"}
        (fed,) = json.loads(self.predict(feed, "--json"))
        self.assertTrue(fed["inside"], fed)
        self.assertAlmostEqual(1400 * 0.58 * 0.015 * fed["fed_depth_m"] * fed["speed_m_per_s"], 200 / 3600, delta=1e-6)
        # The power per area is that per mass times the mass: the uncertain depth widens its interval.
        width = fed["power_per_area_half_width_w_per_m2"] / fed["power_per_area_w_per_m2"]
        self.assertGreater(width, fed["fed_depth_half_width_m"] / fed["fed_depth_m"])
        self.assertIn(f"fed: {1e3 * fed['fed_depth_m']:.3g} +- ", self.predict(feed))

    def test_a_wrong_file(self):
        for given, said in ((self.folder / "gone.toml", "there is no such file"), (self.write_campaign({"trough.friction": -1}), "trough.friction")):
            done = self.call("predict", given)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
