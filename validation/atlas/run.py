#!/usr/bin/python3
import json
import math
import pathlib
import subprocess
import sys
from collections.abc import Sequence
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent.parent / "postprocess")]

import h5py  # noqa: E402
import numpy as np  # noqa: E402
import scipy.stats  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

import design  # noqa: E402
import feeders  # noqa: E402
import other_layers  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
from campaign_program import campaign_text, run_campaign, toml_value  # noqa: E402
from validation_case import ValidationCase, read_table  # noqa: E402

HELD_OUT = {"h0": 15, "h1": 15, "h2": 10, "h3": 16, "h4": 16, "h5": 14, "h6": 14}  # campaigns of random layers, and how many each has
DEEP_HELD_OUT = {"deep0": 16}  # the same of deep ones, which are as precise as the atlas' own
MOST = {"level": 0.03, "shallow": 0.04, "deep": 0.04}  # error of a region
SEEN = 56  # the first of them were known when the surface was chosen (trend, uphill campaigns, draws); it rests on them, and the others judge
FIRST_WIDER = sum((*HELD_OUT.values(), *DEEP_HELD_OUT.values()))  # number of the first random layer of the wider domain
STEEPEST = 0.1  # tan(alpha) up to which the atlas goes: too few layers that climb more were simulated, and they are judged apart
# Parts of the domain: what is judged for each, and which layers lie in it.
REGIONS: dict[str, tuple[str, float, float]] = {
    "no throw": ("throw_number", 0, 1), "near take-off": ("throw_number", 1, 1.2), "thrown": ("throw_number", 1.2, 2.42),
    "thrown far": ("throw_number", 2.42, 4), "downhill": ("tan_inclination", -1, -0.02), "level": ("tan_inclination", -0.02, 0.02),
    "uphill": ("tan_inclination", 0.02, 1), "shallow": ("depth", 0, 6), "deep": ("depth", 6, 20),
    "first domain": ("number", -1, FIRST_WIDER - 1), "wider domain": ("number", FIRST_WIDER - 1, 10_000),
    "steep climb": ("tan_inclination", STEEPEST, 1),
}  # fmt: skip
DRY_TORQUE = 0.02  # of the rolling-layer law, to which rolling friction adds
# What a layer does to its trough: the part of its mass that moves along, its damping over mass times omega (the first campaigns have
# neither), and the cycles after which its motion repeats.
LOADS = ("added_mass", "damping")
LOAD = [*(f"{name}{end}" for name in LOADS for end in ("", "_half_width")), "period"]
COLUMNS = ["case", *design.RANGES, "theory", "rolling_layer", "efficiency", "half_width", "numerical_error", "layer_mode", "outcome", *LOAD]
PREDICTED_LOAD = ["number", "throw_number", *(f"{source}{name}{end}" for name in LOADS for source in ("", "atlas_") for end in ("", "_half_width"))]
MAKERS = (0.10, 0.25)  # of the material's mass move with the trough (NetterVibration)
PREDICTED = ["number", "case", "throw_number", "tan_inclination", "depth", "efficiency", "half_width", "numerical_error", "theory", "rolling_layer", "atlas", "atlas_half_width"]
# Layers that are the same without dimensions: what differs between them. The modulus goes with density, gravity and diameter.
SAME: dict[str, dict[str, Any]] = {
    "plain": {"grains.youngs_modulus": "4 MPa"},
    "larger": {"grains.youngs_modulus": "8 MPa", "grains.diameter": "6 mm", "trough.amplitude": "12 mm", "layer.length": "48 mm", "layer.width": "30 mm"},
    "heavier": {"grains.youngs_modulus": "8 MPa", "grains.density": "2800 kg/m3"},
}
PRECISE = {"measure.half_width": 0.05}  # of the shallow layers that judge
STEADY = ("finished", "not-precise")
Row = dict[str, str]
Floats = NDArray[np.float64]


def campaign_at(run: ValidationCase, unit: Floats, changes: dict[str, Any]) -> str:
    """A campaign file with layers at points of the unit cube."""
    return campaign_of(run, design.columns_of(unit), changes)


