"""Writes the page of one screen about a design or a calibration: one HTML file that needs no network and no other file.

    python3 -m vibrotrough.report.decision DATA.json --output FILE.html

DATA.json is what `vibrotrough design --page`, `theory calibrate --page` and `calibrate --page` hand over. The texts are escaped
by the template (decision.html).
"""

import argparse
import io
import json
import pathlib
import sys
from typing import Any

import jinja2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..figures.corner import draw_one, label
from ..figures.drawn import drawing_of, read_note, write_file
from ..figures.style import COLOURS, DASHES, GREY, MARKERS, Problem, new_figure, plain, plain_axes
from .page import inline_svg

Data = dict[str, Any]
Page = dict[str, Any]

DEGREE = "\u00b0"
NOT_KNOWN = "not known"
RULES = {"v = 3.81 N S, of which 70 to 80 % are used in practice": "v = 3.81 N S; 70 to 80 % of it in practice",
         "no slip, flight of n cycles: v = g n^2 cot(beta) / (2 f)": "no slip: v = g n\u00b2 cot \u03b2 / (2 f)"}


def svg_of(figure: Figure, title: str) -> Any:
    content = io.BytesIO()
    figure.savefig(content, format="svg", metadata={"Date": None})
    return inline_svg(drawing_of(content.getvalue()), 1, title)


def allowed(ends: list[float], unit: str) -> str:
    """What a quantity of the machine may be."""
    low, high = ends
    if low == high:
        return "fixed"
    return f"allowed {low:.3g} to {high:.4g}{'' if unit == DEGREE else ' '}{unit}"


def draw_budget(axes: Axes, model: Data) -> None:
    """What each uncertain input leaves open of the mass flow: a tornado, whose names stand above its bars."""
    plain_axes(axes)
    for place, share in enumerate(reversed(model["budget"])):
        axes.barh(place, 2 * share["sd_t_per_h"], left=-share["sd_t_per_h"], height=0.32, color=COLOURS[0])
        axes.text(0, place + 0.22, share["source"], ha="center", va="bottom", fontsize=7)
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.set_ylim(-0.4, len(model["budget"]) - 0.3)
    axes.set_xlabel("mass flow \u00b1 one standard deviation,\neach alone  [t/h]")


def least_sure(data: Data) -> Data:
    """The model with the lowest probability, whose budget is shown."""
    model: Data = min(data["models"], key=lambda one: one["probability"])
    return model


def draw_flow(data: Data) -> Any:
    """The probability of each mass flow or more, by each model, and what leaves it open; nothing where it is not known."""
    if data["untested"] is not None:
        return ""
    model = least_sure(data)
    if model["budget"]:
        figure, (axes, beside) = new_figure(1, 2, size=(7.0, 2.7), gridspec_kw={"width_ratios": [1.35, 1]})
        draw_budget(beside, model)
    else:
        figure, axes = new_figure(size=(7.0, 2.7))
    plain_axes(axes)
    probability = 1 - np.array(data["quantile_shares"])
    known = [model for model in [*data["models"], *data["models_beside"]] if model["mass_flow_quantiles_t_per_h"]]
    for number, model in enumerate(known):
        axes.plot(model["mass_flow_quantiles_t_per_h"], 100 * probability, DASHES[number % len(DASHES)],
                  color=COLOURS[number % len(COLOURS)], linewidth=2, label=model["model"])
    wanted = data["mass_flow_wanted_t_per_h"]
    axes.axvline(wanted, color=GREY, linewidth=1)
    axes.annotate(f"asked: {wanted:.4g} t/h", (wanted, 1), xytext=(4, 2), textcoords="offset points", fontsize=9, color=GREY)
    axes.axhline(100 * data["confidence"], color=GREY, linewidth=1, linestyle=":")
    axes.set_ylim(0, 100)
    axes.set_xlabel("mass flow  [t/h]")
    axes.set_ylabel("probability of so much\nor more  [%]")
    axes.legend(frameon=False, loc="upper right", bbox_to_anchor=(1.0, 0.94))
    figure.tight_layout()
    return svg_of(figure, "Probability of a mass flow or more, and what leaves it open")


def number(value: float | None) -> str:
    return NOT_KNOWN if value is None else f"{value:.3g}"


Rows = list[tuple[str, str, str]]


def digits(value: float, count: int) -> str:
    """A number with so many digits, without an exponent."""
    return f"{float(f'{value:.{count}g}'):,.15g}".replace(",", "\u2009")


