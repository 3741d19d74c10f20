#!/usr/bin/python3
"""Draws a campaign's figures, each as SVG and PNG; `vibrotrough plot DIR` calls it.

    figures.py DIR [--output OUT] [--only KIND] [--case ID]

DIR holds campaign.h5 and cases/, OUT (by default DIR/report) the folder `data` with what the program computed of the
theory. Prints the path of every file it wrote. Nothing of the theory is computed here.
"""

import argparse
import json
import pathlib
import sys

import figure_cycles
import figure_portraits
import figure_residuals
import vibrotrough
from figure_style import Problem
from plot_campaign import plot_efficiency

KINDS = ("efficiency", "residuals", "cycles", "portraits", "profiles")


class Source:
    """What the figures are drawn from."""

    def __init__(self, directory, output):
        self.directory, self.output, self.data = directory, output, output / "data"
        try:
            with open(self.data / "campaign.json", encoding="utf-8") as file:
                self.overview = json.load(file)
            self.campaign = vibrotrough.open_campaign(directory)
        except (OSError, ValueError) as error:
            raise Problem(f"cannot read the campaign ({error}); give a campaign's folder, by 'vibrotrough plot DIR'") from error
        self.attributes = self.campaign.attributes
        if self.campaign.cases == 0:
            raise Problem(f"{directory / 'campaign.h5'} holds no finished case; run the campaign first")

    def row_of(self, case):
        """The case's row of `vibrotrough compare`."""
        return next(row for row in self.overview["cases"] if row["case"] == case)


def draw(source, only, cases):
    """Draws one figure after another and gives the paths of each."""
    if "efficiency" in only:
        yield plot_efficiency(source.directory, source.data / "theory_curves.csv", source.output / "efficiency")
    if "residuals" in only:
        yield figure_residuals.plot_residuals(source, source.output / "residuals")
    for case in source.campaign["case"]:
        if cases and case not in cases:
            continue
        result = source.campaign.case(case)
        if "cycles" in only:
            yield figure_cycles.plot_cycles(source, case, result, source.output / f"cycles-{case}")
        if "portraits" in only:
            yield figure_portraits.plot_portraits(source, case, result, source.output / f"portraits-{case}")
        if "profiles" in only:
            yield figure_portraits.plot_profiles(source, case, result, source.output / f"profiles-{case}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="DIR", help="a campaign's folder, with campaign.h5")
    parser.add_argument("--output", type=pathlib.Path, metavar="OUT", help="folder of the figures")
    parser.add_argument("--only", action="append", choices=KINDS, help="draw this kind only")
    parser.add_argument("--case", action="append", default=[], metavar="ID", help="single cases' figures of this one only")
    options = parser.parse_args()
    source = Source(options.directory, options.output or options.directory / "report")
    for paths in draw(source, options.only or KINDS, options.case):
        for path in paths:
            print(path, flush=True)


if __name__ == "__main__":
    try:
        main()
    except Problem as problem:
        sys.exit(f"figures.py: {problem}")
