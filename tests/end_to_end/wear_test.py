"""The wear of the trough with the real engine: its numbers against the engine's files, in result.h5, in ParaView's files, after a kill and in a bundle."""

import unittest

import h5py
import numpy as np
from vtk import vtkXMLPolyDataReader
from vtk.util.numpy_support import vtk_to_numpy

from trough_program import EndToEndTest

SHORT = {"measure.wear": True, "measure.min_cycles": 24, "measure.max_cycles": 24, "output.checkpoint_cycles": 8}
COLUMNS = ["wear_rate_w_per_m2", "wear_rate_half_width_w_per_m2", "specific_wear_j_per_t_m", "specific_wear_half_width_j_per_t_m"]


def read_wear(path):
    """{name: numbers} of the arrays of a file of LIGGGHTS' dump mesh/vtk, sorted by the number of the triangle."""
    words = path.read_text().split()
    arrays = {}
    for name in ("meshid", "wear", "area"):
        at = words.index(name)
        arrays[name] = np.array(words[at + 4 : at + 4 + int(words[at + 2])], dtype=float)
    order = np.argsort(arrays["meshid"])
    return {name: values[order] for name, values in arrays.items()}


def wear_in(path):
    """The wear of each triangle of the trough in a .vtp file, as VTK reads it."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetCellData().GetArray("wear"))


class Wear(EndToEndTest):
    def test_the_numbers_are_those_of_the_engine(self):
        self.run_campaign(self.write_campaign(SHORT | {"output.frames_per_cycle": 2}))
        row = self.table()[0]
        with h5py.File(self.results()[0]) as file:
            packings, tables = file["packings"][()], {number: file[f"wear/{number}"][()] for number in (1, 2)}
            ends = {number: file[f"cycle_ends/{number}"]["centre_of_mass_x"] for number in (1, 2)}
            case = file["case"][()]
        rates, specific = [], []
        for number, one in zip((1, 2), packings):
            begin, end = one["cycles_discarded"], one["cycles_discarded"] + one["cycles_measured"]
            folder = next(iter(self.output.glob(f"cases/*/packing-{number}")))
            first, last = (read_wear(folder / f"wear.{cycle * one['steps_per_cycle']}.vtk") for cycle in (begin, end))
            time = (end - begin) / case["frequency"]
            worn = last["wear"] - first["wear"]
            self.assertTrue(np.all(worn > 0), worn)
            np.testing.assert_allclose(tables[number]["rate"], worn / time, rtol=1e-12)
            self.assertAlmostEqual(tables[number]["area"].sum() / (0.015 * 0.015), 1, delta=1e-9)
            rates.append((worn * last["area"]).sum() / (0.015 * 0.015 * time))
            # The mass of 60 grains of three sizes, and its way.
            mass = 60 * 1400 * np.pi / 6 * 0.003**3 * (0.9**3 + 1 + 1.1**3) / 3
            specific.append((worn * last["area"]).sum() / (mass * (ends[number][end] - ends[number][begin])))
        np.testing.assert_allclose(packings["wear_rate"], rates, rtol=1e-9)
        np.testing.assert_allclose(packings["specific_wear"], specific, rtol=1e-9)
        self.assertAlmostEqual(row["specific_wear_j_per_t_m"] / (1000 * np.mean(specific)), 1, delta=1e-9)
        self.assertGreater(row["wear_rate_half_width_w_per_m2"], 0)
        self.check_frames(next(iter(self.output.glob("cases/*/packing-1"))), packings[0]["steps_per_cycle"])
        self.check_bundle(row)

    def check_frames(self, packing, steps):
        """ParaView gets what the trough has worn until the end of the last cycle."""
        done = self.call("export", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        files = sorted(packing.parent.glob("frames/trough/*.vtp"))
        self.assertEqual(len(files), 49)
        start = read_wear(packing / "wear.0.vtk")["wear"]
        for frame, cycle in ((0, 0), (1, 0), (2, 1), (47, 23), (48, 24)):
            worn = read_wear(packing / f"wear.{cycle * steps}.vtk")["wear"] - start
            np.testing.assert_allclose(wear_in(files[frame]), worn, rtol=1e-6)

    def check_bundle(self, row):
        again = self.row_of_bundle()
        self.assertEqual([again[name] for name in COLUMNS], [row[name] for name in COLUMNS])

    def check_rates(self, folder, file):
        """The rates are those of the engine's files from the end of some cycle to that of the last one. Returns that cycle."""
        steps, case, packing = file["packings"]["steps_per_cycle"][0], file["case"][()], file["packings"][0]
        last = packing["cycles_discarded"] + packing["cycles_measured"]
        worn = {cycle: read_wear(folder / f"wear.{cycle * steps}.vtk") for cycle in range(last + 1)}
        rates, area = file["wear/1"]["rate"], file["wear/1"]["area"]
        np.testing.assert_allclose(area, worn[0]["area"], rtol=1e-9)
        self.assertGreater(rates.max(), 0)
        self.assertAlmostEqual(packing["wear_rate"] / ((rates * area).sum() / area.sum()), 1, delta=1e-9)
        begins = [cycle for cycle in range(packing["cycles_discarded"], last)
                  if np.allclose((worn[last]["wear"] - worn[cycle]["wear"]) * case["frequency"] / (last - cycle), rates, rtol=1e-9)]  # fmt: skip
        self.assertEqual(len(begins), 1)
        return begins[0], last

    def test_an_open_trough_wears_per_mass_that_left_it(self):
        changes = {"layer.grains": None, "layer.length": "75 mm", "feed.mass_flow": "0.05 t/h", "feed.length": "15 mm", "trough.side_wall_friction": 0,
                   "measure.wear": True, "measure.impacts": True, "measure.packings": 1, "measure.min_cycles": 32, "measure.max_cycles": 32}  # fmt: skip
        self.run_campaign(self.write_campaign(changes), wanted=None)
        folder = next(iter(self.output.glob("cases/*/packing-1")))
        with h5py.File(self.results()[0]) as file:
            first, last = self.check_rates(folder, file)
            packing, area, time = file["packings"][0], file["wear/1"]["area"].sum(), (last - first) / file["case"]["frequency"]
            left = file["flow/1"]["left_mass"][first + 1 : last + 1].sum()
            self.assertAlmostEqual(packing["specific_wear"] / (packing["wear_rate"] * area * time / (left * 0.075)), 1, delta=1e-9)
            # Impacts are measured there as well, per mass that is held.
            energy = np.loadtxt(folder / "impacts.csv", delimiter=",", skiprows=2)
            held, grains = file["flow/1"]["held_mass"][[30, 32]].mean(), energy[:, 2] > 0
            self.assertAlmostEqual(packing["impact_power"] * held * 2 / file["case"]["frequency"] / energy[grains, 3].sum(), 1, delta=0.02)
            self.assertGreater(packing["trough_impact_power"], 0)

    def test_a_mesh_of_your_own_wears_where_it_is_hit(self):
        """A channel whose upright walls wear less than its floor."""
        corners = [(0, 15), (0, 0), (15, 0), (15, 15)]  # y and z, mm
        text = "solid own\n"
        for (y0, z0), (y1, z1) in zip(corners, corners[1:]):
            a, b, c, d = (f"vertex {x} {y} {z}" for x, y, z in ((0, y0, z0), (15, y0, z0), (15, y1, z1), (0, y1, z1)))
            for triangle in ((a, b, c), (a, c, d)):
                text += "facet normal 0 0 0\nouter loop\n" + "\n".join(triangle) + "\nendloop\nendfacet\n"
        (self.folder / "own.stl").write_text(text + "endsolid own\n")
        changes = {"trough.mesh": "own.stl", "trough.mesh_unit": "mm", "measure.packings": 1, "measure.impacts": True}
        self.run_campaign(self.write_campaign(SHORT | changes), wanted=None)
        folder = next(iter(self.output.glob("cases/*/packing-1")))
        with h5py.File(self.results()[0]) as file:
            self.check_rates(folder, file)
            wear, power = file["wear/1"][()], file["packings"]["trough_impact_power"][0]
        floor = wear["z"] < 1e-6
        self.assertAlmostEqual(wear["area"][floor].sum(), 0.015 * 0.015, delta=1e-9)
        per_area = [(wear["rate"] * wear["area"])[part].sum() / wear["area"][part].sum() for part in (floor, ~floor)]
        self.assertGreater(per_area[0], 2 * per_area[1])
        self.assertGreater(power, 0)

    def test_the_motion_is_that_without_it(self):
        self.assert_motion_does_not_depend_on("measure.wear", SHORT)

    def test_a_killed_run_gives_the_same_numbers(self):
        campaign = self.write_campaign(SHORT | {"measure.packings": 1})
        one, other = self.results_with_and_without_a_kill(campaign, 8, wanted=None)
        with h5py.File(one) as file, h5py.File(other) as same:
            np.testing.assert_array_equal(file["wear/1"][()], same["wear/1"][()])


if __name__ == "__main__":
    unittest.main()
