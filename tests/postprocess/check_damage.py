"""Takes away, one after the other, what figures and report are drawn from, or gives it another type: nobody sees a traceback.

usage: check_damage.py SCRIPTS SAMPLE COLUMNS WORK EVERY
COLUMNS is the program that prints the columns as campaign.json describes them. Of the changes one of EVERY is made. Every file keeps a right checksum: what is damaged by chance is
refused before.
"""

import contextlib
import io
import itertools
import json
import pathlib
import re
import subprocess
import sys

import h5py
from check_report import make_campaign
from sign import sign

CASE = "0123456789abcdef"


def changed_file(path, change):
    """Changes an HDF5 file and signs it; returns what undoes it."""
    before = path.read_bytes()
    with h5py.File(path, "a") as file:
        change(file)
    sign(path)
    return lambda: path.write_bytes(before)


def changed_json(path, change):
    before = path.read_text(encoding="utf-8")
    value = json.loads(before)
    change(value)
    path.write_text(json.dumps(value), encoding="utf-8")
    return lambda: path.write_text(before, encoding="utf-8")


def deleted(name):
    def change(file):
        del file[name]
    return change


def as_text(name):
    def change(file):
        units = file[name].attrs["units"]
        del file[name]
        file[name] = ["x"]
        file[name].attrs["units"] = units if isinstance(units, str) else "1"
    return change


def named(text):
    def change(file):
        file.attrs["campaign"] = text
    return change


def apart(names, source):
    """Names that the scripts write down, with what belongs to them, each alone, and the others together: no script tells them from each
    other."""
    known = [name for name in names if re.search(rf"\b{re.escape(name.removesuffix('_half_width'))}\b", source)]
    return [*([name] for name in known), [name for name in names if name not in known]]


def changes(folder, scripts):
    """(what happens, the file, a function that does it and returns what undoes it)"""
    source = "".join(path.read_text(encoding="utf-8") for path in pathlib.Path(scripts).iterdir() if path.suffix in (".py", ".html"))
    result, table = folder / "cases" / CASE / "result.h5", folder / "campaign.h5"
    overview, numerics = folder / "report" / "data" / "campaign.json", folder / "numerics.json"
    with h5py.File(result) as file:
        groups = [f"{name}/1" for name in file if isinstance(file[name], h5py.Group)] + [name for name in file if isinstance(file[name], h5py.Dataset)]
    for name in groups:
        for change in (deleted(name), as_text(name)):
            yield f"result.h5 {name}", lambda change=change: changed_file(result, change)
    with h5py.File(table) as file:
        columns = [name for name in file if isinstance(file[name], h5py.Dataset)]
    for names in apart(columns, source):
        yield f"campaign.h5 {names}", lambda names=names: changed_file(table, lambda file: [deleted(name)(file) for name in names])
    for attribute in ("campaign", "program_version", "swept_keys"):
        yield f"campaign.h5 @{attribute}", lambda attribute=attribute: changed_file(table, lambda file: file.attrs.pop(attribute, None))
    for text in ("$\\frac{", "a$b", "$$", "\\text{", "^_{}$x", "name\x1b[31m\u202e"):
        yield f"campaign named {text!r}", lambda text=text: changed_file(table, named(text))
        yield f"label {text!r}", lambda text=text: changed_json(overview, lambda value: value["cases"][0].update(label=text))
    for key in json.loads(overview.read_text(encoding="utf-8"))["cases"][0]:
        yield f"row without {key}", lambda key=key: changed_json(overview, lambda value: value["cases"][0].pop(key))
        yield f"row with a list as {key}", lambda key=key: changed_json(overview, lambda value: value["cases"][0].update({key: [1]}))
    for key in ("campaign", "cases", "columns", "input", "written"):
        yield f"campaign.json without {key}", lambda key=key: changed_json(overview, lambda value: value.pop(key))
    for key in ("numerical_error", "settings", "case"):
        yield f"numerics.json without {key}", lambda key=key: changed_json(numerics, lambda value: value["cases"][0].pop(key))


def said_by(call):
    """What a script's main part said on standard error, and whether it gave up with one line."""
    from figure_style import Problem

    errors, gave_up = io.StringIO(), False
    with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
        try:
            call()
        except Problem as problem:
            gave_up = True
            print(problem, file=sys.stderr)
    return errors.getvalue(), gave_up


def main(scripts, sample, columns, work, every):
    sys.path.insert(0, scripts)
    sys.dont_write_bytecode = True
    import figures
    import report
    from figure_style import target

    target.formats = ("svg",)
    work = pathlib.Path(work) / "damage"
    work.mkdir(parents=True, exist_ok=True)
    described = json.loads(subprocess.run([columns], capture_output=True, text=True, check=True).stdout)
    folder = make_campaign(pathlib.Path(sample), described, work)
    tried = drawn = 0
    for what, happen in itertools.islice(changes(folder, scripts), 0, None, int(every)):
        undo = happen()
        # Figures of the campaign read campaign.h5 and the notes, those of a case its result.h5, and both show names.
        of_campaign = ("efficiency", "speed", "mass_flow", "residuals", "budget")
        of_case = tuple(kind for kind in figures.KINDS if kind not in of_campaign)
        kinds = of_case if what.startswith("result.h5") else figures.KINDS if what.startswith(("campaign named", "label ")) else of_campaign

        def draw(kinds=kinds):
            for paths in figures.draw(figures.Source(folder, folder / "report"), kinds, [CASE]):
                nonlocal drawn
                drawn += len(paths)

        for call in (draw, lambda: report.write_page(folder, folder / "report")):
            tried += 1
            said, gave_up = said_by(call)
            assert "Traceback" not in said, (what, said)
            lines = said.splitlines()
            assert all(str(folder) in line or line.startswith(("figures.py: ", "report.py: ")) for line in lines), (what, said)
            assert len(lines) == 1 if gave_up else len(lines) <= len(kinds) + 1, (what, said)
            if what.startswith(("campaign named", "label ")):
                assert "left out" not in said and not gave_up, f"a name is only a name: {what}: {said}"
        undo()
    print(f"{tried} tried, {drawn} figures drawn")
    assert tried > 120 / int(every) and drawn > 100 / int(every)


if __name__ == "__main__":
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    main(*sys.argv[1:])