def campaign_of(run: ValidationCase, columns: design.Columns, changes: dict[str, Any]) -> str:
    """A campaign file with a layer for each row of the columns."""
    text = campaign_text(run.sections(), {"campaign.name": "atlas", **changes}, {}).replace("[sweep]", "[zip]")
    return text + "".join(f'"{key}" = {toml_value(values)}\n' for key, values in design.keys_of(columns).items())


def layers_at(run: ValidationCase, name: str, unit: Floats, changes: dict[str, Any]) -> list[list[object]]:
    """Simulates layers at points of the unit cube; rows of COLUMNS. A campaign whose cases all stand in the tables is not simulated
    again: a case's id says all that its result depends on, but for versions of the program and the engine."""
    text = campaign_at(run, unit, changes)
    stored = {row["case"]: row for table in ("layers.csv", "apart.csv", "held_out.csv") for row in read_table(FOLDER / table)}
    cases = ids_of(run, text)
    if all(case in stored for case in cases):
        return [[stored[case][column] for column in COLUMNS] for case in cases]
    return [[*row_of(run, row), *load_of(run.runs / name, row["case"])] for row in run_campaign(run.program, run.runs / name, text, run.jobs)]


def load_of(campaign: pathlib.Path, case: str) -> list[str]:
    """What a layer did to its trough, as LOAD, with Student's interval over its packings."""
    with h5py.File(campaign / "cases" / case / "result.h5") as file:
        packings, whole = file["packings"], {key: float(file["case"][key][0]) for key in ("added_mass_fraction", "added_mass", "frequency")}
        mass = whole["added_mass"] / whole["added_mass_fraction"]
        count = len(packings)
        width = float(scipy.stats.t.ppf(0.975, count - 1)) / math.sqrt(count) if count > 1 else math.nan
        found: list[str] = []
        for name, unit in (("added_mass", mass), ("damping", mass * 2 * math.pi * whole["frequency"])):
            values = np.asarray(packings[name]) / unit
            found += [f"{np.mean(values):.5f}", f"{width * np.std(values, ddof=1):.5f}"]
        return [*found, str(int(file["case"]["period_cycles"][0]))]


def ids_of(run: ValidationCase, text: str) -> list[str]:
    """The ids of a campaign's cases, in the order of its file."""
    return [case["case"] for case in run.of_file("plan", text)["cases"]]


def row_of(run: ValidationCase, row: Row) -> list[object]:
    place = [
        float(row["throw_number"]), float(row["trough.tan_vibration_angle"]), round(math.tan(math.radians(float(row["inclination_deg"]))), 6),
        float(row["friction"]), round(1000 * float(row["amplitude_m"]) / design.DIAMETER, 6), float(row["layer.diameters"]),
        float(row["grains.friction"]), float(row["grains.rolling_friction"]), float(row["grains.restitution"]),
    ]  # fmt: skip
    keys = ("efficiency_theory", "efficiency", "efficiency_half_width_statistics", "efficiency_numerics")
    theory, *simulated = (row[key] and f"{float(row[key]):.5f}" for key in keys)
    return [row["case"], *place, theory, rolling_layer(run, place), *simulated, row["layer_mode"], row["outcome"]]


def rolling_layer(run: ValidationCase, place: Sequence[float]) -> str:
    """Velocity efficiency of the rolling-layer law, also where it has not been tested; empty without a mean speed."""
    at = dict(zip(design.RANGES, place, strict=True))
    words = [word for name in ("throw_number", "tan_vibration_angle", "tan_inclination", "friction") for word in ("--" + name.replace("_", "-"), str(at[name]))]
    command = [run.program, "theory", "point", *words, "--accept-untested", "--json", "--rolling-layer", f"dry_torque={DRY_TORQUE + at['rolling_friction']}"]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    return f"{json.loads(answer.stdout)['velocity_efficiency']:.5f}" if answer.returncode == 0 else ""


def is_known(row: list[object]) -> bool:
    """Whether a layer is steady, with a mean and an interval, and the law has a mean speed."""
    found = dict(zip(COLUMNS, row, strict=True))
    return found["outcome"] in STEADY and all(found[key] != "" for key in ("theory", "rolling_layer", "efficiency", "half_width"))


