"""vibrotrough validate on made-up cases: good, broken, without criterion, with a negative control that passes, and with unknown names."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, POSTPROCESS = sys.argv[1], sys.argv[2]
VALIDATE = [sys.executable, "-B", str(pathlib.Path(POSTPROCESS) / "validate.py"), "--program", PROGRAM, "--jobs", "1"]
SCRIPT = f"""
import pathlib
import sys
sys.path.insert(0, {POSTPROCESS!r})
from validation_case import ValidationCase
run = ValidationCase(pathlib.Path(__file__).parent)
"""
GOOD = 'run.check("one", 2 if run.control else 1, 1, 0.1)\nrun.finding("it is said", False, "it is not so")\nrun.finish()\n'


class Validate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.cases = pathlib.Path(self.folder.name) / "cases"
        self.cases.mkdir()

    def tearDown(self):
        self.folder.cleanup()

    def case(self, name, body, extra=""):
        folder = self.cases / name
        folder.mkdir()
        (folder / "case.toml").write_text(f'title = "{name}"\nquestion = "Is it?"\nnegative_control = "two for one"\n{extra}')
        (folder / "run.py").write_text(SCRIPT + body)

    def validate(self, *words):
        command = VALIDATE + ["--cases", str(self.cases), "--output", self.folder.name + "/out", *words]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_a_good_case_holds_and_leaves_its_verdict(self):
        self.case("good", GOOD)
        answer = self.validate()
        self.assertEqual(answer.returncode, 0, answer.stdout)
        verdict = json.loads(pathlib.Path(self.folder.name, "out/good/verdict.json").read_text())
        self.assertTrue(verdict["holds"])
        self.assertEqual(verdict["criteria"][0]["value"], 1)

    def test_a_negative_control_that_passes_fails_the_case(self):
        self.case("blind", 'run.check("one", 1, 1, 0.1)\nrun.finish()\n')
        answer = self.validate()
        self.assertEqual(answer.returncode, 1)
        self.assertIn("PASSES", answer.stdout)

    def test_a_crash_is_neither_a_verdict_nor_a_failed_control(self):
        self.case("broken", "if run.control: raise ValueError\n" + GOOD)
        answer = self.validate()
        self.assertEqual(answer.returncode, 1)
        self.assertIn("ERROR 1", answer.stdout)

    def test_a_case_without_criteria_or_with_no_number_fails(self):
        self.case("empty", "run.finish()\n")
        self.case("nan", 'run.check("one", float("nan"), 1, 0.1)\nrun.finish()\n')
        self.assertIn("0 of 2 cases hold", self.validate().stdout)

    def test_a_long_case_is_judged_from_its_stored_table(self):
        body = 'if run.long: run.write_table("result.csv", ["x"], [[1]])\n' \
               'run.check("x", float(run.table("result.csv")[0]["x"]) + run.control, 1, 0.1)\nrun.finish()\n'
        self.case("slow", body, "long = true\n")
        self.assertEqual(self.validate().returncode, 1)  # nothing stored yet
        self.assertEqual(self.validate("--long", "--store").returncode, 0)
        self.assertEqual(self.validate().returncode, 0)
        self.assertIn("holds (1 criteria)", self.validate("--page").stdout)
        table = self.cases / "slow/result.csv"
        table.write_text(table.read_text().replace("\n1\n", "\n3\n"))
        answer = self.validate()
        self.assertEqual(answer.returncode, 1)
        self.assertIn("FAIL x: 3", answer.stdout)

    def test_findings_are_told_and_do_not_decide(self):
        self.case("good", GOOD)
        self.assertEqual(self.validate("--store").returncode, 0)
        pages = self.validate("--page").stdout
        self.assertIn("**not supported**: it is said", pages)
        self.assertIn("[1 missed](findings.md#good)", pages)

    def test_unknown_names_and_unreadable_cases_are_named(self):
        self.case("good", GOOD)
        answer = self.validate("goood")
        self.assertEqual((answer.returncode, answer.stdout), (2, ""))
        self.assertIn("no case 'goood'", answer.stderr)
        (self.cases / "good/case.toml").write_text('title = "half"\n')
        self.assertIn("question", self.validate("good").stderr)

    def test_the_program_lists_its_own_cases(self):
        answer = subprocess.run([PROGRAM, "validate", "--list"], capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.assertIn("theory_table_1", answer.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
