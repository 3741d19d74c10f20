"""What `check` says before a campaign is run, held against the run."""

import csv
import json
import os
import subprocess
import unittest

from trough_program import EndToEndTest, sample

# A box wide and long enough that nothing is to be said against it.
SOUND = {"grains.youngs_modulus": "1 MPa", "layer.length": "27 mm", "layer.width": "18 mm", "layer.grains": 150, "measure.packings": 1}


class Check(EndToEndTest):
    def findings(self, campaign):
        done = self.call("check", campaign, "--json")
        report = json.loads(done.stdout)
        return {one["item"]: one for one in report["cases"][0]["findings"]}, report, done.returncode

    def read_frame(self, path):
        """Lists of z and radius of all grains."""
        lines = path.read_text().splitlines()
        start = next(number for number, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
        names = lines[start].split()[2:]
        rows = [dict(zip(names, map(float, line.split()))) for line in lines[start + 1 :]]
        return [row["z"] for row in rows], [row["radius"] for row in rows]

    def overlaps(self, packing):
        """Largest overlap of a grain with the trough in each frame, m, and how many grains touch it in the first."""
        with open(packing / "dump" / "frames.csv") as file:
            trough = {int(row[0]): float(row[2]) for row in csv.reader(file) if row[0].isdigit()}
        found = {}
        for step, floor in trough.items():
            heights, radii = self.read_frame(packing / "dump" / f"frames.{step}.dump")
            found[step] = [radius - (z - floor) for z, radius in zip(heights, radii)]
        return found

    def test_overlaps_are_those_of_a_run(self):
        """A grain's mean load and one grain's impact are what the formulas know. In a packing few grains carry most
        of the load and columns hit together, so that the largest overlaps are within a factor of 3 only; the mean
        over the floor's grains at rest is within 1.5."""
        changes = SOUND | {"output.frames_per_cycle": 60, "measure.max_cycles": 20, "measure.half_width": 0.5}
        campaign = self.write_campaign(changes)
        findings, _, _ = self.findings(campaign)
        self.call(*self.run_arguments(campaign))
        (packing,) = self.output.glob("cases/*/packing-1")
        overlaps = self.overlaps(packing)
        diameter = 0.003
        resting = [one / diameter for one in overlaps[0] if one > 0]
        expected = findings["overlap under the layer's own weight / diameter"]["measured"]
        self.assertGreater(len(resting), 20)
        mean = sum(resting) / len(resting)
        print(f"resting overlap / d: mean {mean:.3g}, largest {max(resting):.3g}, expected {expected:.3g}")
        self.assertLess(max(mean / expected, expected / mean), 1.5)
        self.assertLess(max(resting) / expected, 3)
        expected = findings["overlap of a grain at impact at twice the trough's speed / diameter"]["measured"]
        largest = max(max(frame) for frame in overlaps.values()) / diameter
        print(f"overlap at impact / d: largest {largest:.3g}, expected {expected:.3g}")
        self.assertLess(max(largest / expected, expected / largest), 3)

    def test_the_cost_is_that_of_a_run(self):
        """Grain-steps of the cycles that were really run: expected within a factor of 3."""
        # Wider than the errors that validation/convergence found in boxes and grains like these.
        campaign = self.write_campaign(SOUND | {"measure.half_width": 0.04, "grains.youngs_modulus": None})
        _, report, code = self.findings(campaign)
        self.assertEqual((code, report["warnings"], report["errors"]), (0, 0, 0))
        done = self.run_campaign(campaign)
        self.assertNotIn("check:", done.stderr)
        (row,) = self.table()
        cycles = row["cycles_measured"] + row["cycles_discarded"]
        expected = report["cases"][0]["expected_cycles_per_packing"]
        print(f"cycles: {cycles}, expected {expected}")
        self.assertLess(max(cycles / expected, expected / cycles), 3)
        seconds = report["expected_core_hours"] * 3600
        (case,) = report["cases"]
        self.assertAlmostEqual(seconds, case["expected_grain_steps"] * case["relative_step_cost"] / report["grain_steps_per_cpu_second"])
        self.assertLess(case["relative_step_cost"], 1.01, "a small layer costs what small layers cost")

    def test_disk_and_memory_are_those_of_a_run(self):
        """Bytes of all files of a campaign, and the memory of an engine: expected within a factor of 2."""
        short = {"measure.max_cycles": 24, "measure.packings": 1, "measure.half_width": 0.5}
        thousand = {"layer.grains": 1000, "layer.length": "30 mm", "layer.width": "30 mm"}
        for number, changes in enumerate(sample((short | {"measure.packings": 3}, short | thousand, short | {"output.frames_per_cycle": 10}), 2)):
            campaign = self.write_campaign(changes)
            output = self.folder / f"runs-{number}"
            _, report, _ = self.findings(campaign)
            self.run_campaign(campaign, output, wanted=None)
            files = {path.stat().st_ino: path.stat().st_size for path in output.rglob("*") if path.is_file()}
            written = sum(files.values())
            print(f"bytes: {written}, expected {report['expected_bytes']:.0f}, at most {report['largest_bytes']:.0f}")
            self.assertLess(max(written / report["expected_bytes"], report["expected_bytes"] / written), 2)
            self.assertLessEqual(report["expected_bytes"], report["largest_bytes"])
            deck = self.folder / f"deck-{number}"
            self.call("deck", campaign, "--output", deck)
            engine = subprocess.Popen(["liggghts", "-in", "settle.liggghts"], cwd=deck / "case-001" / "packing-1",
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
            memory = os.wait4(engine.pid, 0)[2].ru_maxrss * 1024
            engine.returncode = 0
            print(f"memory: {memory}, expected {report['engine_memory_bytes']:.0f}")
            self.assertLess(max(memory / report["engine_memory_bytes"], report["engine_memory_bytes"] / memory), 2)

    def test_long_and_large_campaigns_are_not_small(self):
        million = self.write_campaign({"measure.max_cycles": 1_000_000})
        findings, report, _ = self.findings(million)
        # phases.csv alone has 100 rows of about 250 bytes per cycle.
        self.assertGreater(report["largest_bytes"], 25e9)
        self.assertEqual(findings["disk, with max_packings packings of max_cycles cycles"]["severity"], "fine")
        self.assertEqual(self.findings(self.write_campaign({"measure.max_cycles": 1_000_000, "measure.max_packings": 20}))[0][
            "disk, with max_packings packings of max_cycles cycles"]["severity"], "warning")  # fmt: skip
        large = self.write_campaign({"layer.grains": 10_000_000, "layer.length": "600 mm", "layer.width": "600 mm"})
        findings, report, _ = self.findings(large)
        self.assertGreater(report["expected_bytes"], 10_000_000 * 600)
        self.assertGreater(report["engine_memory_bytes"], 10e9)
        self.assertEqual(findings["memory of one engine"]["severity"], "warning")
        (case,) = report["cases"]
        self.assertGreater(case["relative_step_cost"], 2.9, "ten million grains fit into no cache")
        self.assertAlmostEqual(case["expected_core_hours"] * 3600 * report["grain_steps_per_cpu_second"]
                               / (case["expected_grain_steps"] * case["relative_step_cost"]), 1)  # fmt: skip
        self.assertIn("in the largest layer a step of a grain costs 3 times as much", self.call("check", large).stdout)

    def test_a_throw_number_of_one_is_not_refused(self):
        """At 1 the point mass just does not fly: there is no flight that a contact could be too long for."""
        for values in ([1.0], [1.0 + 1e-9, 1.0001], [0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0]):
            done = self.call("check", self.write_campaign(SOUND, sweep={"trough.throw_number": values}))
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertNotRegex(done.stdout, "(?m)^error")

    def test_the_table_ends_with_the_cost(self):
        campaign = self.write_campaign(SOUND, sweep={"trough.throw_number": [0.8, 2.0]})
        done = self.call("check", campaign)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout.splitlines()[-1], r"^expected cost: [0-9.e-]+ core-hours, at [0-9.e+]+ grain-steps per CPU second")
        self.assertNotIn("warning", done.stdout)

    def test_cases_have_the_names_that_run_gives_them(self):
        """By what is swept, and not by a number that has to be counted out."""
        campaign = self.write_campaign({"grains.youngs_modulus": "1 MPa"}, sweep={"trough.throw_number": [0.8, 2.0], "grains.friction": [0.4, 0.5]})
        done = self.call("check", campaign)
        self.assertRegex(done.stdout, r"(?m)^warning: .* in \d of 4 cases \(throw_number (0\.8|2), grains\.friction 0\.[45] is the worst\)")
        self.assertNotRegex(done.stdout, r"\(case \d+ is the worst\)")
        labels = [case["label"] for case in json.loads(self.call("check", campaign, "--json").stdout)["cases"]]
        self.assertEqual(labels[0], "throw_number 0.8, grains.friction 0.4")
        self.assertEqual(len(set(labels)), 4)

    def test_warnings_are_shown_and_errors_refused(self):
        warned = self.write_campaign({"grains.youngs_modulus": "1 MPa", "measure.packings": 1, "measure.max_cycles": 24})
        done = self.run_campaign(warned, wanted=None)
        self.assertRegex(done.stderr, r"(?m)^check: \d findings? .*\n  warning: layer.length: periodic length / diameter is 5; it should be at least 8; lengthen")

        # Grains like jelly under a violent trough: 30 % of overlap and more.
        jelly = {"grains.youngs_modulus": "0.1 MPa", "trough.throw_number": 20.0, "trough.amplitude": "30 mm"}
        wrong = self.write_campaign({"measure.packings": 1, "measure.max_cycles": 20} | jelly)
        self.take_starts()
        checked = self.call("check", wrong)
        self.assertEqual(checked.returncode, 2)
        self.assertRegex(checked.stdout, r"(?m)^error: grains.youngs_modulus: overlap of a grain at impact .*; raise it")
        refused = self.call("run", wrong, "--output", self.folder / "wrong", "--liggghts", self.engine)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("--accept-findings", refused.stderr.splitlines()[-1])
        self.assertEqual(self.take_starts(), [])
        os.environ["VIBROTROUGH_TEST_BREAK"] = 'test "$2" = settle.liggghts || exit 1'  # it is enough that it was started
        self.call("run", wrong, "--output", self.folder / "wrong", "--liggghts", self.engine, "--accept-findings")
        self.assertGreater(len(self.take_starts()), 0)

    def test_errors_of_the_file(self):
        self.assert_one_line_error(self.call("check", self.folder / "gone.toml"), 2, "there is no such file")


if __name__ == "__main__":
    unittest.main()
