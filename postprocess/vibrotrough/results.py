"""The files of the program as arrays that know their units."""

from __future__ import annotations

import importlib
import os
import pathlib
import stat
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

if TYPE_CHECKING:
    import h5py


def _hdf5() -> Any:
    """h5py, which only results need: the theory and the atlas do without."""
    try:
        return importlib.import_module("h5py")
    except ImportError as error:
        raise ImportError("results are read with h5py; install it: pip install 'vibrotrough[results]', or Debian's python3-h5py") from error


class Array(np.ndarray[Any, np.dtype[Any]]):
    """A numpy array with `units` (udunits2's spelling, "1" for pure numbers) and `description`.

    Slices keep both. What is computed from it is a plain array: its units are yours to know.
    """

    units: str
    description: str

    def __new__(cls, values: ArrayLike, units: str = "1", description: str = "") -> Array:
        array = np.asarray(values).view(cls)
        array.units, array.description = units, description
        return array

    def __array_finalize__(self, parent: object) -> None:
        self.units = getattr(parent, "units", "1")
        self.description = getattr(parent, "description", "")

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, out: Any = None, **settings: Any) -> Any:
        plain = [np.asarray(one) if isinstance(one, Array) else one for one in inputs]
        if out is not None:
            settings["out"] = tuple(np.asarray(one) if isinstance(one, Array) else one for one in out)
        return getattr(ufunc, method)(*plain, **settings)

    def __repr__(self) -> str:
        return f"{np.asarray(self)!r} [{self.units}]"


def _read(dataset: h5py.Dataset) -> Array:
    values = dataset.asstr()[()] if _hdf5().check_string_dtype(dataset.dtype) else dataset[()]
    if "units" not in dataset.attrs:
        raise ValueError(f"{dataset.name} does not tell its units; Vibrotrough did not write it")
    return Array(values, text(dataset.attrs["units"]), text(dataset.attrs.get("description", "")))


def _read_fields(table: h5py.Dataset) -> Iterator[tuple[str, Array]]:
    """The fields of a table, by name, with their units and descriptions."""
    rows = table[0] if table.name == "/case" else table[()]  # a case has one row
    words = zip(table.dtype.names, table.attrs["units"], table.attrs["description"])
    for name, units, description in words:
        values = rows[name]
        yield name, Array(np.char.decode(values, "utf-8") if values.dtype.kind == "S" else values, text(units), text(description))


# Names that were replaced, as `vibrotrough quantities --json` prints them. A value is found under both, and listed under
# today's.
OLD_NAMES = {
    "speed": "conveying_speed",
    "speed_half_width": "conveying_speed_half_width",
    "efficiency_dem": "efficiency",
    "efficiency_dem_half_width": "efficiency_half_width_statistics",
    "efficiency_dem_whole_half_width": "efficiency_half_width",
    "efficiency_whole_half_width": "efficiency_half_width",
    "efficiency_dem_numerical_error": "efficiency_numerics",
    "efficiency_numerical_error": "efficiency_numerics",
    "efficiency_below_half_width": "efficiency_below_half_width_statistics",
    "efficiency_above_half_width": "efficiency_above_half_width_statistics",
    "speed_dem_m_per_s": "conveying_speed_m_per_s",
    "speed_dem_half_width_m_per_s": "conveying_speed_half_width_m_per_s",
    "mode_layer": "layer_mode",
    "efficiency_normal_force": "efficiency_by_normal_force",
    "wall_s": "wall_time_s",
}


def current_name(path: str) -> str:
    """A path whose last part is today's name where it is an old one."""
    before, slash, name = path.rpartition("/")
    return before + slash + OLD_NAMES.get(name, name)


_LARGEST_FILE = 4 << 30  # bytes


def read_regular(path: str | os.PathLike[str], largest: int = _LARGEST_FILE) -> bytes:
    """The bytes of a regular file of bounded size. Anything else, such as a pipe, which would never end, is refused with OSError."""
    # Without O_NONBLOCK the opening of a pipe would wait for a writer.
    with open(os.open(path, os.O_RDONLY | os.O_NONBLOCK), "rb") as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode) or status.st_size > largest:
            raise OSError(f"{path} is not a file of at most {largest >> 20} MB")
        return file.read()


def text(value: Any) -> str:
    """The text of an attribute. h5py gives those of vibrotrough's files, whose texts have a fixed length, as bytes."""
    return value.decode("utf-8") if isinstance(value, bytes) else str(value)


class File:
    """All datasets of a file and fields of its tables by their path, e.g. file["case/throw_number"], and its root
    attributes in `attributes`.
    """

    def __init__(self, path: str | os.PathLike[str], *wanted_formats: str) -> None:
        self.path = pathlib.Path(path)
        self._arrays: dict[str, Array] = {}
        if not self.path.is_file():
            raise OSError(f"{self.path} is not a file")
        try:
            with _hdf5().File(self.path) as file:
                self.attributes: dict[str, Any] = {name: text(value) if isinstance(value, (bytes, str)) else value for name, value in file.attrs.items()}
                found = self.attributes.get("format")
                if found not in wanted_formats:
                    raise ValueError(f"{self.path} holds a '{found}', not a '{wanted_formats[-1]}'")
                if "theory" not in str(found) and int(self.attributes["schema_version"]) < 3:
                    raise ValueError(f"{self.path} was written by an older version of Vibrotrough; 'vibrotrough run' writes it again")
                file.visititems(lambda name, item: self._keep(name, item))
        except (OSError, RuntimeError, KeyError) as error:  # h5py says by all three that a checksum is wrong
            raise ValueError(f"{self.path} is damaged ({error}); delete it, and let vibrotrough make it again") from error

    def _keep(self, name: str, item: object) -> None:
        if not isinstance(item, _hdf5().Dataset):
            return
        if item.dtype.names is None:
            self._arrays[current_name(name)] = _read(item)
        else:
            self._arrays |= {current_name(f"{name}/{field}"): values for field, values in _read_fields(item)}

    def __getitem__(self, name: str) -> Array:
        if name not in self:
            raise KeyError(f"{self.path} has no '{name}'; it has {', '.join(self._arrays)}")
        return self._arrays[current_name(name)]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and current_name(name) in self._arrays

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def names(self) -> list[str]:
        return list(self._arrays)


def open_result(path: str | os.PathLike[str]) -> File:
    """One case's result.h5, from the file or the case's folder."""
    path = pathlib.Path(path)
    return File(path / "result.h5" if path.is_dir() else path, "vibrotrough result")


def open_theory(path: str | os.PathLike[str]) -> File:
    """A map of `vibrotrough theory map` or a table of `vibrotrough theory batch --output FILE.h5`."""
    return File(path, "vibrotrough theory map", "vibrotrough theory table")
