"""What people bring, as made after public reports (trials/README.md), with the real engine: each file has its right answer here."""

import json
import math
import random
import shutil
import unittest
from pathlib import Path

import h5py

from trough_program import EndToEndTest, at_night, campaign_text

TRIALS = Path(__file__).with_name("trials")


class Trials(EndToEndTest):
    def bring(self, name, changes=()):
        """A copy of a trial; `changes`: pairs of a text and what stands in its place."""
        for path in TRIALS.iterdir():
            shutil.copy(path, self.folder)
        path = self.folder / f"{name}.toml"
        text = path.read_text()
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        path.write_text(text)
        return path

    def check(self, name, changes=()):
        told = self.call("check", self.bring(name, changes), "--json")
        self.assertEqual(told.returncode, 0, told.stderr)
        return json.loads(told.stdout)

    def efficiencies(self):
        return {path.parent.name: h5py.File(path)["packings"]["efficiency"][:] for path in (self.folder / "results").glob("cases/*/result.h5")}

    def run_shortly(self, name, changes=()):
        """One packing of few cycles: whether the engine takes the case."""
        text = self.bring(name, changes).read_text()
        for key, value in (("packings", 1), ("max_packings", 1), ("max_cycles", 20)):
            lines = [line for line in text.splitlines() if not line.startswith(f"{key} = ")]
            text = "\n".join(lines).replace("[measure]", f"[measure]\n{key} = {value}") + "\n"
        (self.folder / f"{name}.toml").write_text(text)
        done = self.call("run", self.folder / f"{name}.toml", "--output", self.folder / "results", "--quiet", "--accept-findings")
        status = json.loads(self.call("status", self.folder / "results", "--json").stdout)
        self.assertEqual((status["finished"] + status["unsure"], status["failed"]), (1, 0), done.stdout + done.stderr)

    def test_a_doubled_triangle_is_left_out(self):
        self.assertIn("2 copies of triangles were left out: triangle 3", " ".join(self.check("duplicate")["remarks"]))
        self.run_shortly("duplicate")

    def test_rounded_corners_are_divided(self):
        """The engine's limit is an angle of 0.26 degrees; strips of 1 mm on 600 mm have 0.1."""
        (item,) = [one for one in self.check("rounded_corners")["cases"][0]["findings"] if one["item"].startswith("smallest angle")]
        self.assertGreater(item["measured"], 1)

    @at_night
    def test_rounded_corners_run(self):
        self.run_shortly("rounded_corners")

    def test_a_record_is_a_drive(self):
        """Accelerations of one cycle and ten cycles of displacements are the same motion."""
        one, ten = self.check("record"), self.check("ten_cycles")
        self.assertIn("1 whole cycle of accelerations at 25 Hz", " ".join(one["remarks"]))
        self.assertIn("10 whole cycles of displacements at 25 Hz", " ".join(ten["remarks"]))
        for told in (one, ten):
            self.assertIn("taken as nominal values", " ".join(told["remarks"]))
        self.assertAlmostEqual(one["cases"][0]["throw_number"], ten["cases"][0]["throw_number"], delta=0.01)

    def test_up_and_down_conveys_nothing(self):
        self.run_shortly("updown")
        for values in self.efficiencies().values():
            self.assertLess(abs(values[0]), 0.02, "on a level trough nothing drives the layer along")
        done = self.call("report", self.folder / "results")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "results" / "report" / "record.svg").is_file(), "the record and the cycle of the deck")

    def test_quick_return(self):
        self.run_shortly("quickreturn")
        for values in self.efficiencies().values():
            self.assertGreater(values[0], 0)

    def test_powder(self):
        told = self.check("powder")
        self.assertTrue(any("air" in one["advice"] and one["severity"] == "warning" for one in told["cases"][0]["findings"]))

    def test_what_cannot_be_simulated(self):
        for name, words in (("skirt_at_rest", "move differently"), ("rocking", "rocks or turns")):
            told = self.call("check", self.bring(name))
            self.assertEqual(told.returncode, 2, told.stdout)
            self.assertIn(words, told.stderr)
            self.assertIn("scope.md", told.stderr)

    def noisy_record(self):
        """Ten cycles of an accelerometer at 3.3 kHz, with noise, an offset and a slow drift, of the drive of three harmonics."""
        draw = random.Random(1)
        omega, rows = 2 * math.pi * 25, []
        for i in range(1325):
            t = 1.7 + i / 3300
            x = -omega**2 * (1.8e-3 * math.sin(omega * t) + 9e-4 * math.sin(3 * omega * t + 0.5))
            z = -omega**2 * 1.1e-3 * math.sin(omega * t + 0.2)
            drift = 0.4 + 2 * (t - 1.7)
            rows.append(f"{t:.6f};{x + drift + draw.gauss(0, 3):.4f};{z + drift + draw.gauss(0, 3):.4f}".replace(".", ","))
        (self.folder / "noisy.csv").write_text("time_s;ax_m_per_s2;az_m_per_s2\n" + "\n".join(rows) + "\n")
        harmonic = [f"{i / 2500:.6f},{1.8e-3 * math.sin(omega * i / 2500) + 1e-4 * math.sin(3 * omega * i / 2500 + 0.5)!r},"
                    f"{1.1e-3 * math.sin(omega * i / 2500 + 0.2)!r}" for i in range(100)]
        (self.folder / "clean.csv").write_text("time_s,x_m,z_m\n" + "\n".join(harmonic) + "\n")

    @at_night
    def test_a_noisy_record_conveys_as_the_clean_drive(self):
        """The same packings: their scatter of 0.03 is common to both drives; what is left is the record's error, and what chaos makes of it."""
        self.noisy_record()
        means = {}
        for name in ("noisy", "clean"):
            keys = ("tan_vibration_angle", "amplitude", "throw_number")
            changes = {f"trough.{key}": None for key in keys} | {
                "trough.waveform": f"{name}.csv", "measure.packings": 6, "measure.max_packings": 6, "measure.max_cycles": 300,
                "measure.min_cycles": 300, "measure.half_width": 0.02, "grains.youngs_modulus": None}
            path = self.folder / f"{name}.toml"
            path.write_text(campaign_text(changes))
            self.call("run", path, "--output", self.folder / name, "--quiet", "--accept-findings")
            (result,) = (self.folder / name).glob("cases/*/result.h5")
            with h5py.File(result) as file:
                means[name] = file["packings"]["efficiency"][:].mean()
        self.assertAlmostEqual(means["noisy"], means["clean"], delta=0.01)

    def test_three_sizes_of_one_layer(self):
        """The same numbers without dimension (r / d, omega^2 r / g, E / (rho g d)) give the same efficiency. Fillings are chaotic, so that
        only means agree: those of four packings scatter by 0.015, and two of them differ by less than four times 0.021."""
        means = {}
        for diameter in (50e-6, 3e-3, 100e-3):
            scale = diameter / 3e-3
            path = self.folder / f"{diameter}.toml"
            path.write_text(campaign_text({
                "trough.amplitude": f"{3 * scale!r} mm", "grains.diameter": f"{3 * scale!r} mm",
                "grains.youngs_modulus": f"{6e6 * scale!r} Pa", "layer.length": f"{15 * scale!r} mm", "layer.width": f"{15 * scale!r} mm",
                "measure.packings": 4, "measure.max_packings": 4, "measure.max_cycles": 40}))
            self.call("run", path, "--output", self.folder / f"of {diameter}", "--quiet", "--accept-findings")
            (result,) = (self.folder / f"of {diameter}").glob("cases/*/result.h5")
            with h5py.File(result) as file:
                means[diameter] = file["packings"]["efficiency"][:].mean()
        print(means)
        for diameter in (50e-6, 100e-3):
            self.assertAlmostEqual(means[diameter], means[3e-3], delta=0.08)


if __name__ == "__main__":
    unittest.main()
