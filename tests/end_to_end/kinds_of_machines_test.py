"""Each kind of machine: an own trough, an open one, which is fed with a mixture or in stages, a mixture, a drive in stages, screens with a
batch and with a feed. The smallest campaign of each runs to its end, has the numbers of
its kind, a frame of each cycle for ParaView, and an archive that says the same.
"""

import json
import re
import unittest

import fed_screen_test
import mixture_test
import open_trough_test
import own_trough_test
import screen_test
import stages_test
from trough_program import EndToEndTest, campaign_text, without_wall_time

# One packing with one frame per cycle. What is frequent enough that a kill costs cycles, and rare enough that it costs some.
SHARED = {"measure.packings": 1, "measure.max_packings": 1, "output.frames_per_cycle": 1, "output.checkpoint_cycles": 6}
# Of each kind: changes of the smallest campaign, text after it, and which columns of the table must have a number.
KINDS = {
    "own trough": ({**own_trough_test.CHANGES, "trough.mesh": "own.stl"}, "", ["efficiency"]),
    "open": (open_trough_test.OPEN, "", ["outflow_t_per_h", "residence_time_s"]),
    "fed mixture": (open_trough_test.OPEN, open_trough_test.MATERIALS, ["outflow_t_per_h", "segregation"]),
    "fed stages": ({**open_trough_test.OPEN, "measure.min_cycles": None, "measure.max_cycles": None}, open_trough_test.STAGES, ["outflow_t_per_h", "stage_speed_m_per_s"]),
    "mixture": (mixture_test.LAYER, mixture_test.MATERIALS, ["segregation"]),
    "stages": ({**stages_test.DRIVE, **stages_test.PLAN}, stages_test.STAGES, ["stage_speed_m_per_s"]),
    "screen": (screen_test.SCREEN, "", ["screening_efficiency"]),
    "fed screen": (fed_screen_test.FED_SCREEN, "", ["screening_efficiency", "outflow_t_per_h"]),
}
WITHOUT_MOST = ("stages", "screen", "fed stages")  # these refuse measure.max_packings


class KindTest(EndToEndTest):
    """What can be asked of a campaign of any kind."""

    def setUp(self):
        super().setUp()
        (self.folder / "own.stl").write_bytes(own_trough_test.stl(own_trough_test.FLOOR + own_trough_test.WALLS))

    def write_kind(self, kind, end=""):
        changes, text, _ = KINDS[kind]
        path = self.folder / "campaign.toml"
        written = campaign_text({**changes, **SHARED}).replace("max_packings = 1\n", "" if kind in WITHOUT_MOST else "max_packings = 1\n")
        path.write_text(written + text + end)
        return path

    def run_kind(self, kind):
        """Its row of the table."""
        self.output = self.folder / kind
        self.run_campaign(self.write_kind(kind), wanted=None)
        (row,) = without_wall_time(self.table())
        for column in KINDS[kind][2]:
            self.assertIsNotNone(row[column], f"{kind}: {json.dumps(row)}")
        return row

    def check_frames(self):
        """A frame of each cycle, of grains and of the trough, and of walls where the trough has some of its own."""
        done = self.call("export", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        (case,) = self.output.glob("cases/*")
        frames = len(list((case / "packing-1" / "dump").glob("frames.*.dump")))
        self.assertGreater(frames, 15)
        walls = [name for name in ("left", "right", "back", "end") if (case / "packing-1" / f"{name}.stl").exists()]
        for name in ("grains", "trough", *(["walls"] if walls else [])):
            collection = (case / "frames" / f"{name}.pvd").read_text()
            self.assertEqual(len(re.findall("<DataSet", collection)), frames, name)
            self.assertEqual(len(list((case / "frames" / name).glob("*.vtp"))), frames, name)

    def check_bundle(self, row):
        again = self.row_of_bundle()
        again.pop("bundle", None)
        self.assertEqual({name: again.get(name) for name in row}, row)


class Kinds(KindTest):
    def test_each_kind_runs_to_its_end(self):
        for kind in KINDS:
            with self.subTest(kind):
                self.run_kind(kind)
                self.check_frames()
                self.check_bundle(self.table()[0])


if __name__ == "__main__":
    unittest.main()
