"""Each call of a small campaign that writes, syncs, renames, opens, removes or starts something fails once: the next run
comes to the table of an undisturbed one, bit for bit, and no file outside the campaign's folder is touched.

VIBROTROUGH_FAULTS: how many of the calls are made to fail, spread evenly, or "all".
"""

import collections
import errno
import os
import shutil
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from trough_program import PROGRAM, EndToEndTest, processes_in, wait_until, without_wall_time  # noqa: E402

LIBRARY = os.environ["VIBROTROUGH_FAULT_LIBRARY"]
FAULTS = os.environ.get("VIBROTROUGH_FAULTS", "12")
CHANGES = {"measure.packings": 2, "measure.max_cycles": 20, "measure.half_width": 1.0, "layer.grains": 20}
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


class Faults(EndToEndTest):
    def run_with(self, output, at, error):
        """Runs the campaign; the call with the number `at` fails. (process, kinds of the calls by number)"""
        counted = self.folder / "calls"
        counted.unlink(missing_ok=True)
        environment = dict(os.environ, LD_PRELOAD=LIBRARY, VIBROTROUGH_FAULT_PROGRAM=Path(PROGRAM).name[:15],
                           VIBROTROUGH_FAULT_BELOW=str(output), VIBROTROUGH_FAULT_AT=str(at),
                           VIBROTROUGH_FAULT_ERROR=str(error), VIBROTROUGH_FAULT_COUNT=str(counted))  # fmt: skip
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
        points = sorted(calls)
        if FAULTS != "all":
            count = int(FAULTS)
            points = [points[(2 * i + 1) * len(points) // (2 * count)] for i in range(count)]
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
                self.assertIn(done.returncode, (0, 1, 2, 3), done.stderr)
                self.assertNotIn("internal error", done.stderr)
                self.assertNotIn("terminate called", done.stderr)
                wait_until(lambda: not processes_in(output), "the engines were gone")  # noqa: B023
                again = self.call(*self.run_arguments(self.campaign, output))
                self.assertEqual(again.returncode, 0, f"{done.stderr}\n{again.stdout}{again.stderr}")
                self.assertEqual(without_wall_time(self.table(output)), wanted)
                left = [one.name for one in output.rglob("*") if ".part-" in one.name or ".settling-" in one.name]
                self.assertEqual(left, [], "nothing half-written stays")
                self.assertEqual(self.tree(), before, "no file of another is touched")
            shutil.rmtree(output, ignore_errors=True)
        print(f"{len(calls)} calls ({dict(kinds)}), {len(points)} of them failed once ({dict(seen)}); exit codes {dict(ends)}")


if __name__ == "__main__":
    unittest.main()
