"""Which swept keys make the axis and the series of a figure.

usage: check_inputs.py SCRIPTS
"""

import sys

import numpy as np


def series(keys, throw_numbers):
    """The axis and the keys of the series, of cases with these values."""
    from vibrotrough.figures.inputs import make_input, split_inputs

    over, others = split_inputs({"throw_number": np.array(throw_numbers)}, [make_input(key, np.array(values), "1") for key, values in keys.items()])
    return over.key, [one.key for one in others]


def main():
    sys.path.insert(0, sys.argv[1])
    two, three = [1.5, 1.5, 1.5, 2.5, 2.5, 2.5], [0.1, 0.2, 0.3, 0.1, 0.2, 0.3]
    zipped = {"trough.friction": three, "grains.friction": [10 * one for one in three]}
    # [zip] of two keys beside a swept throw number: a series for each pair of values, by its first key.
    assert series({"trough.throw_number": two, **zipped}, two) == ("trough.throw_number", ["trough.friction"])
    # On a single drive its first key is the axis, and there is one series.
    assert series(zipped, [2.0] * 6) == ("trough.friction", [])
    # [zip] with the throw number: all is told by the axis. Six colours of a single point each tell nothing more.
    together = [1.5, 1.7, 1.9, 2.1, 2.3, 2.5]
    assert series({"trough.throw_number": together, "grains.friction": [one / 5 for one in together]}, together) == ("trough.throw_number", [])
    # Keys that vary on their own make series of their own.
    assert series({"trough.friction": two, "grains.friction": three}, [2.0] * 6) == ("trough.friction", ["grains.friction"])
    # A throw number that differs by chance, and is not swept, hides no key.
    assert series({"grains.friction": three[:3]}, [1.5, 1.6, 1.7]) == ("trough.throw_number", ["grains.friction"])


if __name__ == "__main__":
    main()