def simulate(run: ValidationCase) -> None:
    own = [row for number, points in enumerate(design.own_campaigns()) for row in layers_at(run, f"p{number}", points, {})]
    random = [row for name, points, changes in random_layers() for row in layers_at(run, name, points, changes)]
    write_layers(run, own + random[:SEEN], [(number, row) for number, row in enumerate(random) if number >= SEEN])
    same = [
        [name, row["throw_number"], row["efficiency"], row["efficiency_half_width_statistics"]]
        for name, changes in SAME.items()
        for row in run.campaign(f"same-{name}", changes, {"trough.throw_number": [1.2, 1.8, 2.6]})
    ]
    run.write_table("same.csv", ["layer", "throw_number", "efficiency", "half_width"], same)


def write_layers(run: ValidationCase, own: list[list[object]], random: list[tuple[int, list[object]]]) -> None:
    """Writes the layers on which the surface rests, those without a mean speed, and those that judge, with what wider.py has simulated."""
    own = own + [row for _, row in wider_rows(is_random=False)]
    run.write_table("layers.csv", COLUMNS, [row for row in own if is_known(row)])
    run.write_table("apart.csv", COLUMNS, [row for row in own if not is_known(row)])
    random = random + wider_rows(is_random=True)
    run.write_table("held_out.csv", ["number", *COLUMNS], [[number, *row] for number, row in random if is_known(row)])


def wider_rows(is_random: bool) -> list[tuple[int, list[object]]]:
    """The simulated layers of the wider domain, as COLUMNS, with the numbers of the random ones in the order of their design."""
    order = [layer for _, columns in wider_random() for layer in layers_of(columns)]
    rows = [row for row in read_table(FOLDER / "wider.csv") if row["campaign"].startswith("random") == is_random]
    number = {layer: FIRST_WIDER + k for k, layer in enumerate(order)}
    return [(number.get(numbers_of(row["throw_number"], row["depth"]), -1), [row[column] for column in COLUMNS]) for row in rows]


def wider_random() -> list[tuple[str, design.Columns]]:
    return [(name, columns) for name, columns in design.wider_campaigns().items() if name.startswith("random")]


def numbers_of(throw_number: object, depth: object) -> tuple[float, float]:
    """What tells a layer from all others; ids differ from one version of the program to the next."""
    return round(float(str(throw_number)), 4), round(float(str(depth)), 4)


def layers_of(columns: design.Columns) -> list[tuple[float, float]]:
    return [numbers_of(*pair) for pair in zip(columns["throw_number"], columns["depth"], strict=True)]


def random_layers() -> list[tuple[str, Floats, dict[str, Any]]]:
    """The campaigns of the layers that judge: name, points of the unit cube, and what differs from base.toml."""
    found: list[tuple[str, Floats, dict[str, Any]]] = []
    deep = design.at_random(sum(DEEP_HELD_OUT.values()), design.DEEP, design.SEED + 3)
    shallow = design.at_random(sum(HELD_OUT.values()), design.SHALLOW)
    parts: list[tuple[dict[str, int], Floats, dict[str, Any]]] = [(HELD_OUT, shallow, PRECISE), (DEEP_HELD_OUT, deep, {})]
    for campaigns, points, changes in parts:
        chunks = np.split(points, np.cumsum(list(campaigns.values()))[:-1])
        found += [(name, chunk, changes) for name, chunk in zip(campaigns, chunks, strict=True)]
    return found


def predict_random(run: ValidationCase) -> list[dict[str, Any]]:
    """What the program predicts of each of the random layers, in the order of their numbers."""
    texts = [campaign_at(run, points, changes) for _, points, changes in random_layers()] + [campaign_of(run, columns, {}) for _, columns in wider_random()]
    return [answer for text in texts for answer in run.of_file("predict", text)]


def predict(run: ValidationCase) -> list[list[object]]:
    """Predictions of the random layers; rows of PREDICTED."""
    answers = predict_random(run)
    rows: list[list[object]] = []
    for row in run.table("held_out.csv"):
        answer = answers[int(row["number"])]
        if answer["efficiency"] is None:  # it climbs so steeply that the atlas says nothing
            continue
        rows.append([*(row[key] for key in PREDICTED[:-2]), f"{answer['efficiency']:.4f}", f"{answer['half_width']:.4f}"])
    return rows


