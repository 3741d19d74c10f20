"""What .github/SECURITY.md promises about commands, files and results; its table names these tests."""

import hashlib
import itertools
import json
import os
import shutil
import signal
import stat
import subprocess
import sys
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

from trough_program import PATIENCE, PROGRAM, EndToEndTest, campaign_text, count_cycles, engines_in, pause, sample, wait_until

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "postprocess"))
import vibrotrough  # noqa: E402

TEMPLATES = Path(__file__).parent.parent.parent / "input_templates"
ONE = {"measure.packings": 1, "measure.max_cycles": 24}
# A run that goes on for long enough to be looked at.
LONG = {"measure.packings": 1, "measure.max_cycles": 100_000, "measure.half_width": 0.0001, "output.checkpoint_cycles": 5}
OWN_TEMPLATE = '[engine]\ntemplates = ["contact.mustache"]\n'


class Trust(EndToEndTest):
    def only_case(self):
        (case,) = (self.output / "cases").iterdir()
        return case

    def assert_refused(self, done, code, *parts):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def write_template(self, folder):
        """A template that runs a program beside what it is for."""
        (folder / "contact.mustache").write_text((TEMPLATES / "contact.mustache").read_text() + "shell touch executed\n")

    def proofs(self):
        return list(self.folder.glob("**/executed"))

    def remove_result(self):
        case = self.only_case()
        (case / "result.h5").unlink()
        shutil.rmtree(case / "packing-1")
        return case

    def test_no_command_of_a_campaign_file_reaches_the_engine_unasked(self):
        campaign = self.write_campaign(ONE)
        plain = campaign.read_text()
        self.write_template(self.folder)
        campaign.write_text(plain + OWN_TEMPLATE)
        domain = self.folder / "domain.toml"
        domain.write_text(f'{campaign.read_text()}[domain]\n"trough.throw_number" = {{ from = 1, to = 3 }}\n')
        commands = (("run", campaign), ("deck", campaign), ("friction-test", campaign), ("convergence", campaign),
                    ("learn", domain, "--half-width", "0.05", "--budget", "1 core-hours"))  # fmt: skip
        for command in commands:
            engine = () if command[0] == "deck" else ("--liggghts", self.engine)
            self.assert_refused(self.call(*command, "--output", self.output, *engine), 2, "1 templates beside it", "--allow-extra")
            self.assertEqual(list(self.output.glob("**/*.liggghts")), [])
        self.assertEqual((self.take_starts(), self.proofs()), ([], []))
        done = self.call(*self.run_arguments(campaign), "--allow-extra")
        self.assertIn(done.returncode, (0, 1), done.stderr)  # one packing is not precise
        self.assertNotEqual(self.proofs(), [])

    def test_no_command_of_an_added_case_reaches_the_engine_unasked(self):
        campaign = self.write_campaign(ONE)
        plain = campaign.read_text()
        for folder, command in (("", ("run", campaign, "--accept-findings")), ("", ("prepare", campaign, "--task-list", self.folder / "tasks", "--accept-findings")),
                                ("convergence", ("convergence", campaign)), ("friction-test", ("friction-test", campaign))):  # fmt: skip
            shutil.rmtree(self.output, ignore_errors=True)
            added = self.output / folder / "added" / "0001"
            added.mkdir(parents=True)
            (added / "scenario.toml").write_text(plain.replace("throw_number = 2.0", "throw_number = 2.1") + OWN_TEMPLATE)
            self.write_template(added)
            with self.subTest(command=command[0]):
                self.assert_refused(self.call(*command, "--output", self.output, "--liggghts", self.engine), 2, "1 templates beside it", "--allow-extra")
        self.assertEqual((self.take_starts(), self.proofs()), ([], []))

    def test_no_task_runs_commands_of_a_campaign_unasked(self):
        campaign, tasks = self.write_campaign(ONE), self.folder / "tasks"
        self.write_template(self.folder)
        campaign.write_text(campaign.read_text() + OWN_TEMPLATE)
        prepare = ["prepare", campaign, "--output", self.output, "--task-list", tasks, "--liggghts", self.engine, "--accept-findings"]
        prepared = self.call(*prepare, "--allow-extra")
        self.assertEqual(prepared.returncode, 0, prepared.stderr)
        self.assertIn("--index $i --allow-extra\n", prepared.stdout)
        work = ["work", self.output, "--task-list", tasks, "--index", 0]
        self.assert_refused(self.call(*work), 2, "1 templates beside it", "--allow-extra")
        self.assertEqual(self.proofs(), [])
        self.assertEqual(self.call(*work, "--allow-extra").returncode, 0)
        self.assertNotEqual(self.proofs(), [])

    def test_no_text_of_a_campaign_file_reaches_a_shell(self):
        words = ("$(touch hacked)", "`touch hacked`", "a; touch hacked", "a\nshell touch hacked", "a'; touch hacked; '", "../hacked", "-o hacked", "a\x1bb")
        for word in words:
            for text in (campaign_text({"campaign.name": word}),
                         campaign_text() + f'[run]\nexecutor = "slurm"\n[run.slurm]\npartition = {json.dumps(word)}\n',
                         campaign_text() + f'[run]\nexecutor = "slurm"\n[run.slurm]\nextra = [{json.dumps("--qos=" + word)}]\n',
                         campaign_text() + f"[points_from]\nfile = {json.dumps(word)}\n"):  # fmt: skip
                campaign = self.folder / "campaign.toml"
                campaign.write_text(text)
                self.assert_refused(self.call("run", campaign, "--output", self.output, "--liggghts", self.engine), 2, "campaign.toml:")
        for name in ("a $(touch hacked) b", "'quotes\"", "a;touch hacked&", "-rf"):
            self.run_campaign(self.write_campaign(ONE), output=self.folder / name, wanted=None)
            self.assertEqual(len(self.table(self.folder / name)), 1)
        self.assertEqual([path for path in self.folder.rglob("hacked*")], [])

    def test_no_function_runs_unless_its_file_is_allowed(self):
        self.finished_campaign(ONE)
        proof = self.folder / "executed"
        mine, other = self.folder / "mine.py", self.folder / "other.py"
        mine.write_text(f"open({str(proof)!r}, 'w').close()\nimport vibrotrough\n\n@vibrotrough.observable(of='packing', needs='cycles')\n"
                        "def one(packing):\n    'One.'\n    return [1.0] * packing.result_cycles\n")  # fmt: skip
        shutil.copy(mine, other)
        for words in ([], ["--allow-python", other], ["--allow-python", self.folder]):
            self.assert_refused(self.call("observe", self.output, mine, *words), 2, "--allow-python")
        self.assertFalse(proof.exists())
        done = self.call("observe", self.output, mine, "--allow-python", mine)
        self.assertEqual(done.returncode, 0, done.stderr)
        (kept,) = json.loads((self.output / "observables.json").read_text())["observables"]
        self.assertEqual(kept["source"], mine.read_text())
        self.assertEqual(kept["source_sha256"], hashlib.sha256(mine.read_bytes()).hexdigest())

    def test_devices_and_pipes_are_written_into(self):
        trace = ["theory", "trace", "--throw-number", 2, "--vibration-angle", "30 deg", "--friction", 0.4, "--output"]
        expected = self.call(*trace[:-1]).stdout
        pipe = self.folder / "pipe.csv"
        os.mkfifo(pipe)
        reader = subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, reader)
        self.assertEqual(self.call(*trace, pipe).returncode, 0)
        self.assertEqual(reader.communicate(timeout=PATIENCE)[0], expected)
        self.assertTrue(stat.S_ISFIFO(pipe.stat().st_mode))
        link = self.folder / "link.csv"
        for target in ("/dev/null", pipe, "/proc/self/fd/1"):
            link.symlink_to(target)
            self.assert_refused(self.call(*trace, link), 3, "link to a device, a pipe or an open file")
            self.assertTrue(link.is_symlink())
            link.unlink()
        null = self.folder / "null.csv"
        try:
            os.mknod(null, stat.S_IFCHR | 0o666, os.makedev(1, 3))
        except PermissionError:
            self.skipTest("only root may make a device")
        done = self.call(*trace, null)
        if done.returncode == 3 and "Permission denied" in done.stderr:
            self.skipTest("this file system has no devices")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(stat.S_ISCHR(null.stat().st_mode))

    def test_a_folder_that_is_not_a_campaigns_is_refused(self):
        campaign = self.write_campaign(ONE, name="mine.toml")
        for name in ("campaign.toml", "engine.json", "campaign.h5", "packings/note", "cases/letter"):
            folder = self.folder / f"folder {name.split('/')[0]}"
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text("dear")
            done = self.call("run", campaign, "--output", folder, "--liggghts", self.engine)
            self.assert_refused(done, 2, str(folder))
            self.assertEqual((folder / name).read_text(), "dear")
        self.assertEqual(self.take_starts(), [])

    def test_only_regular_files_of_bounded_size_are_read(self):
        self.finished_campaign(ONE)
        case = self.only_case()
        (case / "result.h5").rename(case / "result")
        paths = (self.output / "certificate.json", self.output / "numerics.json", case / "failure.json", case / "packing-1" / "packing.json", case / "summary")
        for path, make, command in sample(itertools.product(paths, (os.mkfifo, self.make_sparse), ("status", "report")), 5):
            kept = path.read_bytes() if path.is_file() else None
            path.unlink(missing_ok=True)
            make(path)
            with self.subTest(path=path.name, command=command, make=make.__name__):
                begin = time.monotonic()
                done = self.call(command, self.output)
                self.assertIn(done.returncode, (0, 2, 3), done.stderr)
                self.assertLess(time.monotonic() - begin, PATIENCE / 2, "it waits for nobody")
            path.unlink()
            if kept is not None:
                path.write_bytes(kept)

    @staticmethod
    def make_sparse(path):
        with open(path, "wb") as file:
            file.truncate(10 << 30)  # needs no space on the disk

    def test_text_from_files_cannot_steer_the_terminal(self):
        self.finished_campaign(ONE)
        case = self.only_case()
        (case / "result.h5").unlink()
        message = "\x1b]0;owned\x07\x1b[2J\u202egnp.exe \u00b5m"
        (case / "failure.json").write_text(json.dumps({"outcome": "engine-error", "message": message, "packing": 1, "attempts": 1}))
        for command in (("status", self.output), ("compare", self.output), ("compare", self.output, "--csv"), ("status", self.folder / "no\x1b[31mfolder")):
            done = self.call(*command)
            self.assertNotRegex(done.stdout + done.stderr, "[\x00-\x08\x0b-\x1f\x7f\u202e]")
        self.assertIn("\u00b5m", self.call("status", self.output).stdout, "letters stay")

    @staticmethod
    def spoil_cycles(result):
        """Makes the cycles of the first packing three times their value, as a disk or a person may do; size, times and inode stay."""
        times = result.stat()
        with h5py.File(result) as file:
            table = file["series/1"]
            place, count, row = table.id.get_chunk_info(0).byte_offset, len(table), table.dtype
        with open(result, "r+b") as file:
            file.seek(place)
            values = np.frombuffer(file.read(count * row.itemsize), row).copy()
            values["efficiency"] *= 3
            file.seek(place)
            file.write(values.tobytes())
        os.utime(result, ns=(times.st_atime_ns, times.st_mtime_ns))

    def test_no_number_of_a_damaged_result_is_shown(self):
        campaign = self.write_campaign(ONE, {"trough.throw_number": [2.0, 2.2]})
        self.run_campaign(campaign, wanted=None)
        before = self.table()
        result = self.output / "cases" / before[0]["case"] / "result.h5"
        self.spoil_cycles(result)
        with self.assertRaisesRegex(ValueError, "result.h5 is damaged"):
            vibrotrough.open_result(result)
        damaged, sound = self.table()
        self.assertEqual((damaged["outcome"], damaged["efficiency"]), ("interrupted", None))
        self.assertEqual(sound, before[1])
        for command in (("status",), ("compare",), ("report",)):
            done = self.call(*command, self.output)
            self.assertEqual(done.returncode, 0, done.stderr)
            if command != ("status",):  # which believes size and times
                self.assertRegex(done.stderr, r"(\A|\n)vibrotrough: left aside: 1 of 2 cases [^\n]*result.h5 is damaged")
        self.assertEqual(list(self.output.glob(f"report/*-{result.parent.name}.*")), [])
        self.assertEqual(list(vibrotrough.open_campaign(self.output)["case"]), [sound["case"]])
        self.assert_refused(self.call("archive", self.output, "--output", self.folder / "bundle.zip"), 2, "result.h5 is damaged")
        # The next run says it and mends it.
        done = self.run_campaign(campaign, wanted=None)
        for told in (done.stderr, (self.output / "campaign.log").read_text()):
            self.assertRegex(told, f"case {result.parent.name}[^\n]*: its result.h5 is damaged")
        self.assertEqual([row["efficiency"] for row in self.table()], [row["efficiency"] for row in before])

    def test_a_settled_packing_belongs_to_its_deck(self):
        campaign = self.write_campaign(ONE | {"campaign.name": "small", "layer.grains": 40})
        self.run_campaign(campaign, wanted=None)
        (foreign,) = (self.output / "packings").iterdir()
        other = self.write_campaign(ONE)
        again = self.folder / "again"
        self.take_settles()
        self.run_campaign(other, again, wanted=None)
        (own,) = (again / "packings").iterdir()
        self.assertEqual(self.take_settles(), 1)
        shutil.rmtree(own)
        shutil.copytree(foreign, own)  # with its whole seal
        shutil.rmtree(again / "cases")
        self.run_campaign(other, again, wanted=None)
        self.assertEqual(self.take_settles(), 1, "the packing of another deck is not used")

    def take_settles(self):
        count = len(self.settles_file.read_text().splitlines()) if self.settles_file.exists() else 0
        self.settles_file.unlink(missing_ok=True)
        return count

    def test_a_replaced_engine_is_noticed(self):
        engine = self.folder / "liggghts"
        shutil.copy(self.engine, engine)
        campaign = self.write_campaign(ONE, {"layer.grains": [60, 62, 64]})
        self.call("run", campaign, "--output", self.folder / "probed", "--liggghts", engine)
        command = ["run", campaign, "--output", self.output, "--liggghts", engine, "--jobs", "1"]
        driver = subprocess.Popen([PROGRAM, *map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, driver)
        wait_until(lambda: list(self.output.glob("cases/*/packing-*/engine.out")), "the first packing ran", driver)
        self.assertTrue(pause(driver.pid))
        # As an upgrade does it: another file of the same name.
        newer = self.folder / "newer"
        newer.write_text(engine.read_text() + "# another friction\n")
        newer.chmod(newer.stat().st_mode | stat.S_IXUSR)
        os.replace(newer, engine)
        finished = set(self.output.glob("cases/*/packing-*/packing.json"))
        driver.send_signal(signal.SIGCONT)
        code, _, errors = self.finish(driver)
        self.assertEqual(code, 3, errors)
        self.assertIn("was replaced after this run had begun", errors)
        self.assertEqual(set(self.output.glob("cases/*/packing-*/packing.json")), finished, "nothing of it is stored")

    def test_work_says_which_engine_it_starts(self):
        self.finished_campaign(ONE)
        case = self.remove_result()
        tasks = self.folder / "tasks"
        tasks.write_text(f"{case.name} 1\n")
        done = self.call("work", self.output, "--task-list", tasks, "--index", 0)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"engine: {self.engine}", done.stderr)
        other = self.folder / "other"
        other.write_text(self.engine.read_text() + "# another\n")
        other.chmod(0o755)
        facts = json.loads((self.output / "engine.json").read_text())
        (self.output / "engine.json").write_text(json.dumps(facts | {"program": str(other)}))
        self.remove_result()
        done = self.call("work", self.output, "--task-list", tasks, "--index", 0)
        self.assert_refused(done, 3, f"engine: {other}", "not the binary that the campaign was planned with")

    def test_a_campaign_that_goes_on_with_another_binary_says_so(self):
        campaign = self.finished_campaign(ONE)
        told = "is another binary of the same version than that of the results in"
        facts = json.loads((self.output / "engine.json").read_text())
        for changes, is_told in (({}, False), ({"binary_sha256": "0" * 64}, True), ({"binary_sha256": "0" * 64, "version": "LIGGGHTS 0"}, False)):
            (self.output / "engine.json").write_text(json.dumps(facts | changes))
            done = self.call("run", campaign, "--output", self.output, "--liggghts", self.engine)
            self.assertEqual(f"{self.engine} {told} {self.output}" in done.stderr, is_told, done.stderr)
            self.assertEqual(json.loads((self.output / "engine.json").read_text())["binary_sha256"], facts["binary_sha256"])

    def test_the_folder_of_a_packing_has_one_writer(self):
        # A wrapper that does not exec, as containers have one: the kernel ends it with the driver, but not its child.
        real = shutil.which("liggghts")
        wrapper = self.folder / "wrapper"
        wrapper.write_text(f'#!/bin/sh\n"{real}" "$@"\ncode=$?\nexit $code\n')
        wrapper.chmod(0o755)
        self.engine = wrapper
        campaign = self.write_campaign(LONG)
        driver = self.start_campaign(campaign)

        def cycles():
            tables = list(self.output.glob("cases/*/packing-1/cycles.csv"))
            return count_cycles(tables[0]) if tables else 0

        wait_until(lambda: cycles() >= 6, "some cycles were simulated", driver)
        wait_until(lambda: engines_in(self.output), "an engine worked; none does between two rounds", driver)
        driver.send_signal(signal.SIGKILL)
        driver.wait()
        orphans = engines_in(self.output)
        self.assertEqual(len(orphans), 1, "the test is about an engine that outlives its driver")
        driver = self.start_campaign(campaign)
        wait_until(lambda: set(engines_in(self.output)) - set(orphans), "the run went on", driver)
        self.assertEqual(set(engines_in(self.output)) & set(orphans), set(), "two engines write in one folder")
        driver.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(driver)[0], 130)
        table = (self.only_case() / "packing-1" / "cycles.csv").read_text().splitlines()
        steps = [int(line.split(",")[0]) for line in table if line[:1].isdigit()]
        self.assertEqual(steps, sorted(set(steps)), "no cycle is there twice")


if __name__ == "__main__":
    unittest.main()
