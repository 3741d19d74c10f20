"""A real small campaign through a real Slurm: submitted, watched, with tasks killed on the way, and finished."""

import collections
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from private_slurm import RUN_ON_SLURM, PrivateSlurm  # noqa: E402
from trough_program import PROGRAM, EndToEndTest, at_night, campaign_text, engines_in, fingerprint, pause, wait_until, without_wall_time  # noqa: E402

SWEEP = {"layer.grains": [60, 70, 80]}
CHANGES = {"measure.packings": 2}


def parent_of(process):
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


class Slurm(EndToEndTest):
    def setUp(self):
        super().setUp()
        # A name that would do harm in a script that is not careful.
        self.output = self.folder / "runs $(touch hacked) & 'quoted'"

    def start_slurm(self, **settings):
        return PrivateSlurm.for_test(self, **settings)

    def write_slurm_campaign(self, asked=RUN_ON_SLURM, changes=CHANGES, sweep=SWEEP):
        path = self.folder / "campaign.toml"
        path.write_text(campaign_text(changes, sweep) + asked)
        return path

    def assert_refused(self, done, *parts):
        """In one line, below what the check of the campaign may have warned of."""
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        lines = [line for line in done.stderr.splitlines() if line.startswith("vibrotrough: ")]
        self.assertEqual(done.stderr.splitlines()[-1:], lines)
        for part in parts:
            self.assertIn(part, lines[0])

    def simulations(self):
        """Engines that simulate; each task also asks one for its version."""
        found = []
        for number in engines_in(self.output):
            try:
                if "packing" in os.readlink(f"/proc/{number}/cwd"):
                    found.append(number)
            except OSError:
                pass  # ended meanwhile
        return found

    def catch_a_simulation(self, besides=None):
        """Stops an engine, so that it does not end before the test has done to it what it wants."""
        found = lambda: next((one for one in self.simulations() if one != besides and pause(one)), None)  # noqa: E731
        return wait_until(found, "an engine ran")

    def status(self):
        return self.ask_json("status")

    def wait_for_the_end(self):
        def over():
            status = self.status()
            outcomes = {case["outcome"] for case in status["cases"]}
            return not outcomes & {"queued", "running", "unknown"} and status

        return wait_until(over, "no task was left in Slurm")

    def count_submitted(self):
        return sum(len(path.read_text().splitlines()) for path in self.output.glob("slurm/*/tasks.txt"))

    def test_a_campaign_with_tasks_killed_on_the_way(self):
        self.start_slurm(cpus=2, max_array=5)  # arrays of at most 4 tasks, so that 6 packings make two
        campaign = self.write_slurm_campaign()
        done = self.run_campaign(campaign)
        self.assertRegex(done.stdout, r"0 of 3 cases finished; 6 packings submitted as job \d+, \d+\n")
        self.assertEqual({case["outcome"] for case in self.status()["cases"]} - {"queued", "running"}, set())

        # What is in the queue is not submitted twice.
        done = self.run_campaign(campaign)
        self.assertRegex(done.stdout, r"packings are in Slurm's queue already\n")
        self.assertEqual(self.count_submitted(), 6)

        # One task dies without its shell, one with it: the first leaves its exit code, of the other Slurm knows.
        engine = self.catch_a_simulation()
        os.kill(parent_of(engine), signal.SIGKILL)
        other = self.catch_a_simulation(besides=engine)
        work = parent_of(other)
        os.kill(parent_of(work), signal.SIGKILL)
        os.kill(work, signal.SIGKILL)
        status = self.wait_for_the_end()
        self.assertEqual(status["failed"], 0, status)
        cut = [case for case in status["cases"] if case["outcome"] == "interrupted"]
        self.assertEqual(sum(2 - case["packings_done"] for case in status["cases"]), 2, status)
        told = " ".join(case["message"] for case in cut)
        self.assertRegex(told, "exit code 137|Slurm says")
        kept = {path: fingerprint(path) for path in self.output.glob("cases/*/packing-*/packing.json")}
        self.assertEqual(len(kept), 4)

        self.take_starts()
        done = self.run_campaign(campaign)
        self.assertRegex(done.stdout, r"2 packings submitted as job \d+ \(2 of them again\)\n")
        status = self.wait_for_the_end()
        self.assertEqual(status["finished"], 3, status)
        self.assertEqual(len(self.take_starts()), 2, "only what died was run again")
        for path, before in kept.items():
            self.assertEqual(fingerprint(path), before, f"{path} was written again")
        self.assertFalse((self.folder / "hacked").exists() or (self.output / "hacked").exists())

        # The same numbers as on this machine without Slurm; how a case is run does not change its id.
        self.assertIn("3 of 3 cases finished\n", self.run_campaign(campaign).stdout)
        through_slurm = without_wall_time(self.table())
        campaign.write_text(campaign_text(CHANGES, SWEEP))
        local = self.folder / "local"
        self.run_campaign(campaign, output=local)
        self.assertEqual(through_slurm, without_wall_time(self.table(local)))

    @at_night
    def test_a_controller_that_does_not_answer_is_no_end(self):
        slurm = self.start_slurm(cpus=2)
        campaign = self.write_slurm_campaign(changes={"measure.packings": 1}, sweep=None)
        self.run_campaign(campaign)
        engine = self.catch_a_simulation()  # held, so that the task cannot end while nobody answers
        slurm.stop("slurmctld")
        self.assertEqual({case["outcome"] for case in self.status()["cases"]}, {"unknown"})
        self.assert_refused(self.call(*self.run_arguments(campaign)), "Slurm does not answer")
        slurm.start_controller()
        os.kill(engine, signal.SIGCONT)
        self.wait_for_the_end()
        self.run_campaign(campaign)
        status = self.wait_for_the_end()
        self.assertEqual(status["finished"], 1, status)

    def test_what_the_controller_forgot_is_in_the_accounting(self):
        slurm = self.start_slurm(cpus=1, accounting=True)
        # Nobody would stop these for an hour: one runs, one waits.
        changes = {"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 1000000}
        campaign = self.write_slurm_campaign(changes=changes, sweep={"layer.grains": [60, 70]})
        job = re.search(r"submitted as job (\d+)\n", self.run_campaign(campaign).stdout)[1]
        engine = self.catch_a_simulation()
        slurm.command("scancel", f"{job}_1")
        work = parent_of(engine)
        os.kill(parent_of(work), signal.SIGKILL)  # the task's shell: no last word of its own
        os.kill(work, signal.SIGKILL)

        def told():
            return slurm.command("sacct", "-n", "-P", "-X", "-j", job, "-o", "JobID,State").stdout.splitlines()

        wanted = [f"{job}_0|FAILED", f"{job}_1|CANCELLED by {os.getuid()}"]
        wait_until(lambda: sorted(told()) == wanted, "the accounting knew both tasks")
        slurm.stop("slurmctld")
        slurm.start_controller(forgetful=True)
        self.assertIn("Invalid job id", slurm.command("squeue", "-h", "-j", job).stderr)

        status = self.status()
        self.assertEqual([case["outcome"] for case in status["cases"]], ["interrupted"] * 2)
        found = sorted(case["message"] for case in status["cases"])
        self.assertRegex(found[0], rf"Slurm says CANCELLED.* of task {job}_1")
        self.assertRegex(found[1], rf"Slurm says FAILED.* of task {job}_0")

    @at_night
    def test_what_slurm_refuses_is_said_in_one_line(self):
        self.start_slurm(cpus=1)
        for asked, *parts in (
            ('[run]\nexecutor = "slurm"\n[run.slurm]\npartition = "nowhere"\n', "Slurm does not take the job", "partition"),
            ('[run]\nexecutor = "slurm"\n[run.slurm]\npartition = "short"\ntime = "2 hours"\n', "has a limit of 5 minutes, and run.slurm.time asks for 120"),
        ):  # fmt: skip
            campaign = self.write_slurm_campaign(asked)
            self.assert_refused(self.call(*self.run_arguments(campaign)), *parts)
            self.assertEqual(self.status()["left"], 3)
            self.assertEqual(self.count_submitted(), 0)

    @at_night
    def test_a_site_can_ask_for_more_and_set_up_its_tasks(self):
        slurm = self.start_slurm(cpus=1)
        more = 'extra = ["--comment=from-the-campaign"]\nsetup = ["export GREETING=hello", "echo setup says $GREETING"]\n'
        campaign = self.write_slurm_campaign(RUN_ON_SLURM + more, {"measure.packings": 1}, None)

        # The lines of setup are commands: they are shown, and run only when the person says so.
        refused = self.call(*self.run_arguments(campaign))
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertRegex(refused.stderr, r"export GREETING=hello ; echo setup says \$GREETING; .*--allow-setup")
        self.assertFalse((self.output / "slurm").exists())

        done = self.call(*self.run_arguments(campaign), "--allow-setup")
        self.assertEqual(done.returncode, 0, done.stderr)
        job = re.search(r"submitted as job (\d+)\n", done.stdout)[1]
        self.assertEqual(slurm.command("scontrol", "show", "job", job).stdout.count("Comment=from-the-campaign"), 1)
        self.assertEqual(self.wait_for_the_end()["finished"], 1)
        self.assertIn("setup says hello\n", (self.output / "slurm" / "0001" / "task-0.out").read_text())

        # A line that fails ends the task before the engine starts, and says which line it was.
        self.output = self.folder / "other"
        campaign = self.write_slurm_campaign(RUN_ON_SLURM + 'setup = ["true", "(exit 5)"]\n', {"measure.packings": 1}, None)
        self.take_starts()
        self.call(*self.run_arguments(campaign), "--allow-setup")
        status = self.wait_for_the_end()
        self.assertEqual([case["outcome"] for case in status["cases"]], ["interrupted"], status)
        self.assertIn("ended with exit code 5", status["cases"][0]["message"])
        self.assertIn("line 2 of run.slurm.setup", (self.output / "slurm" / "0001" / "task-0.out").read_text())

    def test_several_packings_in_one_task(self):
        slurm = self.start_slurm(cpus=1)
        campaign = self.write_slurm_campaign(RUN_ON_SLURM + "minutes_per_task = 60\n", {"measure.packings": 3}, {"layer.grains": [60, 70]})
        done = self.run_campaign(campaign)
        job = re.search(r"6 packings submitted as job (\d+)\n", done.stdout)[1]
        self.assertEqual(self.count_submitted(), 1)
        self.assertIn("TimeLimit=01:00:00", slurm.command("scontrol", "show", "job", job).stdout, "six packings of ten minutes")

        # The task dies on its way: what is finished stays, and only the others are submitted again.
        wait_until(lambda: list(self.output.glob("cases/*/packing-*/packing.json")), "one packing was finished")
        work = parent_of(self.catch_a_simulation())
        os.kill(parent_of(work), signal.SIGKILL)
        os.kill(work, signal.SIGKILL)
        status = self.wait_for_the_end()
        done = sum(case["packings_done"] for case in status["cases"])
        self.assertIn(done, range(1, 6), status)
        left = 6 - done
        self.assertRegex(self.run_campaign(campaign).stdout, rf"{left} packings submitted as job \d+ \({left} of them again\)\n")
        self.assertEqual(self.wait_for_the_end()["finished"], 2)

    def test_one_question_to_slurm_for_all_tasks(self):
        slurm = self.start_slurm(cpus=1, max_array=3)  # arrays of at most 2 tasks, so that 6 packings make three
        campaign = self.write_slurm_campaign(changes={"measure.packings": 2, "measure.half_width": 0.00001, "measure.max_cycles": 1000000})
        self.run_campaign(campaign)
        self.catch_a_simulation()  # nothing ends
        asked = self.count_questions(slurm)
        self.status()
        self.assertEqual(asked(), {"squeue": 1, "sacct": 1})

    def count_questions(self, slurm):
        """Puts scripts that count before squeue and sacct on the PATH."""
        folder, counts = self.folder / "counted", self.folder / "questions"
        folder.mkdir()
        for name in ("squeue", "sacct"):
            script = folder / name
            script.write_text(f'#!/bin/sh\necho {name} >> "{counts}"\nexec {shutil.which(name)} "$@"\n')
            script.chmod(0o755)
        path = os.environ["PATH"]
        os.environ["PATH"] = f"{folder}:{path}"
        self.addCleanup(os.environ.__setitem__, "PATH", path)
        return lambda: dict(collections.Counter(counts.read_text().split()))

    @at_night
    def test_a_campaign_larger_than_the_limits_of_the_array_and_of_the_jobs_ends(self):
        """8 packings where an array may have 3 tasks and Slurm keeps 4 jobs, each of them until 2 s after its end."""
        slurm = self.start_slurm(cpus=2, max_array=4, max_jobs=4, job_age=2)
        campaign = self.write_slurm_campaign(changes=CHANGES | {"measure.packings": 4}, sweep={"layer.grains": [60, 70]})

        # Without --wait: what Slurm takes is submitted, and the rest is said; nothing is left of what it did not take.
        done = self.run_campaign(campaign)
        taken = self.count_submitted()
        self.assertIn(taken, range(1, 5))
        self.assertRegex(done.stdout, rf"; {taken} packings submitted as job [0-9, ]+; Slurm has no room for {8 - taken} packings now: ")
        for folder in (self.output / "slurm").iterdir():
            self.assertIn("job", (folder / "batch.json").read_text(), folder)

        # With it: they are submitted as others end, and the campaign ends although Slurm is never able to hold all of it.
        most = []
        process = subprocess.Popen([PROGRAM, *map(str, self.run_arguments(campaign)), "--wait"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, process)
        while process.poll() is None:
            most.append(len(slurm.command("squeue", "-h", "-r", "-t", "all").stdout.splitlines()))
            time.sleep(0.2)
        code, output, errors = self.finish(process)
        self.assertEqual(code, 0, output + errors)
        self.assertLessEqual(max(most), 4)
        self.assertEqual(self.status()["finished"], 2)
        self.assertEqual(self.count_submitted(), 8, "a packing was submitted twice")
        self.assertEqual(self.take_starts(), sorted({f"{case['case']}/packing-{n}" for case in self.table() for n in range(1, 5)}))

    @at_night
    def test_a_task_out_of_time_says_so(self):
        self.start_slurm(cpus=2)
        # Two seconds for a packing that nobody would stop for an hour.
        campaign = self.write_slurm_campaign(
            RUN_ON_SLURM.replace("[run.slurm]", 'time_limit = "2 s"\n[run.slurm]'),
            {"measure.packings": 1, "measure.half_width": 0.00001, "measure.max_cycles": 1000000}, None,
        )  # fmt: skip
        self.run_campaign(campaign)
        status = self.wait_for_the_end()
        self.assertEqual([case["outcome"] for case in status["cases"]], ["time-limit"])
        self.assertEqual(status["failed"], 1)


if __name__ == "__main__":
    unittest.main()
