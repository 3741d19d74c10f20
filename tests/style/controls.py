"""Negative controls of style.py: each check reports a violation that was put into a copy of a small project.

usage: controls.py PROJECT
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(sys.argv[1])
SETTINGS = (".clang-format", ".clang-tidy", ".codespellrc", ".mypy.ini")
GOOD_SOURCE = "int twice(int number) {\n    return 2 * number;\n}\n"
GOOD_SCRIPT = '"""A script."""\n\n\ndef twice(number: int) -> int:\n    return 2 * number\n'
SKIPPED = 77


class Controls(unittest.TestCase):
    def setUp(self) -> None:
        self.temporary = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.temporary.name)
        for name in SETTINGS:
            shutil.copy(PROJECT / name, self.root)
        self.write("setup", "#!/bin/bash\n")
        self.write("src/core/good.cpp", GOOD_SOURCE)
        self.write("postprocess/good.py", GOOD_SCRIPT)

    def tearDown(self) -> None:
        self.temporary.cleanup()

    def write(self, name: str, text: str) -> None:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def check(self, name: str, *arguments: str) -> tuple[int, str]:
        command = [sys.executable, "-B", str(PROJECT / "tests/style/style.py"), name, str(self.root), *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode == SKIPPED:
            self.skipTest(done.stdout)
        return done.returncode, done.stdout

    def assert_reported(self, name: str, file: str, text: str, told: str, *arguments: str) -> None:
        """The check accepts the project without `file`, and with it says what is wrong."""
        code, output = self.check(name, *arguments)
        self.assertEqual(code, 0, output)
        self.write(file, text)
        code, output = self.check(name, *arguments)
        self.assertEqual(code, 1, output)
        self.assertIn(told, output)

    def test_a_file_that_is_not_formatted(self) -> None:
        self.assert_reported("format", "src/core/bad.cpp", GOOD_SOURCE.replace("    return", "  return"), "src/core/bad.cpp:1")

    def test_a_name_in_another_case(self) -> None:
        good, bad = self.root / "src/core/good.cpp", self.root / "src/core/bad.cpp"
        commands = [{"directory": str(self.root), "command": f"c++ -std=c++20 -c {path}", "file": str(path)} for path in (good, bad)]
        self.write("compile_commands.json", json.dumps(commands))
        self.assert_reported("tidy", "src/core/bad.cpp", GOOD_SOURCE.replace("twice", "Twice"), "readability-identifier-naming",
                             str(self.root), "core")

    def test_a_name_in_another_case_in_a_batch(self) -> None:
        sources = [self.root / "src/core/good.cpp", self.root / "src/core/bad.cpp"]
        self.write("src/core/bad.cpp", "")
        self.write("Unity/unity_0_cxx.cxx", "".join(f'#include "{path}"\n' for path in sources))
        batch = self.root / "Unity/unity_0_cxx.cxx"
        self.write("compile_commands.json", json.dumps([{"directory": str(self.root), "command": f"c++ -std=c++20 -c {batch}", "file": str(batch)}]))
        self.assert_reported("tidy", "src/core/bad.cpp", "int Thrice(int number) {\n    return 3 * number;\n}\n",
                             "readability-identifier-naming", str(self.root), "core")

    def test_a_file_that_is_not_compiled(self) -> None:
        good = self.root / "src/core/good.cpp"
        self.write("compile_commands.json", json.dumps([{"directory": str(self.root), "command": f"c++ -std=c++20 -c {good}", "file": str(good)}]))
        self.assert_reported("tidy", "src/core/bad.cpp", "int left_out = 1;\n", "src/core/bad.cpp is not compiled", str(self.root), "core")

    def test_a_misspelt_word(self) -> None:
        word = "recie" + "ve"  # put together here, because this file is checked, too
        self.assert_reported("spelling", "README.md", f"The machines {word} grains.\n", word)

    def test_an_unused_import(self) -> None:
        self.assert_reported("lint", "postprocess/bad.py", "import os\n", "imported but unused")

    def test_a_function_without_types(self) -> None:
        self.assert_reported("types", "postprocess/bad.py", "def twice(number):\n    return 2 * number\n", "postprocess/bad.py:1",
                             str(self.root / "cache"))

    def test_a_long_file(self) -> None:
        self.assert_reported("length", "src/core/bad.cpp", "//\n" * 401, "401 lines")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