def spring_rows(springs: Data | None) -> Rows:
    if springs is None:
        return []
    return [("springs", f"sag {springs['sag_mm']:.0f} mm",
             f"natural frequency {springs['natural_frequency_empty_hz']:.3g} Hz empty, {springs['natural_frequency_loaded_hz']:.3g} Hz loaded"),
            ("on the building", f"{digits(springs['force_on_building_n'], 2)} N",
             f"amplitude of the force, isolation {100 * springs['isolation']:.0f} %"),
            ("at the resonance", f"{springs['stroke_ratio_at_stop']:.2g} \u00d7 the stroke",
             f"running out in 10 s, {springs['stroke_ratio_at_start']:.2g} \u00d7 at a start, undamped")]


def exciter_rows(exciter: Data | None) -> Rows:
    """What moves the trough."""
    if exciter is None:
        return []
    motors = exciter["motors"]
    return [("moving mass", f"{digits(exciter['moving_mass_kg'], 3)} kg",
             f"{digits(exciter['trough_mass_kg'], 3)} kg of the trough and {100 * exciter['added_mass_fraction']:.2g} % of {digits(exciter['material_kg'], 3)} kg of material"),
            ("exciter", f"{1e3 * exciter['static_moment_kg_m']:.4g} kg mm",
             f"static moment, {1e-3 * exciter['centrifugal_force_n']:.3g} kN; stroke {exciter['stroke_empty_mm']:.1f} mm when empty"),
            *([] if motors is None else [
                ("motors", motors["text"], f"{motors['rpm']:.4g} 1/min, {1e3 * motors['static_moment_kg_m']:.3g} kg mm and {1e-3 * motors['power_w']:.2g} kW each"
                 + (", by a converter" if motors["frequency_converter"] else ""))]),
            *spring_rows(exciter["springs"])]


def asked_rows(data: Data, task: Data) -> Rows:
    surge = f" in a surge of {task['surge']:g} times {data['mass_flow_wanted_t_per_h'] / task['surge']:.4g} t/h" if task["surge"] > 1 else ""
    friction = f"friction {data['friction_median']:.3g}" + (
        f" ({data['friction_low']:.3g} to {data['friction_high']:.3g})" if data["friction_low"] < data["friction_high"] else ", taken as exact")
    size, rolling = task["grain_diameter_mm"], task["rolling_friction"]
    return [
        *([("project", data["project"], f"revision {data['revision']}" if data["revision"] else "")] if data.get("project") or data.get("revision") else []),
        ("mass flow", f"{data['mass_flow_wanted_t_per_h']:.4g} t/h", f"with {100 * data['confidence']:.4g} %{surge}; {data['objective'].replace('-', ' ')}"),
        ("trough", f"{1e3 * task['width_m']:.4g} mm wide", f"{task['length_m']:.4g} m long" if task["length_m"] else ""),
        *([("drive", task["drive"], "its usual limits")] if task["drive"] else []),
        ("material", f"{task['bulk_density_kg_per_m3']:.4g} kg/m\u00b3", "; ".join(part for part in (task["material"], friction) if part)),
        ("grains", NOT_KNOWN if size is None else f"{size:.3g} mm", "rolling friction " + (NOT_KNOWN if rolling is None else f"{rolling:.3g}")),
    ]


def row_of_model(model: Data, name: str) -> list[str]:
    is_known = model["probability"] is not None
    return [name, f"{model['median_speed_m_per_s']:.3g}", number(model["sure_speed_m_per_s"]), f"{model['mass_flow_t_per_h']:.3g}",
            f"{model['mass_flow_low_t_per_h']:.3g} to {model['mass_flow_high_t_per_h']:.3g}" if is_known else NOT_KNOWN,
            f"{100 * model['probability']:.1f} %" if is_known else NOT_KNOWN]


