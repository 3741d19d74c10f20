"""The contacts of the frames, output.contacts, and frames of any packing, output.frame_packings: forces balance the weight of each
grain, the motion does not change by a bit, and VTK's own reader opens what was exported. All with the real engine.
"""

import math
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
from vtk import vtkXMLPolyDataReader
from vtk.util.numpy_support import vtk_to_numpy

from trough_program import EndToEndTest

DENSITY, GRAVITY, DIAMETER = 1400, 9.81, 0.003
SHORT = {"output.frames_per_cycle": 4, "measure.packings": 2, "measure.max_packings": 2, "measure.max_cycles": 20,
         "measure.half_width": 0.5}  # fmt: skip


def read_vtp(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def arrays_of(values):
    return {values.GetArrayName(i): vtk_to_numpy(values.GetArray(i)) for i in range(values.GetNumberOfArrays())}


def read_contacts(path):
    """Ends of the lines, (n, 2, 3), and the arrays of the contacts."""
    data = read_vtp(path)
    count = data.GetNumberOfLines()
    if count == 0:
        return np.empty((0, 2, 3)), {}
    assert data.GetNumberOfPoints() == 2 * count
    lines = vtk_to_numpy(data.GetLines().GetConnectivityArray()).reshape(count, 2)
    return vtk_to_numpy(data.GetPoints().GetData())[lines], arrays_of(data.GetCellData())


class Contacts(EndToEndTest):
    def run_and_export(self, changes, output):
        self.run_campaign(self.write_campaign(changes), output, wanted=None)
        done = self.call("export", output)
        self.assertEqual(done.returncode, 0, done.stderr)
        (case,) = output.glob("cases/*")
        return case, done.stdout

    def check_geometry(self, frame):
        """Lines are as long as the radii less the overlap; forces are at right angles, and friction obeys Coulomb."""
        ends, contact = read_contacts(frame)
        grains = arrays_of(read_vtp(frame.parent.parent / "grains" / frame.name).GetPointData())
        radius = dict(zip(grains["id"], grains["radius"]))
        trough = contact["second_grain"] == 0
        reach = np.array([radius[one] + radius.get(other, 0) for one, other in zip(contact["first_grain"], contact["second_grain"])])
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        # Six digits of coordinates below 0.03 m, so 1e-7 m each.
        np.testing.assert_allclose(length, reach - contact["overlap"], rtol=0, atol=4e-7)
        square = contact["normal_force"] ** 2 + contact["tangential_force"] ** 2
        # Six digits of forces of 0.01 N, and single precision.
        np.testing.assert_allclose(np.sum(contact["force"] ** 2, axis=1), square, rtol=1e-4, atol=1e-12)
        limit = np.where(trough, 0.23, 0.5) * contact["normal_force"]
        self.assertTrue(np.all(contact["tangential_force"] <= limit * 1.0001 + 1e-8))
        return contact, grains

    def check_balance(self, contact, grains):
        """At rest the vertical forces on each grain sum to its weight, and those of the trough to the weight of the layer.
        A settled layer trembles: its grains were seen to be out of balance by less than 1 % of their weight, and the
        layer by 0.4 %."""
        force = dict.fromkeys(grains["id"], 0.0)
        for one, other, on_first in zip(contact["first_grain"], contact["second_grain"], contact["force"]):
            force[one] += on_first[2]
            if other:
                force[other] -= on_first[2]
        weight = DENSITY * 4 / 3 * math.pi * grains["radius"].astype(float) ** 3 * GRAVITY
        found = np.array([force[grain] for grain in grains["id"]])
        print(f"largest imbalance of a grain: {np.max(np.abs(found / weight - 1)):.2g} of its weight")
        np.testing.assert_allclose(found, weight, rtol=0.03)
        trough = contact["second_grain"] == 0
        self.assertAlmostEqual(contact["force"][trough, 2].sum() / weight.sum(), 1, delta=0.01)

    def test_forces_and_motion(self):
        plain, _ = self.run_and_export(SHORT, self.folder / "plain")
        both, told = self.run_and_export(SHORT | {"output.contacts": True, "output.frame_packings": "all"}, self.folder / "both")
        self.assertNotEqual(plain.name, both.name)
        self.assertFalse((plain / "frames" / "contacts.pvd").exists())
        self.assertFalse((plain / "frames-2").exists())
        self.assertIn(f"case {both.name}, packing 2: ", told)
        for packing in ("packing-1", "packing-2"):
            for name in ("cycles.csv", "phases.csv"):
                self.assertEqual((both / packing / name).read_bytes(), (plain / packing / name).read_bytes(), f"{packing}/{name}")
        for folder in (both / "frames", both / "frames-2"):
            entries = list(ElementTree.parse(folder / "contacts.pvd").getroot().iter("DataSet"))
            frames = list(ElementTree.parse(folder / "grains.pvd").getroot().iter("DataSet"))
            self.assertEqual([entry.get("timestep") for entry in entries], [frame.get("timestep") for frame in frames])
            for entry in entries:
                self.assertNotIn(b"AppendedData", (folder / entry.get("file")).read_bytes())
            self.check_balance(*self.check_geometry(folder / entries[0].get("file")))
        self.check_fields(both)

    def check_fields(self, case):
        """Of the first frame, at rest: the integral of the density is the mass of the grains, and the stress at z is the weight above z, the
        lowest that of the layer."""
        sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "postprocess"))
        from vibrotrough import Case, fields

        packing = Case(case).packing(1)
        frame = packing.frames[0]
        grid = fields.grid_of(frame, DIAMETER, frame.heights.max() + DIAMETER)
        found = fields.moment(frame, packing.contacts[0], grid, {1: DENSITY}, np.zeros(3))
        density, stress = found["density"].mean(axis=1), found["contact_stress"].mean(axis=1)[:, 2, 2]
        mass = DENSITY * frame.volumes.sum() / frame.floor_area
        # The sum over the grid is off by less than 6e-4 (tests/postprocess/check_fields.py).
        self.assertAlmostEqual(density.sum() * grid.steps[0] / mass, 1, delta=6e-4)
        # A settled layer trembles, see check_balance.
        self.assertAlmostEqual(stress[0] / (mass * GRAVITY), 1, delta=0.01)
        above = (np.cumsum(density[::-1])[::-1] - density / 2) * grid.steps[0] * GRAVITY
        print(f"stress in the layer at rest less the weight above it: {abs(stress - above).max() / stress[0]:.2g} of the weight")
        np.testing.assert_allclose(stress, above, rtol=0, atol=0.01 * mass * GRAVITY)


if __name__ == "__main__":
    unittest.main()
