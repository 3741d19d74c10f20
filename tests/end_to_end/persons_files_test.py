"""What the program promises about what a person, or chance, puts into a campaign's folder: each docstring is a sentence of
.github/PROMISES.md (promises.py)."""

import itertools
import os
import resource
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from trough_program import PROGRAM, WHOLE, EndToEndTest, count_cycles, pause, processes_in, sample, wait_until

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "postprocess"))
import vibrotrough  # noqa: E402

SOURCES = Path(__file__).parent.parent.parent
ONE = {"measure.packings": 1, "measure.max_cycles": 24}
LONG = {"measure.packings": 1, "measure.max_cycles": 100_000, "measure.half_width": 0.0001, "output.checkpoint_cycles": 5}
SOON = 120  # s, in which a command that waits for nobody has ended on any machine
STEERING = "[\x00-\x09\x0b-\x1f\x7f\u202a-\u202e\u2066-\u2069]"


class PersonsFiles(EndToEndTest):
    def only_case(self):
        (case,) = (self.output / "cases").iterdir()
        return case

    def quickly(self, *arguments, **settings):
        """Runs the program, which must end soon."""
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=SOON, **settings)

    def run_again(self, campaign):
        """Lets the packing be simulated again, from its filling on."""
        case = self.only_case()
        for name in ("result.h5", "summary", "packing-1/packing.json", "packing-1/checkpoint.json"):
            (case / name).unlink(missing_ok=True)
        return self.run_campaign(campaign, wanted=None)

    def test_what_a_person_put_into_a_folder_stays(self):
        """When a packing is repeated, only the files are removed that the program and the engine write there, by list; of temporary files only those with the
        name of a process that nobody holds locked.
        """
        campaign = self.finished_campaign(ONE | {"output.frames_per_cycle": 4})
        case, (settled,) = self.only_case(), (self.output / "packings").iterdir()
        packing = case / "packing-1"
        names = sorted(path.name for path in packing.rglob("*"))
        mine = [packing / "notes.txt", packing / "dump" / "mine.txt", packing / "profiles.mine.txt", packing / "own folder" / "letter", settled / "notes.txt",
                self.output / "campaign.h5.part-mine", case / "result.h5.part-backup", case / "failure.json.part-of-me", packing / "in.liggghts.kept"]  # fmt: skip
        for path in mine:
            path.parent.mkdir(exist_ok=True)
            path.write_text("dear")
        # What a longer run of the program would have left, and what a killed one leaves.
        remains = [packing / "profiles.999999999.txt", packing / "dump" / "frames.999999999.dump", packing / "checkpoint.99999.restart",
                   packing / "cycles.csv.part-elsewhere-1", case / "result.h5.part-elsewhere-1", self.output / "campaign.h5.part-elsewhere-1"]  # fmt: skip
        for path in remains:
            path.write_text("half")
        (settled / "settled.restart").write_text("damaged")
        self.run_again(campaign)
        self.assertTrue((case / "result.h5").is_file())
        for path in mine:
            self.assertEqual(path.read_text(), "dear", path)
        self.assertEqual([str(path) for path in remains if path.exists()], [])
        self.assertEqual(sorted(path.name for path in packing.rglob("*") if path not in mine and path.name != "own folder"), names)

    def test_the_deck_that_ran_is_stored(self):
        """The deck that ran is stored and archived, whatever lies in its place since."""
        campaign = self.finished_campaign(ONE)
        (result,) = self.results()
        before = str(vibrotrough.open_result(result)["packings/deck"][0])
        deck = result.parent / "packing-1" / "in.liggghts"
        self.assertEqual(deck.read_text(), before)
        self.take_starts()
        for change in (lambda: deck.write_text(before.replace("0.23", "0.77") + "# mine\n"), deck.unlink):
            change()
            result.unlink()
            (result.parent / "summary").unlink(missing_ok=True)
            self.run_campaign(campaign, wanted=None)
            self.assertEqual(self.take_starts(), [], "the packing is not simulated again")
            self.assertEqual(str(vibrotrough.open_result(result)["packings/deck"][0]), before)
        deck.write_text(before + "# mine\n")
        bundle = self.folder / "bundle.zip"
        self.assertEqual(self.call("archive", self.output, "--output", bundle).returncode, 0)
        shutil.unpack_archive(bundle, self.folder / "unpacked")
        self.assertEqual((self.folder / "unpacked" / deck.relative_to(self.output)).read_text(), before)

    def test_a_damaged_result_that_is_replaced_is_said(self):
        """A damaged result that `run` replaces is named on standard error and in `campaign.log`."""
        campaign = self.finished_campaign(ONE)
        (result,) = self.results()
        result.write_bytes(result.read_bytes()[:-3])
        done = self.run_campaign(campaign, wanted=None)
        words = f"case {result.parent.name}: its result.h5 is damaged"
        self.assertIn(words, done.stderr)
        self.assertIn(words, (self.output / "campaign.log").read_text())
        self.assertNotIn("is damaged", self.run_campaign(campaign, wanted=None).stderr)

    def test_no_pipe_is_waited_for(self):
        """A pipe in place of any file of a campaign, or of what its link leads to, is not waited for."""
        campaign = self.finished_campaign(ONE | {"output.frames_per_cycle": 4})
        case = self.only_case()
        packing, (settled,) = case / "packing-1", (self.output / "packings").iterdir()
        pipe, kept = self.folder / "pipe", self.folder / "kept"
        os.mkfifo(pipe)
        frame = sorted((packing / "dump").glob("frames.*.dump"))[0]
        paths = (frame, packing / "dump" / "frames.csv", packing / "trough.stl", packing / "engine.out", packing / "cycles.csv", case / "result.h5", case / "summary",
                 self.output / "campaign.h5", self.output / "campaign.toml", self.output / "engine.json", self.output / "certificate.json")  # fmt: skip
        makers = (os.mkfifo, lambda link: link.symlink_to(pipe))
        commands = (("status",), ("compare",), ("export",), ("plot", "--only", "cycles"), ("report",), ("archive", "--partial", "--output", self.folder / "b.zip"))
        for path, make, command in sample(itertools.product(paths, makers, commands), 17):
            path.rename(kept)
            make(path)
            with self.subTest(path=path.name, command=command[0], link=path.is_symlink()):
                done = self.quickly(command[0], self.output, *command[1:])
                self.assertIn(done.returncode, (0, 2, 3), done.stderr)
                self.assertNotIn("Traceback", done.stderr)
                if path.suffix == ".h5" and not path.is_file():  # campaign.h5 is written again
                    with self.assertRaises((OSError, ValueError)):
                        vibrotrough.File(path, "vibrotrough result")
            path.unlink(missing_ok=True)
            kept.rename(path)
        # The engine's output is read when it has ended: a pipe has taken its place by then.
        (settled / "settled.restart").write_text("damaged")
        os.environ["VIBROTROUGH_TEST_BREAK"] = "rm engine.out; mkfifo engine.out"
        for name in ("result.h5", "summary", "packing-1/packing.json", "packing-1/checkpoint.json"):
            (case / name).unlink(missing_ok=True)
        self.assertEqual(self.quickly(*self.run_arguments(campaign)).returncode, 1)
        self.assertIn("outputs-incomplete", self.call("status", self.output).stdout)

    def test_a_renamed_folder_is_not_the_engines_fault(self):
        """A folder that is renamed, moved or removed while a packing in it is simulated ends the run with its name; nothing is recorded as a failure of the
        engine.
        """
        campaign = self.write_campaign(LONG)
        for place in ("", "cases", "case", "packing"):
            shutil.rmtree(self.output, ignore_errors=True)
            driver = self.start_campaign(campaign)

            def has_cycles():
                tables = list(self.output.glob("cases/*/packing-1/cycles.csv"))
                return tables and count_cycles(tables[0]) >= 6

            wait_until(has_cycles, "some cycles were simulated", driver)
            case = self.only_case()
            folder = {"": self.output, "cases": self.output / "cases", "case": case, "packing": case / "packing-1"}[place]
            elsewhere = self.folder / "elsewhere"
            folder.rename(elsewhere)
            code, _, errors = self.finish(driver)
            with self.subTest(place=place):
                self.assertEqual(code, 3, errors)
                self.assertIn("was renamed, moved or removed", errors)
                self.assertEqual(list(self.folder.rglob("failure.json")), [])
                self.assertNotIn("outputs-incomplete", errors)
            wait_until(lambda: not processes_in(self.folder), "the engine was gone")
            shutil.rmtree(folder, ignore_errors=True)  # the case's lock file may have been made again
            elsewhere.rename(folder)
            (row,) = self.ask_json("status")["cases"]
            self.assertEqual(row["outcome"], "interrupted")

    def test_nothing_of_the_engine_stays(self):
        """What an engine has started and left behind ends with it: its children and daemons that hold its lock and name its session in their environment.

        A child that runs on, and a daemon of its own session, hold the engine's output and its lock.
        """
        campaign = self.write_campaign(ONE)
        sleepers = lambda: [one for one in processes_in(self.output).values() if one == "sleep"]  # noqa: E731
        for command in ("sleep 1000 &", "setsid sleep 1000 & sleep 0.1"):
            shutil.rmtree(self.output, ignore_errors=True)
            os.environ["VIBROTROUGH_TEST_BREAK"] = command
            self.run_campaign(campaign, wanted=None)
            self.assertEqual(sleepers(), [], command)
            os.environ["VIBROTROUGH_TEST_BREAK"] = ""
            self.assertEqual(self.run_again(campaign).stderr.count("still writes"), 0)
        # A person who looks at the output is no descendant of the engine.
        reader = subprocess.Popen(["tail", "-f", self.only_case() / "packing-1" / "engine.out"], stdout=subprocess.DEVNULL)
        self.addCleanup(self.end, reader)
        self.run_again(campaign)
        self.assertIsNone(reader.poll())

    def test_nothing_half_written_stays(self):
        """Where a limit of file size or a signal ends a command, no half-written file and no unpacked bundle stays, or the next command of the same name removes
        it.
        """
        self.finished_campaign(ONE)
        temporary = self.folder / "tmp"
        temporary.mkdir()
        limit = {"env": dict(os.environ, TMPDIR=str(temporary)), "preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000))}
        bundle = self.folder / "bundle.zip"
        left = lambda: [str(path) for path in self.folder.rglob("*.part-*")] + list(temporary.iterdir())  # noqa: E731
        for command in (("archive", self.output, "--output", bundle), ("plot", self.output, "--only", "cycles"), ("report", self.output)):
            done = self.call(*command, **limit)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertEqual(left(), [], command)
        self.assertEqual(self.call("archive", self.output, "--output", bundle).returncode, 0)
        done = self.call("compare", bundle, **limit)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(left(), [])
        # After SIGKILL the next one of the same name removes what is left; a person's file stays.
        for name in ("bundle.zip.part-elsewhere-1", "bundle.zip.part-mine", "runs/report/.cycles-x.svg.part-1"):
            (self.folder / name).write_text("half")
        self.assertEqual(self.call("archive", self.output, "--output", bundle).returncode, 0)
        self.assertEqual(left(), [str(self.folder / "bundle.zip.part-mine"), str(self.output / "report" / ".cycles-x.svg.part-1")])
        (self.folder / "bundle.zip.part-mine").unlink()
        (self.output / "report" / ".cycles-x.svg.part-1").unlink()
        unpacking = subprocess.Popen([PROGRAM, "compare", str(bundle)], env=dict(os.environ, TMPDIR=str(temporary)), stdout=subprocess.DEVNULL)
        self.addCleanup(self.end, unpacking)
        wait_until(lambda: list(temporary.iterdir()) or unpacking.poll() is not None, "the bundle's folder was made")
        if pause(unpacking.pid):
            unpacking.send_signal(signal.SIGKILL)
        unpacking.wait()
        self.assertEqual(self.call("compare", bundle, env=dict(os.environ, TMPDIR=str(temporary))).returncode, 0)
        self.assertEqual(left(), [])

    def test_what_cannot_be_drawn_is_left_out(self):
        """What cannot be drawn is left out of figures and report and named in one line with its file.

        With the sample of the store, tests/postprocess/check_damage.py does the same to every value that is drawn.
        """
        self.finished_campaign(ONE)
        page, certificate = self.output / "report" / "report.html", self.output / "certificate.json"
        whole = certificate.read_bytes()
        for damaged in sample((b"[]", b'{"probes": [{"a": 1}, 2, [3]]}', b"[" * 100_000, b'{"a": ' * 5000, b"", b"{", b"\xff\xfe", whole[: len(whole) // 2]), 5):
            certificate.write_bytes(damaged)
            # The figures do not show it: they are drawn once, and the page is made again as the program makes it.
            if WHOLE or not page.exists():
                done = self.call("report", self.output)
            else:
                page.unlink()
                done = subprocess.run([sys.executable, "-B", SOURCES / "postprocess" / "report.py", self.output], capture_output=True, text=True)
            with self.subTest(damaged=damaged[:20]):
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("Traceback", done.stderr)
                said = [line for line in done.stderr.splitlines() if "certificate.json" in line]
                self.assertEqual(len(said), 0 if damaged.startswith(b'{"probes"') else 1, done.stderr)
                self.assertNotIn("Warning", done.stderr)
                self.assertIn("figure", page.read_text(encoding="utf-8"))

    def test_names_dress_up_nothing(self):
        """Control characters, marks that change the direction of writing and bytes that are not UTF-8 in names of files and folders are shown escaped; a command
        that is shown for copying still means the file.
        """
        self.finished_campaign(ONE)
        for number, name in enumerate(("gnp\u202eexe.", "red\x1b[31m", "title\x1b]0;x\x07 100%\\n'", "two\nlines", os.fsdecode(b"byte\xff"))):
            place = self.folder / name
            shutil.copytree(self.output, place)
            campaign = place / "campaign.toml"
            commands = [("status", place), ("status", place, "--json"), ("compare", place), ("export", place, "--table"), ("check", campaign), ("check", campaign, "--json"),
                        ("plan", campaign, "--output", place), ("plot", place, "--only", "cycles"), ("report", place), ("deck", campaign, "--output", place / name),
                        ("measure", place / "cases" / self.only_case().name / "packing-1", "--json"), ("archive", place, "--output", place / f"{name}.zip"), ("compare", place / name),
                        ("init", "pellets", "--output", place / f"{name}.toml"), ("status", place / "none" / name)]  # fmt: skip
            copied = []
            for command in commands:
                if command[0] in (("plot", "report") if number > 0 else ("plot",)) and not WHOLE:
                    continue
                done = subprocess.run([PROGRAM, *map(os.fsencode, map(str, command))], capture_output=True, timeout=SOON)
                said = (done.stdout + done.stderr).decode()  # UTF-8
                with self.subTest(name=name, command=command[0]):
                    self.assertNotRegex(said, STEERING)
                    self.assertNotIn("internal error", said)
                    self.assertNotIn("Traceback", said)
                copied += [line.partition("with: ")[2] for line in said.splitlines() if "with: vibrotrough compare" in line]
            # A command that is copied into a shell means the same file.
            self.assertEqual(len(copied), 1, copied)
            shell = subprocess.run(["sh", "-c", copied[0].replace("vibrotrough", f"'{PROGRAM}'", 1)], capture_output=True)
            self.assertEqual(shell.returncode, 0, shell.stderr)


if __name__ == "__main__":
    unittest.main()
