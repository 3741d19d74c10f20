"""A trough from an STL file with the real engine: a flat mesh against the flat floor, a channel with upright walls, and what happens to the file."""

import json
import struct
import unittest
import zipfile

import h5py

from trough_program import EndToEndTest, campaign_text

LENGTH, WIDTH = 15.0, 15.0  # mm
FLOOR = [((0, 0, 0), (LENGTH, 0, 0), (LENGTH, WIDTH, 0)), ((0, 0, 0), (LENGTH, WIDTH, 0), (0, WIDTH, 0))]
WALLS = [
    triangle
    for y in (0, WIDTH)
    for triangle in (((0, y, 0), (LENGTH, y, 0), (LENGTH, y, 40)), ((0, y, 0), (LENGTH, y, 40), (0, y, 40)))
]
CHANGES = {"measure.packings": 2, "measure.max_packings": 2, "measure.max_cycles": 20}


def stl(triangles):
    """A binary STL, as CAD programs write it."""
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(number for corner in triangle for number in corner), 0) for triangle in triangles)
    return b"made by a test".ljust(80) + struct.pack("<I", len(triangles)) + body


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
        self.run_campaign(self.write(FLOOR), self.folder / "mesh")
        self.run_campaign(self.write_campaign(CHANGES, name="flat.toml"), self.folder / "flat")
        mesh, flat = self.efficiencies(self.folder / "mesh"), self.efficiencies(self.folder / "flat")
        for one, other in zip(mesh, flat):
            # A contact that moves over an edge may lose its history in another step; layers are chaotic after that.
            self.assertAlmostEqual(one, other, delta=0.05)

    def test_a_channel_keeps_its_grains(self):
        """With upright walls the box is not periodic across, and no grain leaves it."""
        self.run_campaign(self.write(FLOOR + WALLS, changes={"trough.friction": 0.5}))
        row = self.table()[0]
        self.assertIn(row["outcome"], ("finished", "not-precise"))
        (deck,) = self.output.glob("cases/*/packing-1/in.liggghts")
        self.assertIn("boundary        p f f", deck.read_text())

    def test_the_file_is_a_part_of_the_case(self):
        campaign = self.write(FLOOR)
        self.run_campaign(campaign)
        case = self.table()[0]["case"]
        for copy in (self.output / "own.stl", self.output / "cases" / case / "own.stl"):
            self.assertTrue(copy.read_text().startswith("solid"), copy)
        (result,) = self.results()
        with h5py.File(result) as file:
            self.assertIn("own.stl", json.loads(file["scenario_files"][()]))
        bundle = self.folder / "bundle.zip"
        done = self.call("archive", self.output, "--output", bundle)
        self.assertEqual(done.returncode, 0, done.stderr)
        with zipfile.ZipFile(bundle) as file:
            self.assertTrue([name for name in file.namelist() if name.endswith("own.stl")], file.namelist())
        # A changed file is another case, which does not take the results of the first.
        other = self.folder / "other"
        self.run_campaign(self.write(FLOOR + WALLS), other)
        self.assertNotEqual(self.table(other)[0]["case"], case)


if __name__ == "__main__":
    unittest.main()
