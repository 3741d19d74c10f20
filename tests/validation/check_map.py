"""Reads the HDF5 files of the theory with h5py: every dataset has units and a description, and
holds what the program prints for a point.

    check_map.py PROGRAM FOLDER
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
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    check_map(program, folder)
    check_table(program, folder)


if __name__ == "__main__":
    main()
