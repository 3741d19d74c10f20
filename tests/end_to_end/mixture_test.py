"""A layer of two materials with the real engine: what result.h5 says of them against what numpy makes of the engine's dumps, and a run that
is killed and goes on.
"""

import unittest

import h5py
import numpy as np

from trough_program import EndToEndTest, campaign_text, count_cycles, wait_until

MATERIALS = """
[[materials]]
name = "fines"
mass_fraction = 0.4
diameter = "2 mm"
diameter_spread = 0
density = "2500 kg/m3"
friction = 0.3
trough_friction = 0.1

[[pairs]]
materials = ["grains", "fines"]
friction = 0.45
"""
LAYER = {"layer.grains": 120, "measure.packings": 2, "measure.max_packings": 2, "measure.half_width": 1.0, "measure.max_cycles": 20}
DENSITY = {1: 1400, 3: 2500}  # by atom type: the trough is type 2


def read_dump(path):
    """{column: values} of one frame."""
    lines = path.read_text().splitlines()
    names = lines[8].split()[2:]
    rows = np.array([[float(word) for word in line.split()] for line in lines[9:]])
    return dict(zip(names, rows.T))


class Mixture(EndToEndTest):
    def write_mixture(self, changes=None, name="campaign.toml"):
        path = self.folder / name
        path.write_text(campaign_text({**LAYER, **(changes or {})}) + MATERIALS)
        return path

    def result(self, output=None):
        (path,) = (output or self.output).glob("cases/*/result.h5")
        return h5py.File(path)

    def test_the_materials_are_where_the_dumps_say(self):
        self.run_campaign(self.write_mixture({"output.frames_per_cycle": 1}))
        (packing,) = self.output.glob("cases/*/packing-1")
        with self.result() as file:
            steps = int(file["packings"]["steps_per_cycle"][0])
            ends = file["material_ends/1"][:]
            whole = file["cycle_ends/1"]["centre_of_mass_z"]
            materials = file["materials"][:]
            over_time = file["segregation"]["index_1"]
        for cycle in (1, len(whole) - 1):
            frame = read_dump(packing / f"dump/frames.{cycle * steps}.dump")
            mass = np.array([DENSITY[kind] for kind in frame["type"]]) * frame["radius"] ** 3
            for number, kind in enumerate(DENSITY):
                chosen = frame["type"] == kind
                height = np.average(frame["z"][chosen], weights=mass[chosen])
                # Dumps have six digits; grains may have left the box at its ends, so that only heights compare.
                self.assertAlmostEqual(height, ends[f"z_{number}"][cycle], delta=2e-8)
            self.assertAlmostEqual(np.average(frame["z"], weights=mass), whole[cycle], delta=2e-8)
        self.assertEqual([name.decode() for name in materials["name"]], ["grains", "fines"])
        frame = read_dump(packing / f"dump/frames.{steps}.dump")
        self.assertAlmostEqual(np.mean(frame["type"] == 3), materials["number_fraction"][1], delta=1 / len(frame["type"]))
        self.assertEqual(len(over_time), len(whole))
        self.assertAlmostEqual(materials["segregation"][0], -materials["segregation"][1], delta=1e-12)
        # The centre of mass of the layer moves with the mean of the materials, weighted with their masses.
        table = self.table()[0]
        self.assertAlmostEqual(table["segregation"], materials["segregation"][1], delta=1e-12)
        self.assertAlmostEqual(0.6 * materials["efficiency"][0] + 0.4 * materials["efficiency"][1], table["efficiency"], delta=0.01)

    def test_a_run_that_is_killed_goes_on_with_the_same_numbers(self):
        changes = {"output.checkpoint_cycles": 5}
        self.run_campaign(self.write_mixture(changes))
        with self.result() as file:
            heights = file["material_ends/1"]["z_1"]
        other = self.folder / "other"
        campaign = self.write_mixture(changes, "again.toml")
        process = self.start_campaign(campaign, other)
        wait_until(lambda: any(count_cycles(path) > 7 for path in other.glob("cases/*/packing-1/cycles.csv")), "eight cycles", process)
        process.kill()
        process.wait()
        self.kill_leftovers()
        self.run_campaign(campaign, other)
        with self.result(other) as file:
            np.testing.assert_array_equal(file["material_ends/1"]["z_1"], heights)


if __name__ == "__main__":
    unittest.main()
