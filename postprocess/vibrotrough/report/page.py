"""Writes a campaign's report, one HTML file that needs no network and no other file; `vibrotrough report DIR` calls it.

    python3 -m vibrotrough.report.page DIR [--output OUT]

OUT (by default DIR/report) holds what vibrotrough.figures left: the figures as SVG and data/campaign.json. Writes OUT/report.html
and prints its path. What users wrote is escaped by the template (report.html).
"""

import argparse
import base64
import hashlib
import json
import pathlib
import re
import sys
from typing import Any

import jinja2
import markupsafe

from ..figures.drawn import KINDS, DrawnFigures, Kind, digest_of_data, drawing_of, read_note, write_file
from ..figures.columns import half_width_name
from ..figures.style import Problem, one_line, plain, shown
from .reasons import reasons
from .words import conclusion, kind_of

# Of units that are not written as they are.
UNIT_SIGNS = {"1": "", "degree": "\u00b0", "1/minute": "1/min", "t/h/m": "t/h per m", "W/m2": "W/m\u00b2", "N s/m3": "N s/m\u00b3"}

Case = dict[str, Any]
Column = dict[str, Any]

MODE_LETTERS = {
    "F": "flight: nothing touches the trough",
    "P": "slide forwards relative to the trough (positive)",
    "N": "slide backwards relative to the trough (negative)",
    "R": "rest on the trough",
    "P\u2032, N\u2032": "slides that directly follow a landing",
}
WITHOUT_FAILURE = ("finished", "open", "running", "interrupted")


MOST_LEVELS = 20  # of a certificate; ours have four
MOST_CASES = 60  # whose own figures are in the report: 140 kB each


def read_json(path: pathlib.Path, needed: bool = True) -> Any:
    try:
        return json.loads(read_note(path))
    except FileNotFoundError:
        if not needed:
            return None
        raise Problem(f"there is no {path}; call it by 'vibrotrough report DIR'") from None
    except (OSError, ValueError, RecursionError) as error:
        raise Problem(f"cannot read {path} ({one_line(error)}); remove it or write it anew") from error


def read_certificate(directory: pathlib.Path) -> Any:
    """The engine's certificate; None when there is none, or when it is damaged, which is said."""
    try:
        certificate = read_json(directory / "certificate.json", needed=False)
    except Problem as problem:
        print(shown(f"vibrotrough: the page is without the engine's probes: {problem}"), file=sys.stderr)
        return None
    if certificate is None or (isinstance(certificate, dict) and depth_of(certificate) <= MOST_LEVELS):
        return certificate
    print(shown(f"vibrotrough: the page is without the engine's probes: {directory / 'certificate.json'} is not a certificate; remove it, and run the "
                "campaign again"), file=sys.stderr)
    return None


def depth_of(value: Any) -> int:
    """Levels of a value of JSON, which json has read and which is therefore not deeper than Python can go."""
    below = list(value.values()) if isinstance(value, dict) else value if isinstance(value, list) else []
    return 1 + max(map(depth_of, below), default=0)


def as_table(value: Any) -> Any:
    """Lists that are not tables, because their entries differ in kind, as text: a file may hold anything."""
    if isinstance(value, dict):
        return {str(name): as_table(one) for name, one in value.items()}
    if isinstance(value, list):
        is_table = all(isinstance(one, dict) for one in value)
        return [as_table(one) if is_table else one if isinstance(one, (str, int, float)) else json.dumps(one) for one in value]
    return value


def inline_svg(drawing: str, number: int, title: str) -> markupsafe.Markup:
    """The figure as an element of the page: ids of its own, a name for screen readers."""
    text = re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>figure{number}-", drawing)
    opening = f'<svg role="img" aria-label="{markupsafe.escape(title)}"'
    return markupsafe.Markup(text.replace("<svg", opening, 1))


class Figures:
    """Finds the figures that were drawn from the data that the report shows, and numbers them."""

    def __init__(self, directory: pathlib.Path, output: pathlib.Path) -> None:
        self.directory, self.output, self.number = directory, output, 0
        self.drawn = DrawnFigures(output)

    def get(self, kind: Kind, case: str | None, data: str) -> dict[str, Any] | None:
        content = self.drawn.read(f"{kind.kind}-{case}.svg" if case else f"{kind.kind}.svg", data)
        if content is None:
            return None
        self.number += 1
        return {"number": self.number, "title": kind.title, "svg": inline_svg(drawing_of(content), self.number, kind.title), "kind": kind.kind,
                "from": "result.h5 of this case" if case else kind.file}

    def all(self, case: str | None = None) -> list[dict[str, Any]]:
        data = digest_of_data(self.directory, self.output, case)
        return [figure for kind in KINDS if kind.is_of_case == (case is not None) if (figure := self.get(kind, case, data))]


