"""A small campaign from its file to its table, read back by h5py."""

import csv
import io
import math
import os
import pty
import shlex
import subprocess
import unittest

import h5py
import numpy as np

from trough_program import PROGRAM, EndToEndTest, fingerprint, without_wall_time

SWEEP = {"trough.tan_vibration_angle": [0.25, 0.5]}
COLUMNS = {
    "case", "throw_number", "machine_number", "vibration_angle_deg", "inclination_deg", "friction", "amplitude_m",
    "frequency_hz", "efficiency", "efficiency_half_width_statistics", "conveying_speed_m_per_s", "efficiency_theory",
    "mode_theory", "layer_mode", "packings", "cycles_measured", "cycles_discarded", "wall_time_s", "outcome",
}  # fmt: skip
# Student's t for 95 % and one degree of freedom (two packings), from any table of it.


def datasets(file):
    found = {}
    file.visititems(lambda name, item: found.update({name: item}) if isinstance(item, h5py.Dataset) else None)
    return found


class Run(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.campaign = self.write_campaign(sweep=SWEEP)

    def assert_described(self, file):
        for name, data in datasets(file).items():
            for attribute in ("units", "description"):
                words = np.atleast_1d(data.attrs[attribute]).tolist()  # of a table: one for each field
                self.assertEqual(len(words), len(data.dtype.names or [name]), f"{file.filename}: {attribute} of {name}")
                self.assertTrue(all(words), f"{file.filename}: {name} has no {attribute}")

    def check_campaign_file(self, table):
        same = {
            "throw_number": "throw_number", "machine_number": "machine_number", "friction": "friction",
            "amplitude": "amplitude_m", "frequency": "frequency_hz", "efficiency": "efficiency",
            "efficiency_half_width_statistics": "efficiency_half_width_statistics", "conveying_speed": "conveying_speed_m_per_s",
            "packings": "packings", "cycles_measured": "cycles_measured", "cycles_discarded": "cycles_discarded",
            "wall_time": "wall_time_s",
        }  # fmt: skip
        with h5py.File(self.output / "campaign.h5") as file:
            self.assert_described(file)
            self.assertEqual(file.attrs["campaign"], b"small")
            self.assertEqual(list(file["case"].asstr()), [row["case"] for row in table])
            self.assertEqual(list(file["outcome"].asstr()), [row["outcome"] for row in table])
            for stored, shown in same.items():
                # The table rounds what it converts to 12 digits.
                np.testing.assert_allclose(file[stored], [row[shown] for row in table], rtol=1e-11, err_msg=stored)
            angles = np.degrees(file["vibration_angle"])
            np.testing.assert_allclose(angles, [row["vibration_angle_deg"] for row in table], rtol=1e-11)

    def check_result_file(self, row):
        """The numbers of the table, worked out again from the series by the formulas of the glossary."""
        with h5py.File(self.output / "cases" / row["case"] / "result.h5") as file:
            self.assert_described(file)
            self.assertEqual(file.attrs["case"].decode(), row["case"])
            self.assertIn(b"LIGGGHTS", file.attrs["engine_version"])
            case = file["case"][0]
            amplitude_x = case["amplitude"] * math.cos(case["vibration_angle"])
            means = []
            for packing, discarded in enumerate(file["packings"]["cycles_discarded"], start=1):
                series = file[f"series/{packing}"]
                displacement = np.diff(file[f"cycle_ends/{packing}"]["centre_of_mass_x"])
                efficiency = displacement / (2 * math.pi * amplitude_x)
                # Displacements are differences of nearly equal numbers of 16 digits: 1e-12 is a few roundings.
                np.testing.assert_allclose(series["efficiency"], efficiency, rtol=0, atol=1e-12)
                means.append(efficiency[discarded:].mean())
                # The cycle mean of the velocity is the displacement over the period up to the integrator and
                # the six digits that the engine averages with.
                period = 1 / case["frequency"]
                np.testing.assert_allclose(series["mean_velocity"] * period, displacement, rtol=0, atol=1e-3 * amplitude_x)
            self.assertAlmostEqual(row["efficiency"], np.mean(means), delta=1e-12)
            # Two packings: Student's t with one degree of freedom at the level 97.5 %, which is a tangent, unless the
            # fluctuations within the runs say that the two agree by chance. What may be left of a common start-up is added in
            # squares (measure/drift.hpp, with tests of its own), so that this is the least that the interval can be.
            scatter = math.tan(math.pi * 0.4875) * np.std(means, ddof=1) / math.sqrt(2)
            if np.std(means, ddof=1) > case["packing_deviation_within"]:
                self.assertGreaterEqual(row["efficiency_half_width_statistics"], scatter - 1e-9)
            else:
                normal = 2.1 * case["packing_deviation_within"] / math.sqrt(2)
                self.assertGreaterEqual(row["efficiency_half_width_statistics"], normal)
            self.assertLessEqual(row["efficiency_half_width_statistics"], case["half_width_wanted"])
            # The deck in the file is the deck that ran.
            deck = (self.output / "cases" / row["case"] / "packing-1" / "in.liggghts").read_text()
            self.assertEqual(file["packings"]["deck"][0].decode(), deck)

    def test_a_whole_campaign(self):
        # check_result_file() looks at what the integrator misses, which grows with the time step.
        self.campaign = self.write_campaign({"grains.youngs_modulus": "1 MPa"}, SWEEP)
        done = self.run_campaign(self.campaign)
        self.assertIn("2 of 2 cases finished", done.stdout)
        self.assertIn(f"vibrotrough compare {shlex.quote(str(self.output))}", done.stdout)
        self.assertEqual(len(self.take_starts()), 4)
        table = self.table()
        self.assertEqual([row["outcome"] for row in table], ["finished"] * 2)
        self.assertEqual([round(row["vibration_angle_deg"], 2) for row in table], [14.04, 26.57])
        for row in table:
            self.assertLessEqual(COLUMNS, set(row))
            self.assertTrue(all(row[name] is not None for name in COLUMNS), row)
            self.check_result_file(row)
        self.check_campaign_file(table)
        self.check_csv(table)

    def check_csv(self, table):
        text = self.call("compare", self.output, "--csv").stdout
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(len(rows), len(table))
        for row, wanted in zip(rows, table):
            self.assertEqual(list(row), list(wanted))
            # Both print the shortest text of a number: equal, not nearly so.
            # What is not known is null there and empty here.
            known = {name: value for name, value in wanted.items() if value is not None}
            self.assertEqual({name: type(known[name])(text) for name, text in row.items() if text}, known)

    def test_a_second_run_runs_nothing(self):
        self.run_campaign(self.campaign)
        self.take_starts()
        kept = {path: fingerprint(path) for path in self.results()}
        table_file = (self.output / "campaign.h5").read_bytes()
        done = self.run_campaign(self.campaign)
        self.assertEqual(self.take_starts(), [])
        self.assertEqual({path: fingerprint(path) for path in self.results()}, kept)
        self.assertEqual((self.output / "campaign.h5").read_bytes(), table_file)
        self.assertIn("2 of 2 cases finished", done.stdout)

    def test_an_edited_campaign_runs_only_what_is_new(self):
        one = self.write_campaign(sweep={"trough.tan_vibration_angle": [0.25]}, name="one.toml")
        self.run_campaign(one)
        kept = {path: fingerprint(path) for path in self.results()}
        self.take_starts()
        self.run_campaign(self.campaign)
        self.assertEqual(len(self.take_starts()), 2, "the new case's two packings")
        self.assertEqual([fingerprint(path) for path in kept], list(kept.values()))
        self.assertEqual([row["outcome"] for row in self.table()], ["finished"] * 2)

    def test_damage_is_noticed_and_mended(self):
        self.run_campaign(self.campaign)
        self.take_starts()
        table = self.table()
        broken, removed = self.results()
        broken.write_bytes(broken.read_bytes()[:-100])
        removed.unlink()
        cycles = removed.parent / "packing-2" / "cycles.csv"
        cycles.write_text(cycles.read_text() + "1\n")
        self.assertEqual({row["outcome"] for row in self.table()}, {"interrupted"})
        self.run_campaign(self.campaign)
        # A result is put together again from its packings; only the packing that changed is simulated again.
        self.assertEqual(self.take_starts(), [f"{removed.parent.name}/packing-2"])
        self.assertEqual(without_wall_time(self.table()), without_wall_time(table))

    def test_jobs_do_not_change_a_bit(self):
        alone, pair = self.folder / "alone", self.folder / "pair"
        self.run_campaign(self.campaign, output=alone, jobs=1)
        self.run_campaign(self.campaign, output=pair, jobs=2)
        self.assertEqual(without_wall_time(self.table(alone)), without_wall_time(self.table(pair)))
        for path in sorted(alone.glob("cases/*/result.h5")):
            with h5py.File(path) as one, h5py.File(pair / path.relative_to(alone)) as other:
                for name, data in datasets(one["series"]).items():
                    np.testing.assert_array_equal(data, other["series"][name], err_msg=f"{path}: {name}")

    def test_an_imprecise_case_says_so(self):
        # In 20 cycles nothing is known to 0.00001.
        changes = {"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 20}
        campaign = self.write_campaign(changes)
        done = self.run_campaign(campaign, wanted=1)
        self.assertIn("0 of 1 cases finished, 1 not steady or not precise", done.stdout)
        (row,) = self.table()
        self.assertIn(row["outcome"], ("not-steady", "not-precise"))
        self.assertEqual(row["efficiency"] is None, row["outcome"] == "not-steady")
        self.assertEqual(row["cycles_measured"] + row["cycles_discarded"], 20)
        # It has its answer: more cycles are not allowed, so that it is not run again.
        self.assertEqual(len(self.take_starts()), 1)
        self.run_campaign(campaign, wanted=1)
        self.assertEqual(self.take_starts(), [])

    def test_relative_paths_and_the_folder_of_the_name(self):
        self.write_campaign({"measure.packings": 1})
        done = self.call("run", "campaign.toml", "--liggghts", os.path.relpath(self.engine, self.folder), cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("results in runs/small", done.stdout)
        shown = self.call("compare", "runs/small", cwd=self.folder)
        self.assertRegex(shown.stdout, r"(?m)^[0-9a-f]{12} .* finished$")
        status = self.call("status", "runs/small", cwd=self.folder)
        told = "campaign small: 1 case; 1 finished, 0 not steady or not precise, 0 failed, 0 running, 0 left\n"
        self.assertTrue(status.stdout.endswith(told), status.stdout)

    def test_progress_on_a_terminal_and_in_a_file(self):
        campaign = self.write_campaign({"measure.packings": 1})
        plain = self.run_campaign(campaign).stderr
        self.assertRegex(plain, r"(?m)^0 done, \d running, \d waiting; packings 0/1; 0:00 elapsed$")
        # A case is named by what is swept: here nothing.
        self.assertRegex(plain, r"(?m)^case [0-9a-f]{12}: finished$")
        self.assertNotRegex(plain, r"[\r\x1b]")
        self.assertIn("\r\x1b[K", self.errors_on_a_terminal(campaign))

    def errors_on_a_terminal(self, campaign):
        ours, theirs = pty.openpty()
        command = [PROGRAM, *map(str, self.run_arguments(campaign, output=self.folder / "on_terminal"))]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=theirs)
        self.addCleanup(self.end, process)
        os.close(theirs)
        shown = b""
        with os.fdopen(ours, "rb", buffering=0) as terminal:
            while True:
                try:
                    piece = terminal.read(4096)
                except OSError:  # how Linux ends a terminal
                    piece = b""
                if not piece:
                    break
                shown += piece
        self.assertEqual(process.wait(), 0)
        return shown.decode()


if __name__ == "__main__":
    unittest.main()
