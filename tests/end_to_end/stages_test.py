"""A drive in stages with the real engine: where the trough is against the formula, written again here; what result.h5 says of the stages against the
cycles that the engine wrote; and a run that is killed within a stage and goes on.
"""

import csv
import json
import unittest

import h5py
import numpy as np

from trough_program import EndToEndTest, campaign_text, count_cycles, wait_until

# A start with a ramp, a change of frequency, angle and phase within another one, a stop at once, a reversed trough.
STAGES = """
[[stages]]
ramp_cycles = 2
cycles = 6

[[stages]]
ramp_cycles = 3
cycles = 8
frequency = "16 Hz"
amplitude = "2 mm"
vibration_angle = "40 deg"
along_phase = "20 deg"

[[stages]]
standstill = true
cycles = 3

[[stages]]
cycles = 4
along_phase = "-160 deg"
"""
F1, F2 = 12.5, 16.0
DRIVE = {"trough.throw_number": None, "trough.frequency": "12.5 Hz", "trough.tan_vibration_angle": None, "trough.vibration_angle": "30 deg"}
PLAN = {"measure.max_cycles": None, "measure.max_packings": None, "measure.packings": 2}
ANGLES = np.radians([30, 40])


def place(amplitude, angle, lead, phi):
    """Displacement from the place at phi = 0 of an elliptical drive, x and z."""
    along = amplitude * np.cos(angle) * (np.sin(phi + np.radians(lead)) - np.sin(np.radians(lead)))
    return np.array([along, amplitude * np.sin(angle) * np.sin(phi)])


def trough_at(cycle):
    """Where the trough should be at a (broken) number of cycles after the start."""
    one = lambda phi: place(3e-3, ANGLES[0], 0, phi)
    two = lambda phi: place(2e-3, ANGLES[1], 20, phi)
    if cycle < 2:
        u = cycle / 2
        return u * one(2 * np.pi * cycle)
    if cycle < 6:
        return one(2 * np.pi * cycle)
    if cycle < 9:  # the frequency grows linearly with time over three whole cycles
        u, time = (cycle - 6) / 3, 3 / ((F1 + F2) / 2)
        phi = 2 * np.pi * time * (F1 * u + (F2 - F1) * u**2 / 2)
        return (1 - u) * one(phi) + u * two(phi)
    if cycle < 14:
        return two(2 * np.pi * cycle)
    if cycle < 17:
        return np.zeros(2)
    return place(2e-3, ANGLES[1], -160, 2 * np.pi * cycle)


def durations():
    ramp = 1 / ((F1 + F2) / 2)
    return np.array([1 / F1] * 6 + [ramp] * 3 + [1 / F2] * 12)


