#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402

import regions  # noqa: E402
import sources  # noqa: E402
from validation_case import ValidationCase, read_table  # noqa: E402

INPUTS = ["throw_number", "tan_vibration_angle", "tan_inclination", "friction"]
FITTED = ("why_theory_fails", "4 deep, free")  # the six layers to which the law was fitted
LAYERS = ["source", "group", "grains", "throw_number", "tan_vibration_angle", "tan_inclination", "friction", "rolling_friction", "depth",
          "efficiency", "half_width", "point_mass", "rolling_layer", "judges"]
POINT_MASS, LAW = "point mass", "rolling layer"
OTHER = {POINT_MASS: LAW, LAW: POINT_MASS}


def solved(run: ValidationCase, layers: list[sources.Layer]) -> list[dict[str, object]]:
    """Each layer beside both models. `judges` is the model whose error it tells, if any."""
    points = [[getattr(layer, name) for name in INPUTS] for layer in layers]
    point_mass = run.efficiencies(INPUTS, points)
    law = np.empty(len(layers))
    for resistance in {layer.rolling_friction for layer in layers}:  # which adds to the dry torque
        chosen = [i for i, layer in enumerate(layers) if layer.rolling_friction == resistance]
        law[chosen] = run.efficiencies(INPUTS, [points[i] for i in chosen], ["--rolling-layer", f"dry_torque={0.02 + resistance!r}", "--accept-untested"])
    rows = []
    for layer, eta, eta_law in zip(layers, point_mass, law):
        fitted = (layer.source, layer.group) == FITTED
        judges = LAW if layer.rolls() and not fitted else POINT_MASS if layer.does_not_roll() else ""
        rows.append(vars(layer) | {"point_mass": eta, "rolling_layer": eta_law, "judges": judges})
    return rows


def misses(rows: list[dict[str, object]], model: str, judged_by: str) -> list[regions.Miss]:
    """The errors of a model for the layers that tell those of `judged_by`, which is another model in the negative control only."""
    column = {POINT_MASS: "point_mass", LAW: "rolling_layer"}[model]
    return [regions.Miss(str(row["source"]), float(row["throw_number"]), float(row["tan_inclination"]), float(row["depth"]),  # type: ignore[arg-type]
                         float(row["efficiency"]) - float(row[column])) for row in rows if row["judges"] == judged_by]  # type: ignore[arg-type]


def judge_others(run: ValidationCase, model: str, all_misses: list[regions.Miss], judged: list[regions.Miss]) -> None:
    """The errors of all other studies must hold for the layers of each."""
    held = count = 0
    for source in sorted({miss.source for miss in judged}):
        others = regions.errors([miss for miss in all_misses if miss.source != source])
        for miss in judged:
            known = regions.at(others, miss) if miss.source == source else None
            if known is None:
                continue
            count += 1
            held += abs(miss.error) <= 1.96 * known.sd
    run.between(f"{model}: share of layers that the interval from all other studies holds", held / count, 0.85, 1.0,
                f"a normal error gives 0.95; {count} layers, of few studies, that resemble each other")


def stored_is_fresh(run: ValidationCase, rows: list[dict[str, object]]) -> None:
    """The stored table is what the stored layers give now."""
    if run.output.resolve() == FOLDER or run.control:
        return
    stored = read_table(FOLDER / "layers.csv")
    run.between("layers in the stored table, less those in the tables it is made of", len(stored) - len(rows), 0, 0)
    largest = max(abs(float(old[name]) - float(new[name])) for old, new in zip(stored, rows)  # type: ignore[arg-type]
                  for name in ("efficiency", "point_mass", "rolling_layer"))
    run.between("largest difference of the stored table from them", largest, 0, 1e-5, "six digits are stored")


def main() -> None:
    run = ValidationCase(FOLDER)
    rows = solved(run, sources.all_layers())
    run.write_table("layers.csv", LAYERS, [[f"{row[name]:.6g}" if isinstance(row[name], float) else row[name] for name in LAYERS] for row in rows])
    table = []
    for model in (POINT_MASS, LAW):
        all_misses = misses(rows, model, model)
        table += [[model, *error.cells()] for error in regions.errors(all_misses)]
        judge_others(run, model, all_misses, misses(rows, model, OTHER[model]) if run.control else all_misses)
    run.write_table("errors.csv", ["model", *regions.COLUMNS], table)
    stored_is_fresh(run, rows)
    run.finish()


if __name__ == "__main__":
    main()
