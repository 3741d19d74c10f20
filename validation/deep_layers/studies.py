"""The layers that the other studies store: how soft their grains are by the program's own rule, as `vibrotrough check` says it."""

import importlib.util
import itertools
import json
import math
import pathlib
import subprocess
import tomllib
import types
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from campaign_program import Sections, campaign_text
from validation_case import ValidationCase, read_table

VALIDATION = pathlib.Path(__file__).resolve().parent.parent
FIRST = "5 MPa"  # the modulus of all studies before the rule existed
RULE = {"fine": "stiff enough", "warning": "bound above half of the half-width", "error": "soft"}
COLUMNS = ["study", "group", "throw_number", "tan_vibration_angle", "half_width", "modulus_MPa", "wave_number", "middle", "bound", "rule",
           "chosen_MPa", "stored_MPa"]

SUMMARY = ["study", "half_widths", "layers", "wave_number_from", "wave_number_to", "bound_from", "bound_to", "enough", "warned", "soft", "soft_again"]


class Group(NamedTuple):
    """Layers of a study that one campaign describes: base.toml with changes, and the lists that it varies."""

    study: str
    name: str
    base: Sections
    changes: Mapping[str, Any]
    sweep: Mapping[str, Sequence[Any]]
    modulus: str | None = FIRST  # with which they were simulated first; None: the one that the program chose
    together: bool = False       # whether the lists are varied together, first with first

    def points(self) -> list[tuple[Any, ...]]:
        """The varied values of each layer."""
        return list(zip(*self.sweep.values()) if self.together else itertools.product(*self.sweep.values()))


def module(study: str, name: str) -> types.ModuleType:
    """A module of another case; its name may be that of one of ours."""
    spec = importlib.util.spec_from_file_location(f"{study}_{name}", VALIDATION / study / f"{name}.py")
    assert spec is not None and spec.loader is not None
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


def base_of(study: str, file: str = "base.toml") -> dict[str, Any]:
    return tomllib.loads((VALIDATION / study / file).read_text(encoding="utf-8"))


def groups() -> Iterator[Group]:
    demo = base_of("demo", "campaign.toml")
    yield Group("demo", "layers", demo, {}, demo["sweep"], None)
    campaigns = module("paper_experiment", "campaigns").CAMPAIGNS
    for name in ("free_1.25_to_2", "free", "blocked", "cube"):
        yield Group("paper_experiment", name, base_of("paper_experiment"), *campaigns[name])
    for study, layers in (("why_theory_fails", module("why_theory_fails", "ladder").RUNGS),
                          ("rolling_layer", module("rolling_layer", "held_out").HELD_OUT)):
        for name, (changes, numbers) in layers.items():
            if "layer.block" not in changes and "layer.grains" not in changes:  # layers
                yield Group(study, name, base_of(study), changes, {"trough.throw_number": numbers})
    revolutions = [f"{row['revolutions']} / minute" for row in read_table(VALIDATION / "krakow/reference.csv")]
    yield Group("krakow", "layers", base_of("krakow"), {}, {"trough.friction": [0.3, 0.45, 0.6], "trough.frequency": revolutions})
    yield Group("rosta", "layers", base_of("rosta"), {}, {"grains.rotation": ["free", "blocked"], "trough.friction": [0.3, 0.5]})
    yield Group("second_engine", "4 deep", base_of("why_theory_fails"), {},
                {"grains.rotation": ["free", "blocked"], "trough.throw_number": [1.5, 1.7, 2.0, 2.25, 2.5, 3.0]})
    for modulus in ("5 MPa", "80 MPa"):
        yield Group("second_engine", f"14 deep, {modulus}", base_of("second_engine"), {}, {"grains.friction": [0.3]}, modulus)
    yield from decisions()


def decisions() -> Iterator[Group]:
    """Design and held-out points, each once: the table of the latter has a row for each surface."""
    for table, word in (("design.csv", "design"), ("held_out.csv", "held out")):
        points: dict[str, dict[tuple[float, float, float], None]] = {}
        for row in read_table(VALIDATION / "decisions" / table):
            place = float(row["throw_number"]), float(row["tan_vibration_angle"]), float(row["rolling_friction"])
            points.setdefault(row["domain"], {})[place] = None
        for domain, places in points.items():
            numbers, tangents, frictions = (list(values) for values in zip(*places))
            yield Group("decisions", f"{word}, {domain}", base_of("decisions"), {},
                        {"trough.throw_number": numbers, "trough.tan_vibration_angle": tangents, "grains.rolling_friction": frictions}, together=True)


