"""A user's own units, and the campaign files that `init` writes: from rpm, stroke and bulk density to t/h, with swept keys by
their names in every view.
"""

import csv
import io
import json
import math
import re
import tomllib
import unittest
from pathlib import Path

import h5py
import numpy as np

from trough_program import EndToEndTest

KINDS = sorted(path.stem for path in (Path(__file__).parent.parent.parent / "input_templates" / "campaigns").glob("*.toml"))
# The same campaign with one case, few grains and a wide interval: seconds instead of minutes.
SHORTER = {
    '["750 rpm", "850 rpm", "950 rpm"]': '["850 rpm"]',
    'length = "30 mm"': 'length = "15 mm"',
    'height = "12 mm"': 'height = "8 mm"',
    "packings = 4": "packings = 2",
    "half_width = 0.05": "half_width = 1.0",
}


class Units(EndToEndTest):
    def test_the_files_of_init_can_be_run(self):
        for kind in KINDS:
            with self.subTest(kind):
                done = self.call("init", kind, cwd=self.folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(f"vibrotrough check {kind}.toml", done.stdout)
                checked = self.call("check", self.folder / f"{kind}.toml", "--json")
                self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
                self.assertEqual(json.loads(checked.stdout)["errors"], 0)
                self.assert_one_line_error(self.call("init", kind, cwd=self.folder), 2, "is not overwritten")
        self.assert_one_line_error(self.call("init", "cement", cwd=self.folder), 2, "pellets")

    def test_editors_know_the_keys_of_the_files_of_init(self):
        done = self.call("keys", "--schema")
        self.assertEqual(done.returncode, 0, done.stderr)
        sections = json.loads(done.stdout)["properties"]
        for kind in KINDS:
            self.call("init", kind, cwd=self.folder)
            for name, keys in tomllib.loads((self.folder / f"{kind}.toml").read_text()).items():
                with self.subTest(kind=kind, section=name):
                    self.assertIn(name, sections)
                    known = sections[name].get("items", sections[name])  # sections that can be written again are lists
                    if "properties" in known:
                        for section in keys if isinstance(keys, list) else [keys]:
                            self.assertLessEqual(set(section), set(known["properties"]))

    def test_the_chute_of_init_has_a_step(self):
        """A face across the whole floor, upright, not at an end, and higher than a grain."""
        self.call("init", "chute", cwd=self.folder)
        numbers = [list(map(float, line.split()[1:])) for line in (self.folder / "chute.stl").read_text().splitlines() if line.strip().startswith("vertex")]
        corners = np.reshape(numbers, (-1, 3, 3))
        length, width, _ = corners.max(axis=(0, 1))
        face = corners[np.ptp(corners[:, :, 0], axis=1) == 0]
        self.assertTrue(np.all((face[:, :, 0] > 0) & (face[:, :, 0] < length)))
        area = np.abs(np.cross(face[:, 1] - face[:, 0], face[:, 2] - face[:, 0])[:, 0]).sum() / 2
        self.assertGreater(area, width * 3.3)  # the largest grains, mm

    def test_a_file_of_init_gives_tonnes_per_hour(self):
        """m' = v m / (L W) times 300 mm; the layer is that of the file in kg, m and s."""
        self.call("init", "--output", self.folder / "mine.toml")
        text = (self.folder / "mine.toml").read_text()
        for old, new in SHORTER.items():
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.folder / "mine.toml").write_text(text)
        self.run_campaign(self.folder / "mine.toml")
        (row,) = self.table()
        self.assertAlmostEqual(row["turns_per_minute"], 850, 9)
        self.assertAlmostEqual(row["stroke_mm"], 8, 12)
        self.assertAlmostEqual(row["machine_number"], (2 * math.pi * 850 / 60) ** 2 * 0.004 / 9.81, 9)
        (result,) = self.results()
        with h5py.File(result) as file:
            mass, case = file["packings"]["mass"][0], file["case"][0]
            per_area = mass / (0.015 * 0.018)
            # The stored mass is that of whole numbers of grains of three sizes.
            self.assertAlmostEqual(case["mass_per_area"] / per_area, 1, 1)
            # A layer of 8 mm with 600 kg/m3, in whole grains.
            self.assertAlmostEqual(case["mass_per_area"] / (600 * 0.008), 1, delta=0.5 / case["layer_grains"])
            flow = 3.6 * case["conveying_speed"] * case["mass_per_area"] * 0.3
            self.assertAlmostEqual(row["mass_flow_t_per_h"], flow, 9)
            # P = c |V|^2 / 2 per area; on a level trough it is what the layer dissipates, to the two packings' scatter.
            speed = case["velocity_scale"] / math.cos(math.radians(30))
            first_harmonic = case["damping"] * speed**2 / 2 / (0.015 * 0.018)
            self.assertAlmostEqual(row["power_per_area_w_per_m2"] / first_harmonic, 1, 2)
            dissipated = case["dissipation"] * case["frequency"] / (0.015 * 0.018)
            self.assertAlmostEqual(row["power_per_area_w_per_m2"] / dissipated, 1, 1)
            self.assertLess(abs(row["added_mass_fraction"]), 1)
        self.assertAlmostEqual(row["mass_flow_half_width_t_per_h"] / row["mass_flow_t_per_h"],
                               row["efficiency_half_width"] / row["efficiency"], 9)

    def test_times_are_those_of_a_clock(self):
        campaign = self.write_campaign({}, {"layer.grains": [4000, 8000, 16000]})
        arguments = ("plan", campaign, "--output", self.output, "--liggghts", self.engine)
        times = [round(case["core_time_s"]) for case in json.loads(self.call(*arguments, "--json").stdout)["cases"]]
        self.assertTrue(any(time % 60 >= 10 for time in times), times)
        shown = re.findall(r" (?:(\d+):)?(\d+):(\d\d)$", self.call(*arguments).stdout, re.MULTILINE)
        self.assertEqual([3600 * int(hours or 0) + 60 * int(minutes) + int(seconds) for hours, minutes, seconds in shown], times)

    def test_swept_keys_are_in_every_view(self):
        sweep = {"grains.rolling_friction": [0.05, 0.2], "layer.width": ["15 mm", "18 mm"]}
        campaign = self.write_campaign({"grains.rotation": "rolling"}, sweep)
        plan = self.call("plan", campaign, "--output", self.output, "--liggghts", self.engine)
        self.assertRegex(plan.stdout.splitlines()[0], r"^case +rolling_friction +width +Gamma")
        self.assertRegex(plan.stdout.splitlines()[1], r"of grains +mm")
        self.assertRegex(plan.stdout, r"\n[0-9a-f]{12} +0\.2 +18 ")
        self.run_campaign(campaign)
        rows = self.table()
        # 18 mm in metres is rounded.
        self.assertEqual([(row["grains.rolling_friction"], round(row["layer.width"], 12)) for row in rows],
                         [(0.05, 0.015), (0.05, 0.018), (0.2, 0.015), (0.2, 0.018)])
        filtered = self.call("compare", self.output, "--csv", "--filter", "rolling_friction>0.1", "--sort", "layer.width:desc")
        values = [round(float(row["layer.width"]), 12) for row in csv.DictReader(io.StringIO(filtered.stdout))]
        self.assertEqual(values, [0.018, 0.015])
        status = self.ask_json("status")
        self.assertEqual(status["cases"][3]["label"], "grains.rolling_friction 0.2, layer.width 18 mm")
        self.assertAlmostEqual(status["cases"][3]["layer.width"], 0.018, 12)
        text = self.call("status", self.output).stdout
        self.assertIn("  grains.rolling_friction 0.05, layer.width 15 mm  finished", text)
        for impossible in ("inf", "- +- -", "0:00 to go", "nan"):
            self.assertNotIn(impossible, text)
        with h5py.File(self.output / "campaign.h5") as file:
            self.assertEqual(list(file["swept/grains.rolling_friction"]), [0.05, 0.05, 0.2, 0.2])
            self.assertEqual(file["swept/layer.width"].attrs["units"], b"m")
        drawn = self.call("plot", self.output, "--only", "efficiency", "--only", "residuals")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        figure = (self.output / "report" / "efficiency.svg").read_text()
        self.assertIn("grain rolling friction", figure)
        self.assertIn("layer width = 18 mm", figure)


if __name__ == "__main__":
    unittest.main()