class Stages(EndToEndTest):
    def write_stages(self, changes=None, stages=STAGES, name="campaign.toml"):
        path = self.folder / name
        text = campaign_text({**DRIVE, **PLAN, **(changes or {})})
        path.write_text(text + stages)
        return path

    def test_trough_and_results(self):
        self.run_campaign(self.write_stages({"output.frames_per_cycle": 4}))
        (case,) = self.output.glob("cases/*")
        with h5py.File(case / "result.h5") as file:
            steps = int(file["packings"]["steps_per_cycle"][0])
            stages, cycles = file["stages"][:], file["stage_cycles"][:]
        # The engine writes the position of its mesh with 15 digits at each hundredth of a cycle.
        for packing in (1, 2):
            with open(case / f"packing-{packing}/phases.csv") as lines:
                rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
            self.assertEqual(len(rows), 2100)
            for row in rows[::7] + rows[99::100]:
                expected = trough_at(int(row["step"]) / steps)
                np.testing.assert_allclose([float(row["trough_x"]), float(row["trough_z"])], expected, atol=1e-11)
        ends = []
        for packing in (1, 2):
            with open(case / f"packing-{packing}/cycles.csv") as lines:
                ends.append([float(row["x_com"]) for row in csv.DictReader(line for line in lines if not line.startswith("#"))])
        speed = np.diff(ends, axis=1) / durations()
        np.testing.assert_allclose(cycles["conveying_speed"], speed.mean(axis=0), rtol=1e-12)
        np.testing.assert_allclose(cycles["time"], np.cumsum(durations()) - durations() / 2, rtol=1e-12)
        # The second half of the cycles behind each ramp.
        for stage, part in zip(stages, (slice(4, 6), slice(12, 14), slice(16, 17), slice(19, 21))):
            self.assertAlmostEqual(stage["conveying_speed"], speed[:, part].mean(), delta=1e-12)
        np.testing.assert_array_equal(stages["ramp_cycles"], [2, 3, 0, 0])
        self.assertAlmostEqual(stages["distance"][2], np.mean([x[17] - x[14] for x in ends]), delta=1e-12)
        self.assertGreater(stages["conveying_speed"][1], 0)
        self.assertLess(stages["conveying_speed"][3], 0)  # the trough is reversed
        rows = json.loads(self.call("compare", self.output, "--stages", "--json").stdout)
        self.assertEqual([row["stage"] for row in rows], [1, 2, 3, 4])
        np.testing.assert_allclose([row["conveying_speed_m_per_s"] for row in rows], stages["conveying_speed"], rtol=1e-12)
        # The point mass of the first stage, by the command for a drive that never ends.
        words = ["--throw-number", rows[0]["throw_number"], "--tan-vibration-angle", np.tan(ANGLES[0]), "--friction", 0.23, "--json"]
        efficiency = json.loads(self.call("theory", "point", *words).stdout)["velocity_efficiency"]
        self.assertAlmostEqual(rows[0]["speed_theory_m_per_s"], efficiency * 2 * np.pi * F1 * 3e-3 * np.cos(ANGLES[0]), delta=1e-8)
        self.assertIsNone(rows[2]["speed_theory_m_per_s"])
        row = self.table()[0]
        self.assertEqual(row["outcome"], "finished")
        self.assertIsNone(row["efficiency_theory"])
        self.assertAlmostEqual(row["stage_speed_m_per_s"], stages["conveying_speed"][3], delta=1e-12)
        self.assertAlmostEqual(row["stopping_distance_m"], stages["distance"][2], delta=1e-12)

    def test_a_run_that_is_killed_goes_on_with_the_same_numbers(self):
        changes = {"output.checkpoint_cycles": 4}
        self.run_campaign(self.write_stages(changes))
        other = self.folder / "other"
        campaign = self.write_stages(changes, name="again.toml")
        process = self.start_campaign(campaign, other)
        wait_until(lambda: any(count_cycles(path) > 7 for path in other.glob("cases/*/packing-1/cycles.csv")), "eight cycles", process)
        process.kill()
        process.wait()
        self.kill_leftovers()
        self.run_campaign(campaign, other)
        for packing in (1, 2):
            texts = [next(folder.glob(f"cases/*/packing-{packing}/cycles.csv")).read_text() for folder in (self.output, other)]
            rows = [[line for line in text.splitlines() if not line.startswith("#")] for text in texts]
            self.assertEqual(rows[0], rows[1])

    def test_mistakes_are_told_in_one_line(self):
        for stage, told in (
            ("ramp_cycles = 3", "stage 1 has no length"),
            ("cycles = 5\nramp_cycles = 6", "longer than the stage"),
            ('cycles = 5\ntime = "1 s"', "both say the same"),
            ('cycles = 5\nstandstill = true\namplitude = "2 mm"', "stands still"),
            ('cycles = 5\nfrequency = "2000 Hz"', "outside the range"),
            ("cycles = 5\nstandstill = true", "stands still in all stages"),
        ):
            with self.subTest(told):
                done = self.call("check", self.write_stages(stages=f"[[stages]]\n{stage}\n"))
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(told, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)
        steady_only = self.call("convergence", self.write_stages())
        self.assertIn("convergence: the campaign 'small' has [[stages]]", steady_only.stderr)
        done = self.call("check", self.write_stages({"measure.max_packings": 9}))
        self.assertIn("as many packings as measure.packings says", done.stderr)


if __name__ == "__main__":
    unittest.main()
