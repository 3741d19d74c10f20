"""A screen that is fed, with the real engine: at every cycle and of every size what was fed is held, has left over the edge or has passed."""

import json
import os
import re
import unittest

import h5py
import numpy as np

from trough_program import EndToEndTest

# Grains of 2.55, 3 and 3.45 mm on openings of 3.2 mm; downhill, as most screens. Softer grains are pressed through.
FED_SCREEN = {
    "trough.throw_number": 2.5,
    "trough.inclination": "-5 deg",
    "trough.side_wall_friction": 0,
    "grains.youngs_modulus": "5 MPa",
    "grains.diameter_spread": 0.15,
    "layer.grains": None,
    "layer.length": "48 mm",
    "feed.mass_flow": "0.04 t/h",
    "feed.length": "15 mm",
    "screen.opening": "3.2 mm",
    "screen.wire": "1.8 mm",
    "measure.min_cycles": 20,
    "measure.max_cycles": 20,
    "output.checkpoint_cycles": 4,
}
# Where nothing depends on what passes: softer grains take half of the time steps.
SOFT = {"grains.youngs_modulus": "1 MPa", "measure.packings": 1, "measure.max_packings": 1}
# Takes one grain of the first size out of the layer without telling.
# Commands of the shell, before the engine of a packing starts.
LOSING = """test ! -f in.liggghts || sed -i '/^variable        done index/a if "${done} == 7" then "region hole block 0.02 0.04 INF INF 0 INF units box" "delete_atoms region hole compress no"' in.liggghts"""


class FedScreen(EndToEndTest):
    def dumped(self, packing, name):
        """Cycle and diameter of each grain in the engine's files; of files that overlap the later one."""
        found = {}
        for path in sorted(packing.glob(f"{name}.*.dump"), key=lambda path: int(path.name.split(".")[1])):
            start = int(path.name.split(".")[1])
            found = {step: sizes for step, sizes in found.items() if step <= start}
            for snapshot in path.read_text().split("ITEM: TIMESTEP\n")[1:]:
                lines = snapshot.splitlines()
                if int(lines[0]) > start:
                    found[int(lines[0])] = [2 * float(line.split()[-1]) for line in lines[8:]]
        return found

    def check_sizes(self, packing, flow, screen, cycles):
        """The numbers of result.h5 against the engine's own files."""
        for name, total in (("left", flow["left"]), ("passed", screen["passed"])):
            dumps = self.dumped(packing, name)
            diameters = np.array([size for sizes in dumps.values() for size in sizes])
            self.assertEqual(len(diameters), total.sum())
            for size in np.unique(cycles["diameter"]):
                of_size = cycles[cycles["diameter"] == size]
                self.assertEqual(np.isclose(diameters, size, rtol=1e-5).sum(), of_size[name].sum())

    def test_all_grains_add_up_size_by_size(self):
        self.run_campaign(self.write_campaign(FED_SCREEN))
        row = self.table()[0]
        self.assertEqual(row["outcome"], "finished", row)
        with h5py.File(self.results()[0]) as file:
            packings, partition = file["packings"][()], file["partition"][()]
            tables = [{name: file[f"{name}/{number}"][()] for name in ("flow", "through", "size_cycles", "sizes")} for number in (1, 2)]
        shares = []
        for number, table in enumerate(tables, 1):
            flow, screen, cycles, sizes = (table[name] for name in ("flow", "through", "size_cycles", "sizes"))
            gone = np.cumsum(flow["left"] + screen["passed"])
            self.assertTrue(np.all(flow["held"][0] + flow["fed"] == flow["held"] + gone))
            gone = np.cumsum(flow["left_mass"] + screen["passed_mass"])
            lost = flow["held_mass"][0] + flow["fed_mass"] - flow["held_mass"] - gone
            self.assertLess(np.abs(lost).max(), 1e-12 * flow["fed_mass"][-1])
            self.check_sizes(next(iter(self.output.glob(f"cases/*/packing-{number}"))), flow, screen, cycles)
            for size in sizes["diameter"]:
                of_size = cycles[cycles["diameter"] == size]
                self.assertTrue(np.all(np.diff(of_size["fed"]) >= 0))
                np.testing.assert_array_equal(1 + of_size["fed"], of_size["held"] + np.cumsum(of_size["left"] + of_size["passed"]))
            self.assertEqual(sizes["passed"][2], 0)  # 3.45 mm on 3.2 mm
            self.assertGreater(sizes["passed"][0], 0)
            shares.append(1 - sizes["passed"] / sizes["number"])
            mass = sizes["mass"] * sizes["number"]
            passed = sizes["mass"] * sizes["passed"]
            self.assertAlmostEqual(packings["screening_efficiency"][number - 1], passed[:2].sum() / mass[:2].sum(), delta=1e-12)
            through, over = packings["underflow"][number - 1], packings["outflow"][number - 1]
            self.assertAlmostEqual(packings["passed_share"][number - 1], through / (through + over), delta=1e-6)
            self.assertAlmostEqual((through + over) / packings["inflow"][number - 1], 1, delta=0.05)
        np.testing.assert_allclose(partition["stays"], np.mean(shares, axis=0), atol=1e-12)
        self.assertTrue(np.all(np.diff(partition["stays"]) > 0), partition["stays"])  # the smaller, the more pass
        self.check_archive_and_frames(row)

    def check_archive_and_frames(self, row):
        again = self.row_of_bundle()
        for name in ("screening_efficiency", "underflow_t_per_h", "cut_size_mm", "outflow_t_per_h"):
            self.assertEqual(again[name], row[name], name)

    def test_without_holes_it_is_an_open_trough(self):
        """A sheet without holes: nothing passes, and all that is fed leaves over the edge or is held."""
        self.run_campaign(self.write_campaign(FED_SCREEN | SOFT | {"screen.opening": "0 mm", "screen.wire": "5 mm"}), wanted=1)
        with h5py.File(self.results()[0]) as file:
            self.assertEqual(file["through/1"]["passed"].sum(), 0)
            np.testing.assert_array_equal(file["partition"]["stays"], [1, 1, 1])

    def test_a_killed_run_gives_the_same_numbers(self):
        campaign = self.write_campaign(FED_SCREEN | SOFT)
        one, other = self.results_with_and_without_a_kill(campaign, 4, wanted=None)
        with h5py.File(one) as file, h5py.File(other) as same:
            for table in ("flow/1", "size_cycles/1", "partition"):
                self.assertEqual(file[table][()].tobytes(), same[table][()].tobytes(), table)

    def test_lost_grains_are_noticed(self):
        """The negative control: a deck that takes grains out of the layer without telling."""
        os.environ["VIBROTROUGH_TEST_BREAK"] = LOSING
        campaign = self.write_campaign(FED_SCREEN | SOFT)
        done = self.call(*self.run_arguments(campaign))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.table()[0]["outcome"], "lost-grains")
        self.assertTrue(re.search("are missing at the end of cycle 8", json.dumps(self.ask_json("status"))))


if __name__ == "__main__":
    unittest.main()
