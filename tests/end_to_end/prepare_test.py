"""A campaign on a cluster whose scheduler the program does not know: task lists, run by GNU parallel on two "nodes"."""

import json
import os
import shlex
import shutil
import signal
import subprocess
import unittest

from trough_program import PATIENCE, PROGRAM, EndToEndTest, engines_in, fingerprint, pause, wait_until, without_wall_time

SWEEP = {"layer.grains": [60, 70]}
# A second round: two packings of 24 cycles are not precise enough, and one may be added.
ROUNDS = {"measure.packings": 2, "measure.max_packings": 3, "measure.half_width": 0.02, "measure.max_cycles": 24}
MOST_ROUNDS = 10


class Prepare(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.list = self.folder / "tasks of a round.txt"

    def prepare(self, campaign, *options, wanted=0):
        words = ["prepare", campaign, "--output", self.output, "--task-list", self.list, "--liggghts", self.engine, "--accept-findings", *options]
        done = self.call(*words)
        self.assertEqual(done.returncode, wanted, done.stdout + done.stderr)
        return done

    def tasks(self):
        return self.list.read_text().splitlines()

    def start_node(self, indices):
        """GNU parallel with the tasks of one node, two at a time."""
        program = shutil.which("parallel")
        self.assertIsNotNone(program, "this test needs GNU parallel")
        work = shlex.join([PROGRAM, "work", str(self.output), "--task-list", str(self.list), "--index"]) + " {}"
        node = subprocess.Popen([program, "--will-cite", "-j", "2", work, ":::", *map(str, indices)], cwd="/", stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)  # fmt: skip
        self.addCleanup(self.end, node)
        return node

    def run_tasks(self):
        count = len(self.tasks())
        nodes = [self.start_node(range(i, count, 2)) for i in range(2) if i < count]
        for node in nodes:
            output, _ = node.communicate(timeout=PATIENCE)
            self.assertEqual(node.returncode, 0, output)

    def test_rounds_on_two_nodes_give_the_numbers_of_a_local_run(self):
        campaign = self.write_campaign(ROUNDS, SWEEP)
        done = self.prepare(campaign)
        self.assertEqual(len(self.tasks()), 4)
        self.assertIn("0 of 2 cases have ended; 4 tasks in ", done.stdout)
        self.assertIn(f"--task-list {shlex.quote(str(self.list))} --index $i", done.stdout)
        self.assertEqual(self.take_starts(), [], "nothing is simulated")
        rounds = 0
        while self.tasks():
            rounds += 1
            self.assertLess(rounds, MOST_ROUNDS)
            self.run_tasks()
            done = self.prepare(campaign)
        self.assertGreater(rounds, 1, "the test is about rounds")
        self.assertIn("2 of 2 cases have ended\nnothing is missing", done.stdout)
        by_tasks = without_wall_time(self.table())
        local = self.folder / "local"
        self.run_campaign(campaign, output=local, wanted=None)
        self.assertEqual(by_tasks, without_wall_time(self.table(local)))

    def test_what_learn_wants_is_for_the_tasks_of_learn(self):
        """learn.json asks for less than the campaign file: `work` stops early only where learn started it."""
        campaign = self.write_campaign(ROUNDS)
        self.prepare(campaign)
        case = self.tasks()[0].split()[0]
        # Wider than the interval of two packings by far, whose Student factor is 25.
        wanted = {"format": "vibrotrough learn", "schema_version": 1, "half_widths": {case: 50.0}}
        (self.output / "learn.json").write_text(json.dumps(wanted))
        self.run_tasks()
        self.assertEqual(self.results(), [], "two packings are not enough for the campaign file")
        words = ["work", self.output, "--task-list", self.list, "--index", 0]
        learning = self.call(*words, "--learning")
        self.assertEqual(learning.returncode, 0, learning.stderr)
        self.assertEqual(len(self.results()), 1, "but for learn they are")
        self.prepare(campaign)
        self.assertEqual([line.split()[1] for line in self.tasks()], ["3"])
        self.run_tasks()
        self.assertIn("1 of 1 cases have ended\nnothing is missing", self.prepare(campaign).stdout)
        self.assertEqual([row["packings"] for row in self.table()], [3])

    def test_a_task_takes_as_many_minutes_as_it_is_told(self):
        # Packings of a second or so each: a task holds as many as fill a minute. The task counts the cycles that a packing has at first,
        # the plan those that it probably needs in the end: hence a factor of three.
        campaign = self.write_campaign({"measure.packings": 500, "measure.max_packings": 500, "layer.grains": 300})
        self.prepare(campaign, "--minutes-per-task", 1)
        plan = json.loads(self.call("plan", campaign, "--output", self.output, "--json").stdout)
        seconds = plan["core_time_s"] / 500
        self.assertGreater(len(self.tasks()), 1, "the test is about several tasks")
        for task in self.tasks()[:-1]:
            packings = len(task.split()) // 2
            self.assertGreater(packings, 1, "and about several packings in each")
            self.assertGreater(packings * seconds, 20)
            self.assertLess(packings * seconds, 180)

    def test_a_task_of_several_packings_that_dies_costs_only_what_it_had_not_finished(self):
        campaign = self.write_campaign({"measure.packings": 4, "measure.max_cycles": 24})
        self.prepare(campaign, "--minutes-per-task", 1000)
        self.assertEqual(len(self.tasks()), 1)
        self.assertEqual(self.tasks()[0].split()[1::2], ["1", "2", "3", "4"])

        # The task dies while it simulates the third packing.
        work = subprocess.Popen([PROGRAM, "work", self.output, "--task-list", self.list, "--index", "0"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, work)

        def third():
            return next((one for one in engines_in(self.output) if self.folder_of(one).endswith("packing-3") and pause(one)), None)

        engine = wait_until(third, "the third packing ran", work)
        work.send_signal(signal.SIGKILL)
        work.wait()
        os.kill(engine, signal.SIGKILL)
        kept = {path: fingerprint(path) for path in self.output.glob("cases/*/packing-*/packing.json")}
        self.assertEqual(sorted(path.parent.name for path in kept), ["packing-1", "packing-2"])

        self.prepare(campaign)
        self.assertEqual([line.split()[1] for line in self.tasks()], ["3", "4"])
        self.run_tasks()
        self.prepare(campaign)
        self.assertEqual(self.tasks(), [])
        for path, before in kept.items():
            self.assertEqual(fingerprint(path), before)

    @staticmethod
    def folder_of(process):
        try:
            return os.readlink(f"/proc/{process}/cwd")
        except OSError:
            return ""  # it has just ended

    def test_what_is_being_simulated_is_left_out(self):
        campaign = self.write_campaign({"measure.packings": 2, "measure.max_cycles": 100_000, "measure.half_width": 0.0001})
        self.prepare(campaign)
        work = subprocess.Popen([PROGRAM, "work", self.output, "--task-list", self.list, "--index", "1"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, work)
        wait_until(lambda: engines_in(self.output), "the task ran", work)
        done = self.prepare(campaign)
        self.assertIn("1 task in ", done.stdout)
        self.assertIn("without 1 packing being simulated now", done.stdout)
        self.assertEqual([line.split()[1] for line in self.tasks()], ["1"])

    def test_the_schedulers_that_there_is_no_executor_for(self):
        for name in ("torque", "lsf"):
            campaign = self.write_campaign()
            campaign.write_text(campaign.read_text() + f'[run]\nexecutor = "{name}"\n')
            self.assert_one_line_error(self.call(*self.run_arguments(campaign)), 2, f"'{name}' is not an allowed value", "local or slurm")

    def test_a_file_that_is_not_a_list_is_not_replaced(self):
        campaign = self.write_campaign()
        before = campaign.read_bytes()
        self.list = campaign
        done = self.prepare(campaign, wanted=2)
        self.assertIn("is not a task list, so it is not replaced", done.stderr.splitlines()[-1])
        self.assertEqual(campaign.read_bytes(), before)

    def test_a_list_that_cannot_be_written(self):
        campaign = self.write_campaign()
        self.list = self.folder / "absent" / "tasks.txt"
        done = self.prepare(campaign, wanted=3)
        self.assertIn(str(self.list), done.stderr.splitlines()[-1])
        self.assertFalse((self.output / "cases").exists(), "nothing was begun")


if __name__ == "__main__":
    unittest.main()
