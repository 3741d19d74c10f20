"""Exit codes, and errors that are one line: where, what is wrong, what to do."""

import os
import re
import signal
import subprocess
import unittest

from trough_program import PROGRAM, EndToEndTest, campaign_text, engines_in, wait_until

ENGINE_ADVICE = "apt-get install --no-install-recommends liggghts"


class WrongInput(EndToEndTest):
    def refuse(self, text, marked, *parts):
        """Both commands that read a campaign name the line and column of `marked`, leave nothing, start nothing."""
        before, found, _ = text.partition(marked)
        self.assertTrue(found, f"{marked!r} is not in the campaign")
        line, column = before.count("\n") + 1, len(before) - (before.rfind("\n") + 1) + 1
        campaign = self.folder / "wrong.toml"
        campaign.write_text(text)
        for command in (["run", campaign, "--output", self.output, "--liggghts", self.engine],
                        ["deck", campaign, "--output", self.output]):  # fmt: skip
            done = self.call(*command)
            self.assert_one_line_error(done, 2, f"{campaign}:{line}:{column}: ", *parts)
        self.assertFalse(self.output.exists(), "a wrong input leaves nothing behind")
        self.assertEqual(self.take_starts(), [])

    def test_wrong_values(self):
        for path, value, marked, *parts in (
            ("trough.amplitude", "6", '"6"', "has no unit", 'write amplitude = "6 mm"'),
            ("trough.amplitude", 0.0061, "0.0061", "has no unit", 'write amplitude = "6 mm"'),
            ("trough.amplitude", "6 kg", '"6 kg"', "cannot be converted to m"),
            ("trough.friction", -0.25, "-0.25", "out of range", "0 to 5"),
            ("trough.restitution", 0.01, "0.01", "out of range", "above 0.05"),
            ("trough.inclination", "50 deg", '"50 deg"', "out of range", "-45 to 45 deg"),
            ("grains.density", "1400 kg", '"1400 kg"', "cannot be converted to kg/m3"),
            ("grains.poisson_ratio", "soft", '"soft"', "is a text, but the key needs a plain number"),
            ("layer.grains", 60.5, "60.5", "not a whole number"),
            ("layer.length", "12.5 mm", 'length = "12.5', "4 diameters of the largest grains", '"13.2 mm"'),
            ("measure.confidence", 95, "95", "out of range", "0.5 to 0.9999"),
            ("measure.max_cycles", 7, "7", "out of range"),
            ("campaign.name", "../up", 'name = "../up"', "is not a valid name"),
        ):
            with self.subTest(key=path, value=value):
                self.refuse(campaign_text({path: value}), marked, f" {path}: ", *parts)

    def test_wrong_keys(self):
        self.refuse(campaign_text({"trough.frictoin": 0.3}), "frictoin", "unknown key", "did you mean trough.friction?")
        self.refuse(campaign_text().replace("[trough]", "[through]"), "through", "unknown section", "did you mean [trough]?")
        # What is missing has no place of its own: its section's heading.
        self.refuse(campaign_text({"trough.friction": None}), "trough]", "trough.friction: is missing")
        self.refuse(campaign_text({"layer.grains": None}), "layer]", "exactly one of height, diameters, grains, block, feed.mass_flow is needed")
        both = campaign_text({"trough.frequency": "13 Hz"})
        self.refuse(both, "frequency", "trough.throw_number is also given, on line 7", "keep one of the two")
        self.refuse("[campaign\n", "\n", "TOML")
        self.refuse("\n", "\n", "the section [campaign] is missing")

    def test_wrong_sweeps(self):
        self.refuse(campaign_text(sweep={"trough.friction": [0.1, 7]}), "7]", "trough.friction: 7 is out of range")
        self.refuse(campaign_text(sweep={"trough.friction": []}), '"trough.friction"', "no values to sweep over")
        self.refuse(campaign_text(sweep={"trough.fiction": [0.1]}), '"trough.fiction"', "did you mean trough.friction?")
        self.refuse(campaign_text(sweep={"campaign.name": ["a"]}), '"campaign.name"', "this key cannot be varied")

    def test_several_mistakes_are_told_at_once(self):
        changes = {"grains.frictoin": 0.3, "trough.friction": -0.25, "layer.grains": 60.5}
        campaign = self.folder / "wrong.toml"
        campaign.write_text(campaign_text(changes))
        done = self.call("check", campaign)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        told = done.stderr.splitlines()
        self.assertEqual(len(told), 3, told)
        for line, part in zip(told, ("trough.friction: -0.25 is out of range", "did you mean grains.friction?", "60.5 is not a whole number")):
            self.assertTrue(line.startswith(f"vibrotrough: {campaign}:"), line)
            self.assertIn(part, line)

    def test_wrong_command_lines(self):
        campaign = self.write_campaign()
        for arguments, told in (
            ((), "A subcommand is required"),
            (("conquer",), "there is no command 'conquer'"),
            (("run",), "CAMPAIGN.toml is required"),
            (("run", campaign, "--fast"), "--fast"),
            (("run", campaign, "--jobs", "0"), "--jobs: Value 0 not in range"),
            (("run", campaign, "--jobs", "two"), "--jobs"),
            (("deck", campaign), "--output is required"),
            (("compare", self.folder, "--csv", "--json"), "--json excludes --csv"),
            (("status",), "DIR is required"),
            (("export", self.folder, "--everything"), "--everything"),
        ):
            with self.subTest(arguments=arguments):
                done = self.call(*arguments, cwd=self.folder)
                self.assert_one_line_error(done, 2, told, "--help")
                self.assertEqual(done.stdout, "")

    def test_folders_that_are_no_campaign(self):
        a_file = self.folder / "file"
        a_file.touch()
        for command in ("compare", "status", "export"):
            for folder in (self.folder, self.folder / "gone", a_file):
                with self.subTest(command=command, folder=folder):
                    told = f"{folder} is not a campaign folder"
                    self.assert_one_line_error(self.call(command, folder), 2, told, "vibrotrough run")

    def test_help_is_no_error(self):
        for arguments in (("--help",), ("run", "--help"), ("compare", "--help"), ("--version",)):
            done = self.call(*arguments)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("vibrotrough", done.stdout)

    def test_help_of_every_command_fits_and_has_an_example(self):
        def commands(*path):
            # The list ends where a line is not indented: CLI11 2.4 leaves no blank line behind it.
            listed = re.match(r"(?: .*\n)*", self.call(*path, "--help").stdout.partition("Subcommands:\n")[2])[0]
            return [(*path, name) for name in re.findall(r"^  (\S+)", listed, re.MULTILINE)]

        every = [command for command in commands() if command != ("theory",)] + commands("theory")
        self.assertGreater(len(every), 20)
        for command in every:
            with self.subTest(command=command):
                text = self.call(*command, "--help").stdout
                self.assertRegex(text, rf"\nExamples?:\n  vibrotrough {' '.join(command)}")
                self.assertEqual([line for line in text.splitlines() if len(line) > 100], [])


