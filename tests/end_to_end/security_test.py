"""What the program promises about folders and engines: each docstring is a sentence of .github/PROMISES.md (promises.py)."""

import hashlib
import itertools
import json
import os
import shutil
import signal
import stat
import subprocess
import time
import unittest
from pathlib import Path

from trough_program import PATIENCE, PROGRAM, EndToEndTest, count_cycles, engines_in, pause, processes_in, sample, wait_until

ONE = {"measure.packings": 1, "measure.max_cycles": 24}
# A settled filling, and a run that goes on for long enough to be looked at.
LONG = {"measure.packings": 1, "measure.max_cycles": 100_000, "measure.half_width": 0.0001, "output.checkpoint_cycles": 5}
MODULES = ("numpy", "h5py", "matplotlib", "jinja2", "sitecustomize", "usercustomize", "vibrotrough", "figure_style", "json")


class Security(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.precious = self.folder / "precious"
        self.precious.mkdir()
        (self.precious / "letter").write_text("dear")

    def assert_untouched(self):
        self.assertEqual([path.name for path in self.precious.iterdir()], ["letter"])
        self.assertEqual((self.precious / "letter").read_text(), "dear")

    def only_case(self):
        (case,) = (self.output / "cases").iterdir()
        return case

    def wait_for_cycles(self, driver, count):
        def seen():
            tables = list(self.output.glob("cases/*/packing-1/cycles.csv"))
            return tables and count_cycles(tables[0]) >= count

        wait_until(seen, f"{count} cycles were simulated", driver)

    def assert_refused(self, done, code, *parts):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_no_python_module_of_a_folder_is_loaded(self):
        """No Python module and no setting of the current folder or of a campaign's folder is loaded."""
        self.finished_campaign(ONE)
        proof = self.folder / "executed"
        harm = f"open({str(proof)!r}, 'a').write(__name__ + '\\n')\n"
        for place in (self.output, self.output / "report", self.folder / "elsewhere"):
            place.mkdir(exist_ok=True)
            for module in MODULES:
                (place / f"{module}.py").write_text(harm)
            (place / "matplotlibrc").write_text("backend: module://harm\n")
        elsewhere = self.folder / "elsewhere"
        for command, place, path in (("plot --only cycles", self.output, ""), ("report", self.output, "."), ("plot --only cycles", elsewhere, ":")):
            environment = dict(os.environ, PYTHONPATH=path)
            done = self.call(*command.split(), os.path.relpath(self.output, place), cwd=place, env=environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertFalse(proof.exists(), f"{command} in {place} executed {proof.read_text() if proof.exists() else ''}")
            self.assertTrue(all(Path(line).is_file() for line in done.stdout.splitlines()), done.stdout)

    def write_observable(self, before=""):
        mine = self.folder / "mine.py"
        mine.write_text(f"{before}import vibrotrough\n\n@vibrotrough.observable(of='packing', needs='cycles')\n"
                        "def one(packing):\n    'One.'\n    return [1.0] * packing.result_cycles\n")  # fmt: skip
        return mine

    def test_no_function_runs_unless_its_file_is_allowed(self):
        """`observe` runs a person's file only when `--allow-python` names that very file, and what it measures is stored with its text and SHA-256."""
        self.finished_campaign(ONE)
        proof = self.folder / "executed"
        mine = self.write_observable(f"open({str(proof)!r}, 'w').close()\n")
        other = self.folder / "other.py"
        shutil.copy(mine, other)
        for words in ([], ["--allow-python", other], ["--allow-python", self.folder]):
            self.assert_refused(self.call("observe", self.output, mine, *words), 2, "--allow-python")
        # A file of the campaign's folder is no exception, and neither is one with the name of a module.
        for module in ("observables", "observe", *MODULES):
            shutil.copy(mine, self.output / f"{module}.py")
        self.assert_refused(self.call("observe", ".", cwd=self.output), 2, "no packing keeps frames")
        self.assert_refused(self.call("observe", ".", "observables.py", cwd=self.output), 2, "--allow-python observables.py")
        self.assertFalse(proof.exists())
        done = self.call("observe", self.output, mine, "--allow-python", mine)
        self.assertEqual(done.returncode, 0, done.stderr)
        (kept,) = json.loads((self.output / "observables.json").read_text())["observables"]
        self.assertEqual(kept["source"], mine.read_text())
        self.assertEqual(kept["source_sha256"], hashlib.sha256(mine.read_bytes()).hexdigest())

    def test_nothing_is_written_or_removed_through_a_link(self):
        """Below a campaign's folder nothing is written or removed through a symbolic link."""
        campaign = self.finished_campaign(ONE)
        case = self.only_case()
        # A packing's folder that leads elsewhere, with what makes a run believe that it has to be continued or repeated.
        for note in ("failure.json", "packing-1/checkpoint.json"):
            for leftover in ("result.h5", "summary", "failure.json"):
                (case / leftover).unlink(missing_ok=True)
            shutil.rmtree(case / "packing-1")
            (case / "packing-1").symlink_to(self.precious)
            if note == "failure.json":
                (case / note).write_text('{"outcome": "engine-error", "message": "", "packing": 1, "attempts": 1}')
            else:
                (self.precious / "checkpoint.json").write_text("")
            self.run_campaign(campaign, wanted=None)
            (self.precious / "checkpoint.json").unlink(missing_ok=True)
            self.assert_untouched()
            self.assertTrue((case / "result.h5").is_file())
        mine = self.write_observable()
        # Folders and files that lead elsewhere are replaced, or the command ends and names them.
        for command, link, target in (
            (["run", campaign, "--output", self.output, "--liggghts", self.engine], "campaign.log", "letter"),
            (["run", campaign, "--output", self.output, "--liggghts", self.engine], "campaign.h5", "letter"),
            (["run", campaign, "--output", self.output, "--liggghts", self.engine], "engine.json", "letter"),
            (["plot", self.output, "--only", "cycles"], "report", ""),
            (["report", self.output], "report/report.html", "letter"),
            (["report", self.output], "report/data", ""),
            (["plot", self.output, "--only", "efficiency"], "report/efficiency.svg", "letter"),
            (["observe", self.output, mine, "--allow-python", mine], "observables.json", "letter"),
            (["export", self.output, "--table"], "view", ""),
            (["export", self.output, "--table"], "view/campaign.vtt", "letter"),
        ):
            path = self.output / link
            path.parent.mkdir(exist_ok=True)
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            kept = path.read_bytes() if path.is_file() else None
            path.unlink(missing_ok=True)
            path.symlink_to(self.precious / target)
            with self.subTest(link=link):
                done = self.call(*command)
                self.assert_untouched()
                self.assertIn(done.returncode, (0, 1, 2, 3), done.stderr)
                if done.returncode not in (0, 1):
                    self.assertIn("link" if done.returncode == 3 else str(path), done.stderr)
            path.unlink(missing_ok=True) if path.is_symlink() or path.is_file() else None
            if kept is not None and link == "engine.json":
                path.write_bytes(kept)

    def begin_and_kill(self):
        """A campaign whose driver was killed in its first packing. (its file, the packing's folder)"""
        shutil.rmtree(self.output, ignore_errors=True)
        campaign = self.write_campaign(LONG)
        driver = self.start_campaign(campaign)
        self.wait_for_cycles(driver, 6)
        driver.send_signal(signal.SIGKILL)
        driver.wait()
        wait_until(lambda: not processes_in(self.output), "the engine was gone")
        return campaign, self.only_case() / "packing-1"

    def test_the_files_of_the_engine_are_checked_before_it_starts(self):
        """The engine's files are checked for links and for second names before the engine starts."""
        campaign, packing = self.begin_and_kill()
        killed = self.folder / "killed"
        shutil.copytree(self.output, killed)
        cycles = count_cycles(packing / "cycles.csv")

        def went_on(driver, path=packing / "cycles.csv"):  # absent for a moment, while it gets a content of its own
            return driver.poll() is not None or (path.exists() and count_cycles(path) > cycles + 12)

        for name in ("log.liggghts", "checkpoints.txt", "profiles.0.txt", "surface.0.txt", "engine.out", "phases.csv"):
            shutil.rmtree(self.output)
            shutil.copytree(killed, self.output)
            (packing / name).unlink()
            (packing / name).symlink_to(self.precious / "letter")
            driver = self.start_campaign(campaign)
            # What the program itself writes replaces the link; for what only the engine writes the run ends. Twelve cycles have two
            # checkpoints, and all files are written.
            wait_until(lambda: went_on(driver), "the run ended or went on")  # noqa: B023
            driver.send_signal(signal.SIGKILL)
            driver.wait()
            wait_until(lambda: not processes_in(self.output), "the engine was gone")
            self.assert_untouched()
        shutil.rmtree(self.output)
        shutil.copytree(killed, self.output)
        # A second name of the same file, as in a copy made with cp -al: only the campaign's own file grows.
        copy = self.folder / "copy"
        shutil.copytree(packing, copy, copy_function=os.link)
        before = {path.name: path.read_bytes() for path in copy.iterdir() if path.is_file()}
        driver = self.start_campaign(campaign)
        wait_until(lambda: went_on(driver), "the run went on", driver)
        self.assertIsNone(driver.poll(), "the run goes on")
        driver.send_signal(signal.SIGKILL)
        driver.wait()
        for name, content in before.items():
            self.assertEqual((copy / name).read_bytes(), content, name)

    def test_what_a_person_wrote_or_edited_is_not_replaced(self):
        """A file that a person wrote or edited is not replaced."""
        campaign = self.write_campaign(ONE, name="mine.toml")
        for name in ("campaign.toml", "engine.json", "campaign.h5", "packings/note.making-of", "cases/letter"):
            folder = self.folder / f"folder {name.split('/')[0]}"
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text("dear")
            done = self.call("run", campaign, "--output", folder, "--liggghts", self.engine)
            self.assert_refused(done, 2, "--output", str(folder))
            self.assertEqual((folder / name).read_text(), "dear")
            self.assertEqual(self.take_starts(), [])
        self.run_campaign(campaign, wanted=None)
        (self.output / "packings" / "mine.making-of").mkdir()
        frozen = self.output / "campaign.toml"
        edited = frozen.read_text().replace("friction = 0.23", "friction = 0.24")
        frozen.write_text(edited)
        done = self.call(*self.run_arguments(campaign))
        self.assert_refused(done, 2, str(frozen), "was changed since it was frozen")
        self.assertEqual(frozen.read_text(), edited)
        self.run_campaign(frozen, wanted=None)  # the way out that the message names
        self.assertEqual(frozen.read_text(), edited)
        self.assertTrue((self.output / "packings" / "mine.making-of").is_dir())

    def test_only_regular_files_of_bounded_size_are_read(self):
        """Only regular files of bounded size are read from a campaign's folder."""
        self.finished_campaign(ONE)
        batch = self.output / "slurm" / "0001"
        batch.mkdir(parents=True)
        case = self.only_case()
        (case / "result.h5").rename(case / "result")
        paths = (self.output / ".lock", self.output / "certificate.json", batch / "batch.json", self.output / "numerics.json",
                 self.output / "friction.json", case / "failure.json", case / "packing-1" / "packing.json", case / "summary")  # fmt: skip
        for path, make, command in sample(itertools.product(paths, (os.mkfifo, self.make_sparse), ("status", "report")), 3):
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

    def test_text_from_files_steers_nothing(self):
        """Text from files cannot steer the terminal, a spreadsheet or a browser."""
        self.finished_campaign(ONE)
        case = self.only_case()
        (case / "result.h5").unlink()
        message = "\x1b]0;owned\x07\x1b[2J\u202egnp.exe \u00b5m"
        failure = {"outcome": "engine-error", "message": message, "packing": 1, "attempts": 1}
        (case / "failure.json").write_text(json.dumps(failure))
        for command in (["status", self.output], ["compare", self.output], ["compare", self.output, "--csv"]):
            shown = self.call(*command).stdout
            self.assertNotRegex(shown, "[\x00-\x09\x0b-\x1f\x7f\u202e]")
        self.assertIn("\u00b5m", self.call("status", self.output).stdout, "letters stay")
        failure["outcome"] = "=cmd|' /C calc'!A0"
        (case / "failure.json").write_text(json.dumps(failure))
        self.assertNotIn("cmd", self.call("compare", self.output, "--csv").stdout)
        failure["outcome"] = "finished"
        (case / "failure.json").write_text(json.dumps(failure))
        self.assertNotIn("finished", [row["outcome"] for row in self.table()])
        # A name that is printed in an error.
        done = self.call("status", self.folder / "no\x1b[31mfolder")
        self.assertNotIn("\x1b", done.stderr)

    def test_a_marker_of_a_task_cannot_claim_a_result(self):
        """A marker of a cluster's task cannot claim a result."""
        self.finished_campaign(ONE)
        case = self.only_case()
        (case / "result.h5").unlink()
        shutil.rmtree(case / "packing-1")
        batch = self.output / "slurm" / "0001"
        batch.mkdir(parents=True)
        (batch / "batch.json").write_text('{"name": "vibrotrough-0123456789ab", "job": 1}')
        (batch / "tasks.txt").write_text(f"{case.name} 1\n")
        for marker in ('{"outcome": "finished", "message": "well\\u001b[31m"}', '{"outcome": 3}', '{"outcome": "finished", "message": []}'):
            (batch / "task-0.lost").write_text(marker)
            (row,) = self.ask_json("status")["cases"]
            self.assertEqual(row["outcome"], "interrupted", marker)
            self.assertIn("task-0.lost is damaged", row["message"])
        (batch / "task-0.lost").write_text('{"outcome": "interrupted", "message": "well\\u001b[31m"}')
        (row,) = self.ask_json("status")["cases"]
        self.assertIn(r"well\x1b[31m", row["message"])

    def test_a_settled_packing_belongs_to_its_deck(self):
        """A settled packing is used only for the deck that it was made with."""
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
        """An engine that is replaced while a campaign runs is noticed, and what it computed is not stored."""
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

    def test_the_folder_of_a_packing_has_one_writer(self):
        """The folder of a packing has one writer."""
        # A wrapper that does not exec, as containers have one: the kernel ends it with the driver, but not its child.
        real = shutil.which("liggghts")
        wrapper = self.folder / "wrapper"
        wrapper.write_text(f'#!/bin/sh\n"{real}" "$@"\ncode=$?\nexit $code\n')
        wrapper.chmod(0o755)
        self.engine = wrapper
        campaign = self.write_campaign(LONG)
        driver = self.start_campaign(campaign)
        self.wait_for_cycles(driver, 6)
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

    def test_work_says_which_engine_it_starts(self):
        """`work` prints the program that `engine.json` names before it starts it, and refuses another binary than that of the campaign."""
        self.finished_campaign(ONE)
        case = self.only_case()
        (case / "result.h5").unlink()
        shutil.rmtree(case / "packing-1")
        tasks = self.folder / "tasks"
        tasks.write_text(f"{case.name} 1\n")
        facts = json.loads((self.output / "engine.json").read_text())
        done = self.call("work", self.output, "--task-list", tasks, "--index", 0)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"engine: {self.engine}", done.stderr)
        other = self.folder / "other"
        other.write_text(self.engine.read_text() + "# another\n")
        other.chmod(0o755)
        facts["program"] = str(other)
        (self.output / "engine.json").write_text(json.dumps(facts))
        (case / "result.h5").unlink()
        shutil.rmtree(case / "packing-1")
        done = self.call("work", self.output, "--task-list", tasks, "--index", 0)
        self.assert_refused(done, 3, f"engine: {other}", "not the binary that the campaign was planned with")

    def test_a_folder_that_is_removed_is_not_made_again(self):
        """A folder that is removed while a campaign runs is not made again."""
        campaign = self.write_campaign(LONG)
        driver = self.start_campaign(campaign)
        self.wait_for_cycles(driver, 1)
        while self.output.exists():  # an engine may write a file into a folder between its emptying and its removal
            shutil.rmtree(self.output, ignore_errors=True)
        code, _, errors = self.finish(driver)
        self.assertEqual(code, 3, errors)
        self.assertNotIn("internal error", errors)
        self.assertFalse(self.output.exists())


if __name__ == "__main__":
    unittest.main()
