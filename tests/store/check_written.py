"""Reads the sample's result.h5 and campaign.h5 with h5py and holds them to what the program prints of them.

usage: check_written.py FOLDER VIBROTROUGH
"""

import json
import math
import re
import subprocess
import sys

import h5py
import numpy as np

TYPES = {"int32": np.dtype("<i4"), "float64": np.dtype("<f8")}
SHAPES = {"result.h5": {"1": (1,), "packings": (2,), "samples": (5,), "bins": (4,), "columns": (3,), "slabs": (3,), "triangles": (2,), "classes": (2,), "materials": (4,), "materials * bins": (16,), "stages": (1,), "sizes": (2,), "grains": (3,), "sizes * (cycles + 1)": (4,), "cycles": (1,), "cycles + 1": (2,), "101": (101,)}, "campaign.h5": {"cases": (2,)}}
CYCLES = {"1": 3, "2": 1}  # cycles of the sample's packings


def documented(reference, heading):
    """The names of a file in the reference: name -> type, shape, units and meaning."""
    return {row["name"]: [row["type"], row["shape"], row["units"], row["meaning"]] for row in reference[heading]}


def written(file):
    """What is written below each name: type, shape, units and description; nothing of root attributes. A field of a table
    is name/field.
    """
    found = {f"@{name}": None for name in file.attrs}
    text = np.vectorize(lambda value: value.decode(), otypes=[object])  # of the attributes, which are texts of a fixed length

    def add(name, item):
        if not isinstance(item, h5py.Dataset):
            return
        units, meaning = text(item.attrs["units"]), text(item.attrs["description"])
        if item.dtype.names is None:
            found[name] = (item.dtype, item.shape, units, meaning)
            return
        assert len(units) == len(meaning) == len(item.dtype.names), name
        for field, *words in zip(item.dtype.names, units, meaning):
            found[f"{name}/{field}"] = (item.dtype[field], item.shape, *words)

    file.visititems(add)
    return found


def check_dataset(name, data, row, shapes):
    kind, shape, units, meaning = row
    found_type, found_shape, found_units, found_meaning = data
    assert found_units == units, f"{name}: units {found_units!r}, documented {units!r}"
    assert found_meaning == meaning, f"{name}: {found_meaning!r}, documented {meaning!r}"
    if kind == "text":
        assert h5py.check_string_dtype(found_type).encoding == "utf-8", f"{name}: {found_type} is not a UTF-8 text"
    else:
        assert found_type == TYPES[kind], f"{name}: {found_type}, documented {kind}"
    assert found_shape == shapes[shape], f"{name}: shape {found_shape}, documented {shape}"


def check_file(path, heading, reference, others=frozenset()):
    """Returns the names that the file has; with those of other files they must be all that are documented."""
    table = documented(reference, heading)
    seen = set()
    with h5py.File(path) as file:
        for name, data in written(file).items():
            shapes = dict(SHAPES[heading])
            series = re.fullmatch(r"(series|cycle_ends|material_ends|phases|profiles|surface|flow|along|material_flow|material_along|residence|screen|sizes|passed|through|size_cycles)/(\d+)/(\w+)", name)
            row_name = f"{series[1]}/<packing>/{series[3]}" if series else name
            if name.startswith("swept/"):
                row_name = "swept/<key>"
                seen.add(row_name)
                assert row_name in table and data[1] == shapes["cases"], name
                continue
            if name.startswith("observables/"):
                row_name = "observables/<name>/" + name.split("/", 2)[2]
                seen.add(row_name)
                kind, shape = table[row_name][:2]
                assert data[1] == {"cases": (2,), "points": (3,), "1": (1,)}[shape], name
                assert (data[0] == TYPES[kind]) if kind in TYPES else h5py.check_string_dtype(data[0]), name
                continue
            if series:
                shapes |= {"cycles": (CYCLES[series[2]],), "cycles + 1": (CYCLES[series[2]] + 1,), "sizes * (cycles + 1)": (2 * (CYCLES[series[2]] + 1),)}
            assert row_name in table, f"{path}: {name} is not documented"
            seen.add(row_name)
            if data is not None:
                check_dataset(name, data, table[row_name], shapes)
    if others is not None:
        assert seen | others == set(table), f"{path}: documented but not written: {set(table) - seen - others}"
    return seen


