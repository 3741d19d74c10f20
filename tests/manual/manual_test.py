"""manual_test.py BUILD_PY PROGRAM FOLDER: builds the manual and looks at what a reader needs of it. Exit code 77 without Sphinx."""

import importlib.util
import pathlib
import re
import subprocess
import sys

if any(importlib.util.find_spec(module) is None for module in ("sphinx", "myst_parser", "furo", "sphinx_copybutton")):
    print("Sphinx, MyST, furo or the copy button is missing: ./setup packages manual")
    sys.exit(77)

build, program, folder = sys.argv[1:4]
done = subprocess.run([sys.executable, "-B", build, program, folder], capture_output=True, text=True, check=False)
assert done.returncode == 0, done.stdout + done.stderr  # a warning is an error

html = pathlib.Path(folder) / "html"
pages = {str(page.relative_to(html)): page.read_text(encoding="utf-8") for page in html.rglob("*.html")}
for name in ("reference/commands/predict.html", "reference/keys.html", "reference/quantities.html", "reference/python.html", "validation/findings.html"):
    assert name in pages, f"{name} is not there"
assert pages["theory.html"].count('class="tag"') >= 10, "equations without the paper's numbers"
assert "<math" in pages["theory.html"]
assert "bistable-or-slow" in pages["troubleshooting.html"] and "130" in pages["troubleshooting.html"]
assert "ade407d9adf4" in pages["first_result.html"], "the demo's table is missing"

# The search works from file://: its index is a script, and nothing is asked of a network.
assert (html / "searchindex.js").read_text(encoding="utf-8").startswith("Search.setIndex(")
for name, text in pages.items():
    loaded = re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="(https?:[^"]*)"', text)
    assert not loaded, f"{name} loads {loaded}"

# How-to pages have one task each, in fewer than 400 words.
for page in sorted((pathlib.Path(build).parent / "howto").glob("*.md")):
    words = len(page.read_text(encoding="utf-8").split())
    assert words < 400, f"{page.name} has {words} words"
