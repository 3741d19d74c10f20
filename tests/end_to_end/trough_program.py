"""What the end-to-end tests share: the program as a person runs it, small campaigns, and a look at the machine's processes.

The program under test is named by the environment variable VIBROTROUGH_PROGRAM; LIGGGHTS is the one on the PATH.
"""

import json
import os
import shutil
import signal
import stat
import subprocess
import tempfile
import time
import tomllib
import unittest
import zipfile
from pathlib import Path
from typing import ClassVar

PROGRAM = os.environ["VIBROTROUGH_PROGRAM"]

# A machine may be slow and busy: this is how long one step of a test may take before it counts as hanging, s.
PATIENCE = int(os.environ.get("VIBROTROUGH_PATIENCE", "600"))

# The nightly tests NAME.whole try all combinations of what a test names; with every commit it is a sample of them.
WHOLE = os.environ.get("VIBROTROUGH_TEST_WHOLE") == "1"


def sample(combinations, one_of):
    """One of so many combinations; all of them at night. Let `one_of` have no factor in common with the lengths of the lists that
    are combined: then each of their entries appears."""
    return list(combinations)[:: 1 if WHOLE else one_of]


at_night = unittest.skipUnless(WHOLE, "only at night")

# 60 soft grains in the smallest box that the program allows (four of the largest diameters, rounded up): about half a
# second per packing.
SMALL = {
    "campaign": {"name": "small"},
    "trough": {
        "inclination": "0 deg",
        "tan_vibration_angle": 0.5,
        "amplitude": "3 mm",
        "throw_number": 2.0,
        "friction": 0.23,
        "restitution": 0.5,
    },
    "grains": {
        "diameter": "3 mm",
        "diameter_spread": 0.1,
        "density": "1400 kg/m3",
        "youngs_modulus": "0.3 MPa",
        "poisson_ratio": 0.35,
        "friction": 0.5,
        "restitution": 0.5,
    },
    "layer": {"length": "15 mm", "width": "15 mm", "grains": 60},
    # Wide enough for two packings, whose Student factor is 18.
    "measure": {"packings": 2, "half_width": 1.0, "max_cycles": 300},
    "output": {"frames_per_cycle": 0},
}


def campaign_text(changes=None, sweep=None):
    """SMALL as TOML, with as many packings as measure.packings says unless measure.max_packings is given. `changes`: {"section.key": value}, None removes the key; `sweep`: {"section.key": values}."""
    sections = {name: dict(keys) for name, keys in SMALL.items()}
    for path, value in (changes or {}).items():
        section, key = path.split(".")
        sections.setdefault(section, {})[key] = value
    # Most tests count packings: only those that say so have more than the least number.
    sections["measure"].setdefault("max_packings", sections["measure"].get("packings"))
    lines = []
    for name, keys in sections.items():
        # JSON's texts and numbers are TOML's as well.
        lines += [f"[{name}]"] + [f"{key} = {json.dumps(value)}" for key, value in keys.items() if value is not None]
    if sweep:
        lines += ["[sweep]"] + [f'"{path}" = {json.dumps(values)}' for path, values in sweep.items()]
    return "\n".join(lines) + "\n"


def wait_until(question, what, watched=None):
    """Asks until the answer is truthy, and returns it. `watched`: a process that must not end before.
    A folder that the program renames while the question lists it is asked about again."""
    deadline = time.monotonic() + PATIENCE
    missing = None
    while True:
        ended = watched is not None and watched.poll() is not None
        try:
            answer = question()
        except FileNotFoundError as error:
            answer, missing = None, error
        if answer:
            return answer
        if ended:
            raise AssertionError(f"the program ended with {watched.returncode} before {what}")
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {PATIENCE} s in vain until {what}") from missing
        time.sleep(0.02)


def pause(process):
    """Stops a process and waits until it stands still; False if it has ended. SIGCONT lets it go on, SIGKILL ends it all the same.
    A test that is about a moment stays in it, however late the machine gives the test its turn."""
    try:
        os.kill(process, signal.SIGSTOP)
        while True:
            state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
            if state in "TZX":
                return state == "T"
            time.sleep(0.001)
    except (ProcessLookupError, FileNotFoundError):
        return False


def processes_in(folder):
    """{process id: command name} of all living processes that work below `folder`."""
    below = str(Path(folder).resolve()) + "/"
    found = {}
    for process in Path("/proc").iterdir():
        if not process.name.isdigit():
            continue
        try:
            if (os.readlink(process / "cwd") + "/").startswith(below):
                found[int(process.name)] = (process / "comm").read_text().strip()
        except OSError:
            pass  # ended meanwhile, a zombie, or somebody else's
    return found