# Before the efficiencies, because a screen is narrower than the table.
WHAT_A_MACHINE_DOES = ("screening_efficiency", "cut_size_mm", "screen_distance_m", "outflow_t_per_h", "residence_time_s", "conveying_speed_m_per_s",
                       "mass_flow_t_per_h", "mass_flow_per_width_t_per_h_m")
# Of which machine which figures of a case stand at the top, beside the answer.
FIRST_FIGURES = {"screen": ("screening", "partition"), "open trough": ("along", "residence"), "layer": ()}


# What only some readers look for: shown at the push of a button, so that the rest fits on a screen.
MINOR = ("efficiency_half_width_statistics", "efficiency_numerics", "numerics_source", "larger_error", "mass_flow_per_width_t_per_h_m",
         "power_per_area_w_per_m2", "added_mass_fraction", "damping_per_area_n_s_per_m3", "cycles_discarded", "wall_time_s")

def report_columns(overview: dict[str, Any]) -> list[Column]:
    """The columns that the report shows, from left to right, as campaign.json describes them."""
    columns = overview["columns"]
    shown = [dict(column, **column["report"], position=position) for position, column in enumerate(columns) if column["report"]]
    behind_the_modes = next((position + 0.5 for position, column in enumerate(columns) if column["name"] == "layer_mode"), len(columns))
    for column in shown:
        column["error"] = half_width_name(column)
        column["heading"] = plain(column["heading"])
        column["unit"] = UNIT_SIGNS.get(column["shown_unit"], column["shown_unit"])
    errors = {column["error"] for column in shown}
    minor = {*MINOR} - ({"mass_flow_per_width_t_per_h_m"} if all(row.get("mass_flow_t_per_h") is None for row in overview["cases"]) else set())
    for column in shown:
        if column["name"] == "outcome":
            column["position"] = behind_the_modes  # own observables may be many, and this is looked for
        column["minor"] = column["name"] in minor
    # An interval stands in the cell of its number.
    shown = [column for column in shown if column["name"] not in errors]
    inputs_end = min((column["position"] for column in shown if column["name"] == "efficiency"), default=0)
    return sorted(shown, key=lambda column: (column["position"] >= inputs_end and column["name"] not in WHAT_A_MACHINE_DOES,
                                             column["position"] >= inputs_end, column["position"]))


def written(value: Any, column: Column) -> str:
    """A value as people read it, in the column's unit for people."""
    shown: str = column["format"].format(column["factor"] * value if isinstance(value, float) else value)
    return shown


def cell(row: Case, column: Column) -> dict[str, Any]:
    """What is shown of a value, and what it is sorted by; unknown values are empty."""
    value = row.get(column["name"])
    if value is None or value == "":
        return {"shown": "", "key": "", "text": column["type"] == "text", "minor": column["minor"]}
    key = value if isinstance(value, (int, float)) else str(value)
    error = row.get(column["error"])
    bars = f" \u00b1 {written(error, column).lstrip('+')}" if isinstance(error, float) else ""
    return {"shown": written(value, column) + bars, "key": key, "text": column["type"] == "text", "minor": column["minor"]}


def with_unit(shown: str, unit: str) -> str:
    return shown + unit if unit in ("", UNIT_SIGNS["degree"]) else f"{shown} {unit}"


def split_columns(columns: list[Column], cases: list[Case]) -> tuple[list[Column], str]:
    """The columns of the table without empty ones, and a sentence about those that are the same in all cases."""
    same = [column for column in columns
            if column["once_when_same"] and len(cases) > 1 and len({case.get(column["name"]) for case in cases}) == 1]
    empty = [column for column in columns if cases and all(case.get(column["name"]) is None for case in cases)]
    told = [f"{column['heading']} = {with_unit(written(cases[0][column['name']], column), column['unit'])}"
            for column in same if column not in empty]
    return [column for column in columns if column not in same + empty], ", ".join(told)


def table(cases: list[Case], columns: list[Column]) -> list[dict[str, Any]]:
    return [{"id": case["case"], "cells": [cell(case, column) for column in columns], "finished": case["outcome"] == "finished"}
            for case in cases]


