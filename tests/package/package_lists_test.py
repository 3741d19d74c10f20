"""What ./setup installs on a bare machine, according to apt: nothing is installed here, apt only resolves the lists against an empty
list of installed packages."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SETUP = Path(os.environ["VIBROTROUGH_SOURCE"]) / "setup"
SKIPPED = 77
ENGINE = re.compile(r"liggghts$")
# What only tests need, and nobody who wants a first table should have on the machine: services, a second compiler, a browser.
ONLY_FOR_TESTS = re.compile(r"slurm|mariadb-server|mysql-server|munge$|clang|llvm-\d+$|faketime|valgrind|doxygen|chromium|firefox|emscripten|paraview$|xvfb|googletest|libgtest")


def installed_for(command):
    """The packages that a bare machine gets from `./setup COMMAND`, and those that its list names."""
    wanted = subprocess.run([SETUP, "packages", command], capture_output=True, text=True, check=True).stdout.split()
    with tempfile.NamedTemporaryFile(prefix="vibrotrough-status-") as bare:
        done = subprocess.run(["apt-get", "--simulate", "--option", f"Dir::State::status={bare.name}", "install", "--no-install-recommends", *wanted],
                              capture_output=True, text=True, env=os.environ | {"LC_ALL": "C"})
    if done.returncode != 0:
        raise AssertionError(done.stdout[-2000:] + done.stderr)
    return set(re.findall(r"^Inst (\S+)", done.stdout, flags=re.MULTILINE)), set(wanted)


class PackageLists(unittest.TestCase):
    def test_build_and_demo_install_nothing_that_only_tests_need(self):
        for command in ("build", "demo"):
            installed, wanted = installed_for(command)
            print(f"{command}: {len(wanted)} packages are asked for, {len(installed)} installed on a bare machine", flush=True)
            self.assertLessEqual(wanted, installed)
            self.assertEqual([one for one in sorted(installed) if ONLY_FOR_TESTS.match(one)], [], command)
            self.assertEqual(any(map(ENGINE.match, installed)), command == "demo")

    def test_the_list_of_the_tests_is_told_apart(self):
        """The negative control: all that the other lists must not have is found in this one."""
        installed, wanted = installed_for("all")
        self.assertLessEqual(wanted, installed)
        found = [one for one in installed if ONLY_FOR_TESTS.match(one)]
        for service in ("slurmctld", "mariadb-server-core", "munge", "faketime", "valgrind", "emscripten", "firefox-esr"):
            self.assertTrue(any(one.startswith(service) for one in found), service)


if __name__ == "__main__":
    # Packages may be known to dpkg only, when the lists of apt were removed as in a small container.
    if not shutil.which("apt-get") or subprocess.run(["apt-cache", "show", "liggghts"], capture_output=True).returncode != 0:
        print("apt does not know the package liggghts; run 'apt-get update' first")
        sys.exit(SKIPPED)
    unittest.main()
