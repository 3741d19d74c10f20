"""What the scale test and the campaign benchmark share: large campaigns of three kinds, their results, and two ways to measure
the program. A stub stands in for the engine here, and only here.
"""

import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from trough_program import PROGRAM, EndToEndTest  # noqa: E402

# spheres, cubes (clumps of eight spheres), and spheres on a trough that moves as it was measured
KINDS = ("spheres", "cubes", "waveforms")
SAMPLES = 256
# The stub fails every probe of a real engine, and the small layers earn warnings.
DRIVER_OPTIONS = ("--quiet", "--accept-failed-probes", "--accept-findings")

# Runs a command with its output in a file, and prints its exit code, its clock ticks (fields 14 and 15 of its stat file, without
# its children's) and its largest memory in kB. A small process of its own, because the kernel counts the memory of a process from
# its fork on, when it is still its parent's.
MEASURE = """
import os, sys
shown = os.open(sys.argv[1], os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
told = os.open(sys.argv[1] + ".stderr", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
process = os.posix_spawn(sys.argv[2], sys.argv[2:], os.environ,
                         file_actions=[(os.POSIX_SPAWN_DUP2, shown, 1), (os.POSIX_SPAWN_DUP2, told, 2)])
os.waitid(os.P_PID, process, os.WEXITED | os.WNOWAIT)  # it has ended but is not forgotten yet: its times are final
fields = open(f"/proc/{process}/stat").read().rpartition(")")[2].split()
_, status, usage = os.wait4(process, 0)
print(os.waitstatus_to_exitcode(status), int(fields[11]) + int(fields[12]), usage.ru_maxrss)
"""


def campaign_of(kind, cases, width):
    """Changes and sweep of a campaign of rows x columns cases, as square as possible. The drive varies, so that all cases share one
    settled packing; where a waveform fixes the drive, the trough's friction and restitution vary. All vary by about `width`."""
    rows = next(count for count in range(math.isqrt(cases), 0, -1) if cases % count == 0)
    columns = cases // rows
    changes = {"measure.packings": 1, "measure.max_cycles": 24, "grains.diameter_spread": 0.0}
    if kind == "waveforms":
        changes |= {"trough.throw_number": None, "trough.frequency": "20 Hz", "trough.waveform": "measured.csv"}
        return changes, {
            "trough.friction": [round(0.3 + width / 2 * i / rows, 6) for i in range(rows)],
            "trough.restitution": [round(0.5 + width / 2 * i / columns, 6) for i in range(columns)],
        }
    if kind == "cubes":
        changes["grains.shape"] = "cube"
    return changes, {
        "trough.throw_number": [round(1.2 + width * i / rows, 6) for i in range(rows)],
        "trough.amplitude": [f"{3 + 3 * i / columns:.5g} mm" for i in range(columns)],
    }


def waveform():
    """One measured cycle of 20 Hz whose fundamental is the small campaign's: 3 mm at the angle atan(0.5). With its overtones it
    has all the harmonics that the program keeps."""
    lines = ["time_s,x_m,z_m"]
    along, normal = math.cos(math.atan(0.5)), math.sin(math.atan(0.5))
    for i in range(SAMPLES):
        angle = 2 * math.pi * i / SAMPLES
        motion = math.sin(angle) + sum(0.05 / k * math.sin(k * angle + k * k) for k in range(2, 40))
        lines.append(f"{i / SAMPLES / 20:.9g},{0.003 * along * motion:.9g},{0.003 * normal * motion:.9g}")
    return "\n".join(lines) + "\n"


class ManyCases(EndToEndTest):
    # Narrow, so that each case costs the same: the theory of a mass that rebounds takes ten steps of one motion and thousands of another.
    width = 0.02

    def setUp(self):
        super().setUp()
        self.engine = Path(os.environ["VIBROTROUGH_STUB_ENGINE"])
        (self.folder / "measured.csv").write_text(waveform())

    def write_many(self, kind, cases):
        return self.write_campaign(*campaign_of(kind, cases, self.width), name=f"{kind}-{cases}.toml")

    def plan_arguments(self, campaign):
        return ["plan", campaign, "--output", self.output, "--json", "--liggghts", self.engine]

    def driver_arguments(self, campaign):
        return [*self.run_arguments(campaign), *DRIVER_OPTIONS]

    def succeed(self, *arguments):
        """Runs the program to its end; its output."""
        done = self.call(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        return done.stdout

    def measure(self, *arguments):
        """Runs the program to its end; its seconds of processor time without its engines', its largest memory in MB, and what it
        printed."""
        shown = self.folder / "shown"
        done = subprocess.run([sys.executable, "-I", "-S", "-c", MEASURE, shown, PROGRAM, *map(str, arguments)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        code, ticks, kilobytes = map(int, done.stdout.split())
        output = shown.read_text()
        self.assertEqual(code, 0, output[-2000:] + shown.with_name("shown.stderr").read_text()[-2000:])
        return ticks / os.sysconf("SC_CLK_TCK"), kilobytes / 1024, output

    def count_blocks(self, *arguments):
        """The basic blocks that the program executes on one core, without its engines'. They do not depend on what else the machine
        does: threads that wait for each other would count, too. Each turn of a loop is at least one. To count instructions, of which a
        block has eight on average, takes valgrind twice as long."""
        valgrind = shutil.which("valgrind")
        self.assertIsNotNone(valgrind, "valgrind is not installed: ./setup packages lists what the tests need")
        count = [valgrind, "--tool=none", "--stats=yes", "--vex-iropt-unroll-thresh=0"]  # as many turns as the program's own
        cores = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {min(cores)})  # the program inherits it
        try:
            done = subprocess.run([*count, PROGRAM, *map(str, arguments)], capture_output=True, text=True)
        finally:
            os.sched_setaffinity(0, cores)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        return int(re.findall(r"scheduler: ([0-9,]+) event checks", done.stderr)[-1].replace(",", ""))

    def freeze(self, campaign, kind):
        """Makes the campaign's folder by running the first few of its kind."""
        self.succeed(*self.driver_arguments(self.write_many(kind, 4)))
        shutil.copy(campaign, self.output / "campaign.toml")

    def make_results(self, campaign):
        """Gives each case a result.h5: that of a case which was run, with another id."""
        template = self.results()[0]
        for case in json.loads(self.succeed(*self.plan_arguments(campaign)))["cases"]:
            folder = self.output / "cases" / case["case"]
            folder.mkdir(parents=True, exist_ok=True)
            if folder / "result.h5" != template:
                shutil.copy(template, folder / "result.h5")
            with h5py.File(folder / "result.h5", "r+") as file:
                file.attrs.modify("case", np.bytes_(case["case"]))
        self.succeed(*self.driver_arguments(campaign))  # finds nothing to run, and reads each result once
