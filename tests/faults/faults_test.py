"""Each call of a small campaign that writes, syncs, renames, opens, removes or starts something fails once: the next run
comes to the table of an undisturbed one, bit for bit, and no file outside the campaign's folder is touched.

VIBROTROUGH_FAULTS: how many of the calls are made to fail, spread evenly, or "all", or a range of their numbers such as
"101-200". The whole walk prints a line for each of them.
"""

import collections
import errno
import os
import shutil
import signal
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
import h5py  # noqa: E402
from trough_program import PROGRAM, EndToEndTest, processes_in, wait_until, without_wall_time  # noqa: E402

LIBRARY = os.environ["VIBROTROUGH_FAULT_LIBRARY"]
FAULTS = os.environ.get("VIBROTROUGH_FAULTS", "12")
CHANGES = {"measure.packings": 2, "measure.max_cycles": 40, "measure.half_width": 1.0, "layer.grains": 20}
# Columns of campaign.h5 in which two runs of the same campaign differ.
OF_THE_MOMENT = ("started", "finished", "wall_time", "core_time")
# What can happen to a call of each kind, in turn.
ERRORS = {
    "write": (errno.ENOSPC, errno.EIO, "short", errno.EINTR, errno.EDQUOT),
    "fsync": (errno.EIO, errno.ENOSPC, errno.EINTR),
    "rename": (errno.EIO, errno.ENOSPC, errno.EACCES),
    "open": (errno.EMFILE, errno.EIO, errno.ENOSPC, errno.EINTR),
    "unlink": (errno.EIO, errno.EACCES),
    "mkdir": (errno.ENOSPC, errno.EMFILE),
    "link": (errno.EMLINK, errno.ENOSPC),
    "fork": (errno.EAGAIN, errno.ENOMEM),
}