class SomethingMissing(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.campaign = self.write_campaign()

    def refuse_engine(self, engine, told):
        done = self.call("run", self.campaign, "--output", self.output, "--liggghts", engine)
        self.assert_one_line_error(done, 3, told)
        self.assertFalse(self.output.exists())

    def test_no_engine(self):
        self.refuse_engine("/nonexistent", "there is no file /nonexistent")
        self.refuse_engine(self.folder, "there is no file")
        self.refuse_engine("/bin/true", "/bin/true does not identify itself as LIGGGHTS")
        self.refuse_engine(self.campaign, "does not identify itself as LIGGGHTS")  # not executable either
        nowhere = {"PATH": str(self.folder)}
        done = self.call("run", self.campaign, "--output", self.output, env=nowhere)
        self.assert_one_line_error(done, 3, "no liggghts on the PATH", ENGINE_ADVICE)
        # What needs no engine works without.
        self.assertEqual(self.call("deck", self.campaign, "--output", self.output, env=nowhere).returncode, 0)

    def test_no_campaign_file(self):
        gone = self.folder / "gone.toml"
        self.assert_one_line_error(self.call("run", gone), 2, f"{gone}: there is no such file")
        self.assert_one_line_error(self.call("deck", self.folder, "--output", self.output), 2, "no such file")

    def test_no_place_for_results(self):
        # Below a regular file not even root can make a folder.
        below = self.campaign / "runs"
        for folder in (below, self.campaign):
            for command in ("run", self.campaign, "--liggghts", self.engine), ("deck", self.campaign):
                done = self.call(*command, "--output", folder)
                self.assert_one_line_error(done, 3, f"cannot make the folder {folder}", "choose another folder")
        self.assertEqual(self.take_starts(), [])

    def test_output_that_does_not_arrive(self):
        decks = self.folder / "decks"
        for arguments in (("deck", self.campaign, "--output", decks), ("--help",), ("theory", "point", "--help")):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, *map(str, arguments)], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertRegex(done.stderr, r"\Avibrotrough: .*No space left on device[^\n]*\n\Z")

    def test_one_driver_at_a_time(self):
        driver = self.start_campaign(self.campaign)
        wait_until(lambda: engines_in(self.output), "an engine ran", driver)
        driver.send_signal(signal.SIGSTOP)  # so that it is surely still there
        self.addCleanup(lambda: driver.poll() is None and driver.send_signal(signal.SIGCONT))
        second = self.call(*self.run_arguments(self.campaign))
        self.assert_one_line_error(second, 3, "another vibrotrough is running the campaign", str(self.output))
        self.assertEqual(self.ask_json("status")["running"], 1)
        self.assertEqual([row["outcome"] for row in self.table()], ["running"])

        os.kill(driver.pid, signal.SIGCONT)
        code, output, errors = self.finish(driver)
        self.assertEqual(code, 0, output + errors)
        self.assertEqual(len(self.take_starts()), 2, "the second driver started nothing")
        # The folder is free again.
        self.run_campaign(self.campaign)
        self.assertEqual(self.take_starts(), [])


if __name__ == "__main__":
    unittest.main()
