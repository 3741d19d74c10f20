"""Reads the HDF5 files of the theory with h5py: every dataset has units and a description, is in the schema's table, and
holds what the program prints for a point.

    check_map.py PROGRAM FOLDER PAGE [--write]

PAGE is src/manual/theory_map.md, which follows from a map; --write writes it again.
"""

import json
import pathlib
import re
import subprocess
import sys

import h5py
import numpy as np


def theory(program, *arguments):
    return subprocess.run([program, "theory", *map(str, arguments)], capture_output=True, text=True, check=True).stdout


def datasets(file):
    found = {}
    file.visititems(lambda name, item: found.update({name: item}) if isinstance(item, h5py.Dataset) else None)
    return found


# Attributes have no description of their own.
ATTRIBUTES = {
    "format": 'The text "vibrotrough theory map"', "schema_version": "Version of this table", "program_version": "Version that computed the map",
    "git_commit": "Commit that it was built from", "x_name": "The input along x, e.g. throw_number", "y_name": "The input along y",
}  # fmt: skip
TITLE = """# A map of the theory

Written by `tests/validation/check_map.py` from what `vibrotrough theory map --output map.h5 --starts N` stores; without `--starts` the file lacks
`motions`, `fraction`, `lowest_efficiency` and `highest_efficiency`. Names that begin with `@` are attributes of the root.

| name | type | shape | units | meaning |
|---|---|---|---|---|
"""


def page_of(file):
    """The reference of a map with 5 rows and 6 columns."""
    shapes = {(5, 6): "rows, columns", (6,): "columns", (5,): "rows", file["modes"].shape: "modes", file["boundaries/x0"].shape: "pieces", (1,): "1"}
    lines = [f"| `@{name}` | {'int32' if name == 'schema_version' else 'text'} | scalar | 1 | {meaning} |" for name, meaning in ATTRIBUTES.items()]
    for name, item in datasets(file).items():
        kind = "text" if item.dtype.kind in "SO" else item.dtype.name
        # The units of an input depend on which one it is.
        units = "of the input" if re.fullmatch(r"x|y|boundaries/[xy].|fixed/.*", name) else item.attrs["units"].decode()
        name = "fixed/NAME" if name.startswith("fixed/") else name
        line = f"| `{name}` | {kind} | {shapes[item.shape]} | {units} | {item.attrs['description'].decode()} |"
        if line not in lines:
            lines.append(line)
    return TITLE + "\n".join(lines) + "\n"


def check_page(program, folder, page, write):
    path = folder / "all.h5"
    theory(program, "map", "--x", "throw_number=0.5:3:6", "--y", "vibration_angle_deg=10:50:5", "--friction", 0.35,
           "--restitution", 0.3, "--starts", 8, "--output", path)
    with h5py.File(path) as file:
        assert set(file.attrs) == set(ATTRIBUTES), set(file.attrs)
        assert len({file["modes"].shape, file["boundaries/x0"].shape, (5,), (6,)}) == 4, "a shape has two names"
        text = page_of(file)
    if write:
        page.write_text(text, encoding="utf-8")
    assert page.read_text(encoding="utf-8") == text, f"{page} differs from a map; write it again with --write"


def check_map(program, folder):
    path = folder / "map.h5"
    theory(program, "map", "--x", "throw_number=0.5:3:6", "--y", "vibration_angle_deg=10:50:5", "--friction", 0.35,
           "--tan-inclination", -0.1, "--output", path)
    with h5py.File(path) as file:
        for name, item in datasets(file).items():
            assert item.attrs["units"] and item.attrs["description"], name
        assert file["velocity_efficiency"].shape == (5, 6)
        point = json.loads(theory(program, "point", "--throw-number", repr(float(file["x"][2])), "--vibration-angle",
                                  f"{float(file['y'][3])!r} deg", "--tan-inclination", -0.1, "--friction", 0.35, "--json"))
        assert abs(file["velocity_efficiency"][3, 2] - point["velocity_efficiency"]) < 1e-8
        assert file["modes"].asstr()[file["mode"][3, 2]] == point["mode"]
        assert file["fixed/friction"][0] == 0.35
    if "no VTK" in subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout:
        return
    image = (folder / "map.vti").read_text()
    assert 'type="ImageData"' in image and 'format="binary"' in image and "appended" not in image
    assert re.search(r'WholeExtent="0 5 0 4 0 0"', image)


def check_table(program, folder):
    (folder / "in.csv").write_text("throw_number,tan_vibration_angle,friction\n2,0.5,0.23\n1.5,0.25,0.3\n")
    theory(program, "batch", folder / "in.csv", "--output", folder / "out.h5")
    with h5py.File(folder / "out.h5") as file:
        for name, item in datasets(file).items():
            assert item.attrs["units"] and item.attrs["description"], name
        assert abs(file["velocity_efficiency"][0] - 0.5815) < 5e-5
        assert file["mode"].asstr()[0] == "FN'"
        assert np.all(file["converged"][:] == 1)


def main():
    program, folder, page = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    check_page(program, folder, page, "--write" in sys.argv)
    check_map(program, folder)
    check_table(program, folder)


if __name__ == "__main__":
    main()
