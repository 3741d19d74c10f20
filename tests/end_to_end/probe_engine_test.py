"""The engine is probed once per binary, and a campaign is refused to one that fails."""

import json
import os
import unittest

import h5py

from trough_program import EndToEndTest

# Makes friction other than Coulomb's in the whole campaign; the decks' other answers stay right.
SPOIL = "sed -i 's/ tangential_damping off//' in.liggghts"


class ProbeEngine(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.campaign = self.write_campaign({"measure.packings": 1})
        kept = os.environ.get("XDG_CACHE_HOME")
        self.addCleanup(lambda: os.environ.pop("XDG_CACHE_HOME") if kept is None else os.environ.update(XDG_CACHE_HOME=kept))
        os.environ["XDG_CACHE_HOME"] = str(self.folder / "cache")

    def certificates(self):
        return sorted((self.folder / "cache" / "vibrotrough" / "engines").glob("*"))

    def make_wrong_engine(self):
        script = self.folder / "wrong-liggghts"
        script.write_text(f'#!/bin/sh\ncase "$1" in -in) {SPOIL};; esac\nexec "{self.engine}" "$@"\n')
        script.chmod(0o755)
        return script

    def test_a_campaign_probes_once_and_keeps_the_certificate(self):
        done = self.run_campaign(self.campaign)
        self.assertRegex(done.stderr, r"(?m)^probing .*\n(\d+) of \1 probes passed")
        (kept,) = self.certificates()
        text = kept.read_text()
        self.assertEqual((self.output / "certificate.json").read_text(), text)
        (result,) = self.results()
        with h5py.File(result) as file:
            self.assertEqual(file["engine_certificate"].asstr()[0], text)
        again = self.run_campaign(self.campaign)
        self.assertNotIn("probing", again.stderr)

        # Damage is noticed and mended.
        for damaged in (text.replace('"passed"', '"Passed"', 1), text[: len(text) // 2]):
            kept.write_text(damaged)
            self.assertIn("probing", self.run_campaign(self.campaign).stderr)
            self.assertEqual(json.loads(kept.read_text())["verdict"], "passed")

    def test_a_wrong_engine_is_refused_unless_accepted(self):
        wrong = self.make_wrong_engine()
        arguments = ["run", self.campaign, "--output", self.output, "--liggghts", wrong]
        refused = self.call(*arguments)
        self.assertEqual(refused.returncode, 3, refused.stderr)
        last = refused.stderr.splitlines()[-1]
        self.assertRegex(last, r"^vibrotrough: .*wrong-liggghts failed its probes: \d+ of \d+ probes passed; failed: coulomb")
        self.assertIn("--accept-failed-probes", last)
        self.assertEqual(self.take_starts(), [], "no packing was simulated")
        self.assertEqual(self.certificates(), [], "a failed certificate is not kept")

        accepted = self.call(*arguments, "--accept-failed-probes")
        self.assertEqual(accepted.returncode, 0, accepted.stderr)
        (result,) = self.results()
        with h5py.File(result) as file:
            certificate = json.loads(file["engine_certificate"].asstr()[0])
        self.assertEqual(certificate["verdict"], "failed")
        self.assertIn("coulomb", [probe["name"] for probe in certificate["probes"] if probe["verdict"] == "failed"])


if __name__ == "__main__":
    unittest.main()
