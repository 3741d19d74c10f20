"""Runs what no commit waits for (the label `nightly`), and writes when that was and how it ended.

usage: night.py BUILD PAGE [CTEST_OPTION...]      BUILD is a folder with a build, PAGE is tests/suite/last_night.md
       night.py --check BUILD PAGE                fails unless PAGE has every nightly test of BUILD, and all of them passed

With an option such as `-R tidy` only these tests run, and the rows of the others stay as they are.
"""

import datetime
import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

SOURCE = pathlib.Path(__file__).resolve().parents[2]
NIGHTLY = ["-C", "nightly", "-L", "nightly"]
PASSED = "passed"


def rows_of(page: pathlib.Path) -> dict[str, list[str]]:
    """The rows of the table: how each test ended, its seconds and the commit."""
    if not page.exists():
        return {}
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in page.read_text(encoding="utf-8").splitlines() if row.startswith("| ")]
    return {name: cells for name, *cells in rows if name != "test"}


def run(build: pathlib.Path, page: pathlib.Path, options: list[str]) -> int:
    commit = subprocess.run(["git", "-C", SOURCE, "describe", "--always", "--dirty", "--abbrev=12"], capture_output=True, text=True, check=True).stdout.strip()
    with tempfile.TemporaryDirectory(prefix="vibrotrough-night-") as folder:
        results = pathlib.Path(folder, "results.xml")
        code = subprocess.run(["ctest", "--test-dir", build, *NIGHTLY, "--output-on-failure", "--output-junit", results, *options], check=False).returncode
        tests = ElementTree.parse(results).getroot().findall("testcase")
    words = {"run": PASSED, "fail": "**failed**"}
    rows = rows_of(page)
    day = f"{datetime.date.today():%d %B %Y}"
    rows |= {one.get("name", ""): [words.get(one.get("status", ""), "not run"), f"{float(one.get('time', '0')):.0f}", day, commit] for one in tests}
    page.write_text("\n".join([
        "# The last run of the nightly tests", "", "Written by `night.py`.", "",
        "| test | | s | day | commit |", "|---|---|--:|---|---|", *(f"| {' | '.join([name, *rows[name]])} |" for name in sorted(rows))]) + "\n", encoding="utf-8")
    return code


def check(build: pathlib.Path, page: pathlib.Path) -> int:
    listed = subprocess.run(["ctest", "--test-dir", build, *NIGHTLY, "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout
    rows = rows_of(page)
    wrong = [name for name in (test["name"] for test in json.loads(listed)["tests"]) if rows.get(name, [""])[0] != PASSED]
    print(f"{len(wrong)} nightly tests did not pass when {page.name} was written; tests/README.md says how to run them:", *wrong, sep="\n")
    return 1 if wrong or not rows else 0


def main() -> int:
    words = sys.argv[1:]
    if words[:1] == ["--check"] and len(words) == 3:
        return check(pathlib.Path(words[1]), pathlib.Path(words[2]))
    if len(words) < 2 or words[0].startswith("-"):
        print(__doc__)
        return 2
    return run(pathlib.Path(words[0]), pathlib.Path(words[1]), words[2:])


if __name__ == "__main__":
    sys.exit(main())
