"""`vibrotrough archive`: a bundle of a real campaign that `compare` opens again.

The bundles are read and changed with Python's zipfile, and the metadata with its json: readers that we did not write.
"""

import csv
import hashlib
import io
import json
import os
import shutil
import subprocess
import unittest
import zipfile

import h5py
from trough_program import EndToEndTest

SWEEP = {"trough.throw_number": [1.5, 2.0]}


class Archive(EndToEndTest):
    def setUp(self):
        super().setUp()
        self.bundle = self.folder / "supplement of a paper.zip"

    def archive(self, *options, wanted=0, output=None):
        """Makes a bundle of what there is: one of the two cases of make()."""
        done = self.call("archive", self.output, "--partial", "--output", output or self.bundle, *options)
        self.assertEqual(done.returncode, wanted, done.stdout + done.stderr)
        return done

    def make(self):
        """A real campaign of two cases, one of which was not simulated, and its bundle."""
        self.run_campaign(self.write_campaign(sweep=SWEEP))
        shutil.rmtree(self.output / "cases" / self.table()[1]["case"])
        self.check_that_nothing_is_left_out_in_silence()
        self.assertEqual(self.call("plot", self.output, "--only", "efficiency").returncode, 0)  # writes campaign.h5 for what there is
        done = self.call("plot", self.output, "--with", self.output, "--x", "throw_number", "--y", "speed", "--unit", "m/min")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("conveying_speed-over-throw_number.png", done.stdout)
        # A key is an axis where the campaign does not vary it, too; what is kept of the campaign stays as it is.
        kept = (self.output / "campaign.h5").read_bytes()
        done = self.call("plot", self.output, "--with", self.output, "--x", "layer.height", "--y", "speed")
        self.assertIn("conveying_speed-over-height.png", done.stdout, done.stderr)
        self.assertEqual((self.output / "campaign.h5").read_bytes(), kept)
        for words, said in ((("--x", "friction", "--y", "nonsense"), "there is no column 'nonsense'"), (("--x", "outcome", "--y", "speed"), "is not a number"),
                            (("--x", "friction", "--y", "speed", "--unit", "kg/s"), "conveying_speed_m_per_s is in m/s"),
                            (("--x", "friction"), "--y is missing"), (("--by", "friction"), "belong to the figure of two columns"),
                            (("--x", "friction", "--y", "speed", "--only", "cycles"), "leave them out")):  # fmt: skip
            self.assert_one_line_error(self.call("plot", self.output, *words), 2, said)
        shutil.rmtree(self.output / "report")
        self.run_campaign(self.write_campaign({"trough.throw_number": 1.5}, name="one.toml"), self.folder / "one")
        return self.archive("--author", "A. Researcher", "--license", "https://creativecommons.org/licenses/by/4.0/")

    def unpacked(self):
        folder = self.folder / "unpacked"
        shutil.rmtree(folder, ignore_errors=True)
        with zipfile.ZipFile(self.bundle) as source:
            source.extractall(folder)
        return folder

    def test_the_bundle_of_a_campaign(self):
        done = self.make()
        self.assertIn("1 of 2 cases with a result", done.stdout)
        self.assertIn("vibrotrough report", done.stdout)
        self.check_content()
        self.check_metadata()
        self.check_tables()
        self.check_that_it_is_reproducible()
        self.check_campaign_files_that_are_left_out()
        self.check_what_is_not_replaced()

    def check_that_nothing_is_left_out_in_silence(self):
        """A case without a result, a table that holds a case which is gone, a result that rots while its size and times stay."""
        whole = self.call("archive", self.output, "--output", self.bundle)
        self.assert_one_line_error(whole, 2, "1 of 2 cases has no result", self.table()[1]["case"], "--partial")
        self.assertFalse(self.bundle.exists())
        self.assertIn("without campaign.h5, which is damaged or does not hold the results", self.archive().stdout)
        self.bundle.unlink()
        result = self.output / "cases" / self.table()[0]["case"] / "result.h5"
        content, times = result.read_bytes(), result.stat()
        with open(result, "r+b") as file:
            file.seek(len(content) // 2)
            file.write(bytes([content[len(content) // 2] ^ 1]))
        os.utime(result, ns=(times.st_atime_ns, times.st_mtime_ns))
        self.assert_one_line_error(self.archive(wanted=2), 2, "result.h5 is damaged")
        self.assertFalse(self.bundle.exists())
        with open(result, "r+b") as file:
            file.write(content)
        os.utime(result, ns=(times.st_atime_ns, times.st_mtime_ns))

    def check_content(self):
        with zipfile.ZipFile(self.bundle) as bundle:
            self.assertIsNone(bundle.testzip())
            files = {name: bundle.read(name) for name in bundle.namelist()}
        self.assertEqual(next(iter(files)), "archive.json")
        sums = dict(reversed(line.split("  ", 1)) for line in files.pop("SHA256SUMS").decode().splitlines())
        self.assertEqual(sums, {name: hashlib.sha256(content).hexdigest() for name, content in files.items()})
        finished, _ = (row["case"] for row in self.table())
        case = f"cases/{finished}"
        for name in ("campaign.toml", "engine.json", "certificate.json", f"{case}/scenario.toml", f"{case}/result.h5"):
            self.assertEqual(files[name], (self.output / name).read_bytes(), name)
        for packing in (1, 2):
            for deck in ("settle.liggghts", "in.liggghts", "control.in", "trough.stl"):
                name = f"{case}/packing-{packing}/{deck}"
                self.assertEqual(files[name], (self.output / name).read_bytes(), name)
        for left_out in ("settled.restart", "cycles.csv", "phases.csv", ".lock", "summary"):
            self.assertFalse([name for name in files if name.endswith(left_out)], left_out)
        facts = json.loads(files["archive.json"])
        self.assertEqual((facts["format"], facts["cases"], facts["results"]), ("vibrotrough archive", 2, 1))
        self.assertEqual(facts["results_made_with"][0]["cases"], 1)
        self.assertIn(facts["archived_with"]["program_version"], self.call("--version").stdout)
        self.assertIn(facts["archived_with"]["git_commit"], self.call("--version").stdout)

    def check_campaign_files_that_are_left_out(self):
        """The message says what is wrong with campaign.h5: another version of the program is another thing than a newer result."""
        table, other = self.output / "campaign.h5", self.folder / "other.zip"
        content, times = table.read_bytes(), table.stat()

        def said():
            lines = self.archive(output=other).stdout.splitlines()
            with zipfile.ZipFile(other) as bundle:
                self.assertNotIn("campaign.h5", bundle.namelist())
            return next(line for line in lines if line.startswith("without campaign.h5"))

        with h5py.File(table, "r+") as file:
            file.attrs.modify("made_of", file.attrs["made_of"][::-1])
        self.assertIn("does not hold the results that are there", said())
        table.unlink()
        self.assertIn("is not there", said())
        table.write_bytes(content)
        os.utime(table, ns=(times.st_atime_ns, times.st_mtime_ns))

    def check_metadata(self):
        """RO-Crate 1.1: 'Root Data Entity', 'Data Entities', 'Contextual Entities'."""
        with zipfile.ZipFile(self.bundle) as bundle:
            metadata = json.loads(bundle.read("ro-crate-metadata.json"))
            names = bundle.namelist()
        self.assertIn("https://w3id.org/ro/crate/1.1/context", metadata["@context"])
        entities = {entity["@id"]: entity for entity in metadata["@graph"]}
        self.assertEqual(len(entities), len(metadata["@graph"]), "an entity is there twice")
        descriptor = entities["ro-crate-metadata.json"]
        self.assertEqual(descriptor["@type"], "CreativeWork")
        self.assertEqual(descriptor["about"], {"@id": "./"})
        self.assertEqual(descriptor["conformsTo"], {"@id": "https://w3id.org/ro/crate/1.1"})
        root = entities["./"]
        self.assertEqual(root["@type"], "Dataset")
        self.assertRegex(root["datePublished"], r"^\d{4}-\d\d-\d\d$")
        self.assertEqual(entities[root["license"]["@id"]]["@type"], "CreativeWork")
        self.assertEqual([entities[author["@id"]]["name"] for author in root["author"]], ["A. Researcher"])
        reached = set()
        for part in root["hasPart"]:
            reached |= {part["@id"]} | {below["@id"] for below in entities[part["@id"]].get("hasPart", [])}
        data = {name for name, entity in entities.items() if entity["@type"] in ("File", "Dataset") and name != "./"}
        self.assertEqual(reached, data, "the crate does not list every file")
        for name in data:
            there = [one for one in names if one.startswith(name)] if name.endswith("/") else name in names
            self.assertTrue(there, name)
        for entity in metadata["@graph"]:
            for value in entity.values():
                for one in value if isinstance(value, list) else [value]:
                    if isinstance(one, dict) and not one["@id"].startswith("https://w3id.org"):
                        self.assertIn(one["@id"], entities)
        self.assertEqual(entities["#engine"]["version"], json.loads((self.output / "engine.json").read_text())["version"])

    def check_tables(self):
        """The table is the same digit for digit, from the folder and from the unpacked bundle, of which sha256sum finds no file changed."""
        unpacked = self.unpacked()
        subprocess.run(["sha256sum", "-c", "--quiet", "SHA256SUMS"], cwd=unpacked, check=True)
        for options in ([], ["--csv"], ["--json"], ["--filter", "throw_number<1.8"], ["--theory-curves"]):
            wanted = self.call("compare", self.output, *options)
            self.assertEqual(wanted.returncode, 0, wanted.stderr)
            done = self.call("compare", unpacked, *options)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, wanted.stdout, ""), options)
        self.assertEqual((unpacked / "tables/compare.csv").read_text(), self.call("compare", self.output, "--csv").stdout)
        self.assertEqual(json.loads((unpacked / "tables/compare.json").read_text()), self.table())
        rows = list(csv.DictReader(io.StringIO((unpacked / "tables/compare.csv").read_text())))
        self.assertEqual([row["outcome"] for row in rows], ["finished", "open"])

    def check_that_it_is_reproducible(self):
        before = self.bundle.read_bytes()
        again = self.folder / "again.zip"
        os.utime(self.output / "campaign.toml")
        done = self.call("archive", self.output, "--partial", "--output", again, "--author", "A. Researcher", "--license",
                         "https://creativecommons.org/licenses/by/4.0/", env=dict(os.environ, TZ="Asia/Tokyo", LC_ALL="C"), umask=0o077)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(again.read_bytes(), before)

    def check_what_is_not_replaced(self):
        other = self.folder / "thesis.zip"
        with zipfile.ZipFile(other, "w") as mine:
            mine.writestr("thesis.txt", "years of work")
        before = other.read_bytes()
        self.assert_one_line_error(self.archive(wanted=2, output=other), 2, "is not a bundle", "--output")
        self.assertEqual(other.read_bytes(), before)
        self.assertIn("no licence is named", self.archive(output=self.bundle).stdout)
        self.assert_one_line_error(self.archive("--license", "MIT", wanted=2), 2, "is not an address")


if __name__ == "__main__":
    unittest.main()
