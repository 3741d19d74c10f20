"""A full disk, a folder that nobody may write in, an engine that vanishes, a clock that jumps, too little memory."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from trough_program import (  # noqa: E402
    PATIENCE, PROGRAM, EndToEndTest, count_cycles, engines_in, fingerprint, pause, wait_until, without_wall_time)  # fmt: skip

SWEEP = {"layer.grains": [60, 70]}


class Trouble(EndToEndTest):
    def mount_small(self, size):
        """A small file system of its own, with the campaign's folder in it."""
        place = self.folder / "small disk"
        place.mkdir()
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", place], capture_output=True, text=True)
        if done.returncode != 0:
            if os.geteuid() == 0 and os.environ.get("CI"):
                self.fail(done.stderr)
            self.skipTest(f"may not mount: {done.stderr}")
        self.addCleanup(subprocess.run, ["umount", "-l", place], check=True)
        self.output = place / "runs"
        return place

    def failures(self):
        return [json.loads(path.read_text()) for path in sorted(self.output.glob("cases/*/failure.json"))]

    def test_a_disk_that_fills_up(self):
        place = self.mount_small("8m")
        campaign = self.write_campaign({"measure.packings": 2}, SWEEP)
        ballast = place / "ballast"
        driver = self.start_campaign(campaign)
        wait_until(lambda: list(self.output.glob("cases/*/packing-*/packing.json")), "a packing was finished", driver)
        self.assertTrue(pause(driver.pid), "the campaign was finished before the disk was full")
        try:
            with open(ballast, "wb") as file:
                while True:
                    file.write(bytes(4096))
                    file.flush()
        except OSError:
            pass
        driver.send_signal(signal.SIGCONT)
        code, output, errors = self.finish(driver)
        # The driver either cannot write down what it knows, and stops, or has said it of each case.
        self.assertIn(code, (1, 3), output + errors)
        self.assertRegex(errors, "No space left|disk-full|disk is full")
        kept = {path: fingerprint(path) for path in self.output.glob("cases/*/packing-*/packing.json")}
        self.assertTrue(kept)
        ballast.unlink()
        self.take_starts()
        self.run_campaign(campaign)
        self.assertEqual(self.failures(), [])
        for path, before in kept.items():
            self.assertEqual(fingerprint(path), before, f"{path} was written again")
        self.assertEqual([row["outcome"] for row in self.table()], ["finished"] * 2)
        elsewhere = self.folder / "elsewhere"
        self.run_campaign(campaign, output=elsewhere)
        self.assertEqual(without_wall_time(self.table()), without_wall_time(self.table(elsewhere)))

    def test_a_disk_that_is_full_before(self):
        place = self.mount_small("1m")
        try:
            with open(place / "ballast", "wb") as file:
                while file.write(bytes(4096)):
                    file.flush()
        except OSError:
            pass
        campaign = self.write_campaign({"measure.packings": 1})
        done = self.call(*self.run_arguments(campaign))
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"(?m)^vibrotrough: cannot write .*No space left.*$")

    def test_a_folder_that_may_only_be_read(self):
        place = self.mount_small("8m")
        campaign = self.write_campaign({"measure.packings": 1})
        self.run_campaign(campaign)
        table = self.table()
        subprocess.run(["mount", "-o", "remount,ro", place], check=True)
        self.assertEqual(self.table(), table, "a table needs no writing")
        self.assertEqual(self.ask_json("status")["finished"], 1)
        self.assert_one_line_error(self.call(*self.run_arguments(campaign)), 3, "Read-only file system")

    def test_an_engine_that_vanishes(self):
        real = shutil.which("liggghts")
        engine = self.folder / "my liggghts"
        engine.symlink_to(real)
        self.engine = engine
        campaign = self.write_campaign({"measure.packings": 2}, SWEEP)
        driver = self.start_campaign(campaign)
        wait_until(lambda: list(self.output.glob("cases/*/packing-*/packing.json")), "a packing was finished", driver)
        engine.unlink()
        code, output, errors = self.finish(driver)
        if code == 0:
            self.skipTest("the campaign was finished before the engine vanished")
        self.assertEqual(code, 3, output + errors)
        self.assertIn("is gone", errors)
        self.assertEqual(self.failures(), [], "a case has not failed because its engine is gone")
        engine.symlink_to(real)
        self.run_campaign(campaign)

    def test_a_clock_that_jumps(self):
        fake = shutil.which("faketime")
        self.assertIsNotNone(fake, "faketime is not installed: ./setup packages lists what the tests need")
        campaign = self.write_campaign({"measure.packings": 2}, SWEEP)
        arguments = [str(word) for word in self.run_arguments(campaign)]
        driver = subprocess.Popen([fake, "2035-01-01 00:00:00", PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, driver)
        wait_until(lambda: list(self.output.glob("cases/*/packing-*/packing.json")), "a packing was finished", driver)
        driver.send_signal(signal.SIGINT)
        self.finish(driver)
        kept = {path: fingerprint(path) for path in self.output.glob("cases/*/packing-*/packing.json")}
        # Back by a third of a century: nothing is younger than now, and nothing is run again.
        done = subprocess.run([fake, "2002-01-01 00:00:00", PROGRAM, *arguments], capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, 0, done.stderr)
        for path, before in kept.items():
            self.assertEqual(fingerprint(path), before, f"{path} was written again")
        for row in self.table():
            self.assertEqual(row["outcome"], "finished")
            self.assertGreater(row["wall_time_s"], 0)
            self.assertLess(row["wall_time_s"], 3600)

    def make_memory_group(self, limit):
        """A control group whose processes the kernel kills when they need more; its file of processes."""
        for root, name in ((Path("/sys/fs/cgroup/memory"), "memory.limit_in_bytes"), (Path("/sys/fs/cgroup"), "memory.max")):
            group = root / f"vibrotrough-test-{os.getpid()}"
            try:
                group.mkdir()
                self.addCleanup(group.rmdir)
                (group / name).write_text(str(limit))
                return group / "cgroup.procs"
            except OSError:
                pass
        self.skipTest("may not make a control group here")

    def test_too_little_memory(self):
        processes = self.make_memory_group(8 << 20)
        campaign = self.write_campaign({"measure.packings": 1})
        os.environ["VIBROTROUGH_TEST_BREAK"] = f"echo $$ > {processes}"
        done = self.call(*self.run_arguments(campaign))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        (failure,) = self.failures()
        self.assertEqual(failure["outcome"], "out-of-memory", failure)
        self.assertIn("memory", failure["try_again"])

    def test_a_time_limit(self):
        changes = {"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 1000000}
        campaign = self.write_campaign(changes)
        campaign.write_text(campaign.read_text() + '[run]\ntime_limit = "2 s"\nretries = 3\n')
        done = self.call(*self.run_arguments(campaign))  # without the limit it would run for hours
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        (failure,) = self.failures()
        self.assertEqual((failure["outcome"], failure["attempts"]), ("time-limit", 1))
        self.assertIn("more time", failure["try_again"])

    def test_an_engine_that_stands_still(self):
        """Without a time limit nothing ends it, and the run goes on when the engine does."""
        campaign = self.write_campaign({"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 1000000})
        driver = self.start_campaign(campaign)
        tables = wait_until(lambda: list(self.output.glob("cases/*/packing-1/cycles.csv")), "the packing ran", driver)
        wait_until(lambda: count_cycles(tables[0]) > 0, "a cycle was simulated", driver)
        engine = wait_until(lambda: next(filter(pause, engines_in(self.output)), None), "an engine was stopped", driver)
        time.sleep(3)
        self.assertIsNone(driver.poll())
        seen = count_cycles(tables[0])
        os.kill(engine, signal.SIGCONT)
        wait_until(lambda: count_cycles(tables[0]) > seen, "the run went on", driver)
        driver.send_signal(signal.SIGINT)
        code, output, errors = self.finish(driver)
        self.assertEqual(code, 130, output + errors)

    def test_retries_where_they_make_sense(self):
        campaign = self.write_campaign({"measure.packings": 1})
        campaign.write_text(campaign.read_text() + "[run]\nretries = 2\n")
        tries = self.folder / "tries"
        for last_words, code, count in (("kill -KILL $$", 0, 3), ("echo 'ERROR: no'; exit 1", 1, 1)):
            # Fails twice, then does its work.
            tries.unlink(missing_ok=True)
            shutil.rmtree(self.output, ignore_errors=True)
            os.environ["VIBROTROUGH_TEST_BREAK"] = (
                f'echo x >> "{tries}"; [ $(wc -l < "{tries}") -gt 2 ] || {{ {last_words}; }}'
            )
            done = self.call(*self.run_arguments(campaign))
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            self.assertGreaterEqual(len(tries.read_text().splitlines()), count)

    def test_a_simulation_that_blows_up(self):
        campaign = self.write_campaign({"measure.packings": 1})
        # The real engine's cycles, the last of them spoilt as an explosion does it.
        os.environ["VIBROTROUGH_TEST_BREAK"] = (
            f'VIBROTROUGH_TEST_BREAK= "{self.engine}" "$@"; code=$?; '
            "[ -f cycles.csv ] && sed -i '$s/,[^,]*,[^,]*$/,nan,nan/' cycles.csv; exit $code"
        )
        done = self.call(*self.run_arguments(campaign))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        (failure,) = self.failures()
        self.assertEqual(failure["outcome"], "diverged", failure)

    def test_progress_for_programs(self):
        campaign = self.write_campaign({"measure.packings": 2}, SWEEP)
        self.run_campaign(campaign)  # probes the engine, if no test has before
        shutil.rmtree(self.output)
        done = self.call(*self.run_arguments(campaign), "--progress", "json")
        events = [json.loads(line) for line in done.stderr.splitlines() if line.startswith("{")]
        self.assertEqual({event["event"] for event in events}, {"progress", "case_ended"})
        last = events[-1]
        self.assertEqual([last[key] for key in ("event", "finished", "left", "running")], ["progress", 2, 0, 0])
        self.assertGreater(last["core_time_s"], 0)
        shutil.rmtree(self.output)
        quiet = self.call(*self.run_arguments(campaign), "--quiet").stderr
        self.assertNotRegex(quiet, "done,|: finished", "what the check warns of is all")
        log = (self.output / "campaign.log").read_text()
        self.assertRegex(log, r"(?m)^\d{4}-\d\d-\d\dT[\d:]+Z info run starts: vibrotrough .*$")
        self.assertEqual(log.count(": finished\n"), 2)
        self.assertIn("run ends: 2 of 2 cases finished\n", log)

    def test_progress_tells_what_the_engines_measure(self):
        """However fast they are: this one goes on until it is stopped."""
        campaign = self.write_campaign({"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 1000000})
        driver = subprocess.Popen([PROGRAM, *map(str, self.run_arguments(campaign)), "--progress", "json"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)  # fmt: skip
        self.addCleanup(self.end, driver)
        for line in driver.stderr:
            engines = json.loads(line).get("engines", []) if line.startswith("{") else []
            if any(engine["efficiency"] is not None for engine in engines):
                break
        else:
            self.fail(f"no line told of an efficiency before the run ended with {driver.wait()}")
        driver.send_signal(signal.SIGINT)
        code, output, errors = self.finish(driver)
        self.assertEqual(code, 130, output + errors)


if __name__ == "__main__":
    unittest.main()
