"""A build by a user without rights, who has some of the libraries only in a folder of his own.

Debian's packages of toml++, CLI11, nlohmann-json and NLopt are downloaded and unpacked by that user; those of the machine are hidden in
a mount namespace. The program and the tests of the theory are built, run, and installed in the user's folder. Takes minutes:

    ctest --preset release -C without_root -R machines.without_root
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE = Path(os.environ["VIBROTROUGH_SOURCE"])
CMAKE = os.environ["VIBROTROUGH_CMAKE"]
SKIPPED = 77
NOBODY = 65534
PACKAGES = ("libtomlplusplus-dev", "libtomlplusplus3", "libcli11-dev", "nlohmann-json3-dev", "libnlopt-dev", "libnlopt-cxx-dev", "libnlopt0", "libnlopt-cxx0")
OWN_FOLDERS = {"toml++", "CLI", "CLI11", "nlohmann", "nlohmann_json", "nlopt", "nlopt_cxx", "tomlplusplus"}
POINT = ("theory", "point", "--throw-number", "2", "--vibration-angle", "30 deg", "--friction", "0.23")


def hidden():
    """What of these packages the machine has: the folders that are theirs alone, and the other files."""
    listed = subprocess.run(["dpkg", "--listfiles", *PACKAGES], capture_output=True, text=True, check=True).stdout.split("\n")
    paths = [Path(line) for line in listed if line.startswith("/usr/") and "/doc/" not in line]
    folders = {path for path in paths if path.is_dir() and path.name in OWN_FOLDERS}
    files = {path.resolve() for path in paths if path.is_file() and not folders & set(path.parents)}
    return sorted(folders), sorted(path for path in files if re.search(r"/include/|\.so|\.a$|\.cmake$", str(path)))


class WithoutRoot(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="vibrotrough-user-")
        self.addCleanup(temporary.cleanup)
        self.home = Path(temporary.name)
        self.sources = self.home / "vibrotrough"
        for name in subprocess.run(["git", "-C", SOURCE, "ls-files", "-z"], capture_output=True, text=True, check=True).stdout.split("\0")[:-1]:
            if (SOURCE / name).is_file():
                (self.sources / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(SOURCE / name, self.sources / name)
        subprocess.run(["chown", "--recursive", f"{NOBODY}:{NOBODY}", self.home], check=True)
        folders, files = hidden()
        self.assertTrue(folders and files)
        self.hide = [f"mount -t tmpfs hidden '{path}' && rmdir '{path}'/* 2>/dev/null" for path in folders] + [f"mount --bind /dev/null '{path}'" for path in files]

    def user(self, *words, folder=None):
        """What the command says and its exit code: run by a user without rights, on a machine that has none of the packages."""
        script = "; ".join(self.hide) + f'; exec setpriv --reuid={NOBODY} --regid={NOBODY} --clear-groups "$@"'
        done = subprocess.run(["unshare", "--mount", "--propagation=private", "sh", "-c", script, "sh", *map(str, words)], cwd=folder or self.home, capture_output=True, text=True,
                              env={"PATH": "/usr/bin:/bin", "HOME": str(self.home), "LC_ALL": "C.UTF-8"})  # fmt: skip
        return done.stdout + done.stderr, done.returncode

    def must(self, *words, **settings):
        begin = time.monotonic()
        said, code = self.user(*words, **settings)
        self.assertEqual(code, 0, f"{words}: {said[-4000:]}")
        print(f"{time.monotonic() - begin:7.1f} s  {' '.join(map(str, words))[:110]}", flush=True)
        return said

    def test_built_in_a_prefix_of_the_user(self):
        options = ["-G", "Ninja", "-S", self.sources, "-B", "build", "-DVIBROTROUGH_VIEW=OFF", "-DCMAKE_INSTALL_RPATH_USE_LINK_PATH=ON"]
        said, code = self.user(CMAKE, *options)
        self.assertNotEqual(code, 0)
        for name in ("toml++", "CLI11", "JSON for Modern C++", "NLopt"):
            self.assertIn(f"  {name} (package ", said, "the control: what is hidden is missing, and named at once")
        shutil.rmtree(self.home / "build")

        self.must("apt-get", "download", *PACKAGES)
        prefix = self.home / "prefix"
        for package in self.home.glob("*.deb"):
            self.must("dpkg-deb", "--extract", package, prefix)
        self.must(CMAKE, *options, f"-DCMAKE_PREFIX_PATH={prefix}/usr")
        self.must(CMAKE, "--build", "build", "--parallel", "2", "--target", "vibrotrough", "theory_tests")
        self.must("build/tests/theory/theory_tests", "--gtest_brief=1")
        self.must(CMAKE, "--install", "build", "--component", "program", "--prefix", self.home / ".local")
        program = self.home / ".local/bin/vibrotrough"
        answer = self.must(program, *POINT)
        self.assertIn("velocity efficiency", answer)
        self.assertIn("no VTK", self.must(program, "--version"))
        self.assertIn(f"{prefix}/usr/lib", self.must("ldd", program), "NLopt is the user's")


if __name__ == "__main__":
    missing = [program for program in ("unshare", "setpriv", "apt-get", "dpkg-deb") if not shutil.which(program)]
    if missing or os.geteuid() != 0:
        print("this test needs the rights of root, to hide the machine's libraries from the user, and Debian's programs")
        sys.exit(SKIPPED)
    unittest.main()
