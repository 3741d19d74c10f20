"""Learning a surface, asking it, and calibrating on it, with the real engine."""

import csv
import io
import json
import math
import signal
import subprocess
import unittest

from trough_program import PROGRAM, EndToEndTest, campaign_text, wait_until

# A domain of one input and few points, with a goal that a few batches reach.
PLAN = {"grains.youngs_modulus": "0.3 MPa", "measure.packings": 4, "measure.half_width": 0.2, "measure.max_cycles": 48, "measure.max_packings": 8}
DOMAIN = '[domain]\nstart = 4\n"trough.throw_number" = { from = 1.5, to = 3 }\n'


class Learn(EndToEndTest):
    def write_domain(self, design=DOMAIN):
        path = self.folder / "domain.toml"
        path.write_text(campaign_text({**PLAN, "trough.throw_number": 2.0}) + design)
        return path

    def learn(self, *words, half_width="0.4", design=DOMAIN):
        return self.call("learn", self.write_domain(design), "--output", self.output, "--liggghts", self.engine, "--quiet",
                         "--accept-findings", "--batch", "2", "--half-width", half_width, *words)

    def predict(self, *places, form="--json"):
        words = [word for place in places for word in ("--at", place)]
        answer = self.call("predict", self.output, *words, form)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return answer.stdout

    def test_a_surface_is_learnt_asked_and_used(self):
        # A small budget ends it, but the start is always simulated.
        answer = self.learn("--budget", "1 core-seconds", half_width="0.01", design=DOMAIN.replace("start = 4", "start = 5"))
        self.assertEqual(answer.returncode, 1, answer.stderr)
        self.assertIn("not reached", answer.stdout)
        self.assertIn("--budget", answer.stdout)
        self.assertIn("the numerical errors of the simulations alone may be", answer.stderr)  # which leave no room in 0.01
        self.assertEqual(len(self.results()), 5)

        # With a smaller start nothing that is known is lost.
        answer = self.learn("--budget", "1 core-hours")
        self.assertIn(answer.returncode, (0, 1), answer.stderr)
        self.assertIn("largest half-width", answer.stdout)
        self.assertIn("covered", answer.stdout)
        cases = len(self.results())
        self.assertGreaterEqual(cases, 5)  # five points for each input beside the atlas
        self.assertIn("5 cases: ", answer.stdout)

        one = json.loads(self.predict("throw_number=2.2"))
        self.assertGreater(one["efficiency"], 0)
        self.assertGreater(one["half_width"], 0)
        self.assertGreater(one["numerical_error"], 0)
        self.assertEqual(one["trend"], "atlas")
        self.assertAlmostEqual(one["whole_half_width"], math.hypot(one["half_width"], one["numerical_error"]), 9)
        self.assertEqual(one["at"], {"trough.throw_number": 2.2})
        self.assertTrue(one["inside"])
        two = list(csv.DictReader(io.StringIO(self.predict("throw_number=2.2", "trough.throw_number=9", form="--csv"))))
        self.assertAlmostEqual(float(two[0]["efficiency"]), one["efficiency"], 9)
        self.assertEqual([row["inside"] for row in two], ["1", "0"])

        # Without atlas and theory it is another surface, whose interval overlaps the first.
        alone = json.loads(self.call("predict", self.output, "--at", "throw_number=2.2", "--without-theory", "--json").stdout)
        self.assertEqual(alone["trend"], "constant")
        self.assertNotEqual(alone["efficiency"], one["efficiency"])
        self.assertLessEqual(abs(alone["efficiency"] - one["efficiency"]), alone["half_width"] + one["half_width"])

        # The same command knows what is there: it simulates nothing when the goal is reached.
        starts = self.starts_file.stat().st_size
        again = self.learn("--budget", "1 core-hours")
        self.assertEqual(again.returncode, answer.returncode, again.stderr)
        self.assertEqual(self.starts_file.stat().st_size, starts)
        self.assertEqual(len(self.results()), cases)

        # With another floor none of them counts: four new ones begin.
        file = self.write_domain()
        file.write_text(file.read_text().replace('friction = 0.23', 'friction = 0.3', 1))
        other = self.call("learn", file, "--output", self.output, "--liggghts", self.engine, "--quiet", "--accept-findings", "--half-width", "0.4",
                          "--budget", "1 core-seconds")
        self.assertEqual(other.returncode, 1, other.stderr)
        self.assertTrue(other.stdout.startswith("4 cases: "), other.stdout)
        self.assertIn("left out, as the campaign file describes another layer now: ", other.stderr)

        # With the first floor they all count again.
        back = self.learn("--budget", "1 core-hours")
        self.assertEqual(back.stdout.split(":")[0], again.stdout.split(":")[0], back.stderr)

    def test_an_interruption_is_told_apart_from_the_answer(self):
        words = ["learn", self.write_domain(), "--output", self.output, "--liggghts", self.engine, "--quiet", "--accept-findings", "--half-width", "0.4",
                 "--budget", "1 core-hours"]
        process = subprocess.Popen([PROGRAM, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(self.end, process)
        wait_until(lambda: self.take_starts(), "a packing was simulated", process)
        process.send_signal(signal.SIGINT)
        code, output, errors = self.finish(process)
        self.assertEqual((code, output), (130, ""), errors)
        self.assertIn("interrupted; the same command continues it", errors)

    def test_calibration_refines_the_surface_where_the_posterior_lies(self):
        domain = '[domain]\nstart = 4\n"trough.friction" = { from = 0.1, to = 0.6 }\n'
        campaign = self.folder / "domain.toml"
        campaign.write_text(campaign_text({**PLAN, "measure.half_width": 0.02, "measure.max_cycles": 30, "measure.packings": 2, "measure.max_packings": 2,
                                           "trough.throw_number": 1.5}) + domain)
        omega = math.sqrt(1.5 * 9.81 / (0.003 * math.sin(math.atan(0.5))))
        speeds = self.folder / "speeds.csv"
        speeds.write_text("amplitude_mm,frequency_hz,vibration_angle_deg,speed_m_per_s,uncertainty_m_per_s\n"
                          f"3,{omega / (2 * math.pi)},{math.degrees(math.atan(0.5))},0.12,0.004\n")
        words = ["calibrate", campaign, "--output", self.output, "--measured", speeds, "--free", "friction", "--json"]
        # The start takes a small part of this budget; a machine that is busy counts more processor time.
        answer = self.call(*words, "--budget", "60 core-seconds", "--liggghts", self.engine, "--accept-findings", "--jobs", "2")
        self.assertIn(answer.returncode, (0, 1), answer.stderr)
        self.assertIn("where the posterior lies", answer.stderr)
        self.assertGreater(len(self.results()), 4)  # the start, and cases where the posterior lies
        friction = json.loads(answer.stdout)["parameters"][0]
        self.assertLessEqual(friction["low"], friction["median"])
        refused = self.call("calibrate", self.output, "--measured", speeds, "--free", "friction", "--budget", "1 core-hours")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("campaign file", refused.stderr)

    def test_what_is_wrong_is_refused(self):
        campaign = self.write_domain()
        for words, message in (
            (["learn", campaign, "--output", self.output, "--budget", "1 core-hours"], "--half-width is missing"),
            (["learn", campaign, "--output", self.output, "--half-width", "0.1"], "--budget is missing"),
            (["learn", campaign, "--output", self.output, "--half-width", "0.1", "--budget", "4 apples"], "--budget"),
            (["predict", self.folder, "--at", "throw_number=2"], "campaign"),
        ):
            answer = self.call(*words)
            self.assertEqual(answer.returncode, 2, answer.stderr)
            self.assertIn(message, answer.stderr)
        plain = self.write_domain('[sweep]\n"trough.throw_number" = [1.5, 2.0]\n')
        answer = self.call("learn", plain, "--output", self.output, "--liggghts", self.engine, "--quiet", "--accept-findings",
                           "--half-width", "0.4", "--budget", "1 core-hours")
        self.assertEqual(answer.returncode, 2, answer.stderr)
        self.assertIn("[domain]", answer.stderr)


if __name__ == "__main__":
    unittest.main()
