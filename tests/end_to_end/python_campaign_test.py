"""vibrotrough.Campaign, as a researcher uses it in Python: plan, check, run, table and cases are those of the program."""

import json
import sys
import unittest
from pathlib import Path

from trough_program import PROGRAM, EndToEndTest, engines_in

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "postprocess"))
import vibrotrough  # noqa: E402


class PythonCampaign(EndToEndTest):
    def campaign(self, changes=None, name="campaign.toml"):
        file = self.write_campaign(changes, {"trough.throw_number": [1.5, 2.0]}, name=name)
        return vibrotrough.Campaign(file, self.output, PROGRAM)

    def test_from_the_file_to_the_table(self):
        campaign = self.campaign()
        self.assertEqual(list(campaign.plan()["throw_number"]), [1.5, 2.0])
        self.assertEqual(set(campaign.plan()["outcome"]), {"open"})
        self.assertEqual([case["outside"] for case in campaign.predict()], [[], []])
        fast = self.write_campaign(None, {"trough.throw_number": [3.5]}, name="fast.toml")
        self.assertEqual([case["outside"] for case in vibrotrough.Campaign(fast, self.folder / "fast", PROGRAM).predict()], [["throw_number"]])
        with self.assertRaisesRegex(vibrotrough.ProgramError, "is not a campaign folder"):
            campaign.table()
        events = []
        # The check has something to say of so small a box.
        self.assertTrue(campaign.check())
        self.assertTrue(campaign.run(jobs=2, progress=events.append, options=["--accept-findings"]))
        self.assertEqual(sum(event["event"] == "case_ended" for event in events), 2)

        table = campaign.table()
        answer = {row["case"]: row for row in json.loads(self.call("compare", self.output, "--json").stdout)}
        self.assertEqual(list(table.index), list(answer))
        for case, row in table.iterrows():
            self.assertEqual(row["efficiency"], answer[case]["efficiency"])
        self.assertEqual(campaign.status()["finished"], 2)
        self.assertEqual(set(campaign.results()["case"]), set(table.index))

        again = vibrotrough.Campaign(self.output, program=PROGRAM)
        self.assertEqual(again.folder, campaign.folder)
        self.assertEqual([case.folder.name for case in again.cases()], list(table.index))
        case = campaign.case(table.index[0])
        self.assertEqual([packing.number for packing in case.packings()], [1, 2])
        self.assertEqual(len(case["packings/efficiency"]), 2)
        phases = case.phases(1)
        self.assertEqual(len(phases["velocity_x"]), 100)
        self.assertEqual(phases["velocity_x"].units, "m/s")
        with self.assertRaises(KeyError):
            case.phases(99)
        with self.assertRaises(KeyError):
            campaign.case("aaaaaaaaaaaa")

        both = vibrotrough.table([campaign, self.output], program=PROGRAM)
        self.assertEqual(len(both), 4)
        self.assertEqual(set(both["campaign"]), {self.output.name})

    def test_mistakes_are_those_of_the_program(self):
        with self.assertRaisesRegex(vibrotrough.ProgramError, "there is no such file") as raised:
            vibrotrough.Campaign("gone.toml", program=PROGRAM)
        self.assertEqual(raised.exception.code, 2)
        with self.assertRaisesRegex(vibrotrough.ProgramError, "trough.friction"):
            self.campaign({"trough.friction": -1})
        with self.assertRaisesRegex(FileNotFoundError, "give its path as program="):
            vibrotrough.Campaign("gone.toml", program=self.folder / "nothing")
        with self.assertRaises(vibrotrough.ProgramError) as raised:
            self.campaign().run(options=["--liggghts", "/nowhere/liggghts"])
        self.assertEqual(raised.exception.code, 3, raised.exception)

    def test_a_stop_loses_nothing(self):
        campaign = self.campaign()

        class Enough(Exception):
            pass

        def stop(event):
            if event["event"] == "case_ended":
                raise Enough

        with self.assertRaises(Enough):
            campaign.run(jobs=1, progress=stop, options=["--accept-findings"])
        self.assertEqual(engines_in(self.folder), [], "the program and its engines have ended")
        self.assertTrue(campaign.run(jobs=1, options=["--accept-findings"]))


if __name__ == "__main__":
    unittest.main()
