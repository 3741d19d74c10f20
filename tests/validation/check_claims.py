"""The numbers in the pages are those of the stored tables; every way in which they can differ is found (copies with one mistake each)."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(ROOT / "postprocess"))

import claims  # noqa: E402

TABLE = "# made by hand\nlayer,eta,soft landing\nfree,0.50,0.4\nfree,0.80,0.6\nblocked,0.30,0.3\n"
CLAIMS = """
[free]
tables = ["result.csv"]
where = "layer == 'free'"
value = "eta - soft_landing"
text = "{least:.2f} to {most:.2f}"

[list]
tables = ["result.csv"]
each = "{eta:.1f} ({layer})"

[ratio]
tables = ["result.csv"]
base = "layer == 'blocked'"
where = "eta == 0.8"
value = "100 * base_eta / eta"
text = "{most:.1f} %"
"""
PAGE = "The gap is <!--=made_up.free-->0.10 to 0.20<!--/-->.\n\nAll: <!--=made_up.list-->0.5 (free), 0.8 (free), 0.3 (blocked)<!--/-->, <!--=made_up.ratio-->37.5 %<!--/-->\n"


class Pages(unittest.TestCase):
    def test_all_hold(self):
        self.assertEqual(claims.check(ROOT), [])

    def test_the_command_says_so(self):
        done = subprocess.run([PROGRAM, "validate", "--claims"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("numbers are tied to stored tables", done.stdout)

    def test_any_number_that_is_changed_by_hand_is_found(self):
        """In a copy of all pages and tables, the last digit of every marked text is changed, one after another."""
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder)
            for path in [*claims.pages(ROOT), *ROOT.glob("validation/*/*.csv"), *ROOT.glob("validation/*/claims.toml")]:
                (copy / path.relative_to(ROOT)).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, copy / path.relative_to(ROOT))
            self.assertEqual(claims.check(copy), [])
            texts, _ = claims.all_claims(copy)
            for page in claims.pages(copy):
                content = page.read_text(encoding="utf-8")
                for mark in claims.MARK.finditer(content):
                    at = max(i for i in range(mark.start("text"), mark.end("text")) if content[i].isdigit())
                    changed = content[:at] + str((int(content[at]) + 1) % 10) + content[at + 1:]
                    wrong = claims.wrong_marks(changed, texts)
                    self.assertEqual(len(wrong), 1, f"{page.name}: {mark[0]}")
                    self.assertIn(mark["name"], wrong[0])


class Mistakes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        (self.root / "validation/made_up").mkdir(parents=True)
        self.put("README.md", PAGE)
        self.put("validation/made_up/result.csv", TABLE)
        self.put("validation/made_up/claims.toml", CLAIMS)

    def tearDown(self):
        self.folder.cleanup()

    def put(self, path, text):
        (self.root / path).write_text(text, encoding="utf-8")

    def only_problem(self):
        problems = claims.check(self.root)
        self.assertEqual(len(problems), 1, problems)
        return problems[0]

    def test_none(self):
        self.assertEqual(claims.check(self.root), [])

    def test_a_number_changed_by_hand_is_named_and_written_again(self):
        self.put("README.md", PAGE.replace("0.20", "0.21"))
        self.assertEqual(self.only_problem(), "README.md: made_up.free is '0.10 to 0.21', its table says '0.10 to 0.20'; "
                                              "'vibrotrough validate --claims --store' writes it")
        self.assertEqual(claims.write(self.root), ["README.md"])
        self.assertEqual((self.root / "README.md").read_text(encoding="utf-8"), PAGE)

    def test_the_command_ends_with_1(self):
        self.put("README.md", PAGE.replace("0.20", "0.21"))
        done = subprocess.run([sys.executable, "-B", str(ROOT / "postprocess/validate.py"), "--program", PROGRAM, "--jobs", "1", "--claims",
                               "--cases", str(self.root / "validation")], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("its table says '0.10 to 0.20'", done.stdout)

    def test_a_table_that_changed(self):
        self.put("validation/made_up/result.csv", TABLE.replace("0.80", "0.84"))
        self.assertIn("made_up.free is '0.10 to 0.20', its table says '0.10 to 0.24'", "\n".join(claims.check(self.root)))

    def test_what_was_not_measured_does_not_count(self):
        self.put("validation/made_up/result.csv", TABLE.replace("free,0.80,0.6", "free,0.80,0.6\nfree,nan,0.6\nfree,,0.1"))
        self.assertNotIn("nan", "\n".join(claims.check(self.root)))
        self.assertNotIn("made_up.free", "\n".join(claims.check(self.root)))

    def test_a_column_that_does_not_exist(self):
        self.put("validation/made_up/claims.toml", CLAIMS.replace("eta - soft_landing", "eta - hard_landing"))
        self.assertIn("there is no column 'hard_landing'", "\n".join(claims.check(self.root)))

    def test_a_column_that_a_text_names(self):
        self.put("validation/made_up/claims.toml", CLAIMS.replace("({layer})", "({depth})"))
        self.assertIn("there is no column or statistic 'depth'", "\n".join(claims.check(self.root)))

    def test_a_table_that_does_not_exist(self):
        (self.root / "validation/made_up/result.csv").rename(self.root / "validation/made_up/other.csv")
        self.assertIn("result.csv", "\n".join(claims.check(self.root)))

    def test_no_row(self):
        self.put("validation/made_up/claims.toml", CLAIMS.replace("'free'", "'glued'"))
        self.assertIn("[free]: no row of the table is chosen", "\n".join(claims.check(self.root)))

    def test_a_claim_that_no_page_quotes(self):
        self.put("README.md", PAGE.split("All:")[0] + "<!--=made_up.list-->0.5 (free), 0.8 (free), 0.3 (blocked)<!--/-->".join(["- ", "\n"]))
        self.assertEqual(self.only_problem(), "no page quotes the claim 'made_up.ratio'")

    def test_a_mark_without_claim_or_end(self):
        self.put("README.md", PAGE + "and <!--=made_up.other-->0.3<!--/-->\n")
        self.assertIn("there is no claim 'made_up.other'", self.only_problem())
        self.put("README.md", PAGE + "and <!--=made_up.free-->0.10 to 0.20\n")
        self.assertIn("without its end", self.only_problem())

    def test_a_mark_that_begins_a_line(self):
        self.put("README.md", PAGE + "<!--=made_up.ratio-->37.5 %<!--/--> of it\n")
        self.assertIn("a mark begins a line", self.only_problem())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
