"""What the tests of the page share: the program, where they write, and a page in a browser."""

import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from browser import Browser

NAME, PROGRAM, WORK = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
WORK.mkdir(parents=True, exist_ok=True)
os.environ["VIBROTROUGH_PROGRAM"] = PROGRAM
sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "end_to_end"))  # for trough_program
NEEDS = {"chromium": ["chromium", "chromedriver"], "firefox": ["firefox-esr"]}
ANSWERED = "document.documentElement?.dataset.answered"
READY = "document.documentElement?.dataset.atlas"  # the atlas follows after the first answer


def program(*words, **options):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False, **options)


def number(text):
    """The number that a text begins with, and half of its last digit."""
    found = re.match(r"[−-]?\d+(?:[.,](\d+))?", text)
    assert found, text
    return float(found[0].replace("−", "-").replace(",", ".")), 0.5 * 10 ** -len(found[1] or "") * (1 + 1e-9)


class PageCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
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
        self.browser.wait(READY)

    def tearDown(self):
        asked = [one for one in self.browser.requests if not one.startswith(("file:", "data:", "about:", "chrome:", "resource:", "moz-"))]
        self.assertEqual(asked, [], "the page asks no network for anything")
        self.assertEqual(self.browser.console, [])

    def drawn(self):
        """Waits until everything is drawn that the last action changed."""
        self.browser.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def assert_shows(self, identity, value):
        shown, half = number(self.browser.text(identity))
        self.assertLessEqual(abs(shown - value), half + 1e-9 * abs(value), f"{identity} shows {shown}, the program says {value}")

    def go(self, part):
        self.browser.run(f"new Promise((done) => {{ addEventListener('hashchange', () => done(1), {{once: true}}); location.hash = {json.dumps('#' + part)}; }})")
        self.drawn()
