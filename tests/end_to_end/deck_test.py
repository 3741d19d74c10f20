"""Decks run by hand give the numbers that the driver gets."""

import shlex
import shutil
import subprocess
import unittest

from trough_program import PATIENCE, EndToEndTest, count_cycles

SWEEP = {"trough.throw_number": [0.8, 2.0]}


class Deck(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.campaign = self.write_campaign({}, SWEEP)
        self.decks = self.folder / "decks"

    def run_by_hand(self, packing):
        for deck in ("settle.liggghts", "in.liggghts"):
            done = subprocess.run(
                [shutil.which("liggghts"), "-in", deck], cwd=packing, capture_output=True, text=True, timeout=PATIENCE
            )
            self.assertEqual(done.returncode, 0, done.stdout[-2000:])
            # The deck sets thermo_modify again after this warning, which the engine always gives; after a checkpoint
            # the mesh lies on the box faces up to rounding. No other warning is expected.
            output = done.stdout.split("VIBROTROUGH BEGIN cycle 50")[0]
            warnings = [line for line in output.splitlines() if "WARNING" in line and "thermo_style" not in line]
            self.assertEqual(warnings, [])
        return packing / "cycles.csv"

    def test_by_hand_as_by_the_driver(self):
        told = self.call("deck", self.campaign, "--output", self.decks)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("2 cases written", told.stdout)
        self.assertIn(f"cd {shlex.quote(str(self.decks / 'case-001' / 'packing-1'))} && liggghts -in settle.liggghts && liggghts -in in.liggghts", told.stdout)
        written = sorted(str(path.relative_to(self.decks)) for path in self.decks.glob("*/*"))
        wanted = [f"case-00{case}/{name}" for case in (1, 2) for name in ("packing-1", "packing-2", "scenario.toml")]
        self.assertEqual(written, wanted)

        self.run_campaign(self.campaign)
        for number, row in enumerate(self.table(), start=1):
            by_hand = self.decks / f"case-00{number}" / "packing-2"
            driven = self.output / "cases" / row["case"] / "packing-2"
            for name in ("in.liggghts", "settle.liggghts", "trough.stl"):
                self.assertEqual((by_hand / name).read_bytes(), (driven / name).read_bytes())
            cycles, driven_cycles = self.run_by_hand(by_hand), driven / "cycles.csv"
            self.assertEqual(count_cycles(cycles), 18, "the first round where a half-width of 1 is asked for")
            # The same program on the same machine with the same input: equal, digit for digit.
            self.assertEqual(cycles.read_text(), driven_cycles.read_text(), "the driver's cycles are not those run by hand")

    def test_the_frozen_case_gives_the_same_deck(self):
        self.call("deck", self.campaign, "--output", self.decks)
        again = self.folder / "again"
        told = self.call("deck", self.decks / "case-002" / "scenario.toml", "--output", again)
        self.assertEqual(told.returncode, 0, told.stderr)
        for name in ("packing-1/in.liggghts", "packing-2/in.liggghts", "packing-1/trough.stl", "scenario.toml"):
            first = (self.decks / "case-002" / name).read_bytes()
            self.assertEqual((again / "case-001" / name).read_bytes(), first, name)

    def content(self, folder):
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    def write_decks(self, changes=None):
        return self.call("deck", self.write_campaign(changes, SWEEP), "--output", self.decks)

    def test_no_file_is_replaced(self):
        self.assertEqual(self.write_decks().returncode, 0)
        first = self.content(self.decks)
        (self.decks / "case-001" / "packing-1" / "cycles.csv").write_text("a run by hand")
        self.assertEqual(self.write_decks().returncode, 0, "the same deck may be written again")
        self.assertEqual(self.content(self.decks), first | {"case-001/packing-1/cycles.csv": b"a run by hand"})
        before = self.content(self.decks)
        self.assert_one_line_error(self.write_decks({"trough.friction": 0.3}), 2, "is there already", "choose another folder with --output")
        self.assertEqual(self.content(self.decks), before)


if __name__ == "__main__":
    unittest.main()