def check_mass_flow(file):
    """Two phases of two bins of 1.5 mm, from 0.25 mm above the trough upwards: three slabs. What flows in the bins flows in
    the slabs, and the lowest slab has five sixths of the lower bin."""
    flow, of_packings = file["mass_flow"], []
    for packing in ("1", "2"):
        profile = file["profiles"][packing]
        of_packings.append(1400 * profile["solid_fraction"] * profile["velocity_x"] / 2)
    assert np.allclose(flow["height"], [0.00075, 0.00225, 0.00375], rtol=1e-12)
    assert math.isclose(flow["flow"].sum(), np.mean([one.sum() for one in of_packings]), rel_tol=1e-12)
    lowest = [5 / 6 * (one[0] + one[2]) for one in of_packings]
    assert math.isclose(flow["flow"][0], np.mean(lowest), rel_tol=1e-12)
    wanted = math.tan(0.95 * math.pi / 2) * abs(lowest[1] - lowest[0]) / 2
    assert math.isclose(flow["half_width"][0], wanted, rel_tol=1e-12)


def check_open_trough(file):
    """Means and Student's t over the packings that have a number: two of 12 and 16 mm, of 0.3 and 0.4 m/s, of 1.5 and 2.5 s."""
    along, times = file["along_trough"], file["residence_times"]
    student = math.tan(0.95 * math.pi / 2)  # for one degree of freedom
    assert list(along["x"]) == [0.01, 0.02, 0.03, 0.04] and np.allclose(along["depth"], [0.014, 0.012, 0.011, 0.01], rtol=1e-12)
    assert np.allclose(along["velocity"], [0.35, 0.3, 0.31, 0.32], rtol=1e-12)
    assert np.allclose(along["depth_half_width"], [0.002 * student, 0, 0, 0], rtol=1e-12)
    assert np.allclose(along["velocity_half_width"], [0.05 * student, 0, 0, math.nan], rtol=1e-12, equal_nan=True)
    assert np.allclose(times["share"], np.arange(101) / 100) and list(times["time"][99:]) == [1.5, 2]
    assert np.allclose(times["time_half_width"][99:], [0, 0.5 * student], rtol=1e-12)


def check_materials(file):
    """The last of four materials: its outflow is 0.01 and 0.02 kg/s, its share in the last bin 0.4 and 0.6."""
    materials, along = file["materials"], file["materials_along"]
    student = math.tan(0.95 * math.pi / 2)  # for one degree of freedom
    assert math.isclose(materials["outflow"][3], 0.015) and math.isclose(materials["outflow_half_width"][3], 0.005 * student)
    assert math.isclose(materials["segregation"][3], -0.1) and math.isclose(materials["residence_time"][3], 2)
    scale = file["case"]["velocity_scale"][0]
    assert math.isclose(materials["efficiency"][3], 0.4 / scale, rel_tol=1e-12)
    assert [name.decode() for name in along["material"][[0, 4, 15]]] == ["grains", "a", "c"]
    assert math.isclose(along["share"][15], 0.5) and math.isclose(along["share_half_width"][15], 0.1 * student)
    assert math.isclose(along["velocity"][15], 0.3) and math.isnan(along["velocity_half_width"][15])
    assert np.allclose(along["segregation"], 0.01 * np.arange(16))


