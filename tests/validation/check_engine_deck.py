"""The helper that runs validation/'s own LIGGGHTS decks: floors, tables, and what it says when a deck or the engine fails."""

import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, sys.argv[1])
import engine_deck  # noqa: E402

DUMP = """ITEM: TIMESTEP
{0}
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp ff
0 1
0 1
0 1
ITEM: ATOMS id z vz
1 0.5 {0}
2 0.25 -1e-3
"""


class EngineDeck(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def deck(self, text):
        (self.folder / "in.liggghts").write_text(text)

    def test_a_floor_covers_its_rectangle_once_and_ends_on_its_edges(self):
        words = [line.split() for line in engine_deck.flat_floor(0.3, 0.1, 0.05).splitlines()]
        points = np.array([list(map(float, line[1:])) for line in words if line[0] == "vertex"]).reshape(-1, 3, 3)
        areas = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])[:, 2] / 2
        self.assertTrue((areas > 0).all())
        self.assertAlmostEqual(areas.sum(), 0.03, places=12)
        self.assertEqual((points[:, :, 0].max(), points[:, :, 1].max(), points.min()), (0.3, 0.1, 0.0))

    def test_a_dump_is_read_as_steps_and_columns(self):
        (self.folder / "dump").write_text(DUMP.format(0) + DUMP.format(20))
        steps, columns = engine_deck.read_dump(self.folder / "dump")
        self.assertEqual(list(steps), [0, 20])
        self.assertEqual(columns["vz"].tolist(), [[0, -1e-3], [20, -1e-3]])

    def test_lines_with_remarks_are_read_by_column(self):
        (self.folder / "t.csv").write_text("# SI\nstep,z\n# driven from here\n0,1.5\n10,2\n")
        self.assertEqual(engine_deck.read_lines(self.folder / "t.csv")["z"].tolist(), [1.5, 2])

    def test_variables_reach_the_deck_and_words_with_spaces_stay_one(self):
        self.deck('print "VIBROTROUGH DONE ${a}"\n')
        self.assertIn("VIBROTROUGH DONE limitForce on", engine_deck.run_deck(self.folder, "in.liggghts", {"a": "limitForce on"}))

    def test_a_deck_that_fails_or_ends_early_is_named(self):
        for text in ("no such command\n", 'print "early"\n'):
            self.deck(text)
            with self.assertRaisesRegex(SystemExit, "in.screen"):
                engine_deck.run_deck(self.folder, "in.liggghts")

    def test_a_finished_deck_is_not_run_again_but_a_changed_one_is(self):
        self.deck('print "VIBROTROUGH DONE"\n')
        engine_deck.run_deck(self.folder, "in.liggghts", resume=True)
        (self.folder / "in.screen").write_text("VIBROTROUGH DONE of old\n")
        self.assertIn("of old", engine_deck.run_deck(self.folder, "in.liggghts", resume=True))
        engine_deck.write_if_new(self.folder / "in.liggghts", 'print "VIBROTROUGH DONE"\n')
        self.assertIn("of old", engine_deck.run_deck(self.folder, "in.liggghts", resume=True))
        engine_deck.write_if_new(self.folder / "in.liggghts", 'print "VIBROTROUGH DONE anew"\n')
        later = (self.folder / "in.screen").stat().st_mtime + 1
        os.utime(self.folder / "in.liggghts", (later, later))
        self.assertIn("anew", engine_deck.run_deck(self.folder, "in.liggghts", resume=True))

    def test_a_missing_engine_is_said(self):
        path = os.environ["PATH"]
        os.environ["PATH"] = str(self.folder)
        try:
            with self.assertRaisesRegex(SystemExit, "package liggghts"):
                engine_deck.run_deck(self.folder, "in.liggghts")
        finally:
            os.environ["PATH"] = path


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
