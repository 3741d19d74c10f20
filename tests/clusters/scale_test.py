"""Ten thousand cases: planning, status and table in under two seconds and 200 MB each, and a driver that costs less than five
milliseconds of processor time per case. A stub stands in for the engine here, and only here.
"""

import json
import os
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from trough_program import PROGRAM, EndToEndTest  # noqa: E402

CASES = int(os.environ.get("VIBROTROUGH_CASES", "10000"))
# Processor time, not the clock on the wall: other tests run beside this one.
MOST_SECONDS = 2.0
MOST_MEGABYTES = 200
MOST_DRIVER_SECONDS = 0.005


class Scale(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.engine = Path(os.environ["VIBROTROUGH_STUB_ENGINE"])
        side = round(CASES**0.5)
        self.cases = side * side
        # The drive varies, so that all cases share one settled packing.
        self.campaign = self.write_campaign(
            {"measure.packings": 1, "grains.diameter_spread": 0.0},
            {
                "trough.throw_number": [round(1 + 2 * i / side, 6) for i in range(side)],
                "trough.amplitude": [f"{3 + 3 * i / side:.5g} mm" for i in range(side)],
            },
        )

    def measure(self, *arguments):
        """Runs the program to its end; its own seconds of processor time, largest memory in MB and output."""
        with open(self.folder / "shown", "w+") as shown:
            process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=shown, stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            shown.seek(0)
            output = shown.read()
        self.assertEqual(process.returncode, 0, output[-2000:])
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, output

    def assert_quick(self, *arguments):
        seconds, megabytes, output = self.measure(*arguments)
        print(f"{arguments[0]}: {seconds:.2f} s, {megabytes:.0f} MB")
        self.assertLess(seconds, MOST_SECONDS, arguments)
        self.assertLess(megabytes, MOST_MEGABYTES, arguments)
        return output

    def test_ten_thousand_cases(self):
        planned = json.loads(self.assert_quick("plan", self.campaign, "--output", self.output, "--json", "--liggghts", self.engine))
        self.assertEqual((planned["cases_total"], planned["known"]), (self.cases, 0))

        begun = time.monotonic()
        driver = subprocess.Popen(
            [PROGRAM, *map(str, self.run_arguments(self.campaign)), "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.addCleanup(self.end, driver)
        own = 0.0
        ticks = os.sysconf("SC_CLK_TCK")
        while driver.poll() is None:
            # utime and stime of the driver itself, without its engines.
            try:
                fields = Path(f"/proc/{driver.pid}/stat").read_text().rpartition(")")[2].split()
                own = max(own, (int(fields[11]) + int(fields[12])) / ticks)
            except OSError:
                pass
            time.sleep(0.05)
        output, errors = driver.communicate()
        self.assertEqual(driver.returncode, 0, output + errors)
        print(f"run: {1000 * own / self.cases:.2f} ms of the driver per case, {time.monotonic() - begun:.0f} s in all")
        self.assertLess(own / self.cases, MOST_DRIVER_SECONDS)

        status = json.loads(self.assert_quick("status", self.output, "--json"))
        self.assertEqual((status["finished"], status["left"]), (self.cases, 0))
        table = json.loads(self.assert_quick("compare", self.output, "--json"))
        self.assertEqual(len(table), self.cases)
        self.assert_quick("compare", self.output, "--csv")
        known = json.loads(self.assert_quick("plan", self.campaign, "--output", self.output, "--json", "--liggghts", self.engine))
        self.assertEqual(known["known"], self.cases)


if __name__ == "__main__":
    unittest.main()
