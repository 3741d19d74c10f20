"""The walks of `vibrotrough tutorial`, from their first command to their last, with the real engine: as the page has them, block by block, and as
the cells of the notebook. With every commit one page is followed to its end, and the other up to its simulations; the rest at night. What is shown
below a block is what comes back.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from trough_program import PATIENCE, PROGRAM, WHOLE, EndToEndTest

SOURCES = Path(__file__).resolve().parent.parent.parent
WALKS = ("depth", "design")
MOST_WORDS = 1400  # of both pages together, without blocks
BLOCK = re.compile(r"^```(\w*)(?: exit_code=(\d+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)

# Runs a notebook's code as a kernel does, cell after cell in one namespace. A form feed stands before what each prints.
KERNEL = """import json, sys
names = {}
for cell in json.load(open(sys.argv[1]))["cells"]:
    if cell["cell_type"] == "code":
        print(end="\\f", flush=True)
        exec("".join(cell["source"]), names)
"""


def blocks(page):
    """(language, exit code, content) of the fenced blocks of a page."""
    return [(language, int(code or 0), content) for language, code, content in BLOCK.findall(page)]


def missing_lines(shown, said):
    """The lines of a shown text that do not follow one another in what was said; `...` stands for anything, and the number of blanks does not count."""
    given = iter(" ".join(line.split()) for line in said.splitlines())
    missing = []
    for line in shown.splitlines():
        pattern = re.compile(".*".join(re.escape(part.strip()) for part in " ".join(line.split()).split("...")))
        if not any(pattern.fullmatch(one) for one in given):
            missing.append(line)
    return missing


class Tutorial(EndToEndTest):
    def setUp(self):
        super().setUp()
        # The Python module takes the program on the PATH where it does not lie in a checkout.
        modules = self.folder / "modules"
        modules.mkdir()
        for script in (SOURCES / "postprocess").glob("vibrotrough*.py"):
            shutil.copy(script, modules)
        # The program under the name that a person types.
        programs = self.folder / "programs"
        programs.mkdir()
        (programs / "vibrotrough").symlink_to(PROGRAM)
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "PYTHONPATH": str(modules)}

    def new_folder(self, name):
        folder = self.folder / name
        folder.mkdir()
        return folder

    def command(self, words, folder):
        done = subprocess.run(words, cwd=folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE)
        return done.returncode, done.stdout

    def page(self, walk):
        done = self.call("tutorial", walk)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def follow_page(self, walk, folder, to_its_end=True):
        """Runs every block of the page, or those before its first simulation, and compares what it shows with what comes back."""
        said = ""
        for language, code, content in blocks(self.page(walk)):
            if not to_its_end and ("vibrotrough run " in content or "--verify" in content):
                return
            if language == "text":
                self.assertEqual(missing_lines(content, said), [], said)
                continue
            words = {"sh": ["sh", "-ec", content], "python": [sys.executable, "-c", content]}[language]
            ended, said = self.command(words, folder)
            self.assertEqual(ended, code, content + said)

    def follow_notebook(self, walk, folder, results=None):
        """Runs the notebook's cells, and compares what it shows below them with what they print. What was simulated already is found finished."""
        self.assertEqual(self.command(["vibrotrough", "tutorial", walk, "--output", "."], folder)[0], 0)
        if results:
            shutil.copytree(results, folder / "runs")
        ended, said = self.command([sys.executable, "-c", KERNEL, f"{walk}.ipynb"], folder)
        self.assertEqual(ended, 0, said)
        printed, count = said.split("\f"), 0
        for cell in json.loads((folder / f"{walk}.ipynb").read_text())["cells"]:
            if cell["cell_type"] == "code":
                count += 1
                continue
            for _, _, content in blocks("".join(cell["source"])):
                if results is None:  # else `plan` finds cases with results
                    self.assertEqual(missing_lines(content, printed[count]), [], printed[count])
        self.assertEqual(len(printed), count + 1)

    def test_does_depth_matter(self):
        page, notebook = self.new_folder("page"), self.new_folder("notebook")
        self.follow_page("depth", page, to_its_end=WHOLE)
        if WHOLE:
            self.follow_notebook("depth", notebook, page / "runs")
        for folder in (page, notebook) if WHOLE else ():
            self.assertTrue((folder / "figures" / "conveying_speed-over-height.pdf").read_bytes().startswith(b"%PDF"))
            self.assertIn("point-mass theory", (folder / "runs" / "depth" / "report" / "report.html").read_text())
            self.assertTrue((folder / "depth.zip").is_file())
            self.assertEqual(len(list(folder.glob("runs/depth/cases/*/frames/view.sh"))), 3)

    def test_from_a_mass_flow_to_a_sheet(self):
        page, notebook = self.new_folder("page"), self.new_folder("notebook")
        self.follow_page("design", page, to_its_end=WHOLE)
        if WHOLE:
            self.follow_notebook("design", notebook, page / "runs")
        for folder in (page, notebook) if WHOLE else ():
            sheet = (folder / "design.html").read_text()
            self.assertIn("Verified: this machine was simulated at its own depth", sheet)
            self.assertIn("Signature", sheet)
        if WHOLE:
            self.assert_is_the_machine_that_was_simulated(page)

    def assert_is_the_machine_that_was_simulated(self, folder):
        """The page's command again, which simulates nothing then."""
        (command,) = (content.rstrip("\n") for _, _, content in blocks(self.page("design")) if "--verify" in content)
        results = {path: path.stat().st_mtime_ns for path in folder.rglob("result.h5")}
        code, said = self.command(["sh", "-ec", command + " --quiet --json"], folder)
        self.assertEqual(code, 0, said)
        self.assertEqual({path: path.stat().st_mtime_ns for path in folder.rglob("result.h5")}, results)
        self.assert_was_simulated(json.loads(said), folder)

    def test_the_notebook_is_the_page(self):
        """Fields as https://nbformat.readthedocs.io/en/latest/format_description.html has them for 4.5."""
        for walk in WALKS:
            folder = self.new_folder(walk)
            self.assertEqual(self.call("tutorial", walk, "--output", folder).returncode, 0)
            page, notebook = (folder / f"{walk}.md").read_text(), json.loads((folder / f"{walk}.ipynb").read_text())
            self.assertEqual(page, self.page(walk))
            self.assertEqual((notebook["nbformat"], notebook["nbformat_minor"]), (4, 5))
            self.assertEqual(notebook["metadata"]["kernelspec"]["name"], "python3")
            self.assertEqual(notebook["metadata"]["language_info"], {"name": "python"})
            cells = notebook["cells"]
            self.assertEqual(len({cell["id"] for cell in cells}), len(cells))
            for cell in cells:
                self.assertRegex(cell["id"], r"\A[a-zA-Z0-9_-]{1,64}\Z")
                self.assertEqual(cell["metadata"], {})
                self.assertTrue(all(line.endswith("\n") for line in cell["source"][:-1]))
                if cell["cell_type"] == "code":
                    self.assertEqual((cell["execution_count"], cell["outputs"]), (None, []))
                else:
                    self.assertEqual(set(cell), {"cell_type", "id", "metadata", "source"})
            code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
            wanted = []
            for language, status, content in blocks(page):
                if language == "python":
                    wanted.append(content.rstrip("\n"))
                elif language == "sh":
                    wanted.append(f'sh(r"""\n{content}"""' + (f", exit_code={status})" if status else ")"))
            self.assertEqual(code[1:], wanted)
            text = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
            prose = BLOCK.sub(lambda block: block[0] if block[1] == "text" else "", page)
            self.assertEqual(text.split(), prose.split())

    def test_no_file_is_overwritten(self):
        folder = self.new_folder("used")
        mine = folder / "depth.toml"
        mine.write_text("mine")
        done = self.call("tutorial", "depth", "--output", folder)
        self.assertEqual(done.returncode, 0)
        self.assertIn(f"there already: {mine}", done.stdout)
        self.assertEqual(mine.read_text(), "mine")
        self.assertEqual(sorted(file.name for file in folder.iterdir()), ["depth.ipynb", "depth.md", "depth.toml"])
        self.assert_one_line_error(self.call("tutorial", "cement"), 2, "depth")

    def test_the_pages_are_short(self):
        prose = [re.sub(BLOCK, "", self.page(walk)) for walk in WALKS]
        self.assertLessEqual(len(" ".join(prose).split()), MOST_WORDS)

    def test_another_number_is_noticed(self):
        said = "case   eta\na   0.651 +- 0.05\nb   0.7\n"
        self.assertEqual(missing_lines("a ... +- 0.05\nb 0.7\n", said), [])
        self.assertEqual(missing_lines("a 0.652 ...\n", said), ["a 0.652 ..."])
        self.assertEqual(missing_lines("b 0.7\na ...\n", said), ["a ..."])  # another order


if __name__ == "__main__":
    unittest.main()
