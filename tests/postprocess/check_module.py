"""Opens the sample's campaign.h5 and result.h5 with the package vibrotrough and holds it to h5py itself.

usage: check_module.py SCRIPTS SAMPLE WORK VIBROTROUGH
"""

import importlib.util
import json
import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy as np


def raises(error, call, *parts):
    try:
        call()
    except error as raised:
        for part in parts:
            assert part in str(raised), f"'{part}' is not in '{raised}'"
        return
    raise AssertionError(f"no {error.__name__}")


def check_old_names(vibrotrough, campaign, folder, program):
    """A file of version 0.2.0 has today's names, scripts of that version find today's values, and program and module know the
    same old names."""
    printed = json.loads(subprocess.run([program, "quantities", "--json"], capture_output=True, check=True).stdout)
    assert vibrotrough.results.OLD_NAMES == printed["old_names"]
    files = {row["name"].rpartition("/")[2] for file in ("result.h5", "campaign.h5") for row in printed[file]}
    columns = {column["name"] for column in printed["columns"]}
    assert set(printed["old_names"].values()) <= files | columns, "an old name leads to a name that there is"
    assert not set(printed["old_names"]) & (files | columns), "no name is an old one"

    shutil.copy(folder / "campaign.h5", folder / "old.h5")
    with h5py.File(folder / "old.h5", "a") as file:
        file.move("conveying_speed", "speed")
        file.move("conveying_speed_half_width", "speed_half_width")
    old = vibrotrough.open_campaign(folder / "old.h5")
    for file in (old, campaign):
        for name in ("conveying_speed", "speed"):
            np.testing.assert_array_equal(np.asarray(file[name]), np.asarray(campaign["conveying_speed"]))
            assert name in file
    assert set(old.names()) == set(campaign.names())


def check_dataframe(campaign):
    """One row per case, the same numbers, units beside them."""
    table = campaign.to_dataframe()
    # Neither curves nor the texts of files have a value for each case.
    columns = {name for name in campaign.names() if "/profile/curve/" not in name and not name.endswith(("/file", "/source", "/source_sha256"))} - {"case"}
    assert list(table.index) == list(campaign["case"]) and set(table.columns) == columns
    for name in table.columns:
        np.testing.assert_array_equal(table[name].to_numpy(), np.asarray(campaign[name]), err_msg=name)
        assert table.attrs["units"][name] == campaign[name].units and table.attrs["descriptions"][name] == campaign[name].description
    assert list(table.query("frequency == 27.0").index) == [campaign["case"][1]]


def main(scripts, sample, work, program):
    sys.path.insert(0, scripts)
    sys.dont_write_bytecode = True
    import vibrotrough

    folder = pathlib.Path(work) / "module"
    (folder / "cases" / "0123456789abcdef").mkdir(parents=True, exist_ok=True)
    shutil.copy(pathlib.Path(sample) / "campaign.h5", folder)
    shutil.copy(pathlib.Path(sample) / "result.h5", folder / "cases" / "0123456789abcdef")

    campaign = vibrotrough.open_campaign(folder)
    with h5py.File(folder / "campaign.h5") as file:
        datasets = {name: file[name] for name in file if name not in ("swept", "observables")} | {f"swept/{key}": file["swept"][key] for key in file["swept"]}
        own = file["observables"]["temperature"]
        datasets |= {f"observables/temperature/{name}": own[name] for name in own}
        found = [name for name in campaign.names() if not name.startswith("observables/profile/")]
        assert set(found) == set(datasets) and len(datasets) > 30
        curve = campaign["observables/profile/curve/mean"]
        assert (curve.units, curve.description, list(curve[:2])) == ("m2/s2", "Granular temperature", [1, 2])
        for name, dataset in datasets.items():
            wanted = dataset.asstr()[:] if h5py.check_string_dtype(dataset.dtype) else dataset[()]
            np.testing.assert_array_equal(np.asarray(campaign[name]), wanted, err_msg=name)
            assert campaign[name].units == dataset.attrs["units"].decode(), name
            assert campaign[name].description == dataset.attrs["description"].decode(), name
        assert campaign.attributes["campaign"] == "sample"
    assert campaign.cases == 2 and list(vibrotrough.open_campaign(folder / "campaign.h5")["case"]) == list(campaign["case"])

    # Units stay with slices and do not pass to what is computed.
    angle = campaign["vibration_angle"]
    assert angle.units == angle[:1].units == "rad" and "[rad]" in repr(angle)
    for computed in (np.degrees(angle), angle * campaign["amplitude"], angle.mean(axis=0), angle > 0):
        assert not isinstance(computed, vibrotrough.Array), type(computed)
    np.testing.assert_allclose(np.degrees(angle), 28.64788975654116, rtol=1e-15)

    assert list(campaign.rows(frequency=27.0)) == [1]
    assert list(campaign.rows(outcome="not-precise", friction=0.23)) == [0, 1]
    assert list(campaign.rows(outcome="finished")) == []

    if importlib.util.find_spec("pandas"):  # the first tier of tests has none
        check_dataframe(campaign)

    case = campaign.case(campaign["case"][0])
    assert case["series/1/efficiency"].units == "1" and len(case["series/1/efficiency"]) == 3
    assert case["case/frequency"].units == "Hz" and float(case["case/frequency"]) == 13.5
    assert vibrotrough.open_result(folder / "cases" / "0123456789abcdef").attributes["case"] == "0123456789abcdef"
    assert "case/conveying_speed" in case and "conveying_speed" not in case

    check_old_names(vibrotrough, campaign, folder, program)

    # Every dataset of every kind of file tells its units, and one that does not is refused.
    for file in (campaign, case.result):
        with h5py.File(file.path) as read:
            for name in file:
                table, _, field = name.rpartition("/")
                if name in read:
                    wanted = read[name].attrs["units"]
                else:
                    wanted = read[table].attrs["units"][read[table].dtype.names.index(field)]
                assert file[name].units == vibrotrough.results.text(wanted) != "", name
    for kind in ("map", "table"):
        with h5py.File(folder / f"{kind}.h5", "w") as file:
            file.attrs["format"] = f"vibrotrough theory {kind}"
            file["boundaries/x0"] = [1.0, 2.0]
            file["boundaries/x0"].attrs["units"] = "degree"
        assert vibrotrough.open_theory(folder / f"{kind}.h5")["boundaries/x0"].units == "degree"
    with h5py.File(folder / "map.h5", "a") as file:
        file["foreign"] = [1.0]
    raises(ValueError, lambda: vibrotrough.open_theory(folder / "map.h5"), "/foreign does not tell its units")

    content = bytearray((folder / "campaign.h5").read_bytes())
    for place in range(0, len(content), 997):
        damaged = content.copy()
        damaged[place] ^= 1
        (folder / "damaged.h5").write_bytes(damaged)
        raises(ValueError, lambda: vibrotrough.open_campaign(folder / "damaged.h5"), "is damaged", "delete it")

    raises(KeyError, lambda: campaign["eta"], "has no 'eta'", "efficiency")
    raises(ValueError, lambda: vibrotrough.open_campaign(folder / "cases/0123456789abcdef/result.h5"), "vibrotrough result")
    raises(OSError, lambda: vibrotrough.open_campaign(folder / "none.h5"))
    raises(KeyError, lambda: campaign.case("none"), "has no case none")


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
