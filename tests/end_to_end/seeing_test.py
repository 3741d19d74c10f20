"""Figures, report and table of a real campaign with one case that fails, as a person asks for them."""

import fcntl
import html.parser
import os
import pty
import re
import struct
import subprocess
import termios
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import matplotlib.image

from trough_program import PROGRAM, EndToEndTest

SWEEP = {"trough.throw_number": [1.5, 2.2, 2.5]}


class Text(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.words = ""
        self.feed(path.read_text(encoding="utf-8"))

    def handle_data(self, data):
        self.words += data


class Seeing(EndToEndTest):
    def test_plot_report_and_table(self):
        self.engine_that_fails_one()
        self.check_figures()
        self.check_figures_for_print()
        self.check_report()
        self.check_wrong_options()
        self.check_table()

    def engine_that_fails_one(self):
        campaign = self.write_campaign({"measure.packings": 1}, SWEEP)
        # The first packing that is driven fails, whichever it is; settling is shared by the cases.
        once = f'mkdir "{self.folder}/failed-once" 2>/dev/null'
        os.environ["VIBROTROUGH_TEST_BREAK"] = f'[ "$2" = in.liggghts ] && {once} && exit 7'
        self.run_campaign(campaign, wanted=1)
        self.assertEqual(sorted(row["outcome"] for row in self.table()).count("engine-error"), 1)

    def check_figures(self):
        done = self.call("plot", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        drawn = [Path(line) for line in done.stdout.splitlines()]
        finished = [row["case"] for row in self.table() if row["outcome"] != "engine-error"]
        wanted = {f"{name}.{kind}" for name in ("efficiency", "residuals", *(f"cycles-{case}" for case in finished))
                  for kind in ("svg", "png")}  # fmt: skip
        for case in finished:
            with h5py.File(self.output / "cases" / case / "result.h5") as file:
                if len(file.get("phases/1", [])):  # too few cycles have no curves
                    wanted |= {f"{kind}-{case}.png" for kind in ("portraits", "spin", "profiles")}
        self.assertLessEqual(wanted, {path.name for path in drawn})
        for path in drawn:
            self.assertEqual(path.parent, self.output / "report")
            if path.suffix == ".svg":
                self.assertIn("small  \u00b7  Vibrotrough", "".join(ElementTree.parse(path).getroot().itertext()), path)
            else:
                self.assertGreater(min(matplotlib.image.imread(path).shape[:2]), 300, path)
        done = self.call("plot", self.output, "--only", "cycles", "--case", finished[0], "--output", self.folder / "other")
        names = sorted(Path(line).name for line in done.stdout.splitlines())
        self.assertEqual(names, [f"cycles-{finished[0]}.png", f"cycles-{finished[0]}.svg"], done.stderr)
        self.assertTrue((self.folder / "other" / names[0]).is_file())

    def draw_for_print(self, *options):
        """{file name: content} of the figures that are drawn, and what is said on standard error."""
        folder = self.folder / "print"
        done = self.call("plot", self.output, "--output", folder, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return {Path(line).name: Path(line).read_bytes() for line in done.stdout.splitlines()}, done.stderr

    def check_figures_for_print(self):
        """Kinds of files by their headers, and their sizes: a point is 1/72 inch, in SVG and in PDF's MediaBox; PNG has 300 dots
        per inch and is cut to whole ones.
        """
        general = ("--only", "efficiency", "--only", "residuals")
        for width, millimetres in (("one-column", 84), ("two-columns", 174), ("90 mm", 90)):
            drawn, errors = self.draw_for_print(*general, "--format", "pdf,svg,png", "--width", width)
            self.assertEqual((set(drawn), errors), ({f"{name}.{kind}" for name in general[1::2] for kind in ("pdf", "svg", "png")}, ""))
            for name in general[1::2]:
                pdf, svg, png = (drawn[f"{name}.{kind}"] for kind in ("pdf", "svg", "png"))
                self.assertTrue(pdf.startswith(b"%PDF-1.") and pdf.rstrip().endswith(b"%%EOF"))
                box = [float(number) for number in re.search(rb"/MediaBox \[ ([0-9. ]+) \]", pdf)[1].split()]
                self.assertAlmostEqual(box[2], millimetres / 25.4 * 72, delta=0.01)
                self.assertIn(b"/FontFile2", pdf, "a font is not in the file")
                root = ElementTree.fromstring(svg)
                self.assertAlmostEqual(float(root.get("width").removesuffix("pt")), box[2], delta=0.01)
                self.assertAlmostEqual(float(root.get("height").removesuffix("pt")), box[3], delta=0.01)
                self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
                across, down = struct.unpack(">II", png[16:24])
                self.assertAlmostEqual(across, millimetres / 25.4 * 300, delta=1)
                self.assertAlmostEqual(down / across, box[3] / box[2], delta=0.01)
        again, _ = self.draw_for_print(*general, "--format", "pdf", "--width", width)
        self.assertEqual(again, {name: content for name, content in drawn.items() if name.endswith(".pdf")})
        drawn, errors = self.draw_for_print("--only", "efficiency", "--only", "profiles", "--format", "png", "--width", "one-column")
        self.assertEqual(set(drawn), {"efficiency.png"})
        self.assertIn("is left out: panels beside one another need a width of 150 mm", errors)
        self.check_style(general)

    def check_style(self, general):
        style = self.folder / "my style.mplstyle"
        style.write_text("font.family: serif\nfont.size: 14\nsavefig.dpi: 75\n")
        plain, _ = self.draw_for_print(*general)
        styled, _ = self.draw_for_print(*general, "--style", style)
        self.assertIn(b"14px", styled["efficiency.svg"])
        self.assertNotIn(b"14px", plain["efficiency.svg"])
        self.assertEqual([struct.unpack(">I", one["efficiency.png"][16:20])[0] for one in (plain, styled)], [1080, 540])
        style.write_text("font.size: large letters\n")
        for option, value, told in (("--style", style, "cannot use the style sheet"), ("--style", self.folder / "none", "write the path of a style sheet"),
                                    ("--width", "3 columns", "one-column"), ("--width", "1 mm", "50 mm"), ("--format", "jpg", "jpg")):  # fmt: skip
            done = self.call("plot", self.output, *general, option, value)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(told, done.stderr)

    def check_report(self):
        done = self.call("report", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = Path(done.stdout.splitlines()[-1])
        self.assertEqual(report, self.output / "report" / "report.html")
        page = Text(report).words
        for row in self.table():
            self.assertIn(row["case"], page)
        for wanted in ("Campaign small", "exit code 7", "engine-error", "LIGGGHTS", 'name = "small"', "how to reproduce"):
            self.assertIn(wanted, page)
        self.assertNotIn("http:", report.read_text().replace("http://www.w3.org", ""))

    def check_wrong_options(self):
        for command in ("plot", "report"):
            told = f"has no case 123; 'vibrotrough status {self.output}' lists them"
            self.assert_one_line_error(self.call(command, self.output, "--case", "123"), 2, told)
            missing = self.call(command, self.output, "--python", "/bin/no-python")
            self.assert_one_line_error(missing, 3, "/bin/no-python does not have all of the modules", "apt-get install python3")
            self.assert_one_line_error(self.call(command, self.output, "--output", "/proc/no/such"), 3, "/proc/no")
        self.assert_one_line_error(self.call("plot", self.folder), 2, "campaign")

    def check_table(self):
        rows = self.table()
        done = self.call("compare", self.output, "--json", "--filter", "throw_number>2", "--sort", "frequency_hz:desc")
        self.assertEqual(done.stdout.count('"case"'), 2)
        self.assert_one_line_error(self.call("compare", self.output, "--filter", "gamma>2"), 2, "no column 'gamma'")
        self.assert_one_line_error(self.call("compare", self.output, "--sort", "gamma"), 2, "no column 'gamma'")
        self.assertNotIn("\x1b[", self.call("compare", self.output).stdout, "no colour in a file")
        self.assertIn("\x1b[31mengine-error", self.call("compare", self.output, "--color", "always").stdout)
        for width in (200, 80):
            lines = self.on_terminal(width, {}).splitlines()
            self.assertEqual(sum(line.startswith(tuple(row["case"] for row in rows)) for line in lines), len(rows))
            self.assertEqual(any("no room for" in line for line in lines), width < 100)
        self.assertIn("\x1b[31mengine-error", self.on_terminal(200, {}))
        self.assertNotIn("\x1b[", self.on_terminal(200, {"NO_COLOR": "1"}))

    def on_terminal(self, width, environment):
        """What `compare` prints on a terminal so wide."""
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
        clean = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
        done = subprocess.Popen([PROGRAM, "compare", str(self.output)], stdout=theirs, env=clean | environment)
        os.close(theirs)
        text = b""
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:
                break
            if not part:
                break
            text += part
        os.close(ours)
        self.assertEqual(done.wait(), 0)
        return text.decode()

    def test_report_without_a_finished_case(self):
        campaign = self.write_campaign({"measure.packings": 1})
        os.environ["VIBROTROUGH_TEST_BREAK"] = "exit 7"
        self.run_campaign(campaign, wanted=1)
        self.assert_one_line_error(self.call("plot", self.output), 2, "no finished case yet")
        done = self.call("report", self.output)
        self.assertEqual(done.returncode, 0, done.stderr)
        page = Text(self.output / "report" / "report.html").words
        self.assertIn("No case is finished yet", page)
        self.assertIn("exit code 7", page)


if __name__ == "__main__":
    unittest.main()