def design_page(data: Data) -> Page:
    task = data["task"]
    power = f"{digits(data['power_w'], 3)} W" if "power_w" in data else f"{digits(data['power_w_per_m'], 3)} W/m"
    landing = task["max_landing_speed_m_per_s"]
    frictions = [f"{data[key]:.3g}" for key in ("friction_low", "friction_high")]
    machine = [
        ("stroke", f"{data['stroke_mm']:.4g} mm", f"amplitude {data['stroke_mm'] / 2:.4g} mm; {allowed(task['stroke_mm'], 'mm')}"),
        ("speed of the drive", f"{data['rpm']:.4g} 1/min", f"{data['frequency_hz']:.4g} Hz; {allowed(task['rpm'], '1/min')}"),
        ("vibration angle", f"{data['vibration_angle_deg']:.4g}\u00b0", f"{allowed(task['vibration_angle_deg'], DEGREE)}"),
        ("inclination", f"{data['inclination_deg']:.4g}\u00b0", f"uphill positive; {allowed(task['inclination_deg'], DEGREE)}"),
        ("layer depth", f"{data['layer_depth_mm']:.1f} mm",
         f"{data['depth_in_operation_mm']:.0f} mm at the nominal flow; {allowed([1e3 * depth for depth in task['depth_m']], 'mm')}"),
        ("side walls", f"{data['side_wall_mm']:.0f} mm", "or higher, as usual"),
        ("throw number \u0393", f"{data['throw_number']:.3g}", f"at most {task['max_throw_number']:.4g}"),
        ("machine number K", f"{data['machine_number']:.3g}", f"at most {task['max_machine_number']:.4g}"),
        ("landing speed", f"{data['landing_speed_m_per_s']:.3g} m/s",
         (f"at most {landing:.4g} m/s, " if landing is not None else "") + ("for a friction of " if len(set(frictions)) == 1 else "for frictions of ") + " to ".join(dict.fromkeys(frictions))),
        ("power", power, "given to the material (point mass)"),
        *([("time on trough", f"{data['time_on_trough_s']:.3g} s", f"at most, with {100 * data['confidence']:.4g} %")] if data["time_on_trough_s"] else []),
        ("held back by", "", ", ".join(data["active_limits"]).replace("<=", "\u2264").replace(">=", "\u2265") or "nothing"),
    ]
    sure = f"{100 * data['confidence']:.4g} %"
    models = [row_of_model(model, model["model"]) for model in data["models"]]
    models += [row_of_model(model, f"{model['model']} (for comparison)") for model in data["models_beside"]]
    rules = [[f"{RULES.get(rule['rule'], rule['rule'])} ({rule['source']})", f"{rule['speed_m_per_s']:.3g}" if rule["speed_m_per_s"] else "no throw",
              f"{rule['low_m_per_s']:.3g} to {rule['high_m_per_s']:.3g}" if rule["low_m_per_s"] else ""]
             for rule in data["rules_of_thumb"]]
    return {
        "title": f"Design of a vibrating trough{': ' + data['project'] if data.get('project') else ''}",
        "good": data["feasible"],
        "conclusion": [data["sentence"],
                       f"Stroke {data['stroke_mm']:.4g} mm, {data['rpm']:.4g} 1/min, {data['vibration_angle_deg']:.4g}\u00b0, layer {data['layer_depth_mm']:.1f} mm deep.",
                       *([data["verification"]] if "verification" in data else [])],
        "facts": [{"heading": heading, "rows": rows} for heading, rows in (
            ("The machine", machine), ("What moves it", exciter_rows(data["exciter"])), ("What was asked", asked_rows(data, task))) if rows],
        "svg": draw_flow(data),
        "caption": "" if data["untested"] is not None else
                   "Probability of a mass flow or more at this layer depth; dotted: the confidence asked. "
                   f"Right: what to measure first, by {least_sure(data)['model']}.",
        "tables": [
            {"heading": "What each model says",
             "headings": ["", "speed, m/s", f"with {sure}, m/s", "mass flow, t/h", "95 % interval, t/h", "reaches what was asked"], "rows": models},
            {"heading": "Rules of thumb, for comparison", "headings": ["rule", "m/s", "in practice, m/s"], "rows": rules}],
        "warnings": data["warnings"],
        "basis": "The friction has a distribution, what else is not exact counts as normal, and each model misses the truth by its discrepancy. Every limit is kept by the machine as it is printed, "
                 "the landing speed at every friction in the central 99.7 % of its distribution.",
        "command": "by vibrotrough design",
        "signed": ["Checked by", "Date", "Signature"],
    }


def draw_speeds(axes: Axes, measurements: list[Data]) -> None:
    places = np.arange(len(measurements))
    column = {key: np.array([one[key] for one in measurements]) for key in (
        "speed_m_per_s", "uncertainty_m_per_s", "model_m_per_s", "model_low_m_per_s", "model_high_m_per_s")}
    axes.errorbar(places - 0.08, column["speed_m_per_s"], yerr=1.96 * column["uncertainty_m_per_s"], fmt=MARKERS[0], color=COLOURS[1],
                  markersize=5, capsize=3, label="measured")
    middle = column["model_m_per_s"]
    below, above = (np.maximum(0, part) for part in (middle - column["model_low_m_per_s"], column["model_high_m_per_s"] - middle))
    axes.errorbar(places + 0.08, middle, yerr=[below, above], fmt=MARKERS[1], color=COLOURS[0], markersize=5, capsize=3, label="model")
    axes.set_xticks(places)
    axes.set_xticklabels([f"{2e3 * one['amplitude_m']:.3g} mm\n{60 * one['frequency_hz']:.4g} 1/min" for one in measurements], fontsize=7)
    axes.set_xlim(-0.5, len(measurements) - 0.5)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("speed  [m/s], 95 % intervals")
    axes.legend(frameon=False, fontsize=8)