def predict_loads(run: ValidationCase) -> list[list[object]]:
    """Predictions of what the random layers that were measured do to their trough; rows of PREDICTED_LOAD."""
    answers = predict_random(run)
    names = {"added_mass": "added_mass_fraction", "damping": "damping"}
    rows: list[list[object]] = []
    one: list[object]
    for row in (row for row in run.table("held_out.csv") if row["damping"] and float(row["tan_inclination"]) <= STEEPEST):
        answer, one = answers[int(row["number"])], [row["number"], row["throw_number"]]
        for name in LOADS:
            one += [row[name], row[f"{name}_half_width"], f"{answer[names[name]]:.4f}", f"{answer[f'{names[name]}_half_width']:.4f}"]
        rows.append(one)
    return rows


def judge_loads(run: ValidationCase) -> dict[str, object]:
    """How well the atlas predicts added mass and damping; scores by name."""
    run.follows("loads.csv", PREDICTED_LOAD, predict_loads(run))
    rows = run.table("loads.csv")
    scores: dict[str, object] = {"loads": len(rows)}
    for name in LOADS:
        value, width, atlas, atlas_width = (np.array([float(row[key]) for row in rows]) for key in PREDICTED_LOAD[2 + 4 * LOADS.index(name) :][:4])
        if run.control:
            atlas, atlas_width = np.roll(atlas, 1), np.roll(atlas_width, 1)
        held = int(np.sum(np.abs(value - atlas) <= np.hypot(width, atlas_width)))
        low, high = scipy.stats.binom.ppf([0.025, 0.975], len(rows), 0.95)
        run.between(f"{name.replace('_', ' ')} of layers within their intervals, of {len(rows)}", held, low, high, because="as for the efficiency")
        scores |= {f"{name}_held": held, f"{name}_rms": f"{math.sqrt(float(np.mean((value - atlas) ** 2))):.3f}", f"{name}_mean": f"{np.mean(value):.3f}"}
    added = np.array([float(row["added_mass"]) for row in rows])
    usual = int(np.sum((added >= MAKERS[0]) & (added <= MAKERS[1])))
    run.finding("NetterVibration: 10 to 25 % of the material's mass move with the trough", usual > len(rows) / 2, f"in {usual} of {len(rows)} layers; {added.min():.2f} to {added.max():.2f}")
    periods = [(float(row["throw_number"]), int(row["period"])) for table in ("layers.csv", "held_out.csv") for row in run.table(table) if row["period"]]
    doubled = [throw for throw, period in periods if period > 1]
    return {**scores, "usual": usual, "added_least": f"{added.min():.2f}", "added_most": f"{added.max():.2f}", "periods": len(periods), "doubled": len(doubled),
            "doubled_from": f"{min(doubled):.2f}", "beyond": sum(throw >= min(doubled) for throw, _ in periods)}  # fmt: skip


def judge(run: ValidationCase) -> None:
    for name in SAME:
        for row, plain in zip((r for r in run.table("same.csv") if r["layer"] == name), (r for r in run.table("same.csv") if r["layer"] == "plain"), strict=True):
            if name != "plain":
                width = float(row["half_width"]) + float(plain["half_width"])
                run.check(f"{name}, throw number {row['throw_number']}", float(row["efficiency"]), float(plain["efficiency"]), width,
                          because="the same layer without dimensions; intervals of both")
    run.follows("predicted.csv", PREDICTED, predict(run))
    judging = judging_layers(run)
    value = {key: np.array([float(row[key]) for row in judging]) for key in PREDICTED[2:]}
    if run.control:
        value |= {key: np.roll(value[key], 1) for key in ("atlas", "atlas_half_width")}
    error = np.abs(value["efficiency"] - value["atlas"])
    held = int(np.sum(error <= whole_of(value)))
    low, high = scipy.stats.binom.ppf([0.025, 0.975], len(judging), 0.95)
    run.between(f"layers within their intervals, of {len(judging)}", held, low, high, because="central 95 % of the binomial distribution; both intervals combined in squares")
    rms = {key: math.sqrt(float(np.mean((value["efficiency"] - value[key]) ** 2))) for key in ("atlas", "theory", "rolling_layer")}
    run.between("error of the atlas over that of the law (root mean squares)", rms["atlas"] / rms["rolling_layer"], 0, 1, because="else the layers have taught it nothing")
    for region, most in MOST.items():
        key, above, up_to = REGIONS[region]
        inside = np.array([above < float(row[key]) <= up_to and int(row["number"]) < FIRST_WIDER for row in judging])
        run.between(f"error of the atlas, {region} in the first domain, root mean square less the noise of the simulations", own_error(error[inside], value["half_width"][inside]), 0, most, because="what was wanted of the atlas")
    own = own_error(error, value["half_width"])
    feeders.judge(run)
    others = other_layers.judge(run) | judge_loads(run)
    if not run.control:
        scores = {"layers": len(run.table("layers.csv")), "judging": len(judging), "held": held, "least": f"{low:.0f}", "most": f"{high:.0f}", **{f"rms_{key}": f"{one:.3f}" for key, one in rms.items()}, "own": f"{own:.3f}", **others}
        by_region(run)
        run.follows("scores.csv", ["score", "value"], [[name, one] for name, one in scores.items()])