def differences_of(overview: dict[str, Any]) -> list[dict[str, str]]:
    """The differences of `compare --contrast`, where the campaign sweeps exactly one key and both cases have a mean."""
    told = []
    for row in (overview.get("differences") or {"rows": []})["rows"]:
        value, width = row["efficiency_difference"], row["efficiency_difference_half_width"]
        if value is None:
            continue
        bars = "" if width is None else f" \u00b1 {width:.3f}"
        told.append({"case": plain(row["label"]), "against": plain(row["against_label"]), "difference": f"{value:+.3f}{bars}",
                     "significant": row["significant"] or ""})
    return told


def counts(cases: list[Case]) -> dict[str, int]:
    found: dict[str, int] = {}
    for case in cases:
        found[case["outcome"]] = found.get(case["outcome"], 0) + 1
    return found


def split_certificate(certificate: Any) -> tuple[Any, dict[str, list[dict[str, Any]]]]:
    """Its facts, and its lists of objects (the probes), which are tables of their own."""
    if not isinstance(certificate, dict):
        return certificate, {}
    lists = {name: one for name, one in certificate.items() if isinstance(one, list) and one and isinstance(one[0], dict)}
    return {name: one for name, one in certificate.items() if name not in lists}, lists


def script_digest(template: str) -> str:
    """Names the page's own script in its policy, so that a browser runs no other."""
    script = template[template.index("<script>") + len("<script>") : template.index("</script>")]
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()


def render(directory: pathlib.Path, output: pathlib.Path) -> str:
    overview = read_json(output / "data" / "campaign.json")
    cases = overview["cases"]
    figures = Figures(directory, output)
    general = figures.all()
    certificate, lists = split_certificate(as_table(read_certificate(directory)))
    columns, told = split_columns(report_columns(overview), cases)
    single = [
        {"case": case, "figures": found}
        for case in cases
        if (found := figures.all(case["case"]))
    ] if len(cases) <= MOST_CASES else []
    kind = kind_of(cases)
    at_top = [figure for name in FIRST_FIGURES[kind] for figure in (single[0]["figures"] if single else []) if figure["kind"] == name]
    if single:
        single[0]["figures"] = [figure for figure in single[0]["figures"] if figure not in at_top]
    folder = pathlib.Path(__file__).resolve().parent
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder), autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    return environment.get_template("report.html").render(
        overview=overview,
        conclusion=conclusion(cases),
        kind=kind,
        first_figures=at_top,
        reasons=reasons(overview),
        differences=differences_of(overview),
        engine=overview["engine_version"].replace(", git commit unknown", ""),
        commit="" if overview["git_commit"] == "unknown" else f" ({overview['git_commit']})",
        mode_letters=MODE_LETTERS,
        plain=plain,
        script_digest=script_digest((folder / "report.html").read_text(encoding="utf-8")),
        counts=counts(cases),
        columns=columns,
        same_in_all=told,
        lines=table(cases, columns),
        failures=[case for case in cases if case["outcome"] not in WITHOUT_FAILURE],
        waiting=[case for case in cases if case["outcome"] in WITHOUT_FAILURE[1:]],
        figures=general,
        case_figures=single,
        outside=len(cases) > MOST_CASES,
        certificate=certificate,
        certificate_lists=lists,
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="DIR", help="a campaign's folder")
    parser.add_argument("--output", type=pathlib.Path, metavar="OUT", help="folder of the figures and the report")
    options = parser.parse_args()
    print(shown(write_page(options.directory, options.output or options.directory / "report")))


def write_page(directory: pathlib.Path, output: pathlib.Path) -> pathlib.Path:
    """Writes OUT/report.html, and returns its path."""
    try:
        page = render(directory, output)
    except Problem:
        raise
    except Exception as error:  # a file may be whole and still hold anything
        raise Problem(f"cannot make a page of {output / 'data' / 'campaign.json'} ({one_line(error)}); call 'vibrotrough report {directory}' again, "
                      "which writes it anew") from error
    path = output / "report.html"
    try:
        write_file(path, page.encode())
    except OSError as error:
        raise Problem(f"cannot write {path} ({error.strerror}); choose another --output") from error
    return path


if __name__ == "__main__":
    try:
        main()
    except Problem as problem:
        sys.exit(shown(f"vibrotrough: {problem}"))
