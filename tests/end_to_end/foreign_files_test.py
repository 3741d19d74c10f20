"""What the program promises about other people's files and names: each docstring is a sentence of .github/PROMISES.md (promises.py)."""

import hashlib
import json
import os
import re
import shutil
import stat
import subprocess
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

from trough_program import PATIENCE, PROGRAM, WHOLE, EndToEndTest

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "postprocess"))
import vibrotrough  # noqa: E402

ONE = {"measure.packings": 1, "measure.max_cycles": 24}

# What draws the efficiency over the campaign, and that with the figures of cases.
SOURCES = Path(__file__).resolve().parent.parent.parent
DRAWING = (("plot", "--only", "efficiency"), ("report",))


class ForeignFiles(EndToEndTest):
    def assert_refused(self, done, code, *parts):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def name_a_template(self, campaign):
        """In the campaign file; it holds a command that would leave a proof."""
        own = (SOURCES / "input_templates" / "contact.mustache").read_text()
        (campaign.parent / "contact.mustache").write_text(own + "shell touch executed\n")
        campaign.write_text(campaign.read_text() + '[engine]\ntemplates = ["contact.mustache"]\n')

    def test_no_command_of_a_campaign_file_reaches_the_engine_unasked(self):
        """The commands of `engine.templates`, which LIGGGHTS would run, reach a deck or the engine only when the person gives `--allow-extra`.
        """
        campaign = self.write_campaign(ONE)
        proofs = lambda: list(self.folder.glob("**/executed"))  # noqa: E731 - LIGGGHTS splits the words, so a name without a folder
        self.name_a_template(campaign)
        domain = self.folder / "domain.toml"
        domain.write_text(f'{campaign.read_text()}[domain]\n"trough.throw_number" = {{ from = 1, to = 3 }}\n')
        for command in (("run", campaign), ("deck", campaign), ("friction-test", campaign), ("convergence", campaign), ("learn", domain, "--half-width", "0.05", "--budget", "1 core-hours")):
            engine = () if command[0] == "deck" else ("--liggghts", self.engine)
            self.assert_refused(self.call(*command, "--output", self.output, *engine), 2, "1 templates beside it", "--allow-extra")
            self.assertEqual(proofs(), [])
            self.assertEqual(list(self.output.glob("**/*.liggghts")), [])
        self.assertEqual(self.take_starts(), [])
        # With leave, the line is what the engine runs.
        done = self.call(*self.run_arguments(campaign), "--allow-extra")
        self.assertIn(done.returncode, (0, 1), done.stderr)  # one packing is not precise
        self.assertNotEqual(proofs(), [])

    def test_no_command_of_an_added_case_reaches_the_engine_unasked(self):
        """The same holds for commands of a case that lies in a campaign's folder as if the program had added it."""
        campaign = self.write_campaign(ONE)
        plain = campaign.read_text()
        domain = self.folder / "domain.toml"
        domain.write_text(f'{plain}[domain]\n"trough.throw_number" = {{ from = 1, to = 3 }}\n')
        for folder, command in (("", ("run", campaign, "--accept-findings")), ("", ("prepare", campaign, "--task-list", self.folder / "tasks", "--accept-findings")),
                                ("", ("learn", domain, "--half-width", "0.05", "--budget", "1 core-hours", "--accept-findings")),
                                ("convergence", ("convergence", campaign)), ("friction-test", ("friction-test", campaign))):
            shutil.rmtree(self.output, ignore_errors=True)
            added = self.output / folder / "added" / "0001"
            added.mkdir(parents=True)
            (added / "scenario.toml").write_text(plain.replace("throw_number = 2.0", "throw_number = 2.1"))
            self.name_a_template(added / "scenario.toml")
            done = self.call(*command, "--output", self.output, "--liggghts", self.engine)
            with self.subTest(command=command[0]):
                self.assert_refused(done, 2, "1 templates beside it", "--allow-extra")
                self.assertEqual(list(self.folder.glob("**/executed")), [])
        self.assertEqual(self.take_starts(), [])

    def test_no_library_of_the_current_folder_is_loaded(self):
        """No shared library of the current folder is loaded."""
        needed = re.findall(r"^\s*(\S+) => /", subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout, re.MULTILINE)
        self.assertIn("libstdc++.so.6", needed)
        for name in needed:
            (self.folder / name).write_text("no library")
        done = subprocess.run([PROGRAM, "keys"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_no_task_runs_commands_of_a_campaign_unasked(self):
        """`run` and `prepare` pass `--allow-extra` on to the tasks of a cluster only when it, or `--templates`, was given to them."""
        campaign, tasks = self.write_campaign(ONE), self.folder / "tasks"
        self.name_a_template(campaign)
        prepare = ["prepare", campaign, "--output", self.output, "--task-list", tasks, "--liggghts", self.engine, "--accept-findings"]
        prepared = self.call(*prepare, "--allow-extra")
        self.assertEqual(prepared.returncode, 0, prepared.stderr)
        self.assertIn("--index $i --allow-extra\n", prepared.stdout)
        work = ["work", self.output, "--task-list", tasks, "--index", 0]
        self.assert_refused(self.call(*work), 2, "1 templates beside it", "--allow-extra")
        self.assertEqual(list(self.folder.glob("**/executed")), [])
        self.assertEqual(self.call(*work, "--allow-extra").returncode, 0)
        self.assertNotEqual(list(self.folder.glob("**/executed")), [])

    def test_devices_and_pipes_are_written_into(self):
        """A character device or a pipe that `--output` names is written into and not replaced; a disk, a socket and links to any of them are refused."""
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

    def test_a_private_file_stays_private(self):
        """A file that is replaced hands on its mode."""
        page = self.folder / "trace.csv"
        for mode in (0o600, 0o640, 0o444):
            page.write_text("")
            page.chmod(mode)
            done = self.call("theory", "trace", "--throw-number", 2, "--vibration-angle", "30 deg", "--friction", 0.4, "--output", page)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(stat.S_IMODE(page.stat().st_mode), mode)
            self.assertGreater(page.stat().st_size, 1000)
            page.chmod(0o600)

    def test_numbers_of_other_files_are_not_believed(self):
        """Numbers of a result lie in its own file: an HDF5 file with links, external storage or virtual datasets is damaged to the program and to its Python
        module.

        The checksum of a result covers its own bytes; HDF5 fetches external and virtual data and what links lead to from other files.
        """
        self.finished_campaign(ONE)
        (result,) = self.results()
        foreign, table = self.folder / "foreign.h5", "series/1"
        whole, before = result.read_bytes(), self.table()
        own = whole[: whole.rindex(b"\nvibrotrough sha256 ")]
        for kind in ("external storage", "external link", "soft link", "virtual dataset"):
            result.write_bytes(own)
            with h5py.File(result, "a") as file:
                values, attributes = file[table][:], dict(file[table].attrs)
                del file[table]
                with h5py.File(foreign, "w") as other:
                    other["values"] = values
                    other["values"].attrs.update(attributes)
                    place = other["values"].id.get_offset()
                if kind == "external storage":
                    file.create_dataset(table, values.shape, values.dtype, external=[(str(foreign), place, values.nbytes)])
                elif kind == "external link":
                    file[table] = h5py.ExternalLink(str(foreign), "/values")
                elif kind == "soft link":
                    file["moved"] = values
                    file[table] = h5py.SoftLink("/moved")
                else:
                    layout = h5py.VirtualLayout(values.shape, values.dtype)
                    layout[:] = h5py.VirtualSource(str(foreign), "values", values.shape)
                    file.create_virtual_dataset(table, layout)
                if kind != "external link":
                    file[table].attrs.update(attributes)
            changed = result.read_bytes()
            result.write_bytes(changed + f"\nvibrotrough sha256 {hashlib.sha256(changed).hexdigest()}\n".encode())
            (result.parent / "summary").unlink(missing_ok=True)
            with self.subTest(kind):
                (row,) = self.table()
                self.assertEqual((row["outcome"], row["efficiency"]), ("interrupted", None), "like any damaged result, it is made again")
                with self.assertRaisesRegex(ValueError, "takes data from other files"):
                    vibrotrough.open_result(result)
        result.write_bytes(whole)
        (result.parent / "summary").unlink(missing_ok=True)
        self.assertEqual(self.table(), before)

    @staticmethod
    def spoil_cycles(result):
        """Makes the cycles of the first packing three times their value, as a disk or a person may do; size, times and inode stay."""
        times = result.stat()
        with h5py.File(result) as file:
            table = file["series/1"]
            place, count, row = table.id.get_offset(), len(table), table.dtype
        with open(result, "r+b") as file:
            file.seek(place)
            values = np.frombuffer(file.read(count * row.itemsize), row).copy()
            values["efficiency"] *= 3
            file.seek(place)
            file.write(values.tobytes())
        os.utime(result, ns=(times.st_atime_ns, times.st_mtime_ns))

    def test_no_number_of_a_damaged_result_is_shown(self):
        """Before a number of a result is shown, drawn or published by `compare`, `plot`, `report`, `export` or `archive`, its bytes are compared with their
        SHA-256; size and times are not believed. `status` and `plan`, which publish none, believe them.

        Its summary beside it is sound, and size and times are the old ones: only the hash of the result tells.
        """
        campaign = self.write_campaign(ONE, {"trough.throw_number": [2.0, 2.2]})
        self.run_campaign(campaign, wanted=None)
        before = self.table()
        result = self.output / "cases" / before[0]["case"] / "result.h5"
        whole, drawn = result.read_bytes(), result.parent.name
        self.spoil_cycles(result)
        self.assertNotEqual(result.read_bytes(), whole)
        with self.assertRaisesRegex(ValueError, "result.h5 is damaged"):
            vibrotrough.open_result(result)
        damaged, sound = self.table()
        self.assertEqual((damaged["outcome"], damaged["efficiency"]), ("interrupted", None))
        self.assertEqual(sound, before[1])
        for command in (("plot", "--only", "cycles"), ("report",)):
            done = self.call(command[0], self.output, *command[1:])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(list(self.output.glob(f"report/*-{drawn}.*")), [])
        self.assertEqual(list(vibrotrough.open_campaign(self.output)["case"]), [sound["case"]])
        data = json.loads((self.output / "report" / "data" / "campaign.json").read_text())
        self.assertEqual([row["efficiency"] for row in data["cases"]], [None, sound["efficiency"]])
        self.assertEqual(self.call("export", self.output, "--table").returncode, 0)
        table = (self.output / "view" / "campaign.vtt").read_text(encoding="utf-8")
        (least, most) = re.search(r'Name="efficiency"[^>]*RangeMin="([^"]*)" *RangeMax="([^"]*)"', table).groups()
        self.assertEqual((float(least), float(most)), (sound["efficiency"],) * 2, "only the sound result is in ParaView's table")
        # What compare and status advise helps: run sees the damage, too.
        self.run_campaign(campaign, wanted=None)
        self.assertEqual([row["efficiency"] for row in self.table()], [row["efficiency"] for row in before])

    def assert_left_aside(self, *parts, archive="--partial", drawing=DRAWING):
        """Every command that shows the campaign says in one line what it leaves aside, and archive refuses it."""
        for command in (("status",), ("compare",), ("compare", "--json"), ("export", "--table"), *drawing):
            done = self.call(command[0], self.output, *command[1:])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stderr, r"(\A|\n)vibrotrough: left aside: [^\n]+\n", command)
            for part in parts:
                self.assertIn(part, done.stderr, command)
        bundle = self.folder / "bundle.zip"
        self.assert_one_line_error(self.call("archive", self.output, "--output", bundle), 2, archive)
        self.assertFalse(bundle.exists())

    def test_what_is_left_aside_is_said(self):
        """What lies in a campaign's folder and cannot be used is named in one line by `status`, `compare`, `export`, `plot`, `report` and `archive`: folders and
        files of a case, and a frozen campaign file that was changed. `archive` refuses it without `--partial`.
        """
        self.run_campaign(self.write_campaign(ONE, {"trough.throw_number": [2.0, 2.1, 2.2]}), wanted=None)
        self.assertEqual(self.call("status", self.output).stderr, "", "nothing is left aside")
        first, second, _ = (self.output / "cases" / row["case"] for row in self.table())
        # Something else has the name of a case's folder.
        hidden = self.folder / "hidden"
        for make in (lambda path: path.write_text("dear"), lambda path: path.symlink_to("nowhere"), os.mkfifo):
            first.rename(hidden)
            make(first)
            self.assert_left_aside("1 of 3 cases", first.name, "not a folder", drawing=DRAWING if WHOLE and first.is_file() else ())
            first.unlink()
            hidden.rename(first)
        # The result is there and cannot be used.
        result = second / "result.h5"
        result.rename(hidden)
        for make in (lambda path: path.write_text("damaged"), lambda path: path.symlink_to("nowhere"), os.mkfifo):
            make(result)
            self.assert_left_aside("1 of 3 cases", second.name, "result.h5 is", archive="result.h5 is damaged", drawing=DRAWING if result.is_file() else ())
            result.unlink()
        hidden.rename(result)
        # The frozen campaign file was edited: two cases of three are left, and nobody would miss the third.
        frozen = self.output / "campaign.toml"
        before = frozen.read_text()
        frozen.write_text(before.replace("2.1, ", ""))
        self.assert_left_aside("campaign.toml", "was changed", "1 case folder that belongs to no case", drawing=DRAWING if WHOLE else DRAWING[:1])
        self.assertEqual(len(self.table()), 2)
        done = self.call("archive", self.output, "--partial", "--output", self.folder / "bundle.zip")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("\nleft aside: ", done.stdout)
        frozen.write_text(before)
        self.assertEqual(self.call("compare", self.output).stderr, "")

    def test_a_folder_that_may_not_be_read_is_said(self):
        """So is a folder of a campaign that may not be read."""
        self.run_campaign(self.write_campaign(ONE, {"trough.throw_number": [2.0, 2.1]}), wanted=None)
        case = self.output / "cases" / self.table()[0]["case"]
        stranger = {"user": 65534, "group": 65534} if os.geteuid() == 0 else {}
        os.chmod(self.folder, 0o755)
        os.chmod(self.output, 0o777)  # for the figures
        (self.output / "campaign.h5").unlink()
        if self.call("status", self.output, **stranger).returncode != 0:
            self.skipTest("another user cannot start the program here")
        for path in (case, case / "result.h5", case / "packing-1" / "packing.json", self.output / "cases"):
            mode = path.stat().st_mode
            if path.name == "packing.json":
                (case / "result.h5").rename(case / "result")
            os.chmod(path, 0)
            # A quick look believes the stamp of a result, and reads none.
            for command in ("status", "compare") if path.name != "result.h5" else ("compare",):
                done = self.call(command, self.output, **stranger)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stderr, r"\Avibrotrough: left aside: [^\n]*(cannot be read|cannot be looked at|cannot open)[^\n]+\n\Z", path)
            os.chmod(path, mode)
            if path.name == "packing.json":
                (case / "result").rename(case / "result.h5")

    def test_what_is_drawn_is_what_was_checked(self):
        """The figures are drawn from the very bytes whose SHA-256 was found right.

        campaign.h5 and the results are drawn by Python, which looks at their hashes itself.
        """
        self.finished_campaign(ONE)
        self.assertEqual(self.call("plot", self.output, "--only", "cycles").returncode, 0)
        (result,) = self.results()
        (figure,) = self.output.glob("report/cycles-*.svg")
        figures = str(Path(vibrotrough.__file__).with_name("figures.py"))
        figure.unlink()
        self.spoil_cycles(result)
        # Called as the program calls it: between its own check and this one, the file was spoilt.
        done = subprocess.run([sys.executable, "-B", figures, self.output, "--only", "cycles"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Afigures.py: case [0-9a-f]{12} is left out: [^\n]*result.h5 is damaged[^\n]*\n\Z")
        self.assertFalse(figure.exists())


if __name__ == "__main__":
    unittest.main()