def engines_in(folder):
    return [number for number, name in processes_in(folder).items() if name == "liggghts"]


def count_cycles(path):
    """Whole cycles in a cycles.csv: its lines of numbers but the first, which is the start."""
    return sum(line[:1].isdigit() for line in path.read_text().splitlines()) - 1


def fingerprint(path):
    """Changes whenever the file is written again, even with the same content."""
    status = path.stat()
    return status.st_ino, status.st_mtime_ns, path.read_bytes()


class EndToEndTest(unittest.TestCase):
    """Gives each test a folder of its own and an engine that counts its starts."""

    # What the tests of a process share: the engine, and campaigns that have run, by the text of their file.
    common: ClassVar = tempfile.TemporaryDirectory(prefix="vibrotrough common ")
    finished: ClassVar[dict[str, Path]] = {}

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="vibrotrough test ")  # blanks must do no harm
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.addCleanup(self.kill_leftovers)
        self.output = self.folder / "runs"
        self.starts_file = self.folder / "starts"
        self.settles_file = self.folder / "settles"
        self.engine = self.make_counting_engine()

    def kill_leftovers(self):
        for number in processes_in(self.folder):
            os.kill(number, signal.SIGKILL)

    def make_counting_engine(self):
        """The real engine behind a script that notes the folder of each simulation and of each settling it starts, and
        runs the commands in VIBROTROUGH_TEST_BREAK before. It leaves probes alone, and has the same bytes for all tests of
        all processes: they share one certificate. What the engine says of itself, with exit code 1, is asked of it once."""
        real = shutil.which("liggghts")
        self.assertIsNotNone(real, "these tests need liggghts on the PATH")
        os.environ["VIBROTROUGH_TEST_STARTS"] = str(self.starts_file)
        os.environ["VIBROTROUGH_TEST_BREAK"] = ""
        os.environ["VIBROTROUGH_TEST_SETTLES"] = str(self.settles_file)
        common = Path(self.common.name)
        common.chmod(0o755)  # a test may be another user
        script, said = common / "counting-liggghts", common / "said"
        if not said.exists():
            said.write_bytes(subprocess.run([real, "-log", "none", "-h"], stdout=subprocess.PIPE, check=False).stdout)
        script.write_text(
            "#!/bin/sh\n"
            f'if [ "$*" = "-log none -h" ]; then cat <<"SAID"; exit 1; fi\n{said.read_text()}\nSAID\n'
            'case "$1 $PWD" in -in*/vibrotrough-probe-*) ;;\n'
            '-in*) case "$2" in in.liggghts) pwd >> "$VIBROTROUGH_TEST_STARTS";;\n'
            'settle.liggghts) pwd >> "$VIBROTROUGH_TEST_SETTLES";; esac\n'
            'eval "$VIBROTROUGH_TEST_BREAK";; esac\n'
            f'exec "{real}" "$@"\n'
        )
        script.chmod(script.stat().st_mode | stat.S_IXUSR)
        return script

    def take_starts(self):
        """The packings simulated since the last call, e.g. ["4f.../packing-1"], sorted."""
        lines = self.starts_file.read_text().splitlines() if self.starts_file.exists() else []
        self.starts_file.unlink(missing_ok=True)
        return sorted("/".join(Path(line).parts[-2:]) for line in lines)

    def write_campaign(self, changes=None, sweep=None, name="campaign.toml"):
        path = self.folder / name
        path.write_text(campaign_text(changes, sweep))
        return path

    def call(self, *arguments, **settings):
        """Runs the program to its end."""
        command = [PROGRAM, *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, **settings)

    def run_arguments(self, campaign, output=None, jobs=2):
        # The grains of SMALL are too soft for the narrow intervals that some tests ask for.
        return ["run", campaign, "--output", output or self.output, "--jobs", jobs, "--liggghts", self.engine, "--accept-findings"]

    def run_campaign(self, campaign, output=None, jobs=2, wanted=0):
        done = self.call(*self.run_arguments(campaign, output, jobs))
        if wanted is not None:
            self.assertEqual(done.returncode, wanted, done.stdout + done.stderr)
        return done

    def finished_campaign(self, changes=None, sweep=None, wanted=None):
        """A campaign that has run, for tests of what comes after: simulated for the first that asks for it, and copied for the others.
        Its file."""
        campaign = self.write_campaign(changes, sweep)
        text = campaign.read_text()
        if text not in self.finished:
            self.run_campaign(campaign, wanted=wanted)
            self.finished[text] = Path(self.common.name) / f"finished-{len(self.finished)}"
            shutil.copytree(self.output, self.finished[text], symlinks=True)
            for count in (self.starts_file, self.settles_file):
                count.unlink(missing_ok=True)
        else:
            shutil.copytree(self.finished[text], self.output, symlinks=True)
        return campaign

    def start_campaign(self, campaign, output=None):
        """Starts a run in a process group of its own, as a shell does, and returns at once."""
        command = [PROGRAM, *map(str, self.run_arguments(campaign, output))]
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
        )
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.communicate()

    def finish(self, process):
        """Waits for the end; (exit code, standard output, standard error)."""
        output, errors = process.communicate(timeout=PATIENCE)
        return process.returncode, output, errors

    def results_with_and_without_a_kill(self, campaign, cycle, wanted=0):
        """Runs a campaign of one packing twice: driver and engine are killed when `cycle` is sealed and go on, or are left alone.
        `compare` says the same of both. Returns both results."""
        undisturbed = self.folder / "undisturbed"
        self.run_campaign(campaign, undisturbed, wanted=wanted)

        def sealed_cycle():
            seals = list(self.output.glob("cases/*/packing-1/checkpoint.json"))
            return json.loads(seals[0].read_text())["cycle"] if seals else 0

        driver = self.start_campaign(campaign)
        wait_until(lambda: sealed_cycle() >= cycle or driver.poll() is not None, "a checkpoint was sealed")
        driver.send_signal(signal.SIGKILL)
        self.finish(driver)
        wait_until(lambda: not processes_in(self.output), "the engine was gone")
        self.run_campaign(campaign, wanted=wanted)
        self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(undisturbed)))
        return [next(iter(folder.glob("cases/*/result.h5"))) for folder in (self.output, undisturbed)]

    def assert_motion_does_not_depend_on(self, key, changes):
        """The engine writes the same cycles with and without what `key` asks for."""
        lines = []
        for asked in (True, False):
            output = self.folder / f"{key} {asked}"
            self.run_campaign(self.write_campaign(changes | {"measure.packings": 1, key: asked}), output, wanted=None)
            lines.append([next(iter(output.glob(f"cases/*/packing-1/{name}.csv"))).read_bytes() for name in ("cycles", "phases")])
        self.assertEqual(*lines)

    def ask_json(self, command, output=None):
        answer = self.call(command, output or self.output, "--json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return json.loads(answer.stdout)

    def table(self, output=None):
        return self.ask_json("compare", output)

    def row_of_bundle(self):
        """The only row of `compare` from an archive of the campaign, unpacked by Python's zipfile."""
        bundle, unpacked = self.folder / "bundle.zip", self.folder / "unpacked"
        done = self.call("archive", self.output, "--output", bundle)
        self.assertEqual(done.returncode, 0, done.stderr)
        with zipfile.ZipFile(bundle) as file:
            file.extractall(unpacked)
        done = self.call("compare", unpacked, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        again = json.loads(done.stdout)
        return (again["cases"] if isinstance(again, dict) else again)[0]

    def assert_was_simulated(self, design, folder):
        """The answer of `design --verify` in the folder is the machine that was simulated, and its model is what the layers were."""
        self.assertEqual(design["verification"]["verdict"], "verified", design)
        machine = design["verification"]["machines"][-1]
        self.assertTrue(all(layer["agrees"] for layer in machine["layers"]))
        self.assertGreaterEqual(machine["probability"], 0.95)
        for key in ("stroke_mm", "rpm", "vibration_angle_deg", "layer_depth_mm"):
            self.assertAlmostEqual(design[key], machine[key], 9)
        campaign = folder / machine["campaign"]
        layer = tomllib.loads(campaign.read_text(encoding="utf-8"))["layer"]
        self.assertAlmostEqual(float(layer["height"].split()[0]), machine["layer_depth_mm"], 6)
        simulated = sorted(row["efficiency"] for row in self.table(campaign.with_suffix("")))
        self.assertEqual(len(simulated), len(machine["layers"]))
        for one, other in zip(simulated, sorted(layer["simulated"] for layer in machine["layers"])):
            self.assertAlmostEqual(one, other, 9)

    def results(self):
        return sorted(self.output.glob("cases/*/result.h5"))

    def assert_one_line_error(self, done, exit_code, *parts):
        """The program said what is wrong in exactly one line on stderr, nothing on stdout."""
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"\Avibrotrough: [^\n]+\n\Z")
        self.assertEqual(done.stdout, "")
        for part in parts:
            self.assertIn(part, done.stderr)


def without_wall_time(table):
    """The rows with what two runs of the same campaign must have in common: all but the time they took."""
    return [{name: value for name, value in row.items() if name != "wall_time_s"} for row in table]
