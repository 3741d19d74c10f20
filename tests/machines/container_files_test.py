"""The definition file for Apptainer, as far as it can be held to something without Apptainer: it copies all that a build needs, its
commands are those of the Containerfile, and they are sound shell."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["VIBROTROUGH_SOURCE"])
CMAKE = os.environ["VIBROTROUGH_CMAKE"]
DEFINITION = (SOURCE / ".github/vibrotrough.def").read_text(encoding="utf-8")
CONTAINERFILE = (SOURCE / ".github/Containerfile").read_text(encoding="utf-8")


def sections(name):
    """The sections of this name, in the order of the file, without their heading."""
    return re.findall(rf"^%{name}\b.*\n((?:[ \t]+.*\n|\n)*)", DEFINITION, flags=re.MULTILINE)


def commands(text):
    """The commands of a script, however they are chained, without what differs for a reason: where a command is run."""
    parts = re.split(r"&&|\n", text.replace("\\\n", " "))
    words = [" ".join(part.split()) for part in parts]
    return [line for line in words if line and not line.startswith(("cd ", "rm -rf build"))]


class Definition(unittest.TestCase):
    def test_its_commands_are_those_of_the_containerfile(self):
        run = [commands(script) for script in re.findall(r"^RUN ((?:.*\\\n)*.*)", CONTAINERFILE, flags=re.MULTILINE)]
        stages = [run[0] + run[1], run[2]]  # the layers of a stage; the fourth makes a folder for certificates
        self.assertEqual([commands(script) for script in sections("post")], stages)
        self.assertEqual(re.findall(r"^From: (\S+)", DEFINITION, flags=re.MULTILINE), re.findall(r"^FROM (\S+)", CONTAINERFILE, flags=re.MULTILINE))

    def test_its_scripts_are_sound_shell(self):
        for name in ("post", "environment", "runscript", "test"):
            self.assertTrue(sections(name), name)
            for script in sections(name):
                self.assertEqual(subprocess.run(["sh", "-n", "-e"], input=script, text=True, capture_output=True).stderr, "")

    def test_a_build_needs_no_more_than_it_copies(self):
        with tempfile.TemporaryDirectory(prefix="vibrotrough-container-") as folder:
            for line in sections("files")[0].strip().splitlines():
                origin, target = line.split()
                self.assertEqual(target, f"/source/{origin}")
                if origin == ".git":
                    continue
                copy = shutil.copytree if (SOURCE / origin).is_dir() else shutil.copy
                Path(folder, "source").mkdir(exist_ok=True)
                copy(SOURCE / origin, Path(folder, "source", origin))
            done = subprocess.run([CMAKE, "-G", "Ninja", "-S", f"{folder}/source", "-B", f"{folder}/build", "-DBUILD_TESTING=OFF"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            # Everything that Ninja must have before it begins is there, and so is what is installed.
            done = subprocess.run(["ninja", "-C", f"{folder}/build", "-n"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            installed = "".join(path.read_text(encoding="utf-8") for path in Path(folder, "build").rglob("cmake_install.cmake"))
            named = {Path(path) for path in re.findall(rf'"({re.escape(folder)}/source/[^"]*)"', installed)}
            self.assertTrue(named)
            self.assertEqual([str(path) for path in named if not path.exists()], [])


if __name__ == "__main__":
    unittest.main()
