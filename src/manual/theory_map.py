"""The page of what `theory map` stores, from a small map."""

import pathlib
import re
import subprocess
import tempfile

import h5py

# Attributes have no description of their own.
ATTRIBUTES = {
    "format": 'The text "vibrotrough theory map"', "schema_version": "Version of this table", "program_version": "Version that computed the map",
    "git_commit": "Commit that it was built from", "x_name": "The input along x, e.g. throw_number", "y_name": "The input along y",
}  # fmt: skip
TITLE = """# A map of the theory

What `vibrotrough theory map --output map.h5 --starts N` stores; without `--starts` the file lacks
`motions`, `fraction`, `lowest_efficiency` and `highest_efficiency`. Names that begin with `@` are attributes of the root.

| name | type | shape | units | meaning |
|---|---|---|---|---|
"""


def page_of(file: h5py.File) -> str:
    """The reference of a map with 5 rows and 6 columns."""
    assert set(file.attrs) == set(ATTRIBUTES), set(file.attrs)
    assert len({file["modes"].shape, file["boundaries/x0"].shape, (5,), (6,)}) == 4, "a shape has two names"
    shapes = {(5, 6): "rows, columns", (6,): "columns", (5,): "rows", file["modes"].shape: "modes", file["boundaries/x0"].shape: "pieces", (1,): "1"}
    datasets: dict[str, h5py.Dataset] = {}
    file.visititems(lambda name, item: datasets.update({name: item}) if isinstance(item, h5py.Dataset) else None)
    lines = [f"| `@{name}` | {'int32' if name == 'schema_version' else 'text'} | scalar | 1 | {meaning} |" for name, meaning in ATTRIBUTES.items()]
    for name, item in datasets.items():
        kind = "text" if item.dtype.kind in "SO" else item.dtype.name
        # The units of an input depend on which one it is.
        units = "of the input" if re.fullmatch(r"x|y|boundaries/[xy].|fixed/.*", name) else item.attrs["units"].decode()
        name = "fixed/NAME" if name.startswith("fixed/") else name
        line = f"| `{name}` | {kind} | {shapes[item.shape]} | {units} | {item.attrs['description'].decode()} |"
        if line not in lines:
            lines.append(line)
    return TITLE + "\n".join(lines) + "\n"


def page(program: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "map.h5"
        words = ["--x", "throw_number=0.5:3:6", "--y", "vibration_angle_deg=10:50:5", "--friction", "0.35", "--restitution", "0.3", "--starts", "8"]
        subprocess.run([program, "theory", "map", *words, "--output", path], check=True, capture_output=True)
        with h5py.File(path) as file:
            return page_of(file)
