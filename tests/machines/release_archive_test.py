"""The release archive: a .tar.gz that is unpacked anywhere, by anybody, and needs of the machine only glibc. It is made with CPack and
used in two folders, the second after the first was moved, and in a root that has nothing but glibc and the archive."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE, BUILD, CPACK = (os.environ[f"VIBROTROUGH_{name}"] for name in ("SOURCE", "BUILD", "CPACK"))
# What the loader and the C library of the machine have to bring, because it belongs to its kernel.
GLIBC = re.compile(r"ld-linux.*|lib(c|m|mvec|dl|pthread|rt|resolv|util|anl|nsl)\.so\..*|linux-vdso.*")
POINT = ("theory", "point", "--throw-number", "2", "--vibration-angle", "30 deg", "--friction", "0.23")


def call(*command, **settings):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, **settings)


class ReleaseArchive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="vibrotrough-release-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        made = call(CPACK, "-G", "TGZ", "--config", f"{BUILD}/CPackConfig.cmake", "-B", cls.folder / "made", cwd=cls.folder)
        if made.returncode != 0:
            raise AssertionError(made.stdout + made.stderr)
        [cls.archive] = (cls.folder / "made").glob("*.tar.gz")
        cls.first = cls.unpack(cls.folder / "first place")
        cls.second = cls.unpack(cls.folder / "before it was moved").rename(cls.folder / "moved")
        cls.home = cls.folder / "home"
        cls.home.mkdir()

    @classmethod
    def unpack(cls, place):
        place.mkdir()
        subprocess.run(["tar", "--extract", "--file", cls.archive, "--directory", place], check=True)
        [root] = place.iterdir()
        return root

    def use(self, root, *words):
        """The program as somebody with an empty environment uses it."""
        return call(root / "bin/vibrotrough", *words, cwd=self.home, env={"PATH": "/usr/bin:/bin", "HOME": str(self.home)})

    def done(self, root, *words):
        done = self.use(root, *words)
        self.assertEqual(done.returncode, 0, f"{words}: {done.stdout}{done.stderr}")
        return done.stdout

    def test_it_brings_all_libraries_but_glibc(self):
        for root in (self.first, self.second):
            for file in (root / "bin/vibrotrough", *(root / "lib/vibrotrough").iterdir()):
                dynamic = call("readelf", "--dynamic", file).stdout
                needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic))
                brought = {name for name in needed if (root / "lib/vibrotrough" / name).exists()}
                self.assertEqual([name for name in needed - brought if not GLIBC.fullmatch(name)], [], file.name)
            loaded = re.findall(r"=> (/\S.*) \(", call("ldd", root / "bin/vibrotrough").stdout)
            elsewhere = [path for path in loaded if not os.path.realpath(path).startswith(str(root)) and not GLIBC.fullmatch(Path(path).name)]
            self.assertEqual(elsewhere, [], "no library of the machine in place of its own")
            self.assertGreater(len(loaded), 20)

    def test_nothing_points_into_the_folder_it_was_built_in(self):
        for path in self.first.rglob("*"):
            if path.is_file():
                content = path.read_bytes()
                self.assertNotIn(SOURCE.encode(), content, path)
                self.assertNotIn(BUILD.encode(), content, path)

    def test_it_works_in_any_folder(self):
        answers = []
        for root in (self.first, self.second):
            answers.append(self.done(root, *POINT))
            self.done(root, "init", "pellets", "--output", f"{root.name}.toml")
            self.assertIn("core-hours", self.done(root, "plan", f"{root.name}.toml", "--output", f"runs-{root.name}"))
        self.assertIn("velocity efficiency", answers[0])
        self.assertEqual(*answers)

    def test_it_finds_its_scripts_and_its_validation_cases(self):
        """In the second folder through a link, as somebody puts one on the PATH."""
        (self.home / "bin").mkdir()
        (self.home / "bin/vibrotrough").symlink_to(self.second / "bin/vibrotrough")
        for root in (self.first, self.home):
            self.assertIn("theory_exact", self.done(root, "validate", "--list"))
            self.done(root, "validate", "theory_exact", "--points", "20")

    def test_it_says_what_its_libraries_may_be_used_for(self):
        """Debian's packages of all libraries that are brought along have their licence in the archive."""
        licences = {path.stem for path in (self.first / "share/doc/vibrotrough/licences").iterdir()}
        for package in ("libhdf5-103-1", "libnlopt0", "libssl3", "libstdc++6"):
            if Path(f"/usr/share/doc/{package}/copyright").exists() and "bookworm" in Path("/etc/os-release").read_text(encoding="utf-8"):
                self.assertIn(package, licences)
        self.assertGreater(len(licences), 20)

    def test_its_size_and_its_glibc(self):
        """Printed, for the page src/manual/machines.md."""
        files = [path for path in self.first.rglob("*") if path.is_file() and not path.is_symlink()]
        libraries = [path for path in files if path.parent.name == "vibrotrough" and path.parent.parent.name == "lib"]
        versions = set()
        for file in (self.first / "bin/vibrotrough", *libraries):
            versions |= set(re.findall(r"GLIBC_([0-9.]+)", call("objdump", "-T", file).stdout))
        newest = max(versions, key=lambda text: [int(part) for part in text.split(".")])
        print(f"{self.archive.stat().st_size / 1e6:.0f} MB, unpacked {sum(path.stat().st_size for path in files) / 1e6:.0f} MB; {len(libraries)} libraries; glibc {newest} or later", flush=True)
        self.assertLess(self.archive.stat().st_size, 100e6)

    def test_glibc_is_enough(self):
        """In a root with the machine's loader and C library, and nothing else but the archive: no unit database, no locale, no shell."""
        if os.geteuid() != 0:
            self.skipTest("a root of its own needs the rights of root")
        root = self.folder / "root"
        shutil.copytree(self.second, root / "opt/vibrotrough", symlinks=True)
        libraries = {path for path in re.findall(r"(/\S+) \(", call("ldd", self.second / "bin/vibrotrough").stdout) if GLIBC.fullmatch(Path(path).name)}
        self.assertTrue(libraries)
        # Libraries of the archive may need parts of glibc that the program itself does not name.
        libraries |= {str(path) for known in libraries for path in Path(known).parent.glob("lib*.so.*") if GLIBC.fullmatch(path.name)}
        for library in libraries:
            target = Path(str(root) + library)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(library, target)
        (root / "proc").mkdir()
        inside = ["unshare", "--mount", "--propagation=private", "sh", "-c", 'mount --bind /proc "$0/proc" && exec chroot "$0" "$@"', root]
        done = call(*inside, "/opt/vibrotrough/bin/vibrotrough", *POINT, env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin"})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(done.stdout, self.done(self.first, *POINT))

        (root / "opt/vibrotrough/share/vibrotrough/udunits/udunits2.xml").unlink()
        done = call(*inside, "/opt/vibrotrough/bin/vibrotrough", *POINT, env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin"})
        self.assertEqual(done.returncode, 2, "the control: without its units it cannot work there")
        self.assertIn("UDUNITS2_XML_PATH", done.stderr)


if __name__ == "__main__":
    unittest.main()
