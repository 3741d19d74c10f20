"""A real case that never forgets how it began, and how each view reports it."""

import csv
import io
import math
import unittest

import h5py
from trough_program import EndToEndTest

# A single sphere on a level trough, without rolling friction. Only friction at its lowest point acts along the trough, so that
#     m dv/dt = F,   (2/5) m R^2 dw/dt = -F R,   hence   v + (2/5) R w = constant
# with the spin w (positive when it rolls forwards), whatever the trough does and whether the sphere slides, rolls or flies. Spheres
# that start with different speeds therefore never come to agree.
SPHERE = {
    "layer.grains": 1,
    "grains.diameter_spread": None,
    "grains.youngs_modulus": "1 MPa",
    "trough.throw_number": 0.6,
    "measure.packings": 4,
    "measure.max_packings": 8,
    "measure.half_width": 0.03,
    "measure.max_cycles": 24,
}


class NeverForgets(EndToEndTest):
    def test_two_branches_and_the_sum_behind_them(self):
        self.run_campaign(self.write_campaign(SPHERE), wanted=1)
        self.check_that_two_branches_are_reported_and_no_mean()
        self.check_the_sum_that_friction_cannot_change()

    def check_that_two_branches_are_reported_and_no_mean(self):
        with h5py.File(self.results()[0]) as file:
            case = file["case"][0]
            below, above = (float(case[f"efficiency_{name}"]) for name in ("below", "above"))
            self.assertTrue(math.isnan(case["efficiency"]))
        self.assertGreater(above - below, 0.1, "three half-widths")
        row = self.table()[0]
        self.assertEqual((row["outcome"], row["efficiency"]), ("bistable-or-slow", None))
        told = self.call("status", self.output).stdout
        self.assertIn(f"velocity efficiency {below:.3f} +- ", told)
        self.assertIn("when it starts below", told)
        self.assertIn(f"{above:.3f} +- ", told)
        [line] = csv.DictReader(io.StringIO(self.call("compare", self.output, "--csv").stdout))
        self.assertEqual((line["outcome"], line["efficiency"]), ("bistable-or-slow", ""))

    def check_the_sum_that_friction_cannot_change(self):
        """What makes the case special: v + (2/5) R w stays at 0 for a packing that starts at rest, to 1 % of the trough's speed. (The
        engine's lever arm is shorter than R by half of the overlap.)"""
        folder = self.results()[0].parent / "packing-1"
        names, *rows = [line.split(",") for line in (folder / "phases.csv").read_text().splitlines() if not line.startswith("#")]
        kept = []
        for row in rows:
            now = dict(zip(names, map(float, row)))
            if now["touching"] == 1:
                kept.append(now["touching_vx"] + 0.4 * now["touching_spin"])
        self.assertGreater(len(kept), 100)
        with h5py.File(self.results()[0]) as file:
            speed = 2 * math.pi * float(file["case"]["frequency"][0]) * float(file["case"]["amplitude"][0])
        self.assertLess(max(map(abs, kept)), 0.01 * speed)


if __name__ == "__main__":
    unittest.main()
