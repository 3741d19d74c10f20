"""Two people's questions from beginning to end. The engineer: which stroke, speed and angle carry 12 t/h of pellets on my trough, how
sure is that, and what friction do the speeds say that I measured on the old machine? The researcher: how fast is the layer over throw
number and rolling friction, how sure is that, and what would it cost to know it better?

The measured speeds are those of the Krakow laboratory (validation/krakow). The researcher's campaign, six cases of a tiny layer, is
simulated once, with the real engine, and each test has a copy of its results.
"""

import csv
import json
import math
import shutil
import tempfile
import tomllib
import unittest
from pathlib import Path

from trough_program import EndToEndTest

KRAKOW = Path(__file__).parent.parent.parent / "validation" / "krakow" / "reference.csv"
# Six cases: two inputs, and each packing short.
PLAN = {"trough.amplitude": "6 mm", "grains.rotation": "rolling", "grains.rolling_friction": 0.1, "measure.packings": 3,
        "measure.half_width": 0.15, "measure.max_cycles": 40, "measure.max_packings": 3}
SWEEP = {"trough.throw_number": [1.5, 1.75, 2.0], "grains.rolling_friction": [0.02, 0.25]}
# An error of the models that the user states: without it, and without grains, no probability would be known.
STATED = ["--model-discrepancy", "0.1"]
TROUGH = ["--bulk-density", "600 kg/m3", "--width", "300 mm", "--length", "3 m", "--layer-depth", "5 mm to 60 mm"]


