"""Runs a campaign of variations of a base campaign and reads its table, for the validations by simulation."""

import csv
import io
import pathlib
import subprocess
from collections.abc import Mapping, Sequence
from typing import Any

Row = dict[str, str]
Sections = Mapping[str, Mapping[str, Any]]


def toml_value(value: Any) -> str:
    """A TOML value: a truth value, text, number, or a list of these."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, list):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    return repr(value)


def campaign_text(base: Sections, changes: Mapping[str, Any], sweep: Mapping[str, Sequence[Any]]) -> str:
    """The TOML text of a campaign.

    `base`: sections of a campaign, whose sweep is ignored; `changes`: {"section.key": value}, where None removes the key;
    `sweep`: {"section.key": list of values}. The sections of a list are "materials.1" and so on.
    """
    sections: dict[str, dict[str, Any]] = {}
    for name, keys in base.items():
        if isinstance(keys, list):
            sections |= {f"{name}.{number}": dict(entry) for number, entry in enumerate(keys, 1)}
        elif name != "sweep":
            sections[name] = dict(keys)
    for path, value in changes.items():
        section, key = path.rsplit(".", 1)
        sections.setdefault(section, {})[key] = value
    lines = []
    for name, keys in sections.items():
        section, *is_entry = name.split(".")
        lines += [f"[[{section}]]" if is_entry else f"[{name}]"]
        lines += [f"{key} = {toml_value(value)}" for key, value in keys.items() if value is not None]
    lines += ["[sweep]"] + [f'"{path}" = {toml_value(values)}' for path, values in sweep.items()]
    return "\n".join(lines) + "\n"


def run_campaign(program: str, folder: pathlib.Path, text: str, jobs: int, options: Sequence[str] = ()) -> list[Row]:
    """Runs or finishes the campaign `text` in `folder` and returns the rows of `vibrotrough compare --csv`. `options`: more of `run`."""
    file = folder.with_name(folder.name + ".toml")  # the name may contain a dot
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    # A study may simulate what the check refuses, such as grains that are too soft.
    command = [program, "run", str(file), "--output", str(folder), "--jobs", str(jobs), "--accept-findings", *options]
    code = subprocess.run(command, check=False).returncode
    if code not in (0, 1):  # 1: some cases are not as precise as asked, which the table says
        raise SystemExit(f"{' '.join(command)} ended with {code}")
    return campaign_table(program, folder)


def campaign_table(program: str, folder: pathlib.Path) -> list[Row]:
    """The rows of `vibrotrough compare --csv`, in the order of the sweep."""
    command = [program, "compare", str(folder), "--csv"]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    if answer.returncode not in (0, 1):
        raise SystemExit(f"{' '.join(command)}\n{answer.stderr}")
    return list(csv.DictReader(io.StringIO(answer.stdout)))
