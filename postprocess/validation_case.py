"""One case of validation/: its options, criteria, findings and verdict. postprocess/README.md tells how a case is made."""

import argparse
import csv
import datetime
import io
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import time
import tomllib

from campaign_program import campaign_text, run_campaign

ROOT = pathlib.Path(__file__).resolve().parent.parent
HOLDS, FAILS = 0, 4  # exit codes; 1 is a crash of the script


def read_table(path):
    """Rows of a CSV file as dicts of texts; lines that begin with # are remarks."""
    lines = [line for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def today():
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")


def machine():
    """System, processor and number of cores."""
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
        processor = re.search(r"^model name\s*: (.*)$", text, re.MULTILINE)[1]
    except (OSError, TypeError):
        processor = platform.machine()
    return f"{platform.system()}, {processor}, {os.cpu_count()} cores"


def arguments(description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--program", default=str(ROOT / "build/release/src/app/vibrotrough"))
    parser.add_argument("--output", type=pathlib.Path, help="folder of tables, figures and verdict.json; default: the case's own")
    parser.add_argument("--runs", type=pathlib.Path, help="folder of simulations, which go on where they stopped; default: runs/NAME")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--long", action="store_true", help="run the simulations of a long case instead of judging the stored tables")
    parser.add_argument("--quick", action="store_true", help="with --long: a few cases only, to try the script; proves nothing")
    parser.add_argument("--wrong-twin", action="store_true", help="make the deliberate mistake, which the criteria must notice")
    parser.add_argument("--points", type=int, default=300, help="per axis of a map of the theory")
    return parser.parse_args()


class ValidationCase:
    """Reads FOLDER/case.toml, runs the program, collects criteria and findings; finish() writes the verdict."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.about = tomllib.loads((self.folder / "case.toml").read_text(encoding="utf-8"))
        options = arguments(self.about["question"])
        self.program, self.jobs, self.points = options.program, options.jobs, options.points
        self.output = options.output or self.folder
        self.runs = (options.runs or ROOT / "runs" / self.folder.name).resolve()
        self.long, self.quick, self.wrong = options.long, options.quick, options.wrong_twin
        self.output.mkdir(parents=True, exist_ok=True)
        self.criteria, self.findings = [], []
        self.begin, self.made_by = time.monotonic(), ""

    # What the program says.

    def theory(self, *words):
        """What `vibrotrough theory WORDS` prints."""
        return self._ask("theory", *map(str, words))

    def json(self, *words):
        return json.loads(self.theory(*words, "--json"))

    def csv(self, *words):
        return list(csv.DictReader(io.StringIO(self.theory(*words))))

    def probes(self):
        """What `vibrotrough probe-engine` measured and expected, by the probes' names."""
        return {probe["name"]: probe for probe in json.loads(self._ask("probe-engine", "--json"))["probes"]}

    def _ask(self, *words):
        answer = subprocess.run([self.program, *words], capture_output=True, text=True, check=False)
        if answer.returncode != 0:
            raise SystemExit(f"{self.program} {' '.join(words)}\n{answer.stderr}")
        return answer.stdout

    def campaign(self, name, changes, sweep, base="base.toml"):
        """Runs the variations on FOLDER/base.toml below --runs, and returns the table's rows, in the order of the sweep."""
        sections = tomllib.loads((self.folder / base).read_text(encoding="utf-8"))
        text = campaign_text(sections, {"campaign.name": name, **changes}, sweep)
        return run_campaign(self.program, self.runs / name, text, self.jobs)

    # Tables: written by a long run, read by the judgement of this run or of a later one.

    def reference(self, name="reference.csv"):
        return read_table(self.folder / name)

    def table(self, name):
        """A table that write_table() wrote: this run's with --long or for a case that is not long, else the stored one."""
        fresh = self.long or not self.about.get("long", False)
        path = (self.output if fresh else self.folder) / name
        if not fresh:  # the verdict names what made the numbers, not who judged them
            self.made_by = path.read_text(encoding="utf-8").splitlines()[0].lstrip("# ")
        return read_table(path)

    def write_table(self, name, header, rows):
        with open(self.output / name, "w", encoding="utf-8", newline="") as file:
            file.write(f"# {self.provenance()}\n")
            csv.writer(file, lineterminator="\n").writerows([header, *rows])

    def figure(self, name):
        """Where to save a figure; a twin's goes where nobody takes it for the case's."""
        return self.output / name

    # Judgement.

    def check(self, what, value, expected, tolerance, because=""):
        """A criterion: |value - expected| <= tolerance. `because`: the reason for the tolerance."""
        self.between(what, value, expected - tolerance, expected + tolerance, because)

    def between(self, what, value, least, most, because=""):
        """A criterion: least <= value <= most (not a number fails)."""
        value, holds = float(value), bool(least <= value <= most)
        self.criteria.append({"what": what, "value": value, "least": float(least), "most": float(most), "holds": holds,
                              "because": because})
        print(f"{'ok  ' if holds else 'FAIL'} {what}: {value:.6g}, wanted {least:.6g} to {most:.6g}")

    def finding(self, claim, borne_out, measured):
        """Somebody's claim and whether our measurement bears it out (True, False, or None: undecided); no criterion of ours."""
        self.findings.append({"claim": claim, "borne_out": None if borne_out is None else bool(borne_out), "measured": measured})
        print({True: "borne out    ", False: "not borne out", None: "undecided    "}[self.findings[-1]["borne_out"]], f"{claim}: {measured}")

    def provenance(self):
        """Date, program with its commit, and machine, for the first line of a table."""
        return f"{today()}; {self._ask('--version').strip()}; {machine()}"

    def finish(self):
        """Writes verdict.json (not for a twin) and ends with HOLDS or FAILS. A case without criteria fails."""
        failed = sum(not criterion["holds"] for criterion in self.criteria)
        holds = failed == 0 and bool(self.criteria)
        print("all criteria hold" if holds else f"{failed} of {len(self.criteria)} criteria fail")
        if not self.wrong:
            self._write_verdict(holds)
        sys.exit(HOLDS if holds else FAILS)

    def _write_verdict(self, holds):
        long = self.about.get("long", False)
        verdict = {"case": self.folder.name, "holds": holds, "date": today(), "seconds": round(time.monotonic() - self.begin, 1),
                   "made_by": self.made_by or self.provenance(),
                   "command": f"vibrotrough validate {self.folder.name}" + (" --long" if long else ""),
                   "criteria": self.criteria, "findings": self.findings}
        text = json.dumps(verdict, indent=1, ensure_ascii=False) + "\n"
        (self.output / "verdict.json").write_text(text, encoding="utf-8")
