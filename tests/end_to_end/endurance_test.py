"""What must not stop a run, and what a stop must not lose: nohup, a standard error that nobody can write to, few open files,
and Ctrl-C, which keeps every cycle that is complete."""

import os
import signal
import subprocess
import time
import unittest

from trough_program import PROGRAM, EndToEndTest, count_cycles, engines_in, processes_in, wait_until

ONE = {"measure.max_cycles": 24}
# 24 cycles, after which it is clear that the half-width cannot be reached, take longer than a test does, and no regular checkpoint is written before.
LONG = {"layer.grains": 600, "grains.youngs_modulus": "30 MPa", "measure.packings": 2, "measure.max_packings": 2,
        "measure.max_cycles": 100_000, "measure.half_width": 0.0001, "output.checkpoint_cycles": 50_000}  # fmt: skip


class Endurance(EndToEndTest):
    def start(self, campaign, prefix=(), **settings):
        command = [*prefix, PROGRAM, *map(str, self.run_arguments(campaign))]
        process = subprocess.Popen(command, start_new_session=True, **settings)
        self.addCleanup(self.end, process)
        return process

    def end(self, process):
        if process.poll() is None:
            process.kill()
        process.wait()

    def tables(self):
        return sorted(self.output.glob("cases/*/packing-*/cycles.csv"))

    def wait_for_cycles(self, driver, count):
        wait_until(lambda: len(self.tables()) == 2 and all(count_cycles(path) >= count for path in self.tables()),
                   f"{count} cycles of both packings were simulated", driver)  # fmt: skip

    def test_nohup_protects(self):
        campaign = self.write_campaign(ONE)
        driver = self.start(campaign, ["nohup"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until(lambda: engines_in(self.output), "an engine ran", driver)
        os.killpg(driver.pid, signal.SIGHUP)  # as a terminal does it that is closed
        self.assertEqual(driver.wait(), 0)
        self.assertEqual(len(self.results()), 1)
        without = self.start(self.write_campaign(LONG | {"campaign.name": "small"}), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until(lambda: engines_in(self.output), "an engine ran", without)
        without.send_signal(signal.SIGHUP)
        self.assertEqual(without.wait(), 130, "without nohup a closed terminal stops the run cleanly")

    def test_a_standard_error_that_takes_nothing(self):
        campaign = self.write_campaign(ONE)
        command = " ".join(f"'{word}'" for word in [PROGRAM, *map(str, self.run_arguments(campaign))])
        for number, redirection in enumerate(("2>/dev/full", "2>&-", "2>&- --quiet", "<&- 2>&-", "2>&1 >/dev/null | true")):
            with self.subTest(redirection=redirection):
                output = self.folder / f"runs-{number}"
                line = command.replace(str(self.output), str(output)) + " " + redirection
                done = subprocess.run(["bash", "-c", f"set -o pipefail; {line}"], capture_output=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(len(list(output.glob("cases/*/result.h5"))), 1)
        # A summary that nobody can read is an error, but only after everything has been done.
        output = self.folder / "no-output"
        done = subprocess.run(["bash", "-c", command.replace(str(self.output), str(output)) + " >&-"], capture_output=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn(b"cannot write the output", done.stderr)
        self.assertEqual(len(list(output.glob("cases/*/result.h5"))), 1)

    def test_messages_name_the_cause(self):
        campaign = self.write_campaign(ONE)
        self.run_campaign(campaign, wanted=None)
        for place in ("/proc", "/dev/null/none"):
            done = self.call(*self.run_arguments(campaign), env=dict(os.environ, TMPDIR=place))
            self.assert_one_line_error(done, 3, "temporary", "TMPDIR")
        arguments = " ".join(f"'{word}'" for word in [PROGRAM, *map(str, self.run_arguments(campaign, self.folder / "new"))])
        for count in (12, 16):
            done = subprocess.run(["bash", "-c", f"ulimit -n {count}; {arguments.replace('/new', f'/new{count}')}"], capture_output=True, text=True)
            if done.returncode not in (0, 1):
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertRegex(done.stderr, "open files|cannot be started|shared librar")
        fake = self.folder / "not-liggghts"
        fake.write_text("#!/bin/sh\necho I am another program\nexit 4\n")
        fake.chmod(0o755)
        done = self.call("run", campaign, "--output", self.output, "--liggghts", fake)
        self.assert_one_line_error(done, 3, "does not identify itself as LIGGGHTS", "exit code 4", "I am another program")

    def test_ctrl_c_keeps_every_cycle(self):
        campaign = self.write_campaign(LONG)
        driver = self.start(campaign, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_for_cycles(driver, 5)
        driver.send_signal(signal.SIGINT)
        self.assertEqual(driver.wait(), 130)
        self.assertEqual(processes_in(self.output), {})
        kept = {path: path.read_text().splitlines() for path in self.tables()}
        self.assertEqual(self.ask_json("status")["failed"], 0)
        driver = self.start(campaign, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until(lambda: all(len(path.read_text().splitlines()) > len(lines) + 1 for path, lines in kept.items()),
                   "both packings went on", driver)  # fmt: skip
        for path, lines in kept.items():
            self.assertEqual(path.read_text().splitlines()[: len(lines)], lines, "no cycle is simulated again")
        # A second one does not wait for the end of the cycle.
        begin = time.monotonic()
        for engine in engines_in(self.output):
            os.kill(engine, signal.SIGSTOP)  # a cycle that never ends
        driver.send_signal(signal.SIGINT)
        time.sleep(1)
        self.assertIsNone(driver.poll(), "the first waits")
        driver.send_signal(signal.SIGINT)
        self.assertEqual(driver.wait(), 130)
        self.assertEqual(processes_in(self.output), {})
        self.assertLess(time.monotonic() - begin, 300)


if __name__ == "__main__":
    unittest.main()
