"""Sentences of .github/SECURITY.md about what other people's files and names make the program do: each has a test of the name that the page gives."""

import hashlib
import os
import shutil
import stat
import subprocess
import sys
import unittest
from pathlib import Path

import h5py

from trough_program import PATIENCE, EndToEndTest

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "postprocess"))
import vibrotrough  # noqa: E402

ONE = {"measure.packings": 1, "measure.max_cycles": 24}


class ForeignFiles(EndToEndTest):
    def assert_refused(self, done, code, *parts):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_no_command_of_a_campaign_file_reaches_the_engine_unasked(self):
        campaign = self.write_campaign(ONE)
        proofs = lambda: list(self.folder.glob("**/executed"))  # noqa: E731 - LIGGGHTS splits the words, so a name without a folder
        (self.folder / "x.liggghts").write_text("[after-contact]\nshell touch executed\n")
        (self.folder / "contact.mustache").write_text("shell touch executed\n")
        plain = campaign.read_text()
        for line, shown in (('extra = "x.liggghts"', "shell touch"), ('templates = ["contact.mustache"]', "1 templates beside it")):
            campaign.write_text(f"{plain}[engine]\n{line}\n")
            domain = self.folder / "domain.toml"
            domain.write_text(f'{campaign.read_text()}[domain]\n"trough.throw_number" = {{ from = 1, to = 3 }}\n')
            for command in (("run", campaign), ("deck", campaign), ("friction-test", campaign), ("convergence", campaign), ("learn", domain, "--half-width", "0.05", "--budget", "1 core-hours")):
                engine = () if command[0] == "deck" else ("--liggghts", self.engine)
                self.assert_refused(self.call(*command, "--output", self.output, *engine), 2, shown, "--allow-extra")
                self.assertEqual(proofs(), [])
                self.assertEqual(list(self.output.glob("**/*.liggghts")), [])
        self.assertEqual(self.take_starts(), [])
        # With leave, the line is what the engine runs.
        campaign.write_text(f'{plain}[engine]\nextra = "x.liggghts"\n')
        done = self.call(*self.run_arguments(campaign), "--allow-extra")
        self.assertIn(done.returncode, (0, 1), done.stderr)  # one packing is not precise
        self.assertNotEqual(proofs(), [])

    def test_no_command_of_an_added_case_reaches_the_engine_unasked(self):
        campaign = self.write_campaign(ONE)
        plain = campaign.read_text()
        domain = self.folder / "domain.toml"
        domain.write_text(f'{plain}[domain]\n"trough.throw_number" = {{ from = 1, to = 3 }}\n')
        for folder, command in (("", ("run", campaign, "--accept-findings")), ("", ("prepare", campaign, "--task-list", self.folder / "tasks", "--accept-findings")),
                                ("", ("learn", domain, "--half-width", "0.05", "--budget", "1 core-hours", "--accept-findings")),
                                ("convergence", ("convergence", campaign)), ("friction-test", ("friction-test", campaign))):
            for line, shown in (('extra = "x.liggghts"', "shell touch"), ('templates = ["contact.mustache"]', "1 templates beside it")):
                shutil.rmtree(self.output, ignore_errors=True)
                added = self.output / folder / "added" / "0001"
                added.mkdir(parents=True)
                (added / "scenario.toml").write_text(plain.replace("throw_number = 2.0", "throw_number = 2.1") + f"[engine]\n{line}\n")
                (added / "x.liggghts").write_text("[after-contact]\nshell touch executed\n")
                (added / "contact.mustache").write_text("shell touch executed\n")
                done = self.call(*command, "--output", self.output, "--liggghts", self.engine)
                with self.subTest(command=command[0], line=line):
                    self.assert_refused(done, 2, shown, "--allow-extra")
                    self.assertEqual(list(self.folder.glob("**/executed")), [])
        self.assertEqual(self.take_starts(), [])

    def test_no_task_runs_commands_of_a_campaign_unasked(self):
        campaign, tasks = self.write_campaign(ONE), self.folder / "tasks"
        (self.folder / "x.liggghts").write_text("[after-contact]\nshell touch executed\n")
        campaign.write_text(campaign.read_text() + '[engine]\nextra = "x.liggghts"\n')
        prepare = ["prepare", campaign, "--output", self.output, "--task-list", tasks, "--liggghts", self.engine, "--accept-findings"]
        prepared = self.call(*prepare, "--allow-extra")
        self.assertEqual(prepared.returncode, 0, prepared.stderr)
        self.assertIn("--index $i --allow-extra\n", prepared.stdout)
        work = ["work", self.output, "--task-list", tasks, "--index", 0]
        self.assert_refused(self.call(*work), 2, "shell touch", "--allow-extra")
        self.assertEqual(list(self.folder.glob("**/executed")), [])
        self.assertEqual(self.call(*work, "--allow-extra").returncode, 0)
        self.assertNotEqual(list(self.folder.glob("**/executed")), [])

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
        for command in (trace, ["probe-engine", "--output"]):
            done = self.call(*command, null)
            if done.returncode == 3 and "Permission denied" in done.stderr:
                self.skipTest("this file system has no devices")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(stat.S_ISCHR(null.stat().st_mode), command)

    def test_a_private_file_stays_private(self):
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
        """The checksum of a result covers its own bytes; HDF5 fetches external and virtual data and what links lead to from other files."""
        self.run_campaign(self.write_campaign(ONE), wanted=None)
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
                self.assertEqual((row["outcome"], row["efficiency_dem"]), ("interrupted", None), "like any damaged result, it is made again")
                with self.assertRaisesRegex(ValueError, "takes data from other files"):
                    vibrotrough.open_result(result)
        result.write_bytes(whole)
        (result.parent / "summary").unlink(missing_ok=True)
        self.assertEqual(self.table(), before)


if __name__ == "__main__":
    unittest.main()
