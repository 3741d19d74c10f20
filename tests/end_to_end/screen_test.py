"""A screen with the real engine: its numbers against the engine's files, in result.h5, in ParaView's files, after a kill, in a bundle, and when nothing is left on it."""

import unittest

import h5py
import numpy as np
from vtk import vtkXMLPolyDataReader

from trough_program import EndToEndTest

# Grains of 2.7, 3 and 3.3 mm on openings of 3.2 mm, for 24 cycles.
SCREEN = {
    "trough.throw_number": 2.5,
    "trough.frequency": None,
    "grains.youngs_modulus": "5 MPa",
    "screen.opening": "3.2 mm",
    "screen.wire": "1.8 mm",
    "screen.time": "1.2 s",
    "measure.max_cycles": None,
    "output.checkpoint_cycles": 6,
}


def points_in(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput().GetNumberOfPoints(), reader.GetOutput().GetNumberOfCells()


class Screen(EndToEndTest):
    def write_screen(self, changes=None):
        path = self.write_campaign(SCREEN | (changes or {}))
        path.write_text("\n".join(line for line in path.read_text().splitlines() if not line.startswith("max_packings")) + "\n")
        return path

    def check_observables(self):
        """Grains that leave have no way through all frames: what needs one is left out, and the rest is measured."""
        done = self.call("observe", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("speed_of_grains", "dispersion", "mean_squared_displacement"):
            self.assertIn(f"{name} is not measured: it has no value in any packing: it returned None, grains come or go", done.stderr)
        for name in ("granular_temperature_of_frames [m2/s2]", "segregation_index [1]"):
            self.assertIn(name, done.stdout)

    def test_the_numbers_are_those_of_the_engine(self):
        self.run_campaign(self.write_screen({"output.frames_per_cycle": 1}))
        self.check_observables()
        row = self.table()[0]
        with h5py.File(self.results()[0]) as file:
            partition, screening = file["partition"][()], file["screening"][()]
            sizes = {number: file[f"sizes/{number}"][()] for number in (1, 2)}
            cycles = {number: file[f"screen/{number}"][()] for number in (1, 2)}
        stays, passed_mass = [], []
        for number in (1, 2):
            folder = next(iter(self.output.glob(f"cases/*/packing-{number}")))
            found = {}
            for dump in sorted(folder.glob("passed.*.dump"), key=lambda path: int(path.name.split(".")[1])):
                for snapshot in dump.read_text().split("ITEM: ATOMS id radius")[1:]:
                    lines = snapshot.split("ITEM: TIMESTEP")[0].splitlines()
                    found |= {int(number): 2 * float(radius) for number, radius in (line.split() for line in lines if line.strip())}
            counts = [sum(abs(d - size) < 1e-7 for d in found.values()) for size in sizes[number]["diameter"]]
            np.testing.assert_array_equal(sizes[number]["passed"], counts)
            self.assertEqual(counts[2], 0)  # as large as 3.3 mm
            self.assertGreater(counts[0], 0)
            held = cycles[number]["held"]
            np.testing.assert_array_equal(held + np.cumsum(cycles[number]["passed"]), 60)
            mass = cycles[number]["held_mass"] + np.cumsum(cycles[number]["passed_mass"])
            np.testing.assert_allclose(mass, mass[0], rtol=1e-12)
            self.assertEqual(held[-1], 60 - len(found))
            stays.append(1 - sizes[number]["passed"] / sizes[number]["number"])
            weight = sizes[number]["number"] * sizes[number]["diameter"] ** 3
            passed_mass.append((weight * (1 - stays[-1]))[:2].sum() / weight[:2].sum())
        np.testing.assert_allclose(partition["stays"], np.mean(stays, axis=0), atol=1e-12)
        # Student's interval knows no bounds; a share has them. The largest size stays altogether.
        np.testing.assert_allclose(partition["stays_low"], np.maximum(0, partition["stays"] - partition["stays_half_width"]), atol=1e-12)
        np.testing.assert_allclose(partition["stays_high"], np.minimum(1, partition["stays"] + partition["stays_half_width"]), atol=1e-12)
        self.assertEqual(partition["stays_high"][2], 1)
        np.testing.assert_allclose(partition["probability"], [(0.5 / 5) ** 2, (0.2 / 5) ** 2, 0], rtol=1e-9)
        self.assertAlmostEqual(row["screening_efficiency"], np.mean(passed_mass), delta=1e-12)
        self.assertAlmostEqual(screening["efficiency"][-1], np.mean(passed_mass), delta=1e-12)
        self.assertAlmostEqual(screening["distance"][-1], row["screen_distance_m"], delta=1e-12)
        self.assertEqual(row["outcome"], "finished")
        self.check_frames(cycles[1])
        self.check_bundle(row)

    def check_frames(self, cycles):
        """ParaView gets the sheet with its nine holes and the grains that are left."""
        done = self.call("export", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        case = next(iter(self.output.glob("cases/*")))
        triangles = (case / "packing-1" / "trough.stl").read_text().count("facet normal")
        grains, trough = (sorted(case.glob(f"frames/{name}/*.vtp")) for name in ("grains", "trough"))
        self.assertEqual(points_in(trough[-1])[1], triangles)
        # A frame is written before the grains below the screen are taken out.
        self.assertEqual(points_in(grains[-1])[0], cycles["held"][-1] + cycles["passed"][-1])
        self.assertEqual(points_in(grains[0])[0], 60)

    def check_bundle(self, row):
        again = self.row_of_bundle()
        names = [name for name in row if name.startswith(("screen", "passed_share", "undersize", "cut_size"))]
        self.assertGreaterEqual(len(names), 11)
        self.assertEqual([again[name] for name in names], [row[name] for name in names])

    def test_a_killed_run_gives_the_same_numbers(self):
        campaign = self.write_screen({"measure.packings": 1})
        one, other = self.results_with_and_without_a_kill(campaign, 6)
        with h5py.File(one) as file, h5py.File(other) as same:
            for table in ("partition", "screening", "passed/1", "screen/1"):
                self.assertEqual(file[table][()].tobytes(), same[table][()].tobytes(), table)

    def test_all_grains_may_pass(self):
        self.run_campaign(self.write_screen({"measure.packings": 1, "screen.opening": "14 mm", "screen.wire": "1 mm"}))
        with h5py.File(self.results()[0]) as file:
            np.testing.assert_array_equal(file["partition"]["stays"], [0, 0, 0])
            self.assertEqual(file["screen/1"]["held"][-1], 0)
        self.assertAlmostEqual(self.table()[0]["screening_efficiency"], 1, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
