"""What the validation scripts of the theory share: running the program, and a criterion that can fail."""

import argparse
import csv
import io
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Validation:
    """Runs `vibrotrough theory ...` and collects checks; finish() says how they went and ends with 1 when one failed."""

    def __init__(self, description, folder):
        parser = argparse.ArgumentParser(description=description)
        parser.add_argument("--program", default=str(ROOT / "build/release/src/app/vibrotrough"))
        parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path(folder))
        parser.add_argument("--points", type=int, default=300, help="per axis of a map")
        options = parser.parse_args()
        self.program, self.output, self.points = options.program, options.output, options.points
        self.output.mkdir(parents=True, exist_ok=True)
        self.failed = 0

    def theory(self, *arguments):
        command = [self.program, "theory", *map(str, arguments)]
        answer = subprocess.run(command, capture_output=True, text=True, check=False)
        if answer.returncode != 0:
            raise SystemExit(f"{' '.join(command)}\n{answer.stderr}")
        return answer.stdout

    def json(self, *arguments):
        return json.loads(self.theory(*arguments, "--json"))

    def csv(self, *arguments):
        return list(csv.DictReader(io.StringIO(self.theory(*arguments))))

    def check(self, what, value, expected, tolerance):
        good = abs(value - expected) <= tolerance
        self.failed += not good
        print(f"{'ok  ' if good else 'FAIL'} {what}: {value:.6g}, expected {expected:.6g} +- {tolerance:g}")

    def finish(self):
        print("all criteria hold" if self.failed == 0 else f"{self.failed} criteria fail")
        sys.exit(1 if self.failed else 0)
