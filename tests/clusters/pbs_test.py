"""Campaigns through a PBS that behaves as its manual pages say: submitted, watched, with tasks killed on the way, refused, and finished."""

import os
import re
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from private_pbs import RUN_ON_PBS, PrivatePbs  # noqa: E402
from trough_program import PROGRAM, EndToEndTest, campaign_text, engines_in, fingerprint, pause, wait_until, without_wall_time  # noqa: E402

SWEEP = {"layer.grains": [60, 70, 80]}
CHANGES = {"measure.packings": 2}
ENDLESS = {"measure.half_width": 0.00001, "measure.max_cycles": 1000000}


def parent_of(process):
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


class Pbs(EndToEndTest):
    def setUp(self):
        super().setUp()
        # A name that would do harm in a script that is not careful.
        self.output = self.folder / "runs $(touch hacked) & 'quoted'"

    def start_pbs(self, **settings):
        pbs = PrivatePbs(**settings)
        pbs.__enter__()
        self.addCleanup(pbs.__exit__)
        self.addCleanup(os.environ.__setitem__, "PATH", os.environ["PATH"])
        os.environ["PATH"] = pbs.path
        return pbs

    def write_pbs_campaign(self, asked=RUN_ON_PBS, changes=CHANGES, sweep=SWEEP):
        path = self.folder / "campaign.toml"
        path.write_text(campaign_text(changes, sweep) + asked)
        return path

    def assert_refused(self, done, *parts):
        """In one line, below what the check of the campaign may have warned of."""
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        last = done.stderr.splitlines()[-1]
        self.assertTrue(last.startswith("vibrotrough: "), done.stderr)
        for part in parts:
            self.assertIn(part, last)

    def catch_a_simulation(self):
        """Stops an engine, so that it does not end before the test has done to it what it wants."""

        def found():
            for number in engines_in(self.output):
                try:
                    if "packing" in os.readlink(f"/proc/{number}/cwd") and pause(number):
                        return number
                except OSError:
                    pass  # ended meanwhile
            return None

        return wait_until(found, "an engine ran")

    def kill_task_of(self, engine):
        """The task's shell, so that it has no last word of its own, and what it started."""
        work = parent_of(engine)
        shell = parent_of(work)
        self.assertGreater(min(work, shell), 1)
        for process in (shell, work, engine):
            os.kill(process, signal.SIGKILL)

    def wait_for_the_end(self):
        def over():
            status = self.ask_json("status")
            outcomes = {case["outcome"] for case in status["cases"]}
            return not outcomes & {"queued", "running", "unknown"} and status

        return wait_until(over, "no task was left in PBS")

    def count_submitted(self):
        return sum(len(path.read_text().splitlines()) for path in self.output.glob("pbs/*/tasks.txt"))

    def test_a_campaign_with_a_task_killed_on_the_way(self):
        pbs = self.start_pbs(max_array_size=4)  # 6 packings make two arrays
        campaign = self.write_pbs_campaign()
        done = self.run_campaign(campaign)
        self.assertRegex(done.stdout, r"0 of 3 cases finished; 6 packings submitted as job 1, 2\n")
        self.assertEqual({case["outcome"] for case in self.ask_json("status")["cases"]} - {"queued", "running"}, set())
        words = pbs.known()["jobs"][0]["words"]
        for pair in (["-q", "workq"], ["-l", "walltime=0:10:00"], ["-l", "select=1:ncpus=1:mpiprocs=1:mem=200mb"]):
            self.assertIn(pair, [words[at : at + 2] for at in range(len(words))])

        # What is in the queue is not submitted twice.
        self.assertRegex(self.run_campaign(campaign).stdout, r"packings are in PBS's queue already\n")
        self.assertEqual(self.count_submitted(), 6)

        self.kill_task_of(self.catch_a_simulation())
        status = self.wait_for_the_end()
        cut = [case for case in status["cases"] if case["outcome"] == "interrupted"]
        self.assertEqual(len(cut), 1, status)
        self.assertRegex(cut[0]["message"], r"PBS says [FX] \(Exit_status 265\) of task \d\[\d\]\.pbs")
        kept = {path: fingerprint(path) for path in self.output.glob("cases/*/packing-*/packing.json")}
        self.assertEqual(len(kept), 5)

        self.take_starts()
        done = self.run_campaign(campaign)
        self.assertRegex(done.stdout, r"1 packings submitted as job 3 \(1 of them again\)\n")
        self.assertNotIn("-J", pbs.known()["jobs"][2]["words"], "PBS refuses an array of one task")
        status = self.wait_for_the_end()
        self.assertEqual(status["finished"], 3, status)
        self.assertEqual(len(self.take_starts()), 1, "only what died was run again")
        for path, before in kept.items():
            self.assertEqual(fingerprint(path), before, f"{path} was written again")
        self.assertFalse((self.folder / "hacked").exists() or (self.output / "hacked").exists())
        self.assertIn("engine: ", (self.output / "pbs" / "0001" / "task-0.out").read_text())

        # The same numbers as on this machine without PBS; how a case is run does not change its id.
        self.assertIn("3 of 3 cases finished\n", self.run_campaign(campaign).stdout)
        through_pbs = without_wall_time(self.table())
        campaign.write_text(campaign_text(CHANGES, SWEEP))
        local = self.folder / "local"
        self.run_campaign(campaign, output=local)
        self.assertEqual(through_pbs, without_wall_time(self.table(local)))

    def test_a_server_that_does_not_answer_is_no_end(self):
        pbs = self.start_pbs()
        campaign = self.write_pbs_campaign(changes={"measure.packings": 1}, sweep=None)
        self.run_campaign(campaign)
        engine = self.catch_a_simulation()  # held, so that the task cannot end while nobody answers
        pbs.change(answers=False)
        self.assertEqual({case["outcome"] for case in self.ask_json("status")["cases"]}, {"unknown"})
        self.assert_refused(self.call(*self.run_arguments(campaign)), "PBS does not answer")
        pbs.change(answers=True)
        os.kill(engine, signal.SIGCONT)
        self.assertEqual(self.wait_for_the_end()["finished"], 1)

    def test_a_task_that_the_server_has_forgotten_is_lost(self):
        for history in (True, False):
            with self.subTest(history=history):
                self.output = self.folder / f"runs-{history}"
                pbs = self.start_pbs(history=history)
                campaign = self.write_pbs_campaign(changes=ENDLESS | {"measure.packings": 1}, sweep={"layer.grains": [60, 70]})
                self.run_campaign(campaign)
                for _ in range(2):
                    self.kill_task_of(self.catch_a_simulation())
                if history:
                    wait_until(lambda: all(task["state"] == "X" for task in pbs.known()["jobs"][0]["tasks"]), "both tasks had ended")  # noqa: B023
                    pbs.forget()
                status = self.wait_for_the_end()
                self.assertEqual([case["outcome"] for case in status["cases"]], ["interrupted"] * 2)
                for case in status["cases"]:
                    self.assertRegex(case["message"], r"PBS no longer knows task \d of job 1, which ended without writing its exit marker")

    def test_a_driver_that_died_after_submission_finds_its_job(self):
        pbs = self.start_pbs(cpus=0)  # nothing starts, so that no task has written down its job
        campaign = self.write_pbs_campaign(changes={"measure.packings": 2}, sweep=None)
        self.run_campaign(campaign)
        batch = self.output / "pbs" / "0001" / "batch.json"
        batch.write_text(re.sub(r',\s*"job": \d+', "", batch.read_text()))
        self.assertNotIn('"job"', batch.read_text())
        self.assertEqual({case["outcome"] for case in self.ask_json("status")["cases"]}, {"queued"})
        self.run_campaign(campaign)
        self.assertEqual(len(pbs.known()["jobs"]), 1, "nothing is submitted twice")

    def test_killed_for_its_time_is_said(self):
        # The program's own limit comes before that of the scheduler; a short minute of the scheduler's turns this round.
        self.start_pbs(minute=5)
        asked = RUN_ON_PBS.replace('"10 minutes"', '"1 minute"')
        campaign = self.write_pbs_campaign(asked, ENDLESS | {"measure.packings": 1}, None)
        self.run_campaign(campaign)
        status = self.wait_for_the_end()
        self.assertEqual([case["outcome"] for case in status["cases"]], ["time-limit"], status)
        self.assertIn("Exit_status -29", status["cases"][0]["message"])

    def test_what_pbs_refuses_is_said_in_one_line(self):
        self.start_pbs()
        for asked, *parts in (
            ('[run]\nexecutor = "pbs"\n[run.pbs]\nqueue = "nowhere"\n', "PBS does not take the job", "Unknown queue", "[run.pbs]"),
            ('[run]\nexecutor = "pbs"\n[run.pbs]\nqueue = "short"\ntime = "2 hours"\n', "violates queue and/or server resource limits"),
        ):  # fmt: skip
            campaign = self.write_pbs_campaign(asked)
            self.assert_refused(self.call(*self.run_arguments(campaign)), *parts)
            self.assertEqual(self.ask_json("status")["left"], 3)
            self.assertEqual(self.count_submitted(), 0)
        os.environ["PATH"] = "/usr/bin:/bin"
        self.assert_refused(self.call(*self.run_arguments(campaign)), "there is no qsub here")

    def test_a_site_can_ask_for_more_and_set_up_its_tasks(self):
        pbs = self.start_pbs()
        more = 'extra = ["-lplace=excl", "-p10"]\nconcurrent_tasks = 1\nsetup = ["export GREETING=hello", "echo setup says $GREETING"]\n'
        campaign = self.write_pbs_campaign(RUN_ON_PBS + more, CHANGES, None)
        refused = self.call(*self.run_arguments(campaign))
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("these lines of run.pbs.setup: export GREETING=hello ; echo setup says $GREETING; ", refused.stderr)
        self.assertFalse((self.output / "pbs").exists())
        done = self.call(*self.run_arguments(campaign), "--allow-setup")
        self.assertEqual(done.returncode, 0, done.stderr)
        words = pbs.known()["jobs"][0]["words"]
        self.assertTrue({"-lplace=excl", "-p10", "max_run_subjobs=1"} <= set(words), words)
        self.assertEqual(self.wait_for_the_end()["finished"], 1)
        self.assertIn("setup says hello\n", (self.output / "pbs" / "0001" / "task-0.out").read_text())

    def test_waits_for_room_and_ends(self):
        """8 packings where an array may have 3 tasks and the queue holds 4."""
        self.start_pbs(max_array_size=3, max_queued=4)
        campaign = self.write_pbs_campaign(changes={"measure.packings": 4}, sweep={"layer.grains": [60, 70]})
        done = self.run_campaign(campaign)
        taken = self.count_submitted()
        self.assertIn(taken, range(1, 5))
        self.assertRegex(done.stdout, rf"; {taken} packings submitted as job [0-9, ]+; PBS has no room for {8 - taken} packings now: ")
        process = subprocess.Popen([PROGRAM, *map(str, self.run_arguments(campaign)), "--wait"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, process)
        code, output, errors = self.finish(process)
        self.assertEqual(code, 0, output + errors)
        self.assertEqual(self.ask_json("status")["finished"], 2)
        self.assertEqual(self.count_submitted(), 8, "a packing was submitted twice")

    def test_what_waits_for_a_failed_case_is_cancelled(self):
        pbs = self.start_pbs(cpus=1)
        os.environ["VIBROTROUGH_TEST_BREAK"] = "sleep 3; exit 5"  # every engine fails, but not at once
        campaign = self.write_pbs_campaign(changes={"measure.packings": 6}, sweep=None)
        done = self.call(*self.run_arguments(campaign), "--wait")
        self.assertIn("0 of 1 cases finished, 1 failed", done.stdout, done.stderr)
        deleted = pbs.known()["deleted"]
        self.assertTrue(deleted, "the tasks that waited were taken out of the queue")
        self.assertTrue(all(re.fullmatch(r"1\[\d\]", word) for word in deleted), deleted)
        self.assertEqual(self.wait_for_the_end()["failed"], 1)
        self.assertLess(sum(task.get("status") is not None for task in pbs.known()["jobs"][0]["tasks"]), 6)


if __name__ == "__main__":
    unittest.main()
