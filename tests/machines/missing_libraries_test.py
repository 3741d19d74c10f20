"""What CMake says when libraries are missing, and that the table of libraries agrees with what the rooms look for, with ./setup, and
with the page."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["VIBROTROUGH_SOURCE"])
CMAKE = os.environ["VIBROTROUGH_CMAKE"]
TABLE = SOURCE / "src/dependencies.txt"
COLUMNS = ("name", "how", "purpose", "debian", "fedora", "conda", "spack")
# What comes with the compiler.
NOT_A_PACKAGE = {"Threads"}


def rows():
    lines = [line for line in TABLE.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    return [dict(zip(COLUMNS, (field.strip() for field in line.split("|")), strict=True)) for line in lines]


def debian(*purposes):
    return {package for row in rows() if row["purpose"] in purposes for package in row["debian"].split()}


class Configured(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="vibrotrough-configure-")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def configure(self, *options):
        """Standard output and error of a first configuration with these options, and its exit code."""
        done = subprocess.run([CMAKE, "-G", "Ninja", "-S", SOURCE, "-B", self.folder / "build", *options], capture_output=True, text=True)
        return done.stdout + done.stderr, done.returncode

    def without(self, *names):
        return [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in names]


class Missing(Configured):
    def test_all_that_is_missing_is_named_at_once(self):
        said, code = self.configure(*self.without("tomlplusplus", "NLopt", "GTest"))
        self.assertNotEqual(code, 0)
        self.assertEqual(said.count("CMake Error"), 1, said)
        for name in ("toml++ (package tomlplusplus)", "NLopt (package NLopt)", "GoogleTest (package GTest)"):
            self.assertIn(name, said)
        for command in ("apt-get install libnlopt-cxx-dev libtomlplusplus-dev libgtest-dev libgmock-dev", "dnf install NLopt-devel tomlplusplus-devel gtest-devel gmock-devel",
                        "conda install -c conda-forge nlopt tomlplusplus gtest", "spack install nlopt tomlplusplus googletest"):  # fmt: skip
            self.assertIn(command, said)
        self.assertNotIn("libfmt-dev", said, "what is there is not asked for")
        self.assertIn("-DBUILD_TESTING=OFF", said)

    def test_headers_and_libraries_without_a_package_of_cmake_are_named_too(self):
        said, code = self.configure("-DBUILD_TESTING=OFF", "-DCMAKE_IGNORE_PATH=/usr/include")
        self.assertNotEqual(code, 0)
        for name in ("Mustache for C++ (header kainjow/mustache.hpp", "UDUNITS-2 (header udunits2.h"):
            self.assertIn(name, said)
        self.assertIn("conda-forge has no package that we know of Mustache for C++.", said)

    def test_vtk_can_be_done_without(self):
        said, code = self.configure("-DBUILD_TESTING=OFF", *self.without("VTK"))
        self.assertNotEqual(code, 0)
        self.assertIn("-DVIBROTROUGH_VIEW=OFF", said)
        # What it says holds with the tests, too.
        said, code = self.configure("-DBUILD_TESTING=ON", "-DVIBROTROUGH_VIEW=OFF", *self.without("VTK"))
        self.assertEqual(code, 0, said)
        self.assertNotIn("libvtk", (self.folder / "build/build.ninja").read_text(encoding="utf-8"))
        tests = (self.folder / "build/tests/CTestTestfile.cmake").read_text(encoding="utf-8")
        self.assertNotIn('"view"', tests)
        self.assertIn('"compare"', tests)

    def test_a_boost_that_is_too_new_is_named(self):
        fake = self.folder / "fake/lib/cmake/Boost-1.90.0"
        fake.mkdir(parents=True)
        (fake / "BoostConfig.cmake").write_text("set(Boost_FOUND TRUE)\nset(Boost_filesystem_FOUND TRUE)\nset(Boost_VERSION 1.90.0)\n")
        (fake / "BoostConfigVersion.cmake").write_text("set(PACKAGE_VERSION 1.90.0)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
        said, code = self.configure("-DBUILD_TESTING=OFF", f"-DBoost_DIR={fake}")
        self.assertNotEqual(code, 0)
        self.assertIn("1.90.0 found, but a version from 1.74 to 1.87 is needed", said)


class Table(unittest.TestCase):
    def test_it_has_all_that_the_rooms_look_for(self):
        known = {}
        for row in rows():
            kind, subject, *rest = row["how"].split()
            known[subject] = (kind, rest, row["purpose"])
        looked_for = 0
        for path in (SOURCE / "src").rglob("CMakeLists.txt"):
            for kind, words in re.findall(r"^\s*find_(package|path|library)\((.*)\)", path.read_text(encoding="utf-8"), flags=re.MULTILINE):
                words = [word for word in words.split() if word != "REQUIRED"]
                subject, rest = (words[0], words[1:]) if kind == "package" else (words[1], words[:1])
                if subject in NOT_A_PACKAGE:
                    continue
                looked_for += 1
                self.assertIn(subject, known, path)
                self.assertLessEqual(set(rest), set(known[subject][1]), f"{path}: {subject}")
        self.assertGreater(looked_for, 20)

    def test_setup_installs_what_it_names_on_debian(self):
        def listed(command):
            return set(subprocess.run([SOURCE / "setup", "packages", command], capture_output=True, text=True, check=True).stdout.split())

        self.assertLessEqual(debian("program", "view"), listed("build"))
        self.assertLessEqual(debian("program", "view", "Python", "tests"), listed("test"))
        self.assertLessEqual(debian("Python"), listed("build"))
        libraries = {package for package in listed("build") if package.endswith("-dev")}
        self.assertEqual(libraries - debian("program", "view", "Python"), set(), "a library of ./setup that the table does not have")

    def test_the_table_has_all_libraries(self):
        table = subprocess.run([CMAKE, "-P", SOURCE / "src/dependencies.cmake"], capture_output=True, text=True, check=True).stdout
        for row in rows():
            self.assertIn(f"| {row['name']} |", table)


if __name__ == "__main__":
    unittest.main()