def judging_layers(run: ValidationCase) -> list[Row]:
    return [row for row in run.table("predicted.csv") if float(row["tan_inclination"]) <= STEEPEST]


def whole_of(value: dict[str, Any]) -> Any:
    """Half-widths of the difference between a layer and what the atlas says of it: both intervals, numerical errors of the layer included."""
    return np.sqrt(value["half_width"] ** 2 + value["numerical_error"] ** 2 + value["atlas_half_width"] ** 2)


def own_error(error: Any, half_width: Any) -> float:
    """Root mean square of errors, less the noise of the simulations, of which the 95 % half-widths are known."""
    return math.sqrt(max(0.0, float(np.mean(error**2) - np.mean((half_width / 1.96) ** 2))))


def by_region(run: ValidationCase) -> None:
    """How well each part of the domain is predicted, from all random layers."""
    every = run.table("predicted.csv")
    rows: list[list[object]] = []
    for region, (key, low, high) in REGIONS.items():
        of_region = [row for row in every if (float(row["tan_inclination"]) > STEEPEST) == (region == "steep climb")]
        inside = [row for row in of_region if low < float(row[key]) <= high]
        value = {name: np.array([float(row[name]) for row in inside]) for name in PREDICTED[5:]}
        held = int(np.sum(np.abs(value["efficiency"] - value["atlas"]) <= whole_of(value)))
        rms = [math.sqrt(float(np.mean((value["efficiency"] - value[model]) ** 2))) for model in ("atlas", "rolling_layer", "theory")]
        own = own_error(value["efficiency"] - value["atlas"], value["half_width"])
        rows.append([region, key, low, high, len(inside), held, *(f"{one:.3f}" for one in rms), f"{own:.3f}", f"{np.mean(value['atlas_half_width']):.3f}"])
    run.follows("regions.csv", ["region", "input", "above", "up_to", "layers", "held", "rms_atlas", "rms_rolling_layer", "rms_theory", "own_atlas", "half_width"], rows)


def draw(run: ValidationCase) -> None:
    rows = judging_layers(run)
    number = {key: np.array([float(row[key]) for row in rows]) for key in ("efficiency", "half_width", "atlas", "atlas_half_width", "theory")}
    figure, axes = style.new_figure(layout="constrained")
    axes.plot([-0.2, 1.2], [-0.2, 1.2], color=style.GREY, linewidth=0.8)
    axes.plot(number["theory"], number["efficiency"], "o", mfc="none", color=style.GREY, label="point mass")
    for (region, (key, low, high)), colour in zip(list(REGIONS.items())[:4], style.COLOURS, strict=False):
        here = np.array([low < float(row[key]) <= high for row in rows])
        part = {name: values[here] for name, values in number.items()}
        axes.errorbar(part["atlas"], part["efficiency"], part["half_width"], part["atlas_half_width"], fmt="o", markersize=4, linewidth=0.8, color=colour, label=f"atlas, {region}")
    axes.set(xlabel="velocity efficiency, predicted", ylabel="velocity efficiency, simulated")
    axes.legend(fontsize=8)
    style.plain_axes(axes)
    figure.savefig(run.figure("atlas.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    judge(run)
    if not run.control:
        draw(run)
    run.finish()


if __name__ == "__main__":
    main()
