"""The package as a user gets it: made with CPack, unpacked in another folder and used there, not from the build tree.

It is unpacked and not installed, because that would change the machine. Programs of Debian read what belongs to it: dpkg-deb the
package, groff the manual page, bash the completion.
"""

import gzip
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from trough_program import campaign_text

SOURCE, BUILD, CPACK, CMAKE = (os.environ[f"VIBROTROUGH_{name}"] for name in ("SOURCE", "BUILD", "CPACK", "CMAKE"))


def call(*command, **settings):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, **settings)


class Unpacked(unittest.TestCase):
    """The package, made and unpacked once for all tests."""

    folder = None

    @classmethod
    def setUpClass(cls):
        if Unpacked.folder is None:
            temporary = tempfile.TemporaryDirectory(prefix="vibrotrough-package-")
            unittest.addModuleCleanup(temporary.cleanup)
            Unpacked.folder = Path(temporary.name)
            Unpacked.make()

    @classmethod
    def make(cls):
        cls.folder.chmod(0o755)
        made = call(CPACK, "-G", "DEB", "--config", f"{BUILD}/CPackConfig.cmake", "-B", cls.folder / "made", cwd=cls.folder)
        if made.returncode != 0:
            raise AssertionError(made.stdout + made.stderr)
        [cls.package] = (cls.folder / "made").glob("vibrotrough_*.deb")
        [cls.module] = (cls.folder / "made").glob("python3-vibrotrough_*.deb")
        [cls.library] = (cls.folder / "made").glob("libvibrotrough-theory-dev_*.deb")
        assert len(list((cls.folder / "made").glob("*.deb"))) == 3
        cls.root, cls.module_root, cls.library_root = (cls.folder / name for name in ("root", "module-root", "library-root"))
        subprocess.run(["dpkg-deb", "--extract", cls.package, cls.root], check=True)
        subprocess.run(["dpkg-deb", "--extract", cls.module, cls.module_root], check=True)
        subprocess.run(["dpkg-deb", "--extract", cls.library, cls.library_root], check=True)
        cls.program = cls.root / "usr/bin/vibrotrough"


class Package(Unpacked):
    def field(self, name, package=None):
        return call("dpkg-deb", "--field", package or self.package, name).stdout.strip()

    def test_it_names_what_it_needs(self):
        self.assertEqual(self.field("Package"), "vibrotrough")
        needed = self.field("Depends")
        for name in ("liggghts", "python3-numpy", "python3-h5py", "python3-matplotlib", "python3-jinja2", "libudunits2", "libhdf5", "libc6"):
            self.assertIn(name, needed)
        self.assertEqual("libvtk9" in needed, "no VTK" not in call(self.program, "--version").stdout)
        for name in ("-dev", "slurm", "clang", "gtest"):
            self.assertNotIn(name, needed)

    def test_the_libraries_of_all_programs_were_asked_for(self):
        # src/app/release_archive.cmake names the programs whose libraries the package needs.
        programs = {path.name.split(".")[0] for root in (self.root, self.module_root) for path in root.rglob("*")
                    if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"}  # fmt: skip
        self.assertLessEqual(programs, {"vibrotrough", "vibrotrough-with-vtk", "_theory"})
        self.assertIn("libstdc++6", self.field("Depends", self.module))

    def test_nothing_points_into_the_folder_it_was_built_in(self):
        for path in [*self.root.rglob("*"), *self.module_root.rglob("*")]:
            if path.is_file():
                content = path.read_bytes()
                self.assertFalse(SOURCE.encode() in content, path)
                self.assertFalse(BUILD.encode() in content, path)

    def test_the_module_is_a_package_of_its_own(self):
        """It needs neither the program nor the libraries of the program, and the two have no file in common, so that both can be installed."""
        self.assertEqual(self.field("Package", self.module), "python3-vibrotrough")
        self.assertIn("python3-vibrotrough", self.field("Recommends"))
        needed = self.field("Depends", self.module)
        for name in ("python3", "python3-numpy", "python3-h5py"):
            self.assertIn(name, needed)
        for name in ("liggghts", "libvtk", "libhdf5-", "matplotlib", "-dev"):
            self.assertNotIn(name, needed)
        files = [{str(path.relative_to(root)) for path in root.rglob("*") if path.is_file()} for root in (self.root, self.module_root)]
        self.assertEqual(files[0] & files[1], set())
        own = ("usr/lib/python3/dist-packages/vibrotrough/", "usr/share/doc/python3-vibrotrough/")
        self.assertEqual([path for path in files[1] if not path.startswith(own)], [])

    def test_another_program_finds_the_theory(self):
        """As find_package(vibrotrough-theory) does, with the library's package alone."""
        built = self.folder / "consumer"
        for command in ((CMAKE, "-S", f"{SOURCE}/tests/theory_package/consumer", "-B", built, f"-DCMAKE_PREFIX_PATH={self.library_root}/usr"),
                        (CMAKE, "--build", built)):
            done = call(*command)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_python_finds_the_module(self):
        modules = self.module_root / "usr/lib/python3/dist-packages"
        solved = "vibrotrough.theory.solve(throw_number=2, tan_vibration_angle=0.5, friction=0.3).mode"
        done = call("/usr/bin/python3", "-B", "-c", f"import vibrotrough; print(vibrotrough.__file__, vibrotrough.open_campaign.__name__, {solved})",
                    cwd="/", env={"PATH": "/usr/bin:/bin", "PYTHONPATH": str(modules)})  # fmt: skip
        self.assertEqual(done.stdout.split(), [f"{modules}/vibrotrough/__init__.py", "open_campaign", "FN'"], done.stderr)

    def test_the_page_for_browsers(self):
        """Where the package has the page, the program writes it; without it, one line says what to install."""
        installed = self.root / "usr/share/vibrotrough/postprocess/page.html"
        page = self.folder / "page.html"
        if installed.is_file():
            done = call(self.program, "page", "--output", page)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(page.read_bytes(), installed.read_bytes())
            self.assertLess(page.stat().st_size, 3_000_000)
            installed.unlink()
        done = call(self.program, "page", "--output", page)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1))
        self.assertIn("./setup page", done.stderr)

    def test_the_manual_page_is_sound_and_complete(self):
        page = self.folder / "vibrotrough.1"
        page.write_bytes(gzip.decompress((self.root / "usr/share/man/man1/vibrotrough.1.gz").read_bytes()))
        shown = call("groff", "-man", "-ww", "-Tutf8", "-P-cbou", "-rLL=100n", page)
        self.assertEqual((shown.returncode, shown.stderr), (0, ""))
        for words in ("vibrotrough tutorial depth", "compare", "--version", "Exit codes"):
            self.assertIn(words, shown.stdout.replace("\u2010", "-").replace("\u2212", "-"))

    def complete(self, *words):
        """What bash offers for the last of the words."""
        script = self.root / "usr/share/bash-completion/completions/vibrotrough"
        done = call("bash", "-c", 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _vibrotrough; printf "%s\\n" "${COMPREPLY[@]}"',
                    "bash", script, "vibrotrough", *words)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split()

    def test_bash_completes_commands_and_options(self):
        self.assertIn("compare", self.complete("com"))
        self.assertEqual(self.complete("theory", "po"), ["point"])
        self.assertEqual(self.complete("theory", "point", "--throw"), ["--throw-number"])
        self.assertIn("--jobs", self.complete("run", "campaign.toml", "--"))
        self.assertEqual(self.complete("run", "campaign.tom"), [], "file names are left to bash")

    def test_version_names_libraries_and_engine(self):
        lines = call(self.program, "--version").stdout.splitlines()
        self.assertRegex(lines[0], r"^vibrotrough [0-9.]+ \([0-9a-f]+(-dirty)?\)$")
        self.assertIn("HDF5 ", lines[2])
        self.assertIn("VTK ", lines[2])
        self.assertIn("LIGGGHTS", lines[3])

    def test_what_to_cite(self):
        self.assertIn("Powder Technology 87 (1996) 203-210", call(self.program, "cite").stdout)
        self.assertEqual(call(self.program, "cite", "--bibtex").stdout.count("@"), 4)


