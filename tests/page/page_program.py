"""What the tests of the page share: the program, and where they write."""

import os
import pathlib
import re
import subprocess
import sys

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
