"""The engine is probed once per binary, and a campaign is refused to one that fails."""

import hashlib
import json
import os
import shutil
import unittest

import h5py

from trough_program import EndToEndTest, sample

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

    def assert_genuine(self, text):
        """As any reader of JSON can check: the digest is that of the rest, written without blanks."""
        certificate = json.loads(text)
        digest = certificate.pop("content_sha256")
        rest = json.dumps(certificate, separators=(",", ":"), ensure_ascii=False)
        # Python writes 1e-06 where the program writes 1e-06 too, and 5e6 as 5000000.0 as it does.
        self.assertEqual(hashlib.sha256(rest.encode()).hexdigest(), digest)
        return certificate

    def test_certificate_of_the_real_engine(self):
        wanted = self.folder / "certificate.json"
        done = self.call("probe-engine", "--output", wanted)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"(?m)^passed  restitution-0.1 +0\.25\d+ +expected 0\.2527")
        self.assertNotIn("FAILED", done.stdout)
        certificate = self.assert_genuine(wanted.read_text())
        program = shutil.which("liggghts")
        self.assertEqual(certificate["verdict"], "passed")
        with open(program, "rb") as file:
            self.assertEqual(certificate["engine"]["program_sha256"], hashlib.sha256(file.read()).hexdigest())
        with open(certificate["engine"]["library"], "rb") as file:
            self.assertEqual(certificate["engine"]["library_sha256"], hashlib.sha256(file.read()).hexdigest())
        for probe in certificate["probes"]:
            excess = probe["measured"] - probe["expected"]
            within = abs(excess) if probe["comparison"] == "near" else excess
            self.assertLessEqual(within, probe["tolerance"], probe["name"])
        # Kept for next time, and printed again on demand.
        self.assertEqual([path.read_text() for path in self.certificates()], [wanted.read_text()])
        self.assertEqual(json.loads(self.call("probe-engine", "--json").stdout)["verdict"], "passed")

    def test_a_campaign_probes_once_and_keeps_the_certificate(self):
        done = self.run_campaign(self.campaign)
        self.assertRegex(done.stderr, r"(?m)^probing .*\n(\d+) of \1 probes passed")
        (kept,) = self.certificates()
        text = kept.read_text()
        self.assertEqual((self.output / "certificate.json").read_text(), text)
        (result,) = self.results()
        with h5py.File(result) as file:
            self.assertEqual(file["engine_certificate"].asstr()[()], text)
        again = self.run_campaign(self.campaign)
        self.assertNotIn("probing", again.stderr)

        # Damage is noticed and mended: a digit that changed, a file cut short.
        for damaged in sample((text.replace('"passed"', '"Passed"', 1), text[: len(text) // 2]), 2):
            kept.write_text(damaged)
            self.assertIn("probing", self.run_campaign(self.campaign).stderr)
            self.assertEqual(self.assert_genuine(kept.read_text())["verdict"], "passed")

    def test_a_cache_that_cannot_be_written_costs_time_only(self):
        (self.folder / "cache").touch()
        for _ in range(2):
            done = self.run_campaign(self.campaign)
            self.assertIn("probing", done.stderr)
            self.assertIn("the certificate is not kept, the next run probes again: cannot make the folder", done.stderr)

    def test_a_wrong_engine_is_refused_unless_accepted(self):
        wrong = self.make_wrong_engine()
        probed = self.call("probe-engine", "--liggghts", wrong)
        self.assertEqual(probed.returncode, 1, probed.stderr)
        self.assertRegex(probed.stdout, r"(?m)^FAILED  coulomb +1\.\d+ +at most +1 ")
        self.assertRegex(probed.stdout, r"(?m)^passed  restitution-0.5 ")

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
            certificate = self.assert_genuine(file["engine_certificate"].asstr()[()])
        self.assertEqual(certificate["verdict"], "failed")
        self.assertIn("coulomb", [probe["name"] for probe in certificate["probes"] if probe["verdict"] == "failed"])


if __name__ == "__main__":
    unittest.main()
