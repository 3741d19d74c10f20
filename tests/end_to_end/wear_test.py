"""The wear of the trough with the real engine: its numbers against the engine's files, in result.h5, in ParaView's files, after a kill and in a bundle."""

import json
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
        bundle = self.folder / "bundle.zip"
        done = self.call("archive", self.output, "--output", bundle)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.call("compare", bundle, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        again = json.loads(done.stdout)
        again = (again["cases"] if isinstance(again, dict) else again)[0]
        self.assertEqual([again[name] for name in COLUMNS], [row[name] for name in COLUMNS])

    def test_the_motion_is_that_without_it(self):
        lines = []
        for wear in (True, False):
            output = self.folder / f"wear {wear}"
            self.run_campaign(self.write_campaign(SHORT | {"measure.packings": 1, "measure.wear": wear}), output, wanted=None)
            lines.append([next(iter(output.glob(f"cases/*/packing-1/{name}.csv"))).read_bytes() for name in ("cycles", "phases")])
        self.assertEqual(*lines)

    def test_a_killed_run_gives_the_same_numbers(self):
        campaign = self.write_campaign(SHORT | {"measure.packings": 1})
        one, other = self.results_with_and_without_a_kill(campaign, 8, wanted=None)
        with h5py.File(one) as file, h5py.File(other) as same:
            np.testing.assert_array_equal(file["wear/1"][()], same["wear/1"][()])


if __name__ == "__main__":
    unittest.main()