def chosen(calls):
    """The numbers of the calls that VIBROTROUGH_FAULTS names. A sample has all that start a process: with one of them the driver once
    waited for ever."""
    points = sorted(calls)
    if FAULTS == "all":
        return points
    if "-" in FAULTS:
        first, last = map(int, FAULTS.split("-"))
        return [at for at in points if first <= at <= last]
    count = int(FAULTS)
    sample = {points[(2 * i + 1) * len(points) // (2 * count)] for i in range(count)}
    return sorted(sample | {at for at in points if calls[at][0] == "fork"})


class Faults(EndToEndTest):
    def run_with(self, output, at, error, named=None):
        """Runs the campaign; the call with the number `at` fails, of those to files with `named` in their path.
        (process, kinds of the calls by number)"""
        counted = self.folder / "calls"
        counted.unlink(missing_ok=True)
        environment = dict(os.environ, LD_PRELOAD=LIBRARY, VIBROTROUGH_FAULT_PROGRAM=Path(PROGRAM).name[:15],
                           VIBROTROUGH_FAULT_BELOW=str(output), VIBROTROUGH_FAULT_AT=str(at),
                           VIBROTROUGH_FAULT_ERROR=str(error), VIBROTROUGH_FAULT_COUNT=str(counted))  # fmt: skip
        if named is not None:
            environment["VIBROTROUGH_FAULT_NAMED"] = named
        done = self.call(*self.run_arguments(self.campaign, output), env=environment)
        lines = [line.split(" ", 2) for line in counted.read_text().splitlines()] if counted.exists() else []
        return done, {int(number): (kind, path) for number, kind, path in lines}

    def tree(self):
        """All files outside the campaigns' folders."""
        return {path: path.read_bytes() for path in (self.folder / "others").rglob("*") if path.is_file()}

    def test_every_call_may_fail_once(self):
        self.campaign = self.write_campaign(CHANGES)
        others = self.folder / "others"
        others.mkdir()
        (others / "letter").write_text("dear")
        before = self.tree()
        undisturbed = self.folder / "undisturbed"
        done, calls = self.run_with(undisturbed, 0, 0)
        self.assertEqual(done.returncode, 0, done.stderr)
        wanted = without_wall_time(self.table(undisturbed))
        kinds = collections.Counter(kind for kind, _ in calls.values())
        self.assertGreater(len(calls), 200, kinds)
        points = chosen(calls)
        seen = collections.Counter()
        ends = collections.Counter()
        for at in points:
            kind, path = calls[at]
            errors = ERRORS[kind]
            error = errors[seen[kind] % len(errors)]
            seen[kind] += 1
            output = self.folder / f"runs {at}"
            (output / "packings").parent.mkdir()
            with self.subTest(at=at, kind=kind, path=path.replace(str(undisturbed), ""), error=error):
                done, _ = self.run_with(output, at, error)
                ends[done.returncode] += 1
                if not FAULTS.isdigit():
                    print(f"call {at} of {len(calls)}: {kind} {path.replace(str(undisturbed), '')} {error}: exit code {done.returncode}", flush=True)
                self.assertIn(done.returncode, (0, 1, 2, 3), done.stderr)
                self.assertNotIn("internal error", done.stderr)
                self.assertNotIn("terminate called", done.stderr)
                wait_until(lambda: not processes_in(output), "the engines were gone")  # noqa: B023
                again = self.call(*self.run_arguments(self.campaign, output))
                self.assertEqual(again.returncode, 0, f"{done.stderr}\n{again.stdout}{again.stderr}")
                self.assertEqual(without_wall_time(self.table(output)), wanted)
                left = [one.name for one in output.rglob("*") if ".part" in one.name or ".settling-" in one.name]
                self.assertEqual(left, [], "nothing half-written stays")
                self.assertEqual(self.tree(), before, "no file of another is touched")
            shutil.rmtree(output, ignore_errors=True)
        print(f"{len(calls)} calls ({dict(kinds)}), {len(points)} of them failed once ({dict(seen)}); exit codes {dict(ends)}")

    def assert_comes_to_the_same(self, output, wanted, told):
        """The next run ends in the same table, and so does the table that it writes."""
        wait_until(lambda: not processes_in(output), "the engines were gone")
        for result in output.glob("cases/*/result.h5"):
            with h5py.File(result) as file:  # whole, or not there
                self.assertEqual(file["case"]["packings"][0], 2, told)
        again = self.call(*self.run_arguments(self.campaign, output))
        self.assertEqual(again.returncode, 0, f"{told}\n{again.stdout}{again.stderr}")
        self.assertEqual(without_wall_time(self.table(output)), wanted, told)
        left = [one.name for one in output.rglob("*") if ".part" in one.name]
        self.assertEqual(left, [], f"{told}: nothing half-written stays")
        with h5py.File(output / "campaign.h5") as file:
            return {name: repr(column[...].tolist()) for name, column in file.items() if name not in OF_THE_MOMENT}

    def test_killed_within_the_writing_of_results(self):
        """SIGKILL at each call that writes, syncs or renames result.h5 and campaign.h5, and when half of the file is written."""
        self.campaign = self.write_campaign(CHANGES)
        undisturbed = self.folder / "undisturbed"
        count = 0
        for name in ("result.h5", "campaign.h5"):
            shutil.rmtree(undisturbed, ignore_errors=True)
            done, calls = self.run_with(undisturbed, 0, 0, named="/" + name)
            self.assertEqual(done.returncode, 0, done.stderr)
            kinds = collections.Counter(kind for kind, _ in calls.values())
            self.assertLessEqual({"open", "write", "fsync", "rename"}, set(kinds), calls)
            wanted = without_wall_time(self.table(undisturbed))
            table = self.assert_comes_to_the_same(undisturbed, wanted, "undisturbed")
            whole = False
            for at, (kind, _) in sorted(calls.items()):
                for end in ("kill", "torn") if kind == "write" else ("kill",):
                    output = self.folder / f"killed {count}"
                    # One whole run for each file; then from finished packings, whose results are written by the same calls.
                    if whole:
                        self.copy_without_results(undisturbed, output)
                    whole = whole or kind == "write"
                    told = f"{end} at call {at} to {name} ({kind})"
                    done, _ = self.run_with(output, at, end, named="/" + name)
                    self.assertEqual(done.returncode, -signal.SIGKILL, told + done.stderr)
                    self.assertEqual(self.assert_comes_to_the_same(output, wanted, told), table, told)
                    shutil.rmtree(output)
                    count += 1
        print(f"killed at {count} calls that write result.h5 and campaign.h5")

    @staticmethod
    def copy_without_results(undisturbed, output):
        shutil.copytree(undisturbed, output)
        for written in (*output.glob("cases/*/result.h5"), *output.glob("cases/*/summary"), output / "campaign.h5"):
            written.unlink(missing_ok=True)


if __name__ == "__main__":
    unittest.main()
