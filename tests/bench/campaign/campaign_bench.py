"""Ten thousand cases, or VIBROTROUGH_BENCH_CASES of them: processor time and memory of the commands that look at a campaign, and what the driver costs per case.

It prints, and holds nothing to a time: that depends on the machine and on what else it does. What must not grow is counted in
tests/clusters/scale_test.py. VIBROTROUGH_BENCH_RUNS sets the number of runs of each command; the median is printed.
"""

import os
import shutil
import statistics
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "clusters"))
from many_cases import KINDS, ManyCases  # noqa: E402

CASES = int(os.environ.get("VIBROTROUGH_BENCH_CASES", "10000"))
DRIVER_CASES = 100
DRIVER_MEGABYTES = 55  # what they write
RUNS = int(os.environ.get("VIBROTROUGH_BENCH_RUNS", "3"))


def folder_in_memory():
    """Where files cost no search for a free inode: on ext4 that search takes up to 5 ms per case in the minutes after other tests
    have removed their folders. None, the usual place, where there is no such memory."""
    memory = Path("/dev/shm")
    there = memory.is_dir() and os.access(memory, os.W_OK)
    return memory if there and shutil.disk_usage(memory).free > DRIVER_MEGABYTES * 1e6 else None


class CampaignBench(ManyCases):
    def show(self, what, *arguments):
        seconds, megabytes = zip(*(self.measure(*arguments)[:2] for _ in range(RUNS)))
        every = " ".join(f"{one:.2f}" for one in seconds)
        print(f"{what:<32} {statistics.median(seconds):5.2f} s of CPU ({every}), {max(megabytes):4.0f} MB", flush=True)

    def test_many_cases(self):
        print(f"\n{CASES} cases; required: at most {2 * CASES / 10_000:g} s and {max(200, 500 * CASES / 100_000):g} MB each")
        for kind in KINDS:
            self.output = self.folder / kind
            campaign = self.write_many(kind, CASES)
            self.show(f"plan, {kind}", *self.plan_arguments(campaign))
            self.show(f"check, {kind}", "check", campaign)
            self.show(f"check --json, {kind}", "check", campaign, "--json")
            self.freeze(campaign, kind)
            self.show(f"status, {kind}, none finished", "status", self.output, "--json")

    def test_many_finished_cases(self):
        print(f"\n{CASES} cases; required: at most {2 * CASES / 10_000:g} s and {max(200, 500 * CASES / 100_000):g} MB each")
        self.succeed(*self.driver_arguments(self.write_many("spheres", 4)))
        campaign = self.write_many("spheres", CASES)
        self.make_results(campaign)
        self.show("plan, finished", *self.plan_arguments(campaign))
        self.show("status, finished", "status", self.output, "--json")
        self.show("compare, finished", "compare", self.output)
        self.show("compare --json, finished", "compare", self.output, "--json")
        self.show("compare --csv, finished", "compare", self.output, "--csv")
        self.show("run, finished", *self.driver_arguments(campaign))

    def test_the_driver(self):
        """From the start of the program to its end, campaign.h5 included. What else runs on the machine only adds to it, so the
        least counts."""
        campaign = self.write_many("spheres", DRIVER_CASES)
        seconds = []
        for _ in range(2 * RUNS):
            with tempfile.TemporaryDirectory(dir=folder_in_memory()) as folder:
                self.output = Path(folder) / "runs"
                seconds.append(self.measure(*self.driver_arguments(campaign))[0] / DRIVER_CASES)
        print(f"\ndriver: {1000 * min(seconds):.2f} ms of CPU per case (required: at most 5; median {1000 * statistics.median(seconds):.2f})")


if __name__ == "__main__":
    unittest.main()
