"""One driver per campaign and one engine per packing, under whatever path, process number and number of ranks."""

import fcntl
import os
import re
import shutil
import signal
import socket
import subprocess
import time
import unittest

from trough_program import PROGRAM, EndToEndTest, count_cycles, engines_in, processes_in, wait_until

# Nobody would stop these for an hour.
LONG = {"measure.packings": 1, "measure.max_cycles": 100_000, "measure.half_width": 0.0001, "output.checkpoint_cycles": 5}


class OneWriter(EndToEndTest):
    def write_long_campaign(self, asked=""):
        campaign = self.write_campaign(LONG)
        campaign.write_text(campaign.read_text() + asked)
        return campaign

    def table_of_cycles(self):
        tables = list(self.output.glob("cases/*/packing-1/cycles.csv"))
        return tables[0] if tables else None

    def wait_for_cycles(self, driver, count):
        def seen():
            table = self.table_of_cycles()
            return table and table.exists() and count_cycles(table) >= count

        wait_until(seen, f"{count} cycles were simulated", driver)

    def stop(self, driver):
        driver.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(driver)[0], 130)

    def assert_no_cycle_is_there_twice(self):
        lines = [line.split(",")[0] for line in self.table_of_cycles().read_text().splitlines()]
        steps = [int(step) for step in lines if step.isdigit()]
        self.assertEqual(steps, sorted(set(steps)))

    def bind_mount(self):
        """The campaign's folder under another path that no link shows; None where this is not allowed."""
        place = self.folder / "mounted"
        place.mkdir()
        if subprocess.run(["mount", "--bind", self.output, place], capture_output=True).returncode != 0:
            return None
        self.addCleanup(subprocess.run, ["umount", "-l", place], check=True)
        return place

    def test_two_drivers_over_two_paths(self):
        campaign = self.write_long_campaign()
        driver = self.start_campaign(campaign)
        self.wait_for_cycles(driver, 2)
        (self.folder / "by link").symlink_to(self.output)
        (self.folder / "parent").symlink_to(self.folder)
        paths = [self.folder / "by link", self.folder / "parent" / "runs", self.folder / "others" / ".." / "runs", self.bind_mount()]
        (self.folder / "others").mkdir()
        for path in filter(None, paths):
            with self.subTest(path=path):
                done = self.call(*self.run_arguments(campaign, path))
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn("another vibrotrough is running the campaign", done.stderr)
        self.assertIsNone(driver.poll(), "the first driver goes on")
        engines = wait_until(lambda: engines_in(self.output), "an engine works, as always but between two rounds", driver)
        self.assertEqual(len(engines), 1)
        self.stop(driver)
        self.assert_no_cycle_is_there_twice()

    def test_a_packing_that_is_worked_on_under_another_path(self):
        # As two tasks of a cluster would do it that see the folder in different places.
        campaign = self.write_long_campaign()
        driver = self.start_campaign(campaign)
        self.wait_for_cycles(driver, 2)
        link = self.folder / "by link"
        link.symlink_to(self.output)
        (case,) = (self.output / "cases").iterdir()
        tasks = self.folder / "tasks"
        tasks.write_text(f"{case.name} 1\n")
        command = [PROGRAM, "work", link, "--task-list", tasks, "--index", "0"]
        task = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, task)
        cycles = count_cycles(self.table_of_cycles())
        while task.poll() is None and count_cycles(self.table_of_cycles()) < cycles + 20:
            self.assertLessEqual(len(engines_in(self.output)), 1, "the task waits for the packing, or ends")
            time.sleep(0.02)
        self.stop(driver)
        if task.poll() is None:
            task.send_signal(signal.SIGTERM)
        self.finish(task)
        wait_until(lambda: not processes_in(self.output), "the engine was gone")
        self.assert_no_cycle_is_there_twice()

    def test_ranks_do_not_write_beside_a_new_engine(self):
        self.assertIsNotNone(shutil.which("mpirun"), "mpirun is not installed: ./setup packages lists what the tests need")
        campaign = self.write_long_campaign("[run]\nranks = 2\n")
        for _ in range(3):
            cycles = count_cycles(self.table_of_cycles()) if self.table_of_cycles() else 0
            driver = self.start_campaign(campaign)
            self.wait_for_cycles(driver, cycles + 6)
            wait_until(lambda: len(engines_in(self.output)) >= 2, "two ranks worked; none does between two rounds", driver)
            old = set(engines_in(self.output))
            self.assertGreaterEqual(len(old), 2, "the test is about two ranks")
            driver.send_signal(signal.SIGKILL)
            driver.wait()
            # The next driver is called at once, while the ranks may still be there.
            driver = self.start_campaign(campaign)

            def new_engines():
                now = set(engines_in(self.output))
                self.assertFalse(now & old and now - old, "engines of two drivers work in one folder")  # noqa: B023
                return now - old  # noqa: B023

            wait_until(new_engines, "the run went on", driver)
            self.wait_for_cycles(driver, cycles + 12)
            self.assertFalse(set(engines_in(self.output)) & old)
            driver.send_signal(signal.SIGKILL)
            driver.wait()
            wait_until(lambda: not processes_in(self.output), "no rank outlived its driver")
            self.assert_no_cycle_is_there_twice()

    def test_who_has_the_number_of_a_dead_engine_is_left_alone(self):
        campaign = self.write_long_campaign()
        driver = self.start_campaign(campaign)
        self.wait_for_cycles(driver, 6)
        driver.send_signal(signal.SIGKILL)
        driver.wait()
        wait_until(lambda: not processes_in(self.output), "the engine was gone")
        packing = self.table_of_cycles().parent
        # A process of somebody else, with a process group that has the number of the engine's.
        stranger = subprocess.Popen(["sleep", "1000"], start_new_session=True, cwd="/")
        self.addCleanup(self.end, stranger)
        writer = packing / ".engine"
        self.assertRegex(writer.read_text(), rf"^\d+ {re.escape(socket.gethostname())}\n$")
        writer.write_text(f"{stranger.pid} {socket.gethostname()}\n")

        # Something that the engine had started, in a group of its own, still holds its lock.
        with open(writer, "r+") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            done = self.call(*self.run_arguments(campaign))
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("still writes in", done.stderr)
            self.assertIsNone(stranger.poll(), "a stranger was killed")

        driver = self.start_campaign(campaign)
        self.wait_for_cycles(driver, 12)
        self.assertIsNone(stranger.poll(), "a stranger was killed")
        self.stop(driver)
        self.assert_no_cycle_is_there_twice()
        stranger.kill()
        stranger.wait()

    def test_the_number_of_a_dead_driver_means_nothing(self):
        """Locks are the kernel's: a file that names a living process holds nobody up."""
        campaign = self.write_campaign({"measure.packings": 1, "measure.max_cycles": 24})
        self.output.mkdir()
        (self.output / ".lock").write_text(f"{os.getpid()}\n")
        begin = time.monotonic()
        self.run_campaign(campaign, wanted=None)
        self.assertEqual(self.ask_json("status")["left"], 0, time.monotonic() - begin)


if __name__ == "__main__":
    unittest.main()
