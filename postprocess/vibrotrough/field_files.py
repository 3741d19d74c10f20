"""Writes coarse-grained fields of a case as HDF5 and for ParaView; vibrotrough.fields has their equations.

    import vibrotrough

    fields = vibrotrough.fields.measure(vibrotrough.Campaign("runs/demo").cases()[0])
    vibrotrough.field_files.write_hdf5(fields, "fields.h5")
    vibrotrough.field_files.write_vti(fields, ".")

or by hand: `python3 -m vibrotrough.field_files CASE_FOLDER OUTPUT_FOLDER [--width METRES]`.
"""

from __future__ import annotations

import argparse
import base64
import pathlib
import struct
import sys
from typing import Any

import h5py
import numpy as np

from .campaign import Case
from .fields import UNITS, Fields, Floats, NoFields, measure, stream_function


def write_hdf5(fields: Fields, path: str | pathlib.Path) -> None:
    """fields.h5: x, z, phase; maps, profiles, and `cycle/` with the means over the cycle. Each states its unit."""
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "vibrotrough fields", "case": fields.case, "width": fields.grid.kernel.width, "cycles": fields.frames,
                           "kernel": "4 / (pi w^2) (1 - r^2/w^2)^3, w the width [m]"})  # fmt: skip

        def put(name: str, values: Floats, units: str, description: str) -> None:
            data = file.create_dataset(name, data=values, compression="gzip", shuffle=True)
            data.attrs.update({"units": units, "description": description})

        put("phase", fields.phases, "cycle", "time since phase 0 of the drive over its period")
        put("x", fields.grid.x, "m", "along the trough, from the start of the box, in the frame of the trough")
        put("z", fields.grid.z, "m", "above the floor of the trough")
        groups = (("maps", dict(fields), "phase, z, x"), ("profiles", fields.profiles(), "phase, z"),
                  ("cycle/maps", dict(fields.mean()), "1, z, x"), ("cycle/profiles", fields.mean().profiles(), "1, z"))  # fmt: skip
        for group, values, order in groups:
            for name in fields:
                put(f"{group}/{name}", values[name], UNITS[name][0], f"{UNITS[name][1]} ({order}, components x, y, z)")
        put("cycle/maps/stream_function", stream_function(fields), "kg m-1 s-1", "of the mass relative to the layer's mean velocity (z, x)")


def array_xml(name: str, values: Floats, components: int) -> str:
    """A DataArray of VTK, base64 within the file: ParaView 5.11 does not read what is appended to it."""
    data = np.ascontiguousarray(values, dtype="<f8").tobytes()
    text = base64.b64encode(struct.pack("<I", len(data)) + data).decode()
    return f'<DataArray type="Float64" Name="{name}" NumberOfComponents="{components}" format="binary">{text}</DataArray>\n'


def write_vti(fields: Fields, folder: str | pathlib.Path, name: str = "fields") -> pathlib.Path:
    """NAME.pvd for ParaView, and a NAME.NNN.vti for each phase, whose time is the phase in cycles. Nothing is NaN there: it is 0.

    @return the path of NAME.pvd
    """
    folder, grid = pathlib.Path(folder), fields.grid
    (rows, columns), (dz, dx) = grid.shape, grid.steps
    extent = f"0 {columns - 1} 0 0 0 {rows - 1}"
    head = '<VTKFile type="{}" version="0.1" byte_order="LittleEndian">\n'
    lines = []
    everything = dict(fields)
    for place, phase in enumerate(fields.phases):
        arrays = "".join(array_xml(one, np.nan_to_num(values[place]), int(np.prod(values.shape[3:]))) for one, values in everything.items())
        text = (head.format("ImageData") + f'<ImageData WholeExtent="{extent}" Origin="{grid.x[0]!r} 0 {grid.z[0]!r}" Spacing="{dx!r} 1 {dz!r}">\n'
                f'<Piece Extent="{extent}">\n<PointData Scalars="solid_fraction" Vectors="velocity">\n{arrays}</PointData>\n'
                "</Piece>\n</ImageData>\n</VTKFile>\n")  # fmt: skip
        file = f"{name}.{place + 1:03d}.vti"
        (folder / file).write_text(text, encoding="ascii")
        lines.append(f'<DataSet timestep="{phase!r}" file="{file}"/>\n')
    path = folder / f"{name}.pvd"
    path.write_text(head.format("Collection") + f"<Collection>\n{''.join(lines)}</Collection>\n</VTKFile>\n", encoding="ascii")
    return path


def main() -> int:
    parser = argparse.ArgumentParser(description="Writes fields.h5 and fields.pvd of a case that keeps frames.")
    parser.add_argument("case", type=pathlib.Path, help="a case's folder, such as runs/demo/cases/ID")
    parser.add_argument("output", type=pathlib.Path, help="folder to write to")
    parser.add_argument("--width", type=float, metavar="METRES", help="radius of the kernel; default: a mean diameter")
    parser.add_argument("--discard", type=int, metavar="CYCLES", help="cycles left out at the beginning; default: the start-up")
    options: Any = parser.parse_args()
    if options.width is not None and not options.width > 0:
        parser.error("--width is a length above 0 in metres")
    try:
        fields = measure(Case(options.case), width=options.width, discard=options.discard)
    except (NoFields, OSError, KeyError) as error:
        print(f"vibrotrough: {error.args[0] if isinstance(error, KeyError) else error}", file=sys.stderr)
        return 2
    options.output.mkdir(parents=True, exist_ok=True)
    write_hdf5(fields, options.output / "fields.h5")
    print(options.output / "fields.h5", write_vti(fields, options.output), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
