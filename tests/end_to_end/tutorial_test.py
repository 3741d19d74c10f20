"""The walks of `vibrotrough tutorial`, from their first command to their last, with the real engine: as the page has them, block by block.
With every commit one page is followed to its end, and the other up to its simulations; the rest at night. What is shown
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
BLOCK = re.compile(r"^```(\w*)(?: exit_code=(\d+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)

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
        shutil.copytree(SOURCES / "postprocess/vibrotrough", modules / "vibrotrough")
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

    def test_does_depth_matter(self):
        folder = self.new_folder("page")
        self.follow_page("depth", folder, to_its_end=WHOLE)
        if WHOLE:
            self.assertTrue((folder / "figures" / "conveying_speed-over-height.pdf").read_bytes().startswith(b"%PDF"))
            self.assertIn("point-mass theory", (folder / "runs" / "depth" / "report" / "report.html").read_text())
            self.assertTrue((folder / "depth.zip").is_file())
            self.assertEqual(len(list(folder.glob("runs/depth/cases/*/frames/view.sh"))), 3)

    def test_from_a_mass_flow_to_a_sheet(self):
        folder = self.new_folder("page")
        self.follow_page("design", folder, to_its_end=WHOLE)
        if WHOLE:
            sheet = (folder / "design.html").read_text()
            self.assertIn("Verified: this machine was simulated at its own depth", sheet)
            self.assertIn("Signature", sheet)
            self.assert_is_the_machine_that_was_simulated(folder)

    def assert_is_the_machine_that_was_simulated(self, folder):
        """The page's command again, which simulates nothing then."""
        (command,) = (content.rstrip("\n") for _, _, content in blocks(self.page("design")) if "--verify" in content)
        results = {path: path.stat().st_mtime_ns for path in folder.rglob("result.h5")}
        code, said = self.command(["sh", "-ec", command + " --quiet --json"], folder)
        self.assertEqual(code, 0, said)
        self.assertEqual({path: path.stat().st_mtime_ns for path in folder.rglob("result.h5")}, results)
        self.assert_was_simulated(json.loads(said), folder)

    def test_no_file_is_overwritten(self):
        folder = self.new_folder("used")
        mine = folder / "depth.toml"
        mine.write_text("mine")
        done = self.call("tutorial", "depth", "--output", folder)
        self.assertEqual(done.returncode, 0)
        self.assertIn(f"there already: {mine}", done.stdout)
        self.assertEqual(mine.read_text(), "mine")
        self.assertEqual(sorted(file.name for file in folder.iterdir()), ["depth.md", "depth.toml"])
        self.assert_one_line_error(self.call("tutorial", "cement"), 2, "depth")


if __name__ == "__main__":
    unittest.main()