def rows_of(path):
    return list(csv.DictReader(line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")))


class Engineer(EndToEndTest):
    def write_speeds(self):
        """The three speeds as an engineer has them: with decimal commas, and the columns in any order."""
        lines = ["rpm;stroke_mm;vibration_angle_deg;inclination_deg;speed_m_per_s;uncertainty_m_per_s"]
        for row in rows_of(KRAKOW):
            lines.append(f"{row['revolutions']};2,5;30;2;{row['speed']};{row['speed_error']}".replace(".", ","))
        path = self.folder / "speeds.csv"
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    def design(self, *words, wanted=0, flow="12 t/h"):
        answer = self.call("design", "--mass-flow", flow, *TROUGH, *words, "--json")
        self.assertEqual(answer.returncode, wanted, answer.stderr)
        return json.loads(answer.stdout)

    def assert_is_a_page(self, path, *words):
        text = path.read_text(encoding="utf-8")
        for word in (*words, "<svg", "default-src 'none'"):
            self.assertIn(word, text)
        for outside in ("src=\"http", "href=\"http", "<script"):
            self.assertNotIn(outside, text)

    def test_from_measured_speeds_to_a_machine_and_the_campaign_that_checks_it(self):
        posterior, page = self.folder / "friction.json", self.folder / "calibration.html"
        answer = self.call("theory", "calibrate", self.write_speeds(), "--free", "friction", "--posterior", posterior, "--page", page,
                           "--json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        calibration = json.loads(answer.stdout)
        # No friction explains these three speeds exactly (validation/krakow); what the point mass misses at layers may.
        self.assertLess(calibration["best_fit"]["p_value"], 0.01)
        self.assertGreater(min(one["common_error"] for one in calibration["measurements"]), 0.05)
        self.assertIn("--common-error 0", calibration["verdict"][-1])
        # Without it, the discrepancy says by how much they differ.
        answer = self.call("theory", "calibrate", self.folder / "speeds.csv", "--free", "friction", "--common-error", "0", "--json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.assertGreater(json.loads(answer.stdout)["model_discrepancy"]["low"], 0.01)
        self.assert_is_a_page(page, "Calibration of the point mass", "No friction")

        campaign, page = self.folder / "check design.toml", self.folder / "design.html"
        design = self.design("--posterior", posterior, "--machine-number", "4", "--objective", "least-machine-number", "--grain-diameter", "6 mm",
                             "--campaign", campaign, "--page", page)
        self.assertTrue(design["feasible"])
        self.assertGreaterEqual(design["probability"], 0.95)
        self.assertLessEqual(design["machine_number"], 4)
        model = design["models"][0]
        self.assertLess(model["mass_flow_low_t_per_h"], 12)
        self.assertGreater(model["mass_flow_high_t_per_h"], model["mass_flow_t_per_h"])
        # v = Q / (rho w h): what is printed is consistent with itself.
        flow = 3.6 * 600 * 0.3 * design["layer_depth_mm"] / 1000 * model["median_speed_m_per_s"]
        self.assertAlmostEqual(flow, model["mass_flow_t_per_h"], 6)
        self.assertAlmostEqual(design["rules_of_thumb"][0]["speed_m_per_s"],
                               3.81 * design["rpm"] * design["stroke_mm"] / 2000 / 60, 9)
        self.assert_is_a_page(page, "Design of a vibrating trough", "12 t/h", "Daesung")

        checked = self.call("check", campaign)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        trough = tomllib.loads(campaign.read_text(encoding="utf-8"))["trough"]
        self.assertAlmostEqual(float(trough["stroke"].split()[0]), design["stroke_mm"], 4)
        self.assertAlmostEqual(float(trough["frequency"].split()[0]), design["rpm"], 4)

    def test_several_models_and_limits(self):
        limits = ["--friction", "0.3", "--friction-uncertainty", "0.03", "--machine-number", "4.5", "--stroke", "2 mm to 14 mm",
                  "--rpm", "200 to 1500", "--landing-speed", "0.6 m/s", *STATED]
        one = self.design(*limits)
        both = self.design(*limits, "--model", "point-mass,rolling-layer")
        self.assertEqual([model["model"] for model in both["models"]], ["the point mass", "the rolling-layer law"])
        for design in (one, both):
            self.assertLessEqual(design["landing_speed_m_per_s"], 0.6)
            self.assertLessEqual(design["machine_number"], 4.5)
            self.assertTrue(2 <= design["stroke_mm"] <= 14 and 200 <= design["rpm"] <= 1500, design)
            for model in design["models"]:
                self.assertGreaterEqual(model["probability"], 0.95)
        self.assertLessEqual(both["sure_speed_m_per_s"], one["sure_speed_m_per_s"] * 1.01)

    def test_every_campaign_that_it_writes_passes_the_check(self):
        campaign = self.folder / "check.toml"
        for words, untested in ((["--objective", "gentlest-landing"], False),
                                (["--objective", "least-power", "--model", "point-mass", "--inclination", "8 deg"], True),  # steeper than any that was simulated
                                (["--friction-uncertainty", "0.05", "--inclination", "-3 deg to 2 deg"], False),
                                (["--friction-uncertainty", "0.1", "--machine-number", "4"], False)):  # a deep layer
            design = self.design("--friction", "0.35", "--grain-diameter", "6 mm", *words, "--campaign", campaign, "--force", wanted=1 if untested else 0)
            self.assertEqual((design["probability"] is None, design["sentence"].startswith("Not tested")), (untested, untested))
            checked = self.call("check", campaign)
            self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
            self.assertNotIn("warning: layer", checked.stdout + checked.stderr)

    def test_what_cannot_be_reached_is_said(self):
        answer = self.call("design", "--mass-flow", "900 t/h", *TROUGH, *STATED, "--friction", "0.3")
        self.assertEqual(answer.returncode, 1, answer.stderr)
        self.assertIn("No machine within the limits carries 900 t/h", answer.stdout)
        self.assertIn("layer depth <= 60 mm", answer.stdout)
        self.assertRegex(answer.stdout, r"a trough \d+ mm wide, or \d+ troughs side by side")

    def test_the_best_of_the_speeds_that_can_be_had(self):
        words = [*STATED, "--friction", "0.3", "--machine-number", "4", "--objective", "least-machine-number"]
        design = self.design(*words, "--rpm", "960,1450,2900", flow="6 t/h")
        first, second, third = design["speeds_compared"]
        self.assertEqual([one["rpm"] for one in (first, second, third)], [960, 1450, 2900])
        self.assertIn("a stroke of 0.85 mm or less", third["why_none"])
        self.assertEqual(design["machine_number"], min(one["machine_number"] for one in (first, second) if one["feasible"]))

    def test_the_best_of_the_strokes_that_can_be_had(self):
        design = self.design(*STATED, "--friction", "0.3", "--machine-number", "4", "--rpm", "960", "--stroke", "4,6,9 mm", flow="3 t/h")
        first, second, third = design["speeds_compared"]
        self.assertEqual([round(one["stroke_mm"], 9) for one in (first, second, third)], [4, 6, 9])
        self.assertIn("machine number", third["why_none"])
        self.assertAlmostEqual(design["stroke_mm"], 6, 9)

    def test_what_is_not_exact_is_ranked_and_the_stroke_follows_from_the_exciter(self):
        words = ["--friction", "0.25 to 0.35", "--bulk-density", "600+-30 kg/m3", "--rpm", "960", "--vibration-angle", "28 deg", "--stroke-uncertainty",
                 "0.2 mm", "--width", "300 mm", "--length", "3 m", "--layer-depth", "5 mm to 60 mm", "--model-discrepancy", "0.03"]
        answer = self.call("design", "--mass-flow", "2 t/h", *words, "--trough-mass", "120 kg", "--exciter", "working 92 kg cm", "--json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        design = json.loads(answer.stdout)
        self.assertAlmostEqual(design["exciter"]["static_moment_kg_m"], 0.46, 12)
        self.assertAlmostEqual(design["exciter"]["stroke_empty_mm"], 2e3 * 0.46 / 120, 9)
        self.assertLess(design["stroke_mm"], design["exciter"]["stroke_empty_mm"])
        budget = design["models"][0]["budget"]
        self.assertEqual({one["source"] for one in budget}, {"friction on the trough", "bulk density", "stroke", "error of the point mass"})
        self.assertAlmostEqual(sum(one["share_of_variance"] for one in budget), 1, 6)
        for more, message in ((["--exciter", "92 kg cm", "--trough-mass", "120 kg"], "working 168 kg cm"), (["--spring", "9 N/mm"], "--trough-mass"),
                              (["--exciter", "3 kN at 960", "--trough-mass", "120 kg", "--stroke", "8 mm"], "both given")):
            answer = self.call("design", "--mass-flow", "3 t/h", *words, *more)
            self.assertEqual(answer.returncode, 2, answer.stdout + answer.stderr)
            self.assertIn(message, answer.stderr)

    def verify(self, *words, flow="6 t/h", wanted=0):
        """The answer of `design --verify`."""
        answer = self.call("design", "--mass-flow", flow, "--bulk-density", "600 kg/m3", "--width", "400 mm", "--friction", "0.3", "--rpm", "960",
                           "--machine-number", "4", "--layer-depth", "10 mm to 40 mm", "--grain-diameter", "12 mm", "--rolling-friction", "0.1",
                           "--model", "rolling-layer", "--objective", "least-machine-number", "--verify", "--quiet", "--json", *words,
                           cwd=self.folder)
        self.assertEqual(answer.returncode, wanted, answer.stderr)
        return json.loads(answer.stdout)

    def test_a_machine_is_verified_by_its_own_simulation(self):
        page = self.folder / "design.html"
        self.assert_was_simulated(self.verify("--budget", "0.1 core-hours", "--jobs", "2", "--page", page), self.folder)
        self.assert_is_a_page(page, "Verified: this machine was simulated at its own depth", "Signature")

    def test_a_verification_begins_no_machine_that_exceeds_its_budget(self):
        design = self.verify("--budget", "1 s", wanted=1)
        self.assertEqual(design["verification"]["verdict"], "budget")
        self.assertIn("core-hours, and 0.00028 are left", design["verification"]["why"])
        self.assertEqual(design["verification"]["machines"], [])

    def test_no_machine_is_simulated_that_is_not_expected_to_do(self):
        design = self.verify(flow="60 t/h", wanted=1)
        self.assertEqual((design["verification"]["verdict"], design["verification"]["machines"]), ("no-machine", []))
        self.assertFalse((self.folder / "runs" / "design" / "machine_1.toml").exists())

    def test_what_is_wrong_is_refused(self):
        task = ["design", "--mass-flow", "12 t/h", *TROUGH]
        not_a_calibration = self.folder / "no.json"
        not_a_calibration.write_text('{"parameters": []}', encoding="utf-8")
        for words, message in (
            ([], "--friction is missing"),
            (["--friction", "0.3", "--posterior", "friction.json"], "both given"),
            (["--posterior", str(not_a_calibration)], "holds no calibrated friction"),
            (["--friction", "0.3", "--model", "surface"], "--surface DIR"),
            (["--friction", "0.3", "--inclination", "20 deg"], "no machine fits"),
            (["--friction", "0.3", "--model", "rolling-layer", "--machine-number", "1.5"], "throw numbers of 1.25 to 2.6"),
            (["--friction", "0.3", "--rpm", "960,5"], "decimal comma"),
            (["--friction", "0.3", "--verify"], "write --grain-diameter"),
            (["--friction", "0.3", "--verify", "--grain-diameter", "3 mm"], "write --rolling-friction 0.1, or 0"),
            (["--friction", "0.3", "--budget", "1 core-hours"], "--budget requires --verify"),
            (["--friction", "0.3", "--grain-diameter", "3 mm", "--rolling-friction", "0.1", "--model", "point-mass"], "the point mass does not know it"),
        ):
            answer = self.call(*task, *words)
            self.assertEqual(answer.returncode, 2, answer.stdout + answer.stderr)
            self.assertIn(message, answer.stderr)
        by_mass, by_volume = (self.call("design", "--mass-flow", flow, *TROUGH, "--friction", "0.3").stdout for flow in ("12 t/h", "20 m3/h"))
        self.assertEqual(by_mass, by_volume, "600 kg/m3 times 20 m3/h are 12 t/h")
        answer = self.call("design", "--mass-flow", "12 tons/h", *TROUGH, "--friction", "0.3")
        self.assertEqual(answer.returncode, 2, answer.stdout + answer.stderr)
        self.assertIn("write t for metric tonnes", answer.stderr)


class Researcher(EndToEndTest):
    simulated = None  # the folder of the results, once they are there

    @classmethod
    def tearDownClass(cls):
        if cls.simulated:
            cls.simulated.cleanup()

    def setUp(self):
        super().setUp()
        if not Researcher.simulated:
            self.run_campaign(self.write_campaign(PLAN, SWEEP), wanted=None)
            Researcher.simulated = tempfile.TemporaryDirectory()
            shutil.copytree(self.output, Path(Researcher.simulated.name) / "runs")
        else:
            shutil.copytree(Path(Researcher.simulated.name) / "runs", self.output)

    def predict(self, *places):
        words = [word for place in places for word in ("--at", place)]
        answer = self.call("predict", self.output, *words, "--json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return json.loads(answer.stdout)

    def test_the_surface_says_how_sure_it_is(self):
        easy, hard, case = self.predict("throw_number=1.7,rolling_friction=0.03", "throw_number=1.7,rolling_friction=0.24",
                                        "throw_number=1.75,rolling_friction=0.02")
        for one in (easy, hard, case):
            self.assertTrue(one["inside"])
            self.assertEqual(one["points"], 6)
            self.assertGreater(one["half_width"], 0)
        # The more easily the grains roll, the more they outrun the theory between throw numbers 1.5 and 2.
        self.assertGreater(easy["efficiency"], hard["efficiency"])
        self.assertGreater(easy["efficiency"], easy["efficiency_theory"] + 0.1)
        # At a case that was simulated, the surface says what was measured there, within both intervals.
        row = next(row for row in self.table() if row["throw_number"] == 1.75 and row["grains.rolling_friction"] == 0.02)
        self.assertLess(abs(case["efficiency"] - row["efficiency"]), math.hypot(case["half_width"], row["efficiency_half_width_statistics"]))
        outside = self.predict("throw_number=2.8,rolling_friction=0.1")
        self.assertFalse(outside["inside"])
        self.assertGreater(outside["half_width"], easy["half_width"])

    def test_a_machine_is_designed_by_it(self):
        answer = self.call("design", "--mass-flow", "0.7 t/h", *TROUGH, "--friction", "0.23", "--grain-diameter", "3 mm", "--machine-number", "8", "--surface",
                           self.output, "--at", "rolling_friction=0.02", "--model", "surface,point-mass", "--json")
        self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
        design = json.loads(answer.stdout)
        self.assertEqual([model["model"] for model in design["models"]], ["the simulated layer", "the point mass"])
        self.assertAlmostEqual(design["stroke_mm"], 12, 9)  # the machine that was simulated
        self.assertTrue(1.5 <= design["throw_number"] <= 2, design)

    def test_speeds_of_the_layer_give_its_rolling_friction(self):
        # Speeds that the surface itself predicts for a rolling friction of 0.05, at three throw numbers.
        gammas, beta, amplitude = (1.55, 1.75, 1.95), math.atan(0.5), 0.006
        lines = ["amplitude_mm,frequency_hz,vibration_angle_deg,speed_m_per_s,uncertainty_m_per_s"]
        for gamma, one in zip(gammas, self.predict(*(f"throw_number={gamma},rolling_friction=0.05" for gamma in gammas))):
            omega = math.sqrt(gamma * 9.81 / (amplitude * math.sin(beta)))
            speed = one["efficiency"] * omega * amplitude * math.cos(beta)
            lines.append(f"6,{omega / (2 * math.pi)!r},{math.degrees(beta)!r},{speed!r},0.004")
        speeds = self.folder / "speeds.csv"
        speeds.write_text("\n".join(lines) + "\n", encoding="utf-8")
        answer = self.call("calibrate", self.output, "--measured", speeds, "--free", "rolling_friction", "--json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        found = json.loads(answer.stdout)["parameters"][0]
        self.assertEqual(found["name"], "grains.rolling_friction")
        self.assertGreaterEqual(found["low"], 0.02)
        self.assertLessEqual(found["low"], 0.05)
        self.assertGreaterEqual(found["high"], 0.05)
        self.assertLessEqual(found["high"], 0.25)


if __name__ == "__main__":
    unittest.main()
