"""A campaign file, a name or a path that means harm: refused in one line, or taken for what it is; nothing is run but the engine."""

import json
import os
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "end_to_end"))
from trough_program import EndToEndTest, campaign_text  # noqa: E402

# Where one of these reaches a shell or LIGGGHTS's input as it stands, a file "hacked" appears.
WORDS = [
    "$(touch hacked)", "`touch hacked`", "a; touch hacked", "a & touch hacked", "a | touch hacked", "a\ntouch hacked",
    "a\nshell touch hacked", "a'; touch hacked; '", 'a"; touch hacked; "', "${x}", "../hacked", "/etc/passwd", "-o hacked",
    "a\x00b", "a\x1bb", "\u202ehacked", "%n%s", "{{> world}}", "x" * 101, "x" * 100_000, "", " ", ".", "..", "~", "*",
]  # fmt: skip


class Hostile(EndToEndTest):
    def assert_harmless(self):
        self.assertEqual([path for path in self.folder.rglob("hacked*")], [])
        self.assertFalse(Path("hacked").exists())

    def refuse(self, text, code=2):
        campaign = self.folder / "campaign.toml"
        campaign.write_text(text)
        for command in (["run", campaign, "--output", self.output, "--liggghts", self.engine],
                        ["plan", campaign, "--output", self.output],
                        ["deck", campaign, "--output", self.output]):  # fmt: skip
            done = self.call(*command)
            self.assert_one_line_error(done, code)
            self.assertLess(len(done.stderr), 2000)
            self.assertRegex(done.stderr[:-1], r"\A[ -~]*\Z", "an error is printable")
        self.assertEqual(self.take_starts(), [])
        self.assert_harmless()

    def test_words_where_names_and_numbers_belong(self):
        for word in WORDS:
            self.refuse(campaign_text({"campaign.name": word}))
        for word in WORDS[:16]:
            for path in ("trough.amplitude", "trough.friction", "layer.grains", "grains.rotation", "grains.shape", "trough.waveform"):
                section, key = path.split(".")
                line = f"{key} = {json.dumps(word)}\n"
                base = campaign_text({path: None} if path not in ("grains.rotation", "grains.shape", "trough.waveform") else {})
                self.refuse(base.replace(f"[{section}]\n", f"[{section}]\n{line}"))
            self.refuse(campaign_text(sweep={"trough.friction": [word]}))
            self.refuse(campaign_text() + f'[run]\nexecutor = "slurm"\n[run.slurm]\npartition = {json.dumps(word)}\n')
            self.refuse(campaign_text() + f"[run.slurm]\nmemory = {json.dumps(word)}\n")
            self.refuse(campaign_text() + f'[run]\nexecutor = "slurm"\n[run.slurm]\nextra = [{json.dumps("--qos=" + word)}, "--wrap=id"]\n')
            self.refuse(campaign_text() + f"[points_from]\nfile = {json.dumps(word)}\n")
            self.refuse(campaign_text() + f"[zip]\n{json.dumps(word)} = [1]\n")

    def test_a_points_file_that_means_harm(self):
        campaign = self.folder / "campaign.toml"
        campaign.write_text(campaign_text() + '[points_from]\nfile = "points.csv"\n')
        points = self.folder / "points.csv"
        for text in ("trough.friction\n$(touch hacked)\n", "trough.friction,trough.friction\n1,1\n", "campaign.name\na\n", "\n", "trough.friction\n",
                     "trough.friction\n" + "1," * 100_000 + "\n", "\x00\x01\x02", "trough.friction\nnan\n", "trough.friction\n1e999\n"):  # fmt: skip
            points.write_text(text)
            done = self.call("run", campaign, "--output", self.output, "--liggghts", self.engine)
            self.assert_one_line_error(done, 2)
            self.assertLess(len(done.stderr), 2000)
        points.unlink()
        points.symlink_to("/dev/zero")
        self.assert_one_line_error(self.call("plan", campaign, "--output", self.output), 2)
        self.assert_harmless()

    def test_files_too_large_and_too_deep(self):
        campaign = self.folder / "campaign.toml"
        for text in (campaign_text() + "#" * 50_000_000, "a = " + "[" * 1_000_000, "a" + ".a" * 1_000_000 + " = 1", "[" + "a." * 1_000_000 + "a]",
                     "a = " + "{a = " * 100_000, '"' * 3_000_000, "[[points]]\n" * 300_000):  # fmt: skip
            campaign.write_text(text)
            start = time.monotonic()
            done = self.call("run", campaign, "--output", self.output, "--liggghts", self.engine)
            # 0.1 s at most were measured; three million quotes once took two minutes, the square of their number.
            self.assertLess(time.monotonic() - start, 20, text[:20])
            self.assert_one_line_error(done, 2)
            self.assertLess(len(done.stderr), 2000)

    def test_folders_with_names_that_mean_harm(self):
        campaign = self.write_campaign({"measure.packings": 1})
        for name in ("a $(touch hacked) b", "new\nline", "'quotes\"", "a;touch hacked&", "-rf", "x" * 200, "\\", "%s%n"):
            self.run_campaign(campaign, output=self.folder / name)
            self.assertEqual([row["outcome"] for row in self.table(self.folder / name)], ["finished"])
        self.assert_one_line_error(self.call("run", campaign, "--output", self.folder / ("x" * 300), "--liggghts", self.engine), 3)
        self.assertEqual([path for path in self.folder.iterdir() if path.name == "hacked"], [])

    def test_links_do_not_lead_astray(self):
        campaign = self.write_campaign({"measure.packings": 1})
        real = self.folder / "real"
        real.mkdir()
        self.output.symlink_to(real)
        self.run_campaign(campaign)
        (case,) = (self.output / "cases").iterdir()
        # A packing's folder that is a link: a new run replaces the link, and what it led to stays.
        precious = self.folder / "precious"
        precious.mkdir()
        (precious / "letter").write_text("dear")
        (case / "result.h5").unlink()
        os.rename(case / "packing-1", self.folder / "moved")
        (case / "packing-1").symlink_to(precious)
        self.run_campaign(campaign)
        self.assertEqual([path.name for path in precious.iterdir()], ["letter"])
        self.assertEqual((precious / "letter").read_text(), "dear")

    def test_no_deck_runs_a_shell(self):
        campaign = self.write_campaign({}, {"trough.throw_number": [1.0, 2.0]})
        self.call("deck", campaign, "--output", self.output)
        decks = list(self.output.rglob("*.liggghts"))
        self.assertTrue(decks)
        for deck in decks:
            for line in deck.read_text().splitlines():
                self.assertNotRegex(line, r"^\s*shell\b")


if __name__ == "__main__":
    unittest.main()
