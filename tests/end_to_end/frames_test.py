"""Frames of a real run, exported while it runs and when it is done."""

import base64
import re
import shlex
import struct
import unittest
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

from trough_program import EndToEndTest, count_cycles, engines_in, wait_until

FRAMES_PER_CYCLE = 4
GRAINS = 60


def read_array(file, name):
    """An array of an inline binary, compressed .vtp as VTK's file format describes it: base64 of a header (number of
    blocks, size of a block, size of the last, compressed sizes), then base64 of the blocks."""
    root = ElementTree.parse(file).getroot()
    width = {"UInt32": 4, "UInt64": 8}[root.get("header_type")]
    kind = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8"}
    array = next(one for one in root.iter("DataArray") if one.get("Name") == name)
    text = array.text.strip()

    def numbers(count):
        coded = 4 * -(-count * width // 3)  # base64 makes 4 letters of 3 bytes
        return struct.unpack(f"<{count}{'I' if width == 4 else 'Q'}", base64.b64decode(text[:coded])[: count * width])

    blocks = numbers(1)[0]
    header = numbers(3 + blocks)
    body = base64.b64decode(text[4 * -(-(3 + blocks) * width // 3) :])
    content, start = b"", 0
    for size in header[3:]:
        content += zlib.decompress(body[start : start + size])
        start += size
    values = np.frombuffer(content, kind[array.get("type")])
    components = int(array.get("NumberOfComponents", 1))
    return values.reshape(-1, components) if components > 1 else values


class Frames(EndToEndTest):
    def setUp(self):
        super().setUp()
        changes = {"output.frames_per_cycle": FRAMES_PER_CYCLE, "measure.packings": 2}
        self.campaign = self.write_campaign(changes)

    def export(self):
        done = self.call("export", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        pattern = r"case (\w{12}): (\d+) frames; open with: sh (.*)\n"
        told = re.fullmatch(pattern, done.stdout)
        self.assertTrue(told, done.stdout)
        case, count, script = told.groups()
        folder = self.output.resolve() / "cases" / case / "frames"
        self.assertEqual(script, shlex.quote(str(folder / "view.sh")))
        for name in ("view.sh", "view_case.py", "profile.pvd", "point_mass.pvd"):
            self.assertTrue((folder / name).is_file(), name)
        return folder, int(count)

    def check_collection(self, folder, name, count, period):
        """Every frame is there, at its true time; returns the frames' files."""
        entries = list(ElementTree.parse(folder / f"{name}.pvd").getroot().iter("DataSet"))
        self.assertEqual(len(entries), count)
        times = [float(entry.get("timestep")) for entry in entries]
        # Frames are whole numbers of time steps apart; their times are sums and products of doubles.
        np.testing.assert_allclose(times, np.arange(count) * period / FRAMES_PER_CYCLE, rtol=1e-9, atol=1e-12)
        files = [folder / entry.get("file") for entry in entries]
        for file in files:
            # Debian's ParaView shows a file with appended data as an empty scene, without an error.
            self.assertNotIn(b"AppendedData", file.read_bytes())
        return files

    def check_grains(self, file):
        piece = next(ElementTree.parse(file).getroot().iter("Piece"))
        self.assertEqual(int(piece.get("NumberOfPoints")), GRAINS)
        self.assertEqual(sorted(read_array(file, "id")), list(range(1, GRAINS + 1)))
        # Three classes of equal number, single precision.
        radii = np.sort(read_array(file, "radius"))
        np.testing.assert_allclose(radii, np.repeat([0.00135, 0.0015, 0.00165], GRAINS // 3), rtol=1e-6)

    def test_export_while_it_runs_and_after(self):
        driver = self.start_campaign(self.campaign)

        def some_frames():
            tables = list(self.output.glob("cases/*/packing-1/dump/frames.csv"))
            return tables and len(tables[0].read_text().splitlines()) > 2 + 3 and engines_in(self.output)

        wait_until(some_frames, "frames were written", driver)
        folder, count = self.export()
        self.assertGreaterEqual(count, 3)
        self.assertEqual(len(list((folder / "grains").glob("*.vtp"))), count)
        code, output, errors = self.finish(driver)
        self.assertEqual(code, 0, output + errors)

        folder, count = self.export()
        (row,) = self.table()
        packing = folder.parent / "packing-1"
        self.assertEqual(count, count_cycles(packing / "cycles.csv") * FRAMES_PER_CYCLE + 1)
        period = 1 / row["frequency_hz"]
        grains = self.check_collection(folder, "grains", count, period)
        trough = self.check_collection(folder, "trough", count, period)
        for file in (grains[0], grains[-1]):
            self.check_grains(file)
        self.check_motion(grains, trough)
        self.check_point_mass(folder, count, period, trough)
        self.assertFalse((folder.parent / "packing-2" / "dump" / "frames.csv").exists(), "frames show one packing")

    def check_motion(self, grains, trough):
        """A quarter of a cycle after its start the trough is at its largest displacement, and stands still."""
        amplitude = 0.003 * np.array([2, 0, 1]) / np.sqrt(5)  # tan(beta) = 0.5
        rest, largest = read_array(trough[0], "Points"), read_array(trough[1], "Points")
        # The engine's wiggle is off by A pi / n, 0.2 % of the amplitude at 1500 steps per cycle, and single
        # precision by 1e-8 m.
        np.testing.assert_allclose(largest - rest, np.tile(amplitude, (len(rest), 1)), rtol=0, atol=1e-5)
        velocity = read_array(grains[1], "velocity")
        relative = read_array(grains[1], "velocity_relative_to_trough")
        # Standing still up to the phase's rounding; six digits of velocities below 1 m/s.
        np.testing.assert_allclose(relative, velocity, rtol=0, atol=1e-6)
        # At the start of a cycle the trough moves at omega A.
        start = read_array(grains[4], "velocity") - read_array(grains[4], "velocity_relative_to_trough")
        omega = np.sqrt(2 * 9.81 / amplitude[2])  # throw number 2
        np.testing.assert_allclose(start, np.tile(omega * amplitude, (GRAINS, 1)), rtol=0, atol=1e-6)

    def check_point_mass(self, folder, count, period, trough):
        """The theory's block is conveyed by its efficiency, and never below the trough."""
        self.check_collection(folder, "profile", count, period)
        blocks = self.check_collection(folder, "point_mass", count, period)
        for block, floor in zip(blocks[-4:], trough[-4:]):
            # The engine's wiggle and the theory's sine differ by 0.2 % of 3 mm.
            lowest = read_array(block, "Points")[:, 2].min()
            self.assertGreater(lowest, read_array(floor, "Points")[:, 2].max() - 1e-5)
        moved = read_array(blocks[-1], "displacement") - read_array(blocks[0], "displacement")
        theory = self.table()[0]["efficiency_theory"] * 2 * np.pi * 0.003 * 2 / np.sqrt(5)  # m per cycle
        np.testing.assert_allclose(moved, theory * (count - 1) / FRAMES_PER_CYCLE, rtol=1e-6)

    def test_export_of_another_drive(self):
        """An ellipse with a harmonic, between side walls: the block moves in step with this trough, too."""
        changes = {"output.frames_per_cycle": FRAMES_PER_CYCLE, "measure.packings": 1, "trough.along_phase": "20 deg",
                   "trough.harmonics": ["3, 0.2, 40 deg"], "trough.side_wall_friction": 0.3}  # fmt: skip
        self.run_campaign(self.write_campaign(changes))
        folder, count = self.export()
        period = 1 / self.table()[0]["frequency_hz"]
        trough = self.check_collection(folder, "trough", count, period)
        blocks = self.check_collection(folder, "point_mass", count, period)
        for block, floor in list(zip(blocks, trough))[:8]:
            gap = read_array(block, "Points")[:, 2].min() - read_array(floor, "Points")[:, 2].max()
            # The engine's steps and the drive's formula differ by less than 0.5 % of 3 mm.
            np.testing.assert_allclose(gap, read_array(block, "gap")[0], rtol=0, atol=1.5e-5)
        solid = read_array(folder / "profile" / "000000.vtp", "solid_fraction")
        self.assertTrue(0.4 < solid[1] < 0.75, solid)

    def test_export_without_frames(self):
        campaign = self.write_campaign({"measure.packings": 1})
        self.run_campaign(campaign)
        self.assert_one_line_error(self.call("export", self.output), 2, "holds no frames", "frames_per_cycle = 20")
        told = f"has no case 123456789abc; 'vibrotrough status {self.output}' lists them"
        self.assert_one_line_error(self.call("export", self.output, "--case", "123456789abc"), 2, told)


if __name__ == "__main__":
    unittest.main()
