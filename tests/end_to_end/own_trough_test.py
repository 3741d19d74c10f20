"""A trough from an STL file with the real engine: a flat mesh against the flat floor, a channel with upright walls, and what happens to the file."""

import json
import struct
import unittest
import zipfile

import h5py
from vtk import vtkXMLPolyDataReader

from trough_program import EndToEndTest, campaign_text

LENGTH, WIDTH = 15.0, 15.0  # mm
FLOOR = [((0, 0, 0), (LENGTH, 0, 0), (LENGTH, WIDTH, 0)), ((0, 0, 0), (LENGTH, WIDTH, 0), (0, WIDTH, 0))]
WALLS = [
    triangle
    for y in (0, WIDTH)
    for triangle in (((0, y, 0), (LENGTH, y, 0), (LENGTH, y, 40)), ((0, y, 0), (LENGTH, y, 40), (0, y, 40)))
]
CHANGES = {"measure.packings": 1, "measure.max_packings": 1, "measure.max_cycles": 20}


def stl(triangles):
    """A binary STL, as CAD programs write it."""
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(number for corner in triangle for number in corner), 0) for triangle in triangles)
    return b"made by a test".ljust(80) + struct.pack("<I", len(triangles)) + body


def solid(name, start, end):
    """A piece of a flat floor as a solid of a text STL."""
    corners = [((start, 0, 0), (end, 0, 0), (end, WIDTH, 0)), ((start, 0, 0), (end, WIDTH, 0), (start, WIDTH, 0))]
    facets = "".join("facet normal 0 0 1 outer loop " + " ".join(f"vertex {x} {y} {z}" for x, y, z in three) + " endloop endfacet\n" for three in corners)
    return f"solid {name}\n{facets}endsolid {name}\n"


class OwnTrough(EndToEndTest):
    def write(self, triangles, name="campaign.toml", changes=None):
        (self.folder / "own.stl").write_bytes(stl(triangles))
        path = self.folder / name
        path.write_text(campaign_text({**CHANGES, "trough.mesh": "own.stl", "trough.mesh_unit": "mm", **(changes or {})}))
        return path

    def efficiencies(self, output):
        (path,) = output.glob("cases/*/result.h5")
        with h5py.File(path) as file:
            return file["packings"]["efficiency"]

    def test_a_flat_mesh_is_the_flat_floor(self):
        """The same box, grains and seeds: the same packings, but for the places where triangles meet."""
        two = CHANGES | {"measure.packings": 2, "measure.max_packings": 2}
        self.run_campaign(self.write(FLOOR, changes=two), self.folder / "mesh")
        self.run_campaign(self.write_campaign(two, name="flat.toml"), self.folder / "flat")
        mesh, flat = self.efficiencies(self.folder / "mesh"), self.efficiencies(self.folder / "flat")
        for one, other in zip(mesh, flat):
            # A contact that moves over an edge may lose its history in another step; layers are chaotic after that.
            self.assertAlmostEqual(one, other, delta=0.05)

    def test_solids_with_a_friction_of_their_own(self):
        """A layer stays where it is on a level floor without friction. A rough liner on half of the floor conveys it. A liner with the
        floor's own friction changes nothing: the packings agree as those on the mesh and on the flat floor do."""
        (self.folder / "own.stl").write_text(solid("floor", 0, LENGTH / 2) + solid("liner", LENGTH / 2, LENGTH))
        mean = {}
        for name, floor, liner in (("slippery", 0.0, None), ("lined", 0.0, 0.5), ("plain", 0.23, None), ("same", 0.23, 0.23)):
            pair = "" if liner is None else f'[[pairs]]\nmaterials = ["grains", "liner"]\nfriction = {liner}\n'
            campaign = self.folder / f"{name}.toml"
            changes = {**CHANGES, "trough.mesh": "own.stl", "trough.mesh_unit": "mm", "trough.friction": floor, "output.frames_per_cycle": 2 if name == "lined" else 0}
            campaign.write_text(campaign_text(changes) + pair)
            self.run_campaign(campaign, self.folder / name, wanted=None)  # one packing may not be precise
            (mean[name],) = self.efficiencies(self.folder / name)
        self.assertAlmostEqual(mean["slippery"], 0, delta=0.06)  # grains that began at the trough's speed keep it, as nothing stops them
        self.assertGreater(mean["lined"], 0.4)
        self.assertAlmostEqual(mean["same"], mean["plain"], delta=0.05)
        done = self.call("export", self.folder / "lined")
        self.assertEqual(done.returncode, 0, done.stderr)
        (packing,) = (self.folder / "lined").glob("cases/*/packing-1")
        self.assertIn("solid", (packing / "part.1.stl").read_text())
        first = sorted((self.folder / "lined").glob("cases/*/frames/trough/*.vtp"))[0]
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(first))
        reader.Update()
        cells = reader.GetOutput().GetCellData().GetArray("part")
        self.assertEqual({cells.GetValue(i) for i in range(cells.GetNumberOfTuples())}, {0, 1})

    def test_a_channel_keeps_its_grains(self):
        """With upright walls the box is not periodic across, and no grain leaves it."""
        self.run_campaign(self.write(FLOOR + WALLS, changes={"trough.friction": 0.5}), wanted=1)
        row = self.table()[0]
        self.assertIn(row["outcome"], ("finished", "not-precise"))
        (deck,) = self.output.glob("cases/*/packing-1/in.liggghts")
        self.assertIn("boundary        p f f", deck.read_text())

    def test_the_file_is_a_part_of_the_case(self):
        campaign = self.write(FLOOR)
        self.run_campaign(campaign, wanted=1)
        case = self.table()[0]["case"]
        for copy in (self.output / "own.stl", self.output / "cases" / case / "own.stl"):
            self.assertTrue(copy.read_text().startswith("solid"), copy)
        (result,) = self.results()
        with h5py.File(result) as file:
            self.assertIn("own.stl", json.loads(file["scenario_files"][0]))
        bundle = self.folder / "bundle.zip"
        done = self.call("archive", self.output, "--output", bundle)
        self.assertEqual(done.returncode, 0, done.stderr)
        with zipfile.ZipFile(bundle) as file:
            self.assertTrue([name for name in file.namelist() if name.endswith("own.stl")], file.namelist())
        # A changed file is another case, which does not take the results of the first.
        other = self.folder / "other"
        self.run_campaign(self.write(FLOOR + WALLS), other, wanted=1)
        self.assertNotEqual(self.table(other)[0]["case"], case)


if __name__ == "__main__":
    unittest.main()