def check_result_values(file):
    assert file.attrs["schema_version"] == 3
    assert file.attrs["case"] == b"0123456789abcdef"
    assert file.attrs["engine_version"] == b"LIGGGHTS 3.8.0"
    # The glossary's formulas, written down again; 1e-14 allows a few roundings of a double.
    omega = 2 * math.pi * 13.5
    case = {name: file["case"][name][0] for name in file["case"].dtype.names}
    wanted = {
        "machine_number": omega**2 * 0.006 / 9.81,
        "throw_number": omega**2 * 0.006 * math.sin(0.5) / (9.81 * math.cos(-0.05)),
        "velocity_scale": omega * 0.006 * math.cos(0.5),
        "conveying_speed": 0.82 * omega * 0.006 * math.cos(0.5),
        "conveying_speed_half_width": case["efficiency_half_width"] * omega * 0.006 * math.cos(0.5),
    }
    for name, value in wanted.items():
        assert math.isclose(case[name], value, rel_tol=1e-14), f"{name}: {case[name]}, wanted {value}"
    # The mass of 500 grains in three sizes 0.9, 1 and 1.1 d, per area; speed times that; powers per area.
    mass = 500 * 1400 * math.pi / 6 * 0.003**3 * (0.9**3 + 1 + 1.1**3) / 3 / (0.036 * 0.018)
    assert math.isclose(case["mass_per_area"], mass, rel_tol=1e-13)
    assert math.isclose(case["mass_flow_per_width"], wanted["conveying_speed"] * mass, rel_tol=1e-13)
    # The trough is open: Student's t over the packings' products of speed (0.83 and 0.81) and equal depths, and the start-up.
    flow_half_width = math.hypot(math.tan(0.95 * math.pi / 2) * 0.01, 0.03125) * case["velocity_scale"] * mass
    assert math.isclose(case["mass_flow_per_width_half_width"], flow_half_width, rel_tol=1e-12)
    assert math.isclose(case["power_per_area"], 0.75 / (0.036 * 0.018), rel_tol=1e-13) and case["damping"] == 0.5
    assert math.isnan(case["trough_width"])
    # Stored as given: exact.
    assert case["efficiency"] == 0.82 and case["efficiency_half_width_statistics"] == 0.127 and case["efficiency_drift"] == 0.03125 and case["confidence"] == 0.95
    assert case["cycles_measured"] == 2 and case["cycles_discarded"] == 2 and case["wall_time"] == 23.75
    assert case["grain_density"] == 1400.0 and case["layer_grains"] == 500 and math.isnan(case["layer_height"])
    # The layer: means over the packings that have the number, the largest overlap, NaN where none has it.
    assert file.attrs["layer_mode"] == b"FP'N"
    assert math.isclose(case["take_off_phase"], 0.75, rel_tol=1e-14) and math.isclose(case["landing_phase"], 4.75, rel_tol=1e-14)
    assert case["period_cycles"] == 2 and case["velocity_gradient"] == -0.01
    assert case["largest_overlap"] == 4.5e-5 and math.isnan(case["friction_ratio"])
    scale = 0.0099 * (omega * 0.006) ** 2
    assert math.isclose(case["dissipation_fraction"], (0.001 + 0.25 / 1024) / scale, rel_tol=1e-14)
    assert math.isclose(case["gravity_power"], 0.0099 * 9.81 * math.sin(0.05) * wanted["conveying_speed"], rel_tol=1e-13)
    assert math.isclose(case["dissipated_power"], 13.5 * (0.001 + 0.25 / 1024), rel_tol=1e-13)
    check_mass_flow(file)
    check_open_trough(file)
    check_materials(file)
    assert list(file["phases/1"]["phase"]) == [0.25, 0.5, 0.75, 1.0, 1.25]
    assert list(file["surface/2"]["height"])[-1] > list(file["surface/1"]["height"])[-1]
    assert case["granular_temperature"] == 0.26
    # Three of five passed, with ((3 - 2) / 4)^2 at an attempt.
    assert np.allclose(file["partition"]["stays"], [0.4, 1]) and list(file["partition"]["probability"]) == [0.0625, 0]
    assert math.isclose(file["partition"]["attempts"][0], math.log(0.4) / math.log(0.9375), rel_tol=1e-12)
    assert case["screening_efficiency"] == 0.6 and math.isclose(case["screening_efficiency_by_model"], 0.0625, rel_tol=1e-12)
    assert np.allclose(file["screening"]["efficiency"], [0, 0.6]) and np.allclose(file["partition_cycles"]["stays"], [1, 0.4, 1, 1])
    packings = file["packings"]
    assert list(packings["seed"]) == [49979687, 86028121]
    assert [text.decode() for text in packings["verdict"]] == ["precise", "not-precise"]
    assert [text.decode() for text in packings["deck"]] == ["# deck of packing 1, angle \u03b2\nrun 3000\n", "# deck of packing 2\n"]
    assert list(packings["correlation_time"]) == [1.5, 2.25]
    assert list(file["cycle_ends/1"]["centre_of_mass_x"]) == [0.018, 0.0241, 0.0337, 0.0431]
    assert list(file["series/2"]["tangential_force"]) == [-0.0012]
    assert file["engine_certificate"].asstr()[0] == '{"verdict": "passed"}\n'
    assert file["scenario"].asstr()[0].startswith("[campaign]\nname = \"sample\"")


