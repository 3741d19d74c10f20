"""Engines that break, lie or hang: each case says why it failed, the others go on, the next run mends it."""

import json
import os
import signal
import unittest

from trough_program import EndToEndTest, engines_in, pause, processes_in, wait_until

SWEEP = {"layer.grains": [60, 70]}


class FailingEngine(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.campaign = self.write_campaign({"measure.packings": 1}, SWEEP)

    def break_engine(self, commands):
        """From now on the engine, asked to simulate a packing, runs these shell commands; its probes go well."""
        os.environ["VIBROTROUGH_TEST_BREAK"] = commands

    def failures(self):
        return [json.loads(path.read_text()) for path in sorted(self.output.glob("cases/*/failure.json"))]

    def assert_all_fail(self, outcome, message, attempts=1):
        done = self.run_campaign(self.campaign, wanted=1)
        self.assertIn("0 of 2 cases finished, 2 failed", done.stdout)
        self.assertEqual(done.stderr.count(f"): {outcome}: "), 2, done.stderr)
        failures = self.failures()
        self.assertEqual([failure["outcome"] for failure in failures], [outcome] * 2)
        for failure in failures:
            self.assertIn(message, failure["message"])
            self.assertEqual(failure["attempts"], attempts)
        table = self.table()
        self.assertEqual([row["outcome"] for row in table], [outcome] * 2)
        self.assertEqual([row["efficiency"] for row in table], [None] * 2)
        self.assertEqual(self.ask_json("status")["failed"], 2)

    def test_failures_are_named_and_mended(self):
        self.break_engine("exit 7")
        self.assert_all_fail("engine-error", "exit code 7 and no message")
        self.break_engine('echo "ERROR: no such thing (in.liggghts:12)"; exit 1')
        self.assert_all_fail("engine-error", "ERROR: no such thing (in.liggghts:12)", attempts=2)
        # What LIGGGHTS does on a full disk: exit code 0 and nothing written.
        self.break_engine("exit 0")
        self.assert_all_fail("outputs-incomplete", "is the disk full?", attempts=3)
        self.break_engine(f'VIBROTROUGH_TEST_BREAK= "{self.engine}" "$@"; test ! -f settled.restart || : > settled.restart; exit 0')
        self.assert_all_fail("outputs-incomplete", "or an empty one", attempts=4)
        self.break_engine("kill -SEGV $$")
        self.assert_all_fail("engine-crashed", "signal 11", attempts=5)
        # A run whose last cycles are missing although its end marker is there.
        self.break_engine(f'VIBROTROUGH_TEST_BREAK= "{self.engine}" "$@"; sed -i "\\$d" cycles.csv; exit 0')
        self.assert_all_fail("outputs-incomplete", "cycles.csv holds", attempts=6)

        # Numbers that are not finite, and displacements that contradict the velocities.
        edit = f"""VIBROTROUGH_TEST_BREAK= "{self.engine}" "$@"; test ! -f cycles.csv || {{ awk -F, -v OFS=, 'PROGRAM {{print}}' cycles.csv > c; mv c cycles.csv; }}; exit 0"""
        self.break_engine(edit.replace("PROGRAM", '/^[0-9]/ && NR == 8 {$3 = "nan"}'))
        self.assert_all_fail("diverged", "NaN or infinite", attempts=7)
        self.break_engine(edit.replace("PROGRAM", "/^[0-9]/ {$3 *= 2}"))
        self.assert_all_fail("outputs-incomplete", "contradicts itself", attempts=8)

        # A table larger than is read, while the engine runs and when it has ended.
        grow = "truncate -s 300M cycles.csv"
        self.break_engine(f'test "$2" != in.liggghts || {{ {grow}; sleep 2; exit 7; }}')
        self.assert_all_fail("engine-error", "exit code 7 and no message", attempts=9)
        self.break_engine(f'VIBROTROUGH_TEST_BREAK= "{self.engine}" "$@"; test ! -f cycles.csv || {grow}; exit 0')
        self.assert_all_fail("outputs-incomplete", "it is larger than 256 MB", attempts=10)

        self.break_engine("")
        self.run_campaign(self.campaign)
        self.assertEqual(self.failures(), [])
        self.assertEqual([row["outcome"] for row in self.table()], ["finished"] * 2)

    def test_a_failed_case_does_not_stop_the_others(self):
        self.break_engine('grep -q "grains    60 " "$2" && exit 7')
        done = self.run_campaign(self.campaign, wanted=1)
        self.assertIn("1 of 2 cases finished, 1 failed", done.stdout)
        self.assertEqual([row["outcome"] for row in self.table()], ["engine-error", "finished"])
        self.assertNotIn("to go", self.call("status", self.output).stdout, "neither case goes on by itself")

    def test_an_engine_that_hangs_is_killed_on_ctrl_c(self):
        driver = self.start_campaign(self.campaign)
        # It cannot answer any more.
        wait_until(lambda: next(filter(pause, engines_in(self.output)), None), "an engine ran", driver)
        driver.send_signal(signal.SIGINT)
        code, output, errors = self.finish(driver)
        self.assertEqual(code, 130, output + errors)
        self.assertEqual(processes_in(self.output), {})
        self.assertEqual(self.failures(), [])

    def test_terminated_driver_ends_its_engines(self):
        driver = self.start_campaign(self.campaign)
        wait_until(lambda: engines_in(self.output), "an engine ran", driver)
        driver.send_signal(signal.SIGTERM)
        code, output, errors = self.finish(driver)
        self.assertEqual(code, 130, output + errors)
        self.assertEqual(processes_in(self.output), {})


if __name__ == "__main__":
    unittest.main()
