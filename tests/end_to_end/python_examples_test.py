"""Every example of Python in the docstrings of the modules and in the manual runs, on a real campaign that is called as they call it."""

import ast
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from trough_program import PATIENCE, PROGRAM, EndToEndTest, campaign_text

POSTPROCESS = Path(__file__).resolve().parent.parent.parent / "postprocess"
HOWTO = POSTPROCESS.parent / "src/manual/howto"
THEORY = os.environ.get("VIBROTROUGH_THEORY_MODULE", "")
CAMPAIGN = {"campaign.name": "pellets", "output.frames_per_cycle": 4, "output.frame_packings": "all", "output.contacts": True,
            "measure.max_cycles": 20}  # fmt: skip


def blocks(text):
    """The blocks of a text that are indented by four, without their indentation."""
    found, block = [], []
    for line in [*text.splitlines(), "end"]:
        if line.startswith("    ") or (block and not line.strip()):
            block.append(line[4:])
        elif block:
            found.append("\n".join(block).strip("\n") + "\n")
            block = []
    return found


def is_python(block):
    """Whether a block is Python; commands of a shell are not."""
    try:
        ast.parse(block)
        return True
    except SyntaxError:
        return False


def sections(page):
    """{heading: text} of a page."""
    parts = re.split(r"^## (.*)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2]))


class PythonExamples(EndToEndTest):
    def simulate(self):
        """A campaign as two folders, simulated once for all tests."""
        simulated = Path(self.common.name) / "runs"
        campaign = self.folder / "pellets.toml"
        campaign.write_text(campaign_text(CAMPAIGN, {"trough.throw_number": [1.5, 2.0]}))
        if not simulated.exists():
            done = self.call("run", campaign, "--output", simulated, "--accept-findings", "--jobs", 2)
            self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("pellets", "demo"):
            shutil.copytree(simulated, self.folder / "runs" / name)
        done = self.call("theory", "map", "--x", "throw_number=1:3:5", "--y", "friction=0.2:0.4:3", "--tan-vibration-angle", 0.5, "--output",
                         self.folder / "map.h5")  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)

    def run_code(self, code, what):
        code = f"import vibrotrough; vibrotrough.__path__.insert(0, {THEORY!r})\n{code}"
        environment = os.environ | {"PYTHONPATH": str(POSTPROCESS), "MPLBACKEND": "Agg", "PATH": f"{Path(PROGRAM).parent}{os.pathsep}{os.environ['PATH']}"}
        done = subprocess.run([sys.executable, "-B", "-W", "error", "-c", code], cwd=self.folder, env=environment, capture_output=True, text=True,
                              timeout=PATIENCE)  # fmt: skip
        self.assertEqual(done.returncode, 0, f"{what}:\n{code}\n{done.stderr}")
        self.assertTrue(done.stdout or any(word in code for word in ("savefig", "observable", "write_")), what)
        return done.stdout

    def docstring(self, module):
        return ast.get_docstring(ast.parse((POSTPROCESS / f"vibrotrough/{module}.py").read_text(encoding="utf-8")))

    def test_of_the_docstrings(self):
        self.simulate()
        for module, least in (("__init__", 1), ("campaign", 1), ("field_files", 1), ("fields", 1), ("frames", 1), ("theory", 1)):
            if module == "theory" and not THEORY:
                continue
            examples = [block for block in blocks(self.docstring(module)) if is_python(block)]
            self.assertGreaterEqual(len(examples), least, module)
            code = "\n".join(examples)
            if module == "__init__" and not THEORY:
                code = "\n".join(line for line in code.splitlines() if "vibrotrough.theory" not in line)
            with self.subTest(module=module):
                if module == "frames":
                    code += "\ncycle = case.packing(1).cycles('frames')[0]\nprint(height_of_the_layer(cycle), velocity_profile(cycle))\n"
                self.run_code(code, module)

    def test_of_the_page(self):
        self.simulate()
        page = {heading: text for name in ("python", "python_theory", "observe") for heading, text in sections(HOWTO / f"{name}.md").items()}
        for heading, least in (("Reading results with Python", 2), ("A campaign in Python", 1), ("Your own measurements", 1), ("The theory in Python", 1)):
            examples = [block for block in blocks(page[heading]) if is_python(block)]
            self.assertGreaterEqual(len(examples), least, heading)
            if heading == "The theory in Python" and not THEORY:
                continue
            with self.subTest(heading=heading):
                self.run_code("\n".join(examples), heading)
        # The function of the page is measured.
        own = self.folder / "my_observables.py"
        own.write_text("\n".join(block for block in blocks(page["Your own measurements"]) if is_python(block)))
        done = self.call("observe", self.folder / "runs" / "demo", own, "--allow-python", own)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("packings of"), 2)
        self.assertTrue((self.folder / "speed.png").is_file())

    def test_the_function_of_the_help_is_that_of_the_page(self):
        shown = self.call("observe", "--help").stdout
        function = next(block for block in blocks(sections(HOWTO / "observe.md")["Your own measurements"]) if is_python(block))
        for line in function.replace('"""', "'''").splitlines():
            self.assertIn(line.strip(), shown)


if __name__ == "__main__":
    unittest.main()
