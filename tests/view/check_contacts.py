"""Run by pvbatch: the scene of a case with contacts opens, and ParaView's reader finds the contacts of the engine's dumps.

usage: check_contacts.py FOLDER DUMPS
"""

import os
import sys

from paraview import servermanager
from paraview.simple import FindSource, GetActiveView, GetAnimationScene, GetDisplayProperties, Render


def read_dump(path):
    with open(path, encoding="ascii") as file:
        return [[float(word) for word in line.split()] for line in file.readlines()[9:]]


def size(vector):
    return sum(value * value for value in vector) ** 0.5


def main(folder, dumps):
    path = os.path.join(folder, "view_case.py")
    with open(path, encoding="utf-8") as file:
        exec(compile(file.read(), path, "exec"), {"__file__": path, "__name__": "__main__"})
    contacts = FindSource("contacts")
    shown = GetDisplayProperties(contacts, GetActiveView())
    assert shown.Visibility == 0, "contacts are not shown at first"
    times = list(GetAnimationScene().TimeKeeper.TimestepValues)
    assert len(times) == 2, times
    for step, time in zip((0, 250), times):
        GetAnimationScene().AnimationTime = time
        contacts.UpdatePipeline(time)
        rows = [row for name in ("contacts", "trough_contacts") for row in read_dump(os.path.join(dumps, f"{name}.{step}.dump"))]
        data = servermanager.Fetch(contacts)
        assert data.GetNumberOfLines() == len(rows) > 0, f"{data.GetNumberOfLines()} contacts at step {step}, wanted {len(rows)}"
        for name, column in (("normal_force", 9), ("tangential_force", 12)):
            array = data.GetCellData().GetArray(name)
            found = sum(array.GetValue(i) for i in range(len(rows)))
            wanted = sum(size(row[column : column + 3]) for row in rows)
            # Single precision of at most some hundred terms.
            assert abs(found - wanted) <= 1e-5 * wanted + 1e-12, f"{name} at step {step}: {found} N, wanted {wanted} N"
        print(f"{len(rows)} contacts at step {step}")
    Render()


main(*sys.argv[1:])
