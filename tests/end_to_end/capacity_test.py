"""The largest feed of an open trough, found by the real engine: what is fed leaves below it, and the trough fills above it."""

import json
import unittest

from open_trough_test import OPEN
from trough_program import EndToEndTest

# The layer may be two grains and a half high: a short, low trough that is full after a second.
LOW = {**OPEN, "measure.packings": 1, "measure.max_packings": 1, "feed.height": "15 mm", "feed.length": "36 mm", "feed.mass_flow": "0.1 t/h"}


class Capacity(EndToEndTest):
    def search(self, campaign, *options):
        return self.call("capacity", campaign, "--output", self.output, "--jobs", 2, "--liggghts", self.engine, "--progress", "none", *options)

    def test_the_capacity_lies_between_two_feeds(self):
        campaign = self.write_campaign(LOW)
        done = self.search(campaign, "--precision", 1, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        feeds = found["feeds"]
        flows = [one["mass_flow_kg_per_s"] for one in feeds]
        self.assertEqual(flows, sorted(flows))
        # With --precision 1 a factor of two ends the search: the feed of the file, doubled or halved.
        self.assertAlmostEqual(found["not_carried_kg_per_s"] / found["carried_kg_per_s"], 2, places=9)
        self.assertEqual([one["carried"] for one in feeds], [flow <= found["carried_kg_per_s"] for flow in flows])
        self.assertIn("overfull", [one["outcome"] for one in feeds])
        rows = self.table()
        self.assertEqual(len(rows), len(feeds))
        for row_flow, flow in zip(sorted(row["feed.mass_flow"] for row in rows), flows, strict=True):
            self.assertAlmostEqual(row_flow, flow, places=12)
        self.assertEqual(sum(row["outcome"] == "finished" for row in rows), sum(one["carried"] for one in feeds))

        # Each feed is simulated once, also one that was overfull.
        starts = self.take_starts()
        self.assertEqual(len(starts), len(set(starts)), starts)
        self.assertEqual(len(starts), len(feeds))

        # The same call knows all of it, and a text says the same.
        again = self.search(campaign, "--precision", 1)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertRegex(again.stdout, r"the trough carries [\d.]+ t/h and not [\d.]+ t/h")
        self.assertEqual(len(again.stdout.splitlines()), len(feeds) + 2)
        self.assertEqual(self.take_starts(), [])

    def test_wrong_input(self):
        closed = self.write_campaign({})
        self.assert_one_line_error(self.search(closed), 2, "only an open trough has a capacity")
        without_height = self.write_campaign({**LOW, "feed.height": None})
        self.assert_one_line_error(self.search(without_height), 2, "feed.height is missing")
        varied = self.write_campaign(LOW, {"trough.throw_number": [1.5, 2.0]})
        self.assert_one_line_error(self.search(varied), 2, "trough.throw_number is varied")
        self.assert_one_line_error(self.search(self.write_campaign(LOW), "--precision", 0), 2, "--precision")

    def test_a_feed_that_cannot_be_simulated_ends_the_search(self):
        """A stream faster than 1.5 m/s is refused: what the trough itself could carry is not known then."""
        campaign = self.write_campaign({**LOW, "layer.length": "45 mm", "measure.min_cycles": 20, "measure.max_cycles": 20,
                                        "feed.length": "14 mm", "feed.height": "60 mm", "feed.mass_flow": "0.15 t/h"})
        done = self.search(campaign, "--precision", 1)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, "no larger feed was simulated; .* cannot be simulated: .*does not fit through a zone")


if __name__ == "__main__":
    unittest.main()