class Campaign(Unpacked):
    """A campaign from its simulation to its report: as a user without rights, in a folder of his own, with nothing of the sources at
    hand."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.home = cls.folder / "home"
        cls.home.mkdir()
        cls.user = {}
        if os.geteuid() == 0:
            os.chown(cls.home, 65534, 65534)
            cls.user = {"user": 65534, "group": 65534, "extra_groups": []}
        (cls.folder / "campaign.toml").write_text(campaign_text({"output.frames_per_cycle": 4}))
        cls.simulated = cls.run_as_user("run", cls.folder / "campaign.toml", "--output", "runs", "--quiet")

    @classmethod
    def run_as_user(cls, *words):
        return call(cls.program, *words, cwd=cls.home, **cls.user,
                    env={"PATH": "/usr/bin:/bin", "HOME": str(cls.home), "TMPDIR": str(cls.home)})  # fmt: skip

    def assert_done(self, done):
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_it_is_simulated_and_compared(self):
        self.assert_done(self.simulated)
        done = self.run_as_user("compare", "runs", "--json")
        self.assert_done(done)
        self.assertEqual([row["outcome"] for row in json.loads(done.stdout)], ["finished"])

    def test_it_is_reported(self):
        self.assert_done(self.run_as_user("report", "runs"))
        self.assertTrue((self.home / "runs/report/report.html").is_file())

    @unittest.skipIf("no VTK" in call(os.environ["VIBROTROUGH_PROGRAM"], "--version").stdout, "this program was built without VTK")
    def test_it_is_exported(self):
        self.assert_done(self.run_as_user("export", "runs"))
        self.assertTrue(list((self.home / "runs").rglob("*.pvd")))

    def test_the_theory_is_validated(self):
        self.assert_done(self.run_as_user("validate", "theory_shake_test"))


class Sources(unittest.TestCase):
    def test_the_tarball_holds_the_sources_and_nothing_made_from_them(self):
        with tempfile.TemporaryDirectory(prefix="vibrotrough-sources-") as folder:
            made = call(CPACK, "--config", f"{BUILD}/CPackSourceConfig.cmake", "-B", folder, cwd=folder)
            self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
            [tarball] = Path(folder).glob("*.tar.gz")
            names = call("tar", "--list", "--file", tarball).stdout.splitlines()
            inside = {name.partition("/")[2] for name in names}
            missing = {"README.md", "LICENSE", "setup", "CMakeLists.txt", "src/app/main.cpp"} - inside
            self.assertEqual(missing, set())
            self.assertEqual([name for name in inside if name.startswith(("build/", "runs/", ".git/"))], [])


if __name__ == "__main__":
    unittest.main()
