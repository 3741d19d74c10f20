"""The Debian package on a bare Debian: installed by apt in a new root, used there by a user without rights, and removed.

The root is made by debootstrap from the machine's own archive of Debian, of the release that the machine runs. It has nothing but what
debootstrap's smallest variant puts there, and lives in a mount namespace of its own, so that no mount outlives the test. This takes
about five minutes and one gigabyte of downloads, so that a plain `ctest` leaves it out:

    ctest --preset release -C bare_root -R package.bare_root
"""

import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from trough_program import campaign_text

BUILD, CPACK = (os.environ[f"VIBROTROUGH_{name}"] for name in ("BUILD", "CPACK"))
SKIPPED = 77
NEEDED = ("debootstrap", "unshare", "chroot", "mount")
# What apt, the linker's cache and the fonts' cache write whatever is installed; the archives of packages lie there, too.
KEPT_BY_DEBIAN = ("/var/cache/", "/var/lib/apt/", "/var/lib/dpkg/", "/var/log/", "/home/", "/proc", "/dev", "/tmp/")


class Root:
    """A root made by debootstrap. Every command has the kernel's file systems mounted for itself."""

    def __init__(self, folder):
        self.path = folder
        release = platform.freedesktop_os_release()["VERSION_CODENAME"]
        self.must("debootstrap", "--variant=minbase", release, folder)

    @staticmethod
    def must(*command):
        done = subprocess.run([*map(str, command)], capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(f"{command}: {done.stdout[-3000:]}{done.stderr}")
        return done.stdout

    def call(self, *words, user="root", folder="/"):
        inside = ["chroot", str(self.path), "/usr/bin/env", "--ignore-environment", f"--chdir={folder}",
                  "PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "LANG=C.UTF-8", "DEBIAN_FRONTEND=noninteractive"]  # fmt: skip
        if user != "root":
            inside += ["setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", "env", f"HOME=/home/{user}"]
        mounts = f"mount -t proc proc {self.path}/proc && mount --rbind /dev {self.path}/dev && exec \"$@\""
        return subprocess.run(["unshare", "--mount", "--propagation=private", "sh", "-c", mounts, "sh", *inside, *map(str, words)],
                              capture_output=True, text=True)  # fmt: skip

    def files(self):
        found = set()
        for folder, folders, names in os.walk(self.path):
            inside = "/" + str(Path(folder).relative_to(self.path)).removeprefix(".")
            found |= {os.path.join(inside, name) for name in folders + names}
        return found


class BareRoot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="vibrotrough-root-")
        cls.addClassCleanup(temporary.cleanup)
        folder = Path(temporary.name)
        Root.must(CPACK, "-G", "DEB", "--config", f"{BUILD}/CPackConfig.cmake", "-B", folder / "made")
        cls.root = Root(folder / "root")
        for name in ("vibrotrough", "python3-vibrotrough"):
            [package] = (folder / "made").glob(f"{name}_*.deb")
            shutil.copy(package, cls.root.path / "tmp" / f"{name}.deb")

    def done(self, *words, **settings):
        done = self.root.call(*words, **settings)
        self.assertEqual(done.returncode, 0, f"{words}: {done.stdout[-3000:]}{done.stderr[-3000:]}")
        return done.stdout

    def as_user(self, *words):
        return self.done("vibrotrough", *words, user="engineer", folder="/home/engineer")

    def test_installed_used_and_removed(self):
        self.done("useradd", "--create-home", "engineer")
        before = self.root.files()
        self.done("apt-get", "install", "--yes", "--no-install-recommends", "/tmp/vibrotrough.deb", "/tmp/python3-vibrotrough.deb")
        installed = self.root.files() - before
        self.assertIn("/usr/bin/vibrotrough", installed)
        self.assertIn("/usr/bin/liggghts", installed)

        self.assertIn("LIGGGHTS", self.as_user("--version"))
        self.as_user("init", "pellets")
        self.assertIn("core-hours", self.as_user("check", "pellets.toml"))
        home = self.root.path / "home/engineer"
        (home / "small.toml").write_text(campaign_text({"output.frames_per_cycle": 4}))
        self.as_user("run", "small.toml", "--quiet")
        self.assertEqual([row["outcome"] for row in json.loads(self.as_user("compare", "runs/small", "--json"))], ["finished"])
        self.as_user("report", "runs/small")
        self.assertGreater((home / "runs/small/report/report.html").stat().st_size, 10_000)
        self.as_user("export", "runs/small")
        self.assertTrue(list(home.rglob("*.pvd")) and list(home.rglob("*.vtp")))
        self.assertIn("vibrotrough run", self.as_user("manual"))
        read = "import vibrotrough; print(vibrotrough.open_campaign('runs/small').cases, vibrotrough.theory.solve(throw_number=2, tan_vibration_angle=0.5, friction=0.3).mode)"
        self.assertEqual(self.done("python3", "-c", read, user="engineer", folder="/home/engineer").split(), ["1", "FN'"])

        self.done("apt-get", "purge", "--yes", "vibrotrough", "python3-vibrotrough")
        left = sorted(path for path in self.root.files() if "vibrotrough" in path and not path.startswith(KEPT_BY_DEBIAN))
        self.assertEqual(left, [], "the package leaves nothing of its own")
        self.done("apt-get", "autoremove", "--purge", "--yes")
        left = sorted(path for path in self.root.files() - before if not path.startswith(KEPT_BY_DEBIAN))
        print("left by other packages:", left, flush=True)
        self.assertEqual([path for path in left if "vibrotrough" in path or "liggghts" in path], [])
        self.assertNotIn("vibrotrough", self.done("dpkg-query", "--show"))


if __name__ == "__main__":
    missing = [program for program in NEEDED if not shutil.which(program)]
    if missing or os.geteuid() != 0:
        print(f"this test needs the rights of root and the programs {', '.join(NEEDED)}")
        sys.exit(SKIPPED)
    unittest.main()