def checked(run: ValidationCase, group: Group, modulus: str | None) -> list[dict[str, Any]]:
    """What `vibrotrough check --json` says of each layer with this modulus, or with the one that it chooses."""
    file = run.output / "study.toml"
    text = campaign_text(group.base, {**group.changes, "grains.youngs_modulus": modulus}, group.sweep)
    file.write_text(text.replace("[sweep]", "[zip]") if group.together else text, encoding="utf-8")
    answer = subprocess.run([run.program, "check", str(file), "--json"], capture_output=True, text=True, check=False)
    file.unlink()
    cases: list[dict[str, Any]] = json.loads(answer.stdout)["cases"]
    return cases


def stored_moduli() -> dict[tuple[str, str], str]:
    """The modulus of the values that a study stores now, by label(), where its table names it."""
    moduli = {}
    for study, table, group in (("rolling_layer", "held_out.csv", "{group}"), ("why_theory_fails", "result.csv", "{rung}"),
                                ("paper_experiment", "result.csv", "{grains} {tan_inclination} {tan_vibration_angle}"),
                                ("krakow", "result.csv", "{friction} {revolutions}")):
        for row in read_table(VALIDATION / study / table):
            name = group.format(**row) + (f" {float(row['throw_number']):.4g}" if "throw_number" in row else "")
            moduli[study, name] = row.get("modulus_MPa", "")
    return moduli


def label(group: Group, trough: Mapping[str, Any], throw_number: float) -> str:
    """How the table of a study names a layer; `trough`: its keys in the campaign."""
    if group.study == "krakow":
        return f"{trough['friction']} {trough['frequency'].split()[0]}"
    if group.study == "paper_experiment":
        return f"{group.name.split('_')[0]} {trough['tan_inclination']:g} {trough['tan_vibration_angle']:g} {throw_number:.4g}"
    return f"{group.name} {throw_number:.4g}"


def rows_of(run: ValidationCase, group: Group, stored: Mapping[tuple[str, str], str]) -> list[list[object]]:
    rows: list[list[object]] = []
    for point, case, free in zip(group.points(), checked(run, group, group.modulus), checked(run, group, None)):
        softness = next(one for one in case["findings"] if "soft grains" in one["item"])
        bound, gamma, modulus = softness["measured"], case["throw_number"], case["youngs_modulus_pa"] / 1e6
        trough = group.base["trough"] | {key.split(".")[1]: value for key, value in (*group.changes.items(), *zip(group.sweep, point))}
        tangent = trough.get("tan_vibration_angle") or math.tan(math.radians(float(str(trough["vibration_angle"]).split()[0])))
        now = stored.get((group.study, label(group, trough, gamma))) or f"{modulus:g}"
        rows.append([group.study, group.name, f"{gamma:.4g}", f"{tangent:.4g}", f"{2 * softness['limit']:.3g}", f"{modulus:g}",
                     f"{math.sqrt(bound / 4):.4f}", f"{bound / 4:.4f}", f"{bound:.4f}", RULE[softness["severity"]],
                     f"{free['youngs_modulus_pa'] / 1e6:g}", now])
    return rows


def table(run: ValidationCase) -> list[list[object]]:
    """A row for each layer."""
    stored = stored_moduli()
    return [row for group in groups() for row in rows_of(run, group, stored)]


def summary(rows: list[list[object]]) -> list[list[object]]:
    """SUMMARY of each study; `soft_again`: soft layers whose stored value is one of stiffer grains."""
    found: list[list[object]] = []
    for study in dict.fromkeys(row[0] for row in rows):
        mine = [dict(zip(COLUMNS, map(str, row))) for row in rows if row[0] == study]
        rules = [row["rule"] for row in mine]
        numbers, bounds = ([row[name] for row in mine] for name in ("wave_number", "bound"))
        again = sum(row["rule"] == RULE["error"] and row["stored_MPa"] != row["modulus_MPa"] for row in mine)
        found.append([study, " and ".join(dict.fromkeys(row["half_width"] for row in mine)), len(mine), min(numbers), max(numbers), min(bounds), max(bounds),
                      *(rules.count(rule) for rule in RULE.values()), again])
    return found
