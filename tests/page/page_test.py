"""The page of `vibrotrough page` in a headless browser, with real clicks and keys.

usage: page_test.py BROWSER PROGRAM WORK      BROWSER is chromium or firefox
"""

import json
import pathlib
import random
import re
import shutil
import subprocess
import sys
import unittest

try:
    from browser import Browser
except ImportError:
    print("SKIPPED: python3-websocket is not installed")
    sys.exit(77)

NAME, PROGRAM, WORK = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
NEEDS = {"chromium": ["chromium", "chromedriver"], "firefox": ["firefox-esr"]}
ANSWERED = "document.documentElement.dataset.answered"


def program(*words, **options):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False, **options)


def number(text):
    """The number that a text begins with, and half of its last digit."""
    found = re.match(r"[−-]?\d+(?:[.,](\d+))?", text)
    assert found, text
    return float(found[0].replace("−", "-").replace(",", ".")), 0.5 * 10 ** -len(found[1] or "") * (1 + 1e-9)


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        cls.page = WORK / "page.html"
        done = program("page", "--output", cls.page)
        assert done.returncode == 0, done.stderr
        cls.browser = Browser(NAME, WORK)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.size(1280, 900)
        self.browser.requests.clear()
        self.browser.console.clear()
        self.browser.open(self.page, f"?{self.id()}")  # a page of its own: only '#' would keep the old one
        self.browser.wait(ANSWERED)

    def tearDown(self):
        asked = [one for one in self.browser.requests if not one.startswith(("file:", "data:", "about:", "chrome:", "resource:", "moz-"))]
        self.assertEqual(asked, [], "the page asks no network for anything")
        self.assertEqual(self.browser.console, [])

    def drawn(self):
        """Waits until everything is drawn that the last action changed."""
        before = self.browser.run("document.documentElement.dataset.drawn")
        self.browser.wait(f"document.documentElement.dataset.drawn > {before} || true")
        self.browser.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def assert_shows(self, identity, value):
        shown, half = number(self.browser.text(identity))
        self.assertLessEqual(abs(shown - value), half + 1e-9 * abs(value), f"{identity} shows {shown}, the program says {value}")

    def go(self, part):
        self.browser.run(f"(location.hash = {json.dumps(part)}, 1)")
        self.drawn()

    def test_answers_are_those_of_the_program(self):
        draw = random.Random(50)
        for _ in range(50):
            stroke, machine_number = round(draw.uniform(2, 16), 1), draw.uniform(1, 5)
            one = {"stroke_mm": stroke, "rpm": round(945.8 * (machine_number / (stroke / 2)) ** 0.5), "vibration_angle_deg": round(draw.uniform(18, 40)),
                   "inclination_deg": round(draw.uniform(-3, 3), 1), "friction": round(draw.uniform(0.2, 0.6), 2), "rolling_friction": draw.choice([0, 0.3]),
                   "depth_mm": round(draw.uniform(8, 40)), "width_mm": round(draw.uniform(100, 900)), "bulk_density": round(draw.uniform(300, 1800))}
            self.go("&".join(f"{name}={value}" for name, value in one.items()))
            words = ["theory", "point", "--json", "--stroke", f"{stroke} mm", "--rpm", one["rpm"], "--vibration-angle", f"{one['vibration_angle_deg']} deg",
                     "--inclination", f"{one['inclination_deg']} deg", "--friction", one["friction"], "--layer-height", f"{one['depth_mm']} mm",
                     "--layer-width", f"{one['width_mm']} mm", "--bulk-density", f"{one['bulk_density']} kg/m3"]
            mass = json.loads(program(*words).stdout)
            layer = json.loads(program(*words, "--rolling-layer", "--accept-untested").stdout)
            best = mass if one["rolling_friction"] else layer
            with self.subTest(one):
                self.assert_shows("throw-number", mass["throw_number"])
                self.assert_shows("machine-number", mass["machine_number"])
                self.assert_shows("mass-speed", mass["quantities"]["conveying_speed"]["value"])
                self.assert_shows("layer-speed", layer["quantities"]["conveying_speed"]["value"])
                self.assert_shows("speed", best["quantities"]["conveying_speed"]["value"])
                self.assert_shows("flow", best["quantities"]["mass_flow_per_hour"]["value"])
                self.assert_shows("efficiency", best["velocity_efficiency"])
                self.assertEqual(self.browser.text("mode"), best["mode"])
                landing = mass["quantities"]["impact_speed"]["value"]
                self.assertEqual(self.browser.text("landing-speed"), "none") if landing == 0 else self.assert_shows("landing-speed", landing)
                self.assert_shows("power", mass["quantities"]["power_per_area"]["value"])
                if not one["rolling_friction"] and layer["outside_tested_range"]:
                    self.assertIn(self.browser.text("trust-word"), ("at the edge of what was tested", "not tested"))
                    self.assertIn("tested", self.browser.text("reason"))

    def test_keys_and_clicks_change_the_answer(self):
        b = self.browser
        b.type_into("#stroke_mm", "8,4")
        self.drawn()
        self.assertEqual(b.run("document.getElementById('amplitude_mm').value"), "4.2")
        b.type_into("#amplitude_mm", "4.9")
        self.drawn()
        self.assertEqual(b.run("document.getElementById('stroke_mm').value"), "9.8")
        b.click("[data-poles='6,50']")
        self.drawn()
        self.assertEqual(b.run("document.getElementById('rpm').value"), "1000")
        self.assertEqual(b.run("document.querySelector(\"[data-poles='6,50']\").getAttribute('aria-pressed')"), "true")
        said = json.loads(program("theory", "point", "--json", "--stroke", "9.8 mm", "--rpm", 1000, "--vibration-angle", "30 deg", "--friction", 0.3, "--rolling-layer",
                                  "--accept-untested").stdout)
        self.assert_shows("speed", said["quantities"]["conveying_speed"]["value"])
        before = b.text("speed")
        b.run("(document.getElementById('slide-vibration_angle_deg').focus(), 1)")
        b.press("Right", "Right")
        self.drawn()
        self.assertEqual(b.run("document.getElementById('vibration_angle_deg').value"), "31")
        self.assertNotEqual(b.text("speed"), before)

    def test_wrong_inputs_are_named_and_the_old_answer_is_marked(self):
        b = self.browser
        for text, expected in (("nine", "“nine” is not a number; write for example 9.7."), ("", "is not a number"), ("970", "970 is outside 0.1 to 100; write for example 9.7."),
                               ("-3", "outside"), ("1e999", "outside")):
            b.type_into("#stroke_mm", text or "\ue017")
            self.drawn()
            self.assertIn(expected, b.text("stroke_mm-wrong"))
            self.assertEqual(b.run("document.getElementById('stroke_mm').getAttribute('aria-invalid')"), "true")
            self.assertEqual(b.text("trust-word"), "check the inputs")
            self.assertIn("last inputs that were complete", b.text("reason"))
        b.type_into("#stroke_mm", "9.7")
        self.drawn()
        self.assertEqual((b.text("stroke_mm-wrong"), b.text("trust-word")), ("", "tested"))
        b.type_into("#rpm", "6000")
        self.drawn()
        self.assertEqual(b.text("trust-word"), "not tested")
        self.assertIn("machine number of 195 is unusual", b.text("reason"))
        self.go("inclination_deg=25&friction=0.2&rpm=960")
        self.assertEqual(b.text("speed"), "none")
        self.assertIn("runs away", b.text("reason"))

    def test_words_and_units(self):
        b = self.browser
        b.run("(document.getElementById('language').focus(), 1)")
        self.go("lang=de&unit=m/min")
        self.assertEqual(b.run("document.documentElement.lang"), "de")
        self.assertEqual(b.text("speed"), "23,8 m/min")
        self.assertIn("Grad des Zyklus im Wurf, landet vorwärts gleitend", b.text("sentence"))
        self.assertEqual(b.run("document.getElementById('stroke_mm').value"), "9,7")
        left = b.run("[...document.querySelectorAll('[data-word]')].filter((e) => !e.textContent && e.dataset.word !== 'unit_1').map((e) => e.dataset.word)")
        self.assertEqual(left, [])

    def test_first_answer_and_redraws(self):
        b = self.browser
        first = float(b.run(ANSWERED))
        frames = b.run("""new Promise((done) => {
            const slider = document.getElementById('slide-stroke_mm'), times = [], worked = []; let k = 0;
            const step = (now) => {
              times.push(now); worked.push(Number(document.documentElement.dataset.worked));
              slider.value = 5 + (k++ % 80) / 10; slider.dispatchEvent(new Event('input', {bubbles: true}));
              if (k < 90) requestAnimationFrame(step); else done({seconds: (times[89] - times[9]) / 1000, worked: worked.slice(9).sort((a, b) => a - b)});
            }; requestAnimationFrame(step); })""")
        per_second, typical = 80 / frames["seconds"], frames["worked"][40]
        print(f"{NAME}: first answer {first:.0f} ms after opening, {per_second:.0f} redraws a second while a slider moves, {typical:.1f} ms of work in each", flush=True)
        # Other tests may keep the cores busy: what is held is far from what is measured on a quiet machine (60 redraws, 0.2 s).
        self.assertLess(first, 3000)
        self.assertLess(typical, 50)

    def test_nothing_is_wider_than_a_telephone(self):
        for width in (360, 800, 1280):
            self.browser.size(width, 740)
            self.drawn()
            wide, inner = self.browser.run("[document.documentElement.scrollWidth, innerWidth]")
            self.assertLessEqual(wide, inner)


def main():
    missing = [one for one in NEEDS[NAME] if not shutil.which(one)]
    if missing:
        print(f"SKIPPED: {' and '.join(missing)} not installed")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], "--verbose"])


if __name__ == "__main__":
    main()
