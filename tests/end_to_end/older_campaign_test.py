"""A campaign that version 0.1 made: its ids were hashes of decks with their comments. It is opened, compared and continued under
its old ids, and what it had is not run again.
"""

import json
import shutil
import subprocess
import unittest
from pathlib import Path

import h5py
from trough_program import EndToEndTest, fingerprint

STORED = Path(__file__).parent / "campaign_of_version_0.1"
# One case with its result, and one whose simulation had only begun; version 0.1 finished it later with these numbers.
FINISHED, BEGUN = "455974daa9dc", "516d5d3e5ffb"
ETA_OF_BEGUN = 0.8752489592287114
# A campaign of version 0.1 whose case was called finished, because each packing was as precise as asked, although the two differ.
CALLED_FINISHED = Path(__file__).parent / "campaign_called_finished"


def installed_version():
    """The version that LIGGGHTS names itself by, in the form of engine.json."""
    lines = subprocess.run(["liggghts", "-log", "none", "-h"], capture_output=True, text=True, stdin=subprocess.DEVNULL).stdout
    return next((line for line in lines.splitlines() if "Version" in line), "")


class OlderCampaign(EndToEndTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(STORED, self.output)

    def test_it_is_opened_and_compared(self):
        before = {path: fingerprint(path) for path in self.output.rglob("*") if path.is_file()}
        status = self.ask_json("status")
        self.assertEqual([case["case"] for case in status["cases"]], [FINISHED, BEGUN])
        self.assertEqual(status["finished"], 1)
        table = self.table()
        self.assertEqual([row["throw_number"] for row in table], [2.0, 2.5])
        self.assertAlmostEqual(table[0]["efficiency_dem"], 0.785, delta=5e-4)
        self.assertIsNone(table[1]["efficiency_dem"])
        after = {path: fingerprint(path) for path in self.output.rglob("*") if path.is_file()}
        self.assertEqual(before, after, "queries write nothing")

    def test_it_is_continued(self):
        asked = json.loads((STORED / "engine.json").read_text())["version"]
        version = asked.removeprefix("LIGGGHTS-PUBLIC ").split(",")[0]
        if version not in installed_version() or "2022-01-26-19:42:32" not in installed_version():
            self.skipTest(f"the installed LIGGGHTS is not the one that made the campaign: {installed_version()}")
        result = self.output / "cases" / FINISHED / "result.h5"
        before = fingerprint(result)
        self.take_starts()
        self.run_campaign(STORED / "campaign.toml")
        self.assertEqual(len(self.take_starts()), 2, "the two packings of the case that had no result")
        self.assertEqual(fingerprint(result), before, "a result of version 0.1 stays")
        self.assertEqual(sorted(path.name for path in (self.output / "cases").iterdir()), [FINISHED, BEGUN])
        begun = self.table()[1]
        # Its packings start and end otherwise than those of version 0.1, so that only the physics is the same: within the 0.2
        # that the campaign asks for.
        self.assertEqual(begun["outcome"], "finished")
        self.assertLessEqual(begun["efficiency_dem_half_width"], 0.2)
        self.assertAlmostEqual(begun["efficiency_dem"], ETA_OF_BEGUN, delta=0.2)

    def test_a_case_is_finished_only_when_it_is_as_precise_as_asked(self):
        """In every view: status, compare, report, and campaign.h5 that the figures are drawn from."""
        folder = self.folder / "called finished"
        shutil.copytree(CALLED_FINISHED, folder)
        status = self.ask_json("status", folder)
        self.assertEqual((status["finished"], status["unsure"]), (0, 1))
        self.assertEqual(status["cases"][0]["outcome"], "not-precise")
        self.assertRegex(status["cases"][0]["message"], r"needs about \d+ packings")
        row = self.table(folder)[0]
        self.assertEqual(row["outcome"], "not-precise")
        self.assertGreater(row["efficiency_dem_half_width"], 0.04)
        self.assertEqual(self.call("plot", folder).returncode, 0)
        with h5py.File(folder / "campaign.h5") as file:
            self.assertEqual(file["outcome"].asstr()[0], "not-precise")
        cases = json.loads((folder / "report" / "data" / "campaign.json").read_text())["cases"]
        self.assertEqual([case["outcome"] for case in cases], ["not-precise"])

    def test_a_changed_command_is_another_case(self):
        deck = self.output / "cases" / FINISHED / "packing-1" / "in.liggghts"
        deck.write_text(deck.read_text().replace("fix ", "fix  ", 1))
        self.assertEqual(self.ask_json("status")["finished"], 0, "the old id no longer belongs to its files")


if __name__ == "__main__":
    unittest.main()
