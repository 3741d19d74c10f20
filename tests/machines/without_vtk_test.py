"""The program without VTK, as a login node of a cluster may have it: what writes files for ParaView says so in one line, and all else
works. The commands are those of the program, linked with the room view that has no VTK."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAMS = {"with": os.environ["VIBROTROUGH_PROGRAM"], "without": os.environ["VIBROTROUGH_WITHOUT_VTK"]}
BUILT_WITHOUT = "this program was built without VTK"
MAP = ("theory", "map", "--x", "throw_number=0.3:3.3:20", "--y", "vibration_angle_deg=5:60:10", "--friction", "0.35", "--output", "map.h5")


class WithoutVtk(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="vibrotrough-without-vtk-")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def call(self, *words, which="without"):
        return subprocess.run([PROGRAMS[which], *words], cwd=self.folder, capture_output=True, text=True)

    def files(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def test_it_loads_no_vtk(self):
        libraries = subprocess.run(["ldd", PROGRAMS["without"]], capture_output=True, text=True, check=True).stdout
        self.assertIn("libhdf5", libraries)
        self.assertNotIn("vtk", libraries.lower())

    def test_export_says_so_in_one_line_and_writes_nothing(self):
        (self.folder / "campaign.toml").write_text("", encoding="utf-8")
        for words in (["export", "."], ["export", "gone"]):
            done = self.call(*words)
            self.assertEqual((done.returncode, done.stdout), (3, ""), words)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(BUILT_WITHOUT, done.stderr)
            self.assertIn("-DVIBROTROUGH_VIEW=ON", done.stderr)
        self.assertEqual(self.files(), ["campaign.toml"])

    def test_a_map_is_written_without_the_files_for_paraview(self):
        done = self.call(*MAP)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for words in ("map.vti", "map_modes.vtp", BUILT_WITHOUT):
            self.assertIn(words, done.stderr)
        self.assertNotIn("map.vti", done.stdout)
        self.assertEqual(self.files(), ["map.h5"])

    def test_a_map_of_a_rolling_layer_too(self):
        done = self.call(*MAP, "--rolling-layer")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.files(), ["map.h5"])

    def test_version_and_help_say_so(self):
        self.assertIn("no VTK", self.call("--version").stdout.splitlines()[2])
        for words in (["export"], ["theory", "map"]):
            said = " ".join(self.call(*words, "--help").stdout.split())
            self.assertIn("This program was built without VTK", said)
        self.assertIn("not in this program, which was built without VTK", " ".join(self.call("--help").stdout.split()))

    def test_the_rest_works(self):
        self.assertEqual(self.call("theory", "point", "--throw-number", "2", "--tan-vibration-angle", "0.5", "--friction", "0.23").returncode, 0)
        self.assertEqual(self.call("init", "pellets").returncode, 0)
        self.assertEqual(self.call("plan", "pellets.toml").returncode, 0)


class Control(WithoutVtk):
    """The program with VTK says none of this, so that the tests above can fail."""

    def setUp(self):
        super().setUp()
        if "no VTK" in self.call("--version", which="with").stdout:
            self.skipTest("this build has no VTK")

    def call(self, *words, which="with"):
        return super().call(*words, which=which)

    def test_it_loads_no_vtk(self):
        """Only its second part does, which few commands need: to load VTK takes longer than most commands."""
        for part, loads in (("", False), ("-with-vtk", True)):
            libraries = subprocess.run(["ldd", PROGRAMS["with"] + part], capture_output=True, text=True, check=True).stdout
            self.assertEqual("libvtk" in libraries, loads, part)

    def test_without_its_second_part_it_says_so_and_starts_none_of_another_folder(self):
        alone = self.folder / "alone"
        alone.mkdir()
        shutil.copy(PROGRAMS["with"], alone)
        foreign = self.folder / "vibrotrough-with-vtk"
        foreign.write_text("#!/bin/sh\ntouch started\n", encoding="utf-8")
        foreign.chmod(0o755)
        for words in (["export", "gone"], [*MAP]):
            done = subprocess.run([alone / "vibrotrough", *words], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (3, ""), words)
            self.assertRegex(done.stderr, r"^vibrotrough: cannot start \S+/alone/vibrotrough-with-vtk, .*; install Vibrotrough again\n$")
        for words in (["--version"], ["--help"], ["manual"], ["init", "pellets"]):
            self.assertEqual(subprocess.run([alone / "vibrotrough", *words], cwd=self.folder, capture_output=True).returncode, 0, words)
        self.assertFalse((self.folder / "started").exists())

    def test_export_says_so_in_one_line_and_writes_nothing(self):
        done = self.call("export", "gone")
        self.assertNotIn(BUILT_WITHOUT, done.stderr)

    def test_a_map_is_written_without_the_files_for_paraview(self):
        done = self.call(*MAP)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.files(), ["map.h5", "map.vti", "map_modes.vtp"])

    def test_a_map_of_a_rolling_layer_too(self):
        """The files are those of the test above."""

    def test_version_and_help_say_so(self):
        self.assertRegex(self.call("--version").stdout.splitlines()[2], r"VTK [0-9]")
        self.assertNotIn("without VTK", self.call("export", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
