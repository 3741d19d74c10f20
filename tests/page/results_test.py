"""The page with results of the program: the cases of a campaign, and machines that `design` proposed. page_test.py runs these tests."""

import json
import shutil
import unittest

from browser import Browser, pages_in
from page_program import NAME, READY, WORK, number, program
from trough_program import campaign_text


class DesignTest(unittest.TestCase):
    TASK = ["--bulk-density", "600 kg/m3", "--width", "300 mm", "--friction", "0.3", "--friction-uncertainty", "0.03", "--layer-depth", "10 mm to 60 mm", "--grain-diameter", "10 mm"]

    def design(self, name, *words, flow="12 t/h", code=0):
        done = program("design", *self.TASK, "--mass-flow", flow, *words, "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        (WORK / name).write_text(done.stdout, encoding="utf-8")
        return json.loads(done.stdout)

    def open_page(self, *files):
        page = WORK / "design.html"
        done = program("page", *[WORK / name for name in files], "--output", page)
        self.assertEqual(done.returncode, 0, done.stderr)
        browser = Browser(NAME, WORK / "design")
        self.addCleanup(browser.close)
        browser.open(page)
        browser.wait(f"{READY} && document.documentElement.dataset.complete === 'true'")
        return browser

    def assert_is(self, browser, machine):
        for field, value in (("stroke_mm", machine["stroke_mm"]), ("rpm", machine["rpm"]), ("depth_mm", machine["layer_depth_mm"]), ("width_mm", 300), ("grain_mm", 10)):
            self.assertAlmostEqual(float(browser.run(f"document.getElementById('{field}').value")), value, delta=1e-3 * value, msg=field)

    def test_the_proposed_machine_and_the_second_best(self):
        """The page begins with the machine of the design; B is the second best speed of the drive. What the design says stands beside."""
        said = self.design("<i>design.json", "--rpm", "720,800", "--vibration-angle", "30 deg", flow="9 t/h")
        second = next(one for one in said["speeds_compared"] if one["rank"] == 2)
        b = self.open_page("<i>design.json")
        self.assert_is(b, said)
        table = b.text("design-table")
        self.assertIn("<i>design.json", table)
        self.assertIn("point mass (for comparison)", table)
        for probability in (said["models"][0]["probability"], second["probability"]):
            self.assertIn("not known" if probability is None else f"{100 * probability:#.3g} %", table)
        self.assertIn("Asked for are 9.00 t/h with a probability of 95.0 %.", b.text("design-asked"))
        self.assertIn("Rolling friction of the grains: 0.1", b.text("design-asked"))
        # The mass flow that was asked is a line at its height, over the stroke.
        self.assertEqual(b.run("[document.getElementById('curve-axis').value, document.getElementById('curve-quantity').value]"), ["stroke_mm", "flow"])
        self.assertEqual(b.run("document.querySelectorAll('#curve .asked').length"), 1)
        y, tick = b.run("[Number(document.querySelector('#curve .asked').getAttribute('y1')), Number(document.querySelector('#curve circle.own-0').getAttribute('cy'))]")
        flow = number(b.text("flow"))[0]
        zero = float(b.run("document.querySelector('#curve .zero').getAttribute('y1')"))
        self.assertAlmostEqual((zero - y) / (zero - tick), 9 / flow, delta=0.01)
        b.click("#edit-b")
        self.assert_is(b, second)
        # A change is answered by the page; the proposal comes back by its button.
        b.type_into("#rolling_friction", "0")
        b.type_into("#stroke_mm", "3")
        b.wait("document.getElementById('design-now').textContent.includes('does not reach what is asked')")
        b.click("#design-table tbody tr:last-child button")
        self.assert_is(b, second)
        self.assertEqual(pages_in(b.printed()), 1)
        self.assertEqual(b.console, [])

    def test_two_designs(self):
        """The proposals of two models side by side; a file that holds something else is named."""
        first, other = self.design("mass.json", "--model", "point-mass"), self.design("layer.json", "--model", "rolling-layer", "--rolling-friction", "0.4", code=1)  # not tested
        b = self.open_page("mass.json", "layer.json")
        self.assert_is(b, first)
        self.assertIn("rolling-layer law", b.text("design-table"))
        self.assertIn("layer.json: Asked for are 12.0 t/h with a probability of 95.0 %. No probability is known", b.text("design-asked"))
        b.click("#edit-b")
        self.assert_is(b, other)
        (WORK / "other.json").write_text("[1, 2]", encoding="utf-8")
        done = program("page", WORK / "other.json", "--output", WORK / "other.html")
        self.assertEqual((done.returncode, (WORK / "other.html").exists()), (2, False))
        self.assertIn("not what 'vibrotrough design --json' prints", done.stderr)
        done = program("page", WORK / "gone.json")
        self.assertEqual((done.returncode, done.stderr.count("there is no such file")), (2, 1))


class CampaignTest(unittest.TestCase):
    def test_simulated_cases(self):
        """A campaign of two small cases: the points and bars of the page are the numbers of compare."""
        if not shutil.which("liggghts"):
            self.skipTest("liggghts is not installed")
        file, runs = WORK / "small.toml", WORK / "<b>runs"
        file.write_text(campaign_text({"trough.width": "300 mm"}, {"trough.throw_number": [1.7, 2.2]}), encoding="utf-8")
        done = program("run", file, "--output", runs, "--jobs", 1)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        rows = json.loads(program("compare", runs, "--json").stdout)
        page = WORK / "campaign.html"
        done = program("page", runs, "--output", page)
        self.assertEqual(done.returncode, 0, done.stderr)
        browser = Browser(NAME, WORK / "campaign")
        self.addCleanup(browser.close)
        browser.open(page)
        browser.wait(f"{READY} && document.documentElement.dataset.complete === 'true'")  # curves that appear below the pointer take the click away
        self.assertIn("<b>runs", browser.text("campaign-title"))
        browser.click("#campaign-table tbody tr:nth-child(2) button")
        browser.wait("document.querySelectorAll('#curve .mark.simulated:not(.other)').length === 1")
        self.assertEqual(browser.run("document.querySelectorAll('#curve .mark.simulated .bar').length"), 2)
        table = browser.text("campaign-table")
        for row in rows:
            for column in ("conveying_speed_m_per_s", "mass_flow_t_per_h"):
                shown = f"{row[column]:.3g}"
                self.assertIn(shown, table)
        heads = browser.run("[...document.querySelectorAll('#campaign-table thead th')].map((e) => e.textContent)")
        self.assertIn("Depth of the layer [mm]", heads)
        second = browser.run("[...document.querySelectorAll('#campaign-table tbody tr:nth-child(2) > *')].map((e) => e.textContent)")
        depth = second[heads.index("Depth of the layer [mm]")]
        self.assertAlmostEqual(float(browser.run("document.querySelector('#depth_mm').value")), float(depth), places=1)
        self.assertAlmostEqual(float(browser.text("throw-number")), rows[1]["throw_number"], places=2)
        self.assertEqual(browser.console, [])