def draw_calibration(data: Data, quantities: list[Data]) -> Any:
    count = len(quantities)
    figure, grid = new_figure(1, count + 1, size=(max(7.0, 2.3 * count + 3.6), 3.3), squeeze=False,
                              gridspec_kw={"width_ratios": [1] * count + [1.6]})
    for axes, quantity in zip(grid[0], quantities):
        plain_axes(axes)
        draw_one(axes, np.array(data["draws"][quantity["name"]]), quantity)
        axes.set_xlabel(plain(label(quantity)), fontsize=9)
        axes.tick_params(labelsize=7)
    plain_axes(grid[0][-1])
    draw_speeds(grid[0][-1], data["measurements"])
    figure.tight_layout()
    return svg_of(figure, "Distributions of the quantities, and measured speeds beside the model")


def calibration_page(data: Data) -> Page:
    quantities = list(data["parameters"]) + ([data["model_discrepancy"]] if data["model_discrepancy"] is not None else [])
    found = [(plain(one["name"]), f"{one['median']:.3g}" + ("" if one["unit"] == "1" else f" {one['unit']}"),
              f"{one['low']:.3g} to {one['high']:.3g} (95 %); " + (f"narrowed by {100 * (1 - one['remaining']):.0f} %" if one["identifiable"] else "not identifiable"))
             for one in quantities]
    fit = data["best_fit"]
    trust = [
        ("chains", "converged" if data["converged"] else "not converged",
         f"R-hat up to {max(one['rhat'] for one in quantities):.3f}, effective sample size from {min(one['ess'] for one in quantities):.0f}"),
        ("best fit of an exact model", f"\u03c7\u00b2 = {fit['chi_square']:.3g}",
         f"{fit['degrees_of_freedom']} degrees of freedom, p = {fit['p_value']:.2g}" if fit["degrees_of_freedom"] > 0 else "too few speeds to judge it"),
    ]
    rows = [[one["line"], f"{2e3 * one['amplitude_m']:.4g}", f"{60 * one['frequency_hz']:.5g}", f"{one['speed_m_per_s']:.4g} \u00b1 {one['uncertainty_m_per_s']:.2g}",
             f"{one['model_m_per_s']:.4g}", f"{one['model_low_m_per_s']:.4g} to {one['model_high_m_per_s']:.4g}", f"{one['misfit']:+.1f}"]
            for one in data["measurements"]]
    explained = fit["degrees_of_freedom"] <= 0 or fit["p_value"] >= 0.01
    return {
        "title": f"Calibration of {data['model']}",
        "good": data["converged"] and explained,
        "conclusion": data["verdict"],
        "facts": [{"heading": "What the speeds say", "rows": found}, {"heading": "How far it can be trusted", "rows": trust}],
        "svg": draw_calibration(data, quantities),
        "caption": "Distribution of each quantity (solid: median, dashed: 95 % interval), and the measured speeds beside the calibrated model.",
        "tables": [{"heading": "Measurements",
                    "headings": ["line", "stroke, mm", "1/min", "measured, m/s", "model, m/s", "95 % interval, m/s", "misfit, in \u00b1"], "rows": rows}],
        "warnings": [],
        "basis": "\u00b1 is one standard uncertainty. The model discrepancy is the standard deviation of what the model misses from setting to setting, in velocity efficiency; "
                 "it is estimated with the rest.",
        "signed": [],
        "command": "by vibrotrough " + ("theory calibrate" if data["model"] == "the point mass" else "calibrate"),
    }


PAGES = {"design": design_page, "calibration": calibration_page}


def render(data: Data) -> str:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(pathlib.Path(__file__).resolve().parent), autoescape=True, trim_blocks=True, lstrip_blocks=True,
        undefined=jinja2.StrictUndefined)
    return environment.get_template("decision.html").render(made=data["made"], **PAGES[data["kind"]](data))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    page = render(json.loads(read_note(options.data)))
    try:
        write_file(options.output, page.encode())
    except OSError as error:
        raise Problem(f"cannot write {options.output} ({error.strerror}); choose another --page") from error


if __name__ == "__main__":
    try:
        main()
    except Problem as problem:
        sys.exit(f"vibrotrough: {problem}")
