"""Engines that work in a scratch folder of the machine: what comes back, what is left, and what a machine that dies costs."""

import contextlib
import json
import os
import re
import shutil
import signal
import stat
import subprocess
import time
import unittest
from pathlib import Path

from trough_program import PROGRAM, EndToEndTest, campaign_text, engines_in, pause, wait_until, without_wall_time

# Nobody would stop this for an hour; a checkpoint comes soon.
ENDLESS = {"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 1000000, "output.checkpoint_cycles": 5}
# Long enough to be killed on the way, and then finished.
LONG = {"measure.packings": 2, "measure.max_packings": 2, "measure.half_width": 0.00001, "measure.max_cycles": 192, "output.checkpoint_cycles": 5}


class Scratch(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.scratch = self.folder / "node"
        self.scratch.mkdir()
        os.environ["VIBROTROUGH_TEST_SCRATCH"] = str(self.folder)
        self.addCleanup(os.environ.pop, "VIBROTROUGH_TEST_SCRATCH", None)

    def mount_small(self, place, size):
        """A small file system of its own."""
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", place], capture_output=True, text=True)
        if mounted.returncode != 0:
            self.skipTest(f"may not mount: {mounted.stderr}")
        self.addCleanup(subprocess.run, ["umount", "-l", place], check=True)

    def write(self, changes, scratch="$VIBROTROUGH_TEST_SCRATCH/node", name="campaign.toml", sweep=None):
        path = self.folder / name
        path.write_text(campaign_text(changes, sweep) + (f'[run]\nscratch = "{scratch}"\n' if scratch else ""))
        return path

    def packing(self, number=1):
        (case,) = (self.output / "cases").iterdir()
        return case / f"packing-{number}"

    def checkpoint(self):
        """The cycle of the checkpoint that came back."""
        seals = list(self.output.glob("cases/*/packing-1/checkpoint.json"))
        return json.loads(seals[0].read_text())["cycle"] if seals else 0

    def places(self):
        """The folders in which engines simulate now."""
        found = []
        for process in engines_in(self.scratch):
            try:
                place = Path(os.readlink(f"/proc/{process}/cwd"))
                if (place / "in.liggghts").is_file():
                    found.append(place)
            except OSError:
                pass  # ended meanwhile
        return found

    def wait_for_checkpoint(self, driver):
        wait_until(lambda: self.checkpoint() >= 5 and self.places(), "a checkpoint came back and an engine ran", driver)

    def kill(self, driver):
        driver.send_signal(signal.SIGKILL)
        self.finish(driver)
        wait_until(lambda: not engines_in(self.scratch), "the engines of the killed driver were gone")

    def test_the_digits_are_those_without_a_scratch_folder_and_all_files_are_there(self):
        changes = {"measure.packings": 2, "output.frames_per_cycle": 2, "output.contacts": True}
        self.run_campaign(self.write(changes, scratch=None), output=self.folder / "plain")
        self.run_campaign(self.write(changes))
        self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(self.folder / "plain")))
        own = lambda folder: {path.relative_to(folder) for path in folder.glob("cases/*/packing-*/**/*") if path.name != ".engine"}  # noqa: E731
        self.assertEqual(own(self.output), own(self.folder / "plain"))
        for name in own(self.output):
            if (self.output / name).is_file() and name.name not in ("packing.json", "engine.out", "log.liggghts"):
                self.assertEqual((self.output / name).read_bytes(), (self.folder / "plain" / name).read_bytes(), name)
        self.assertEqual(list(self.scratch.iterdir()), [], "nothing is left")

    def test_the_engine_writes_in_a_private_folder_only(self):
        driver = self.start_campaign(self.write(ENDLESS))
        (place,) = wait_until(self.places, "an engine ran", driver)
        self.assertEqual(place.parent, self.scratch)
        self.assertTrue(place.name.startswith("vibrotrough-scratch-"))
        self.assertEqual(stat.S_IMODE(place.stat().st_mode), 0o700)
        self.assertEqual(engines_in(self.output), [])
        self.wait_for_checkpoint(driver)
        self.assertFalse((self.packing() / ".engine").exists())
        for file in os.listdir(f"/proc/{engines_in(self.scratch)[0]}/fd"):
            self.assertNotIn(str(self.output), os.readlink(f"/proc/{engines_in(self.scratch)[0]}/fd/{file}"))
        driver.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(driver)[0], 130)
        reached = max(int(line.split(",")[0]) for line in (self.packing() / "cycles.csv").read_text().splitlines() if line[:1].isdigit())
        self.assertGreater(reached, 0)
        self.assertEqual((self.packing() / "checkpoints.txt").read_text().split()[-1], str(self.checkpoint()), "no cycle is lost")
        self.assertEqual(list(self.scratch.iterdir()), [])

    def test_killed_in_the_middle_it_goes_on_and_ends_with_the_same_digits(self):
        self.run_campaign(self.write(LONG, scratch=None), output=self.folder / "plain", wanted=None)
        campaign = self.write(LONG)
        driver = self.start_campaign(campaign)
        self.wait_for_checkpoint(driver)
        self.kill(driver)
        left = list(self.scratch.iterdir())
        self.assertTrue(left, "the control: what SIGKILL leaves")
        kept = self.checkpoint()
        self.assertGreater(kept, 0)
        self.run_campaign(campaign, wanted=None)
        self.assertIn(f"VIBROTROUGH BEGIN cycle {kept}\n", (self.packing() / "engine.out").read_text() + self.begun())
        self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(self.folder / "plain")))
        self.assertEqual(list(self.scratch.iterdir()), [], "the next run removes what was left")

    def begun(self):
        """All beginnings that the log names, which holds more than the last start."""
        return "".join(line + "\n" for line in (self.packing() / "log.liggghts").read_text().splitlines() if "VIBROTROUGH BEGIN" in line)

    def test_a_machine_that_dies_costs_what_was_not_brought_back(self):
        campaign = self.write(ENDLESS)
        driver = self.start_campaign(campaign)
        self.wait_for_checkpoint(driver)
        self.kill(driver)
        for left in self.scratch.iterdir():
            shutil.rmtree(left)  # and its disk with it
        kept = self.checkpoint()
        driver = self.start_campaign(campaign)

        def begun():
            for process in engines_in(self.scratch):
                words = Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")
                if b"done" in words:
                    return int(words[words.index(b"done") + 1])
            return None

        self.assertEqual(wait_until(begun, "the packing went on", driver), kept)
        driver.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(driver)[0], 130)

    def test_each_moment_of_the_way_back_is_that_of_a_killed_run(self):
        """What has come back when the driver dies between two files: with the old seal, or with the new one."""
        campaign = self.write(LONG | {"measure.packings": 1, "measure.max_packings": 1})
        driver = self.start_campaign(campaign)
        self.wait_for_checkpoint(driver)
        (place,) = self.places()
        self.assertTrue(pause(engines_in(self.scratch)[0]))
        self.kill(driver)
        packing, before = self.packing(), self.checkpoint()
        # All but the seal is newer.
        for file in place.iterdir():
            if file.name not in (".engine", "checkpoint.json") and ".part-" not in file.name:
                shutil.copy(file, packing / file.name)
        self.assertEqual(self.checkpoint(), before)
        self.run_campaign(campaign, wanted=None)
        campaign.write_text(campaign.read_text().partition("[run]")[0])
        self.run_campaign(campaign, output=self.folder / "plain", wanted=None)
        self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(self.folder / "plain")))

    def start_tasks(self, campaign):
        """One process for each task of the campaign, as on the nodes of a cluster."""
        tasks = self.folder / "tasks"
        prepared = self.call("prepare", campaign, "--output", self.output, "--task-list", tasks, "--liggghts", self.engine, "--accept-findings")
        self.assertEqual(prepared.returncode, 0, prepared.stderr)
        started = []
        for index in range(len(tasks.read_text().splitlines())):
            words = [PROGRAM, "work", self.output, "--task-list", tasks, "--index", index]
            started.append(subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True))
            self.addCleanup(self.end, started[-1])
        return started

    def files_of_packing(self):
        return {path.name: path.read_bytes() for path in self.packing().iterdir() if path.is_file()}

    def test_a_packing_that_a_task_has_is_left_alone(self):
        """Whether its engine works in a scratch folder or not, before the first checkpoint as after it."""
        for scratch in ("$VIBROTROUGH_TEST_SCRATCH/node", None):
            for cycles in (1000, 5):  # between two checkpoints
                with self.subTest(scratch=scratch, cycles=cycles):
                    self.output = self.folder / f"runs {scratch is None} {cycles}"
                    campaign = self.write(ENDLESS | {"output.checkpoint_cycles": cycles}, scratch)
                    (task,) = self.start_tasks(campaign)
                    place = self.scratch if scratch else self.output
                    wait_until(lambda: engines_in(place) and (self.checkpoint() or cycles > 5) and list(place.rglob("cycles.csv")), "the task simulated", task)  # noqa: B023
                    self.assertTrue(pause(engines_in(place)[0]))
                    self.assertTrue(pause(task.pid))
                    before, engines = self.files_of_packing(), engines_in(place)
                    done = self.run_campaign(campaign, wanted=3)
                    self.assertIn("another process runs packing 1 of case ", done.stderr)
                    self.assertEqual(self.files_of_packing(), before)
                    self.assertEqual(engines_in(place), engines)
                    # A lock ends with its process, whatever the engine is still about to do.
                    os.kill(task.pid, signal.SIGKILL)
                    self.finish(task)
                    begin = time.monotonic()
                    driver = self.start_campaign(campaign)
                    wait_until(lambda: set(engines_in(place)) - set(engines), "the packing went on", driver)  # noqa: B023
                    self.assertLess(time.monotonic() - begin, 8, "nobody waits for a lock")
                    self.assertEqual(set(engines_in(place)) & set(engines), set())
                    driver.send_signal(signal.SIGINT)
                    self.assertEqual(self.finish(driver)[0], 130)

    def test_two_tasks_settle_one_packing(self):
        """Each in a folder of its own, which a third driver does not take for that of a killed one."""
        campaign = self.write({"measure.packings": 1, "measure.max_packings": 1}, sweep={"trough.throw_number": [1.8, 2.0]})
        self.run_campaign(campaign, output=self.folder / "alone")
        self.settles_file.unlink()
        tasks = self.start_tasks(campaign)
        engines = set()

        def both_settle():
            for process in engines_in(self.scratch):
                if b"settle.liggghts" in Path(f"/proc/{process}/cmdline").read_bytes() and pause(process):
                    engines.add(process)
            return len(engines) == 2

        wait_until(both_settle, "both settled", tasks[0])
        settling = lambda: sorted(path.name for path in (self.output / "packings").iterdir())  # noqa: E731
        before = settling()
        self.assertEqual(len(before), 4, before)  # two folders with their locks
        done = self.run_campaign(campaign, wanted=3)
        self.assertIn("another process runs packing 1 of case ", done.stderr)
        self.assertEqual(settling(), before)
        for engine in engines:
            os.kill(engine, signal.SIGCONT)
        for task in tasks:
            self.assertEqual(self.finish(task)[0], 0)
        self.assertEqual(len(self.settles_file.read_text().splitlines()), 2)
        self.assertEqual(len(settling()), 1, "one of them is used, and nothing is left of the other")
        self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(self.folder / "alone")))

    def test_no_link_is_followed_on_the_way_back(self):
        precious = self.folder / "precious"
        precious.mkdir()
        (precious / "letter").write_text("dear")
        # In the place of the engine, and in the campaign's folder where the file comes back to.
        os.environ["VIBROTROUGH_TEST_BREAK"] = f"ln -sf '{precious}/letter' planted; ln -sf '{precious}' folder; mkfifo pipe"
        driver = self.start_campaign(self.write(ENDLESS))
        wait_until(self.places, "an engine ran", driver)
        (self.packing() / "phases.csv").symlink_to(precious / "letter")
        self.wait_for_checkpoint(driver)
        driver.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(driver)[0], 130)
        self.assertEqual([path.name for path in precious.iterdir()], ["letter"])
        self.assertEqual((precious / "letter").read_text(), "dear")
        self.assertFalse((self.packing() / "phases.csv").is_symlink())
        for name in ("planted", "folder", "pipe"):
            self.assertFalse(os.path.lexists(self.packing() / name), name)
        self.assertEqual(list(self.scratch.iterdir()), [])

    def test_a_scratch_folder_that_is_removed_is_not_the_engines_fault(self):
        driver = self.start_campaign(self.write(ENDLESS))
        (place,) = wait_until(self.places, "an engine ran", driver)
        shutil.rmtree(place)
        code, _, errors = self.finish(driver)
        self.assertEqual(code, 3, errors)
        self.assertIn(f"{place} was removed while an engine worked in it", errors)
        self.assertEqual(list(self.output.glob("cases/*/failure.json")), [])

    def test_a_full_scratch_folder_is_named(self):
        self.mount_small(self.scratch, "400k")
        done = self.run_campaign(self.write(ENDLESS), wanted=None)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"(disk-full|cannot write).*(scratch|node)")

    def fill_the_disk_of_the_campaign(self, campaign, is_time, wanted):
        """Until the driver has ended, from a moment in which its engine works. @return what the driver said"""
        ballast = self.output.parent / "ballast"
        driver = self.start_campaign(campaign)
        engine = wait_until(lambda: next((one for one in engines_in(self.scratch) if is_time(Path(f"/proc/{one}/cmdline").read_bytes())), None), "the engine worked", driver)
        self.assertTrue(pause(engine), "the engine ended too soon")
        self.assertTrue(pause(driver.pid))
        with contextlib.suppress(OSError), open(ballast, "wb", buffering=0) as file:
            while file.write(bytes(4096)):
                pass
        os.kill(engine, signal.SIGCONT)
        driver.send_signal(signal.SIGCONT)
        code, _, errors = self.finish(driver)
        self.assertIn(code, wanted, errors)
        said = re.search(r"case \w+: disk-full: .*No space left.*is kept in (\S*/vibrotrough-kept-\w+) on \S+: call the same command again", errors.replace(str(self.folder), "/folder"))
        self.assertTrue(said, errors)
        kept = self.folder / said[1].removeprefix("/folder/")
        self.assertEqual(list(self.scratch.iterdir()), [kept])
        self.assertEqual(stat.S_IMODE(kept.stat().st_mode), 0o700)
        refused = self.run_campaign(campaign, wanted=None)
        self.assertNotEqual(refused.returncode, 0, "the disk is still full")
        self.assertEqual(list(self.scratch.iterdir()), [kept])
        ballast.unlink()
        return errors

    def test_what_a_full_disk_does_not_take_back_is_not_lost(self):
        """Of a packing, and of a settling: the next run takes it, and no engine repeats it."""
        campaign = self.write({"measure.packings": 1, "measure.max_cycles": 24, "measure.half_width": 0.00001, "output.checkpoint_cycles": 5})
        self.run_campaign(campaign, output=self.folder / "plain", wanted=None)
        for deck, file in ((b"in.liggghts", self.starts_file), (b"settle.liggghts", self.settles_file)):
            with self.subTest(deck=deck):
                self.output = self.folder / deck.decode() / "runs"
                self.output.parent.mkdir()
                self.mount_small(self.output.parent, "4m")
                file.unlink()
                self.fill_the_disk_of_the_campaign(campaign, lambda words: deck in words, (1, 3))  # noqa: B023
                self.run_campaign(campaign, wanted=None)
                self.assertEqual(len(file.read_text().splitlines()), 1, "the work was done once")
                self.assertEqual(list(self.scratch.iterdir()), [])
                self.assertEqual(list(self.output.glob("cases/*/failure.json")), [])
                self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(self.folder / "plain")))

    def test_where_there_is_no_such_folder_it_is_said_in_one_line(self):
        for scratch, said in (("$VIBROTROUGH_NO_SUCH", "VIBROTROUGH_NO_SUCH is not set on "), ("$VIBROTROUGH_TEST_SCRATCH/nowhere", "there is no folder "),
                              ("/dev/null", "there is no folder /dev/null")):  # fmt: skip
            done = self.run_campaign(self.write(ENDLESS, scratch), wanted=3)
            self.assertIn(said, done.stderr.splitlines()[-1])
        for scratch in ("here", "$", "$A B/c", "../up", "~/x", "$(id)", "/tmp/\\u001b[2J"):
            done = self.run_campaign(self.write(ENDLESS, scratch), wanted=2)
            self.assertIn("run.scratch", done.stderr.splitlines()[-1])

    def test_tmpdir_is_that_of_the_machine(self):
        os.environ["TMPDIR"] = str(self.scratch)
        self.addCleanup(os.environ.pop, "TMPDIR", None)
        driver = self.start_campaign(self.write(ENDLESS, "$TMPDIR"))
        (place,) = wait_until(self.places, "an engine ran", driver)
        self.assertEqual(place.parent, self.scratch)
        driver.send_signal(signal.SIGINT)
        self.finish(driver)
        self.assertEqual(list(self.scratch.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