def check_campaign_values(file):
    assert file.attrs["campaign"] == b"sample"
    assert list(file["case"].asstr()) == ["0123456789abcdef", "fedcba9876543210"]
    assert list(file["frequency"]) == [13.5, 27.0]
    # Gamma goes with the square of the frequency; powers of two are exact in a double.
    assert file["throw_number"][1] == 4 * file["throw_number"][0]
    assert list(file["packings"]) == [2, 2]
    # A person's own number and curve were measured in the first case alone.
    number, curve = file["observables/temperature"], file["observables/profile/curve"]
    assert number["mean"][0] == 0.25 and math.isnan(number["mean"][1]) and list(number["packings"]) == [2, 0]
    assert (number["mean"].attrs["units"], number["mean"].attrs["description"]) == (b"m2/s2", b"Granular temperature")
    assert list(number["steadiness"].asstr()) == ["drifting", ""] and number["source"].asstr()[0] == "text"
    assert list(curve["at"]) == [0.001, 0.002, 0.003] and list(curve["mean"][:2]) == [1, 2] and math.isnan(curve["mean"][2])
    assert list(curve.attrs["units"]) == [b"1", b"m", b"m2/s2", b"m2/s2", b"1"] and curve.attrs["description"][1] == b"height"
    # The first case was studied, the error of the second is what is expected: the root of the sum of squares.
    bounds = [np.asarray(file[f"{part}_error"]) for part in ("softness", "box", "time_step")]
    assert file["efficiency_numerics"][0] == 0.034
    assert math.isclose(file["efficiency_numerics"][1], math.sqrt(sum(part[1]**2 for part in bounds)))
    assert list(file["numerics_source"].asstr()) == ["convergence", "expected"]
    for whole, statistics, numerics in zip(file["efficiency_half_width"], file["efficiency_half_width_statistics"], file["efficiency_numerics"]):
        assert math.isclose(whole, math.hypot(statistics, numerics))
    # The swept keys, by their names in the campaign file.
    assert file.attrs["swept_keys"] == b"trough.frequency grains.rotation"
    assert list(file["swept/trough.frequency"]) == [13.5, 27.0] and file["swept/trough.frequency"].attrs["units"] == b"Hz"
    assert list(file["swept/grains.rotation"].asstr()) == ["free", "free"]
    assert list(file["layer_mode"].asstr()) == ["FP'N"] * 2 and list(file["flight_number"]) == [0.625] * 2


def main(folder, program):
    printed = subprocess.run([program, "quantities", "--json"], capture_output=True, check=True).stdout
    reference = json.loads(printed)
    kept = check_file(f"{folder}/kept.h5", "result.h5", reference, None)  # a mixture that is not fed
    assert {"segregation/index_3", "material_ends/<packing>/z_3"} <= kept and "materials/outflow" not in kept
    check_file(f"{folder}/result.h5", "result.h5", reference, kept)
    check_file(f"{folder}/campaign.h5", "campaign.h5", reference)
    with h5py.File(f"{folder}/result.h5") as file:
        check_result_values(file)
    with h5py.File(f"{folder}/campaign.h5") as file:
        check_campaign_values(file)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
