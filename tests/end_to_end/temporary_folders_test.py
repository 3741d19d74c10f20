"""No end of the program leaves a folder in the temporary folder, but for SIGKILL; what that leaves the next run removes."""

import os
import shutil
import signal
import subprocess
import time
import unittest

from trough_program import PROGRAM, EndToEndTest, engines_in, processes_in, wait_until

# More packings than are simulated before a test stops the run.
ENDLESS = {"measure.packings": 1000, "measure.max_cycles": 100000, "output.checkpoint_cycles": 5}
FAILING = "exit 1"
CRASHING = "kill -SEGV $$"


class TemporaryFolders(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        before = os.environ.get("TMPDIR")
        os.environ["TMPDIR"] = str(self.temporary)
        self.addCleanup(lambda: os.environ.pop("TMPDIR") if before is None else os.environ.update(TMPDIR=before))
        self.real = shutil.which("liggghts")

    def left(self):
        return sorted(path.name for path in self.temporary.iterdir())

    def start(self, *arguments):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        self.addCleanup(self.end, process)
        return process

    def slow_engine(self, seconds=2):
        """The real engine, which takes its time to name its version."""
        script = self.folder / "slow-liggghts"
        script.write_text(f'#!/bin/sh\ncase "$*" in *-h*) touch "{self.folder}/asked"; sleep {seconds};; esac\nexec "{self.real}" "$@"\n')
        script.chmod(0o755)
        return script

    def stop(self, process, number, times=1):
        for _ in range(times):
            os.killpg(process.pid, number) if number == signal.SIGINT else process.send_signal(number)
            time.sleep(0.3)
        return self.finish(process)[0]

    def test_ordinary_end(self):
        done = self.call(*self.run_arguments(self.write_campaign()), "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.left(), [])

    def test_failed_engine(self):
        for commands in (FAILING, CRASHING, "sleep 1000 & exit 1"):
            os.environ["VIBROTROUGH_TEST_BREAK"] = commands
            done = self.call(*self.run_arguments(self.write_campaign()), "--quiet")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(self.left(), [], commands)

    def test_no_engine(self):
        done = self.call("run", self.write_campaign(), "--output", self.output, "--liggghts", "/bin/true")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(self.left(), [])

    def test_stopped_while_packings_run(self):
        campaign = self.write_campaign(ENDLESS)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for times in (1, 3):
                self.output = self.folder / f"runs-{number}-{times}"
                process = self.start_campaign(campaign)
                wait_until(lambda: engines_in(self.output), "an engine ran", process)
                time.sleep(0.5)
                # Later signals may come when the run has ended and the program is about to.
                code = self.stop(process, number, times)
                self.assertIn(code, [130, -number][:times])
                if code == -number:  # it may have come while a folder was being removed; the next process goes on with that
                    self.call("plan", campaign, "--output", self.folder / "next", "--liggghts", self.engine)
                self.assertEqual(self.left(), [], (number, times))

    def test_stopped_while_the_engine_is_asked_for_its_version(self):
        campaign = self.write_campaign(ENDLESS)
        for arguments in (["run", campaign, "--output", self.output], ["plan", campaign, "--output", self.output]):
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                asked = self.folder / "asked"
                asked.unlink(missing_ok=True)
                process = self.start(*arguments, "--liggghts", self.slow_engine())
                wait_until(asked.exists, "the engine was asked", process)
                self.assertEqual(self.stop(process, number), -number)
                self.assertEqual(self.left(), [], (arguments[0], number))

    def test_stopped_task(self):
        campaign = self.write_campaign(ENDLESS)
        tasks = self.folder / "tasks.txt"
        done = self.call("prepare", campaign, "--output", self.output, "--liggghts", self.engine, "--task-list", tasks)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.left(), [])
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start("work", self.output, "--task-list", tasks, "--index", 0)
            wait_until(lambda: engines_in(self.output), "the task's engine ran", process)
            self.stop(process, number)
            self.assertEqual(self.left(), [], number)

    def test_several_ranks(self):
        campaign = self.write_campaign(ENDLESS)
        campaign.write_text(campaign.read_text() + "[run]\nranks = 2\n")
        for number, times in ((signal.SIGTERM, 1), (signal.SIGTERM, 3)):
            self.output = self.folder / f"runs-{times}"
            process = self.start_campaign(campaign)
            wait_until(lambda: engines_in(self.output), "an engine ran", process)
            time.sleep(1)
            self.assertIn(self.stop(process, number, times), [130, -number][:times])
            wait_until(lambda: not processes_in(self.output), "the ranks were gone")
            self.assertEqual(self.left(), [], times)

    def test_what_killed_runs_left_is_removed_by_the_next(self):
        campaign = self.write_campaign(ENDLESS)
        process = self.start_campaign(campaign)
        wait_until(lambda: engines_in(self.output), "an engine ran", process)
        self.assertEqual(self.stop(process, signal.SIGKILL), -signal.SIGKILL)
        wait_until(lambda: not processes_in(self.output), "the engines were gone")
        dead = self.left()
        self.assertGreater(len(dead), 0, "SIGKILL leaves the folders of engines")
        older = self.temporary / "vibrotrough-engine-a1B2c3"  # of an older version: nobody knows whether its owner lives
        older.mkdir()

        living = self.start("run", campaign, "--output", self.folder / "other", "--liggghts", self.engine, "--jobs", 2)
        # Both, so that none of them is stopped after its folder is made and before it is locked.
        wait_until(lambda: len(engines_in(self.folder / "other")) == 2, "both engines of the next run ran", living)
        os.kill(living.pid, signal.SIGSTOP)  # so that no packing of it ends between the looks
        in_use = set(self.left()) - {older.name}
        self.assertEqual(in_use & set(dead), set(), "the next run removes what the dead one left")
        self.assertGreater(len(in_use), 0)

        done = self.call("plan", campaign, "--output", self.folder / "third", "--liggghts", self.engine)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLessEqual(in_use, set(self.left()), "those of a living run stay")
        os.kill(living.pid, signal.SIGCONT)
        self.assertEqual(self.stop(living, signal.SIGTERM), 130)
        self.assertEqual(self.left(), [older.name])


if __name__ == "__main__":
    unittest.main()
