"""`vibrotrough observe` with the real engine: a person's own quantities have the program's statistics, are kept and shown like its own, and
nothing of a file runs that was not allowed.
"""

import json
import shutil
import sys
import unittest
import zipfile
from pathlib import Path

import h5py
import numpy as np

from mixture_test import LAYER, MATERIALS
from trough_program import EndToEndTest, campaign_text, sample

SOURCES = Path(__file__).resolve().parent.parent.parent
FRAMES = {"output.frames_per_cycle": 4, "output.frame_packings": "all", "output.contacts": True, "measure.packings": 2,
          "measure.max_cycles": 30}  # fmt: skip
HEAD = "import numpy as np\nimport vibrotrough\n\n"
# The velocity efficiency once more, from the very numbers that the program measures it from.
AGAIN = HEAD + '''@vibrotrough.observable(of="packing", needs="cycles")
def efficiency_again(packing):
    """Displacement of the centre of mass in a cycle over 2 pi r cos(beta)."""
    way = np.diff(packing.table("cycles.csv")["x_com"])[:packing.result_cycles]
    return way * packing.value("frequency") / packing.value("velocity_scale")
'''


class Observe(EndToEndTest):
    def write(self, text, name="mine.py"):
        path = self.folder / name
        path.write_text(text)
        return path

    def observe(self, *words, file=None):
        allowed = [] if file is None else [file, "--allow-python", file]
        return self.call("observe", self.output, *allowed, *words)

    def measured(self, text, *words):
        done = self.observe("--json", *words, file=self.write(HEAD + text))
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["observables"]

    def refused(self, text, *parts, lines=1):
        """The command ends with 2 and the parts in its last line, and keeps nothing. Returns what it said."""
        before = {path: path.read_bytes() for path in (self.output / "observables.json", self.output / "campaign.h5") if path.exists()}
        done = self.observe(file=self.write(HEAD + text))
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        said = done.stderr.splitlines()
        if lines:
            self.assertEqual(len(said), lines, done.stderr)
        self.assertTrue(said[-1].startswith("vibrotrough: "), said)
        for part in parts:
            self.assertIn(part, said[-1])
        for path, content in before.items():
            self.assertEqual(path.read_bytes(), content)
        return done.stderr

    def row(self):
        (row,) = self.table()
        return row

    def test_a_quantity_that_the_program_measures_itself_is_the_same(self):
        self.run_campaign(self.write_campaign(FRAMES))
        done = self.observe(file=self.write(AGAIN))
        self.assertEqual(done.returncode, 0, done.stderr)
        row = self.row()
        # The same numbers; only products and fits round.
        self.assertAlmostEqual(row["efficiency_again"], row["efficiency"], delta=1e-12)
        self.assertAlmostEqual(row["efficiency_again_half_width"], row["efficiency_half_width_statistics"], delta=1e-10)
        done = self.observe()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("surface_waves is not measured: it has no value in any packing", done.stderr, "a box of three columns")
        row = self.row()
        # The dumps have six digits, so that places below 0.1 m are off by 5e-8 m at most, and a displacement by twice that.
        tolerance = 1e-7 * row["frequency_hz"]
        self.assertAlmostEqual(row["speed_of_grains_m_per_s"], row["conveying_speed_m_per_s"], delta=tolerance)
        scale = row["conveying_speed_m_per_s"] / row["efficiency"]
        # The half-width is a factor (Student's 18 or so with one degree of freedom) times a difference of two such means.
        self.assertAlmostEqual(row["speed_of_grains_half_width_m_per_s"], scale * row["efficiency_half_width_statistics"], delta=40 * tolerance)
        self.check_kept(row)

    def check_kept(self, row):
        """In campaign.h5 with units, meaning and source; `run` writes the same file again; a bundle shows the same table."""
        with h5py.File(self.output / "campaign.h5") as file:
            speed = file["observables/speed_of_grains"]
            self.assertEqual(speed["mean"][0], row["speed_of_grains_m_per_s"])
            self.assertEqual(speed["mean"].attrs["units"], b"m/s")
            self.assertTrue(speed["mean"].attrs["description"].startswith(b"Mean velocity of the grains"))
            self.assertEqual(file["observables/efficiency_again/source"].asstr()[0], AGAIN)
            self.assertEqual(len(file["observables/efficiency_again/source_sha256"].asstr()[0]), 64)
            curve = file["observables/stress_profile/curve"][:]
            cycles = int(speed["cycles_measured"][0] + speed["cycles_discarded"][0])
        self.assertTrue(np.isfinite(curve["mean"]).all() and curve["mean"][0] > curve["mean"][-1])
        kept = (self.output / "campaign.h5").read_bytes()
        (self.output / "campaign.h5").unlink()
        self.run_campaign(self.folder / "campaign.toml")
        self.assertEqual((self.output / "campaign.h5").read_bytes(), kept)
        bundle = self.folder / "bundle.zip"
        self.assertEqual(self.call("archive", self.output, "--output", bundle).returncode, 0)
        with zipfile.ZipFile(bundle) as file:
            file.extractall(self.folder / "unpacked")
        self.assertEqual(self.table(self.folder / "unpacked"), self.table())
        self.assertIn("granular_temperature_of_frames", self.call("compare", self.output).stdout)
        self.assertIn(",dispersion_m2_per_s,", self.call("compare", self.output, "--csv").stdout)
        done = self.call("plot", self.output, "--x", "throw_number", "--y", "speed_of_grains", "--output", self.folder / "figures")
        self.assertEqual(done.returncode, 0, done.stderr)
        # The report, whose Python reads campaign.h5, is drawn as before.
        self.assertEqual(self.call("report", self.output).returncode, 0)
        self.assertIn("granular_temperature_of_frames", (self.output / "report" / "report.html").read_text())
        with h5py.File(self.results()[0]) as file:
            self.assertEqual(cycles, len(file["series/1"]))

    def test_the_index_of_segregation_is_that_of_the_program(self):
        """In the last cycle and in each before; the frames show the same grains as the columns of cycles.csv."""
        campaign = self.folder / "campaign.toml"
        campaign.write_text(campaign_text({**LAYER, "output.frames_per_cycle": 1, "measure.packings": 1, "measure.max_packings": 1}) + MATERIALS)
        self.run_campaign(campaign, wanted=None)
        (path,) = self.results()
        sys.path.insert(0, str(Path(__file__).parent.parent.parent / "postprocess"))
        from vibrotrough import Case, observables

        found = observables.segregation_index(Case(path.parent).packing(1))
        with h5py.File(path) as file:
            wanted = file["segregation"]["index_1"][1:]
        # Both have the height of the layer as 0.58 of solid, but the program that of the grains that were asked for: within 2 %, the rounding of
        # 120 grains to a mass fraction. Places have six digits.
        self.assertEqual(len(found), len(wanted))
        ratio = np.array(found) @ wanted / (wanted @ wanted)
        self.assertAlmostEqual(ratio, 1, delta=0.02)
        np.testing.assert_allclose(np.array(found) / ratio, wanted, rtol=0, atol=1e-4)

    def test_files_of_own_templates_are_observables(self):
        """Files that engine.templates write, which need no frames. With ${now} in their names they keep all cycles although the engine begins anew at
        each checkpoint; without it only those since the last one are left."""
        (self.folder / "cycles.mustache").write_text(
            "compute own all ke\nvariable own_energy equal c_own\n"
            'fix own all print ${n} "${now},${own_energy}" file own.${now}.csv screen no title "step,energy"\n'
            'fix lost all print ${n} "${now},${own_energy}" file lost.csv screen no title "step,energy"\n'
            "fix mean all ave/time 1 ${n} ${n} c_own file mean.${now}.txt\n"
            + (SOURCES / "input_templates" / "cycles.mustache").read_text())  # fmt: skip
        path = self.folder / "campaign.toml"
        path.write_text(campaign_text({"output.checkpoint_cycles": 10, "measure.packings": 1}) + '[engine]\ntemplates = ["cycles.mustache"]\n')
        done = self.call(*self.run_arguments(path), "--allow-extra")
        self.assertIn(done.returncode, (0, 1), done.stderr)
        function = '''@vibrotrough.observable(unit="J", of="packing", needs="{0}")
def energy(packing):
    """Kinetic energy at the ends of cycles."""
    table = packing.table("{0}")
    ends = np.arange(1, packing.result_cycles + 1) * packing.steps_per_cycle
    assert list(table["step"]) == list(ends), table["step"]
    return table["{1}"]
'''
        for file, column in (("own.*.csv", "energy"), ("mean.*.txt", "c_own")):
            (found,) = self.measured(function.format(file, column))
            self.assertGreater(found["cases"][0]["mean"][0], 0)
            self.assertGreater(found["cases"][0]["discarded"] + found["cases"][0]["measured"], 10, "there was a checkpoint")
        self.refused(function.format("lost.csv", "energy"), "energy in case", "AssertionError", lines=None)

    def test_what_a_function_may_return(self):
        self.run_campaign(self.write_campaign(FRAMES | {"output.contacts": None}))
        case = self.results()[0].parent.name
        function = '@vibrotrough.observable(unit="m"{})\ndef mine(cycle):\n    """Mine."""\n    {}\n'
        said = self.refused(function.format("", "return helper(cycle)") + "def helper(cycle):\n    return 1 / (cycle.number - 4)\n",
                            f"mine in case {case}, packing 1, cycle 4 failed: ZeroDivisionError: division by zero", lines=None)  # fmt: skip
        self.assertIn("mine.py\", line 7, in mine\n    return helper(cycle)", said)
        self.assertIn("in helper\n    return 1 / (cycle.number - 4)", said)
        self.assertNotIn("observe.py", said, "only the person's own lines are shown")
        self.refused(function.format("", "raise SystemExit(0)"), "packing 1, cycle 1 failed: SystemExit: 0", lines=None)
        for options, returned, part in sample((
            ("", "return 'high'", "cycle 1 returned str; return one number"),
            ("", "return [1, 2]", "cycle 1 returned an array of shape (2,); return one number"),
            ("", "pass", "cycle 1 returned NoneType; return one number"),
            ("", "return np.nan", "returned NaN for all cycles"),
            ("", "return np.ma.masked if cycle.number == 3 else 1.0", "cycle 3 returned nan, which is not a finite number"),
            ("", "return 10**400", "cycle 1 returned a number that is too large"),
            ("", "return np.inf if cycle.number == 3 else 1.0", "cycle 3 returned inf, which is not a finite number"),
            ("", "return np.nan if cycle.number == 3 else 1.0", "cycle 3 returned nan, which is not a finite number"),
            (", over=('height', 'm')", "return 1.0", "cycle 1 returned float; return two arrays of one length"),
            (", over=('height', 'm')", "return [1, 2], [1, 2, 3]", "2 places and values of shape (3,)"),
            (", over=('height', 'm')", "return [1, cycle.number], [1, 2]", "other places than in the cycle before"),
            (", of='packing'", "return [1.0, 2.0]", "returned values for 2 cycles; return an array with a number for each of the"),
            (", of='layer'", "return 1.0", 'write of="cycle" or of="packing"'),
        ), 2):  # fmt: skip
            with self.subTest(returned=returned):
                self.refused(function.format(options, returned), part)
        for text, part in sample((
            (function.format("", "return 1.0").replace("Mine.", ""), "mine has no docstring"),
            (function.format("", "return 1.0").replace('"m"', '"parsnip"'), "'parsnip' is not a unit"),
            (function.format("", "return 1.0").replace("def mine", "def efficiency").replace('"m"', '"1"'), "efficiency is already a quantity of the program"),
            (function.format("", "return 1.0").replace("def mine", "def wall_time").replace('"m"', '"s"'), "already a quantity"),
            (function.format("", "return 1.0").replace("def mine", "def Mine"), "'Mine' cannot be the name of an observable"),
            (function.format(", needs='contacts'", "return 1.0"), "write contacts = true and frames_per_cycle = 20 under [output]"),
            (function.format(", needs='rotor.csv'", "return 1.0"), "no packing has the file rotor.csv"),
            ("x = 1\n", "defines no observable"),
        ), 2):  # fmt: skip
            with self.subTest(text=text):
                self.refused(text, part)
        said = self.refused("x = 1 +\n", "cannot be run: SyntaxError: invalid syntax", lines=None)
        self.assertIn("line 4", said)
        self.assertFalse((self.output / "observables.json").exists())
        # Values that are not there at the beginning, as those of a mean over the last cycles, are a start-up.
        (found,) = self.measured(function.format("", "return np.nan if cycle.number < 4 else float(cycle.number > 8)"))
        self.assertGreaterEqual(found["cases"][0]["discarded"], 8)
        self.assertEqual(found["cases"][0]["mean"], [1.0])
        self.assert_one_line_error(self.observe("--only", "yours", file=self.folder / "mine.py"), 2, "has no observable yours; it has mine")

    def test_without_frames_the_key_is_named(self):
        self.finished_campaign({"measure.packings": 1})
        own = self.write(HEAD + '@vibrotrough.observable()\ndef mine(cycle):\n    """Mine."""\n    return 1.0\n')
        self.assert_one_line_error(self.observe(file=own), 2, "mine cannot be measured: no packing keeps frames",
                                   "write frames_per_cycle = 20 under [output] in the campaign file", 'frame_packings = "all"')  # fmt: skip
        self.assert_one_line_error(self.call("observe", self.folder), 2, "is not a campaign folder")
        self.assert_one_line_error(self.call("observe"), 2, "DIR is missing")
        examples = self.call("observe", "--examples")
        self.assertEqual(examples.returncode, 0)
        compile(examples.stdout, "examples", "exec")

    def test_frames_that_are_gone_are_told(self):
        changes = FRAMES | {"output.contacts": None, "output.frame_packings": None, "measure.packings": 1}
        self.run_campaign(self.write_campaign(changes, {"layer.grains": [60, 70]}), wanted=None)
        own = self.write(HEAD + '@vibrotrough.observable()\ndef mine(cycle):\n    """Mine."""\n    print("a word")\n    return float(len(cycle.frames))\n')
        done = self.observe("--json", file=own)
        self.assertEqual(len(json.loads(done.stdout)["observables"][0]["cases"]), 2, "what a function prints is not part of the answer")
        self.assertIn("a word", done.stderr)
        first, second = (path.parent for path in self.results())
        dumps = sorted((first / "packing-1" / "dump").glob("frames.*.dump"), key=lambda path: int(path.name.split(".")[1]))
        for gone in (dumps[5], dumps[-1]):
            kept = gone.read_bytes()
            gone.unlink()
            done = self.observe(file=own)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("dump lacks 1 of its", done.stderr)
            gone.write_bytes(kept)
        shutil.rmtree(second / "packing-1" / "dump")
        done = self.observe(file=own)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"mine is not measured in {second.name}", done.stderr)

    def test_what_belongs_to_an_earlier_result_is_left_aside(self):
        changes = {"grains.youngs_modulus": "1 MPa", "measure.packings": 2, "measure.half_width": 0.15,  # more than the numerical errors of these grains
                   "measure.max_cycles": 20}  # fmt: skip
        self.run_campaign(self.write_campaign(changes), wanted=None)
        self.assertEqual(self.observe(file=self.write(AGAIN)).returncode, 0)
        self.assertIsNotNone(self.row()["efficiency_again"])
        # More packings are allowed: the same case, another result.
        self.run_campaign(self.write_campaign(changes | {"measure.max_packings": 4}), wanted=None)
        self.assertEqual(len(self.table()), 1)
        self.assertIsNone(self.row()["efficiency_again"])
        done = self.call("compare", self.output)
        self.assertNotIn("efficiency_again", done.stdout)
        self.assertIn("observables of 1 case, which belong to an earlier result; 'vibrotrough observe' measures them again", done.stderr)
        with h5py.File(self.output / "campaign.h5") as file:
            self.assertTrue(np.isnan(file["observables/efficiency_again/mean"][0]))
        self.assertEqual(self.observe(file=self.folder / "mine.py").returncode, 0)
        self.assertIsNotNone(self.row()["efficiency_again"])
        self.assertEqual(self.call("compare", self.output).stderr, "")

    def test_a_file_that_is_not_allowed_is_not_run(self):
        self.finished_campaign({"measure.packings": 1})
        proof = self.folder / "ran"
        mine = self.write(f"open({str(proof)!r}, 'w').close()\n" + AGAIN)
        other = self.write(AGAIN, "other.py")
        for words in ([], ["--allow-python", other], ["--allow-python", self.folder / "gone.py"], ["--allow-python", self.folder]):
            done = self.call("observe", self.output, mine, *words)
            self.assert_one_line_error(done, 2, str(mine), "can do anything that you can", "--allow-python")
            self.assertFalse(proof.exists())
        self.assert_one_line_error(self.call("observe", self.output, self.folder / "gone.py"), 2, "there is no such file")
        link = self.folder / "link.py"
        link.symlink_to(mine)
        self.assertEqual(self.call("observe", self.output, mine, "--allow-python", link).returncode, 0, "it is that very file")
        self.assertTrue(proof.exists())


if __name__ == "__main__":
    unittest.main()
