#!/usr/bin/python3
import math
import pathlib
import sys
import tomllib

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import costs  # noqa: E402
import numpy as np  # noqa: E402

from campaign_program import Row, campaign_text, run_campaign  # noqa: E402
from vibrotrough.figures.style import COLOURS, MARKERS, plain_axes, plt  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

SETS = 100  # synthetic data sets of each kind
THROW_NUMBERS = [0.7, 1.1, 1.5, 1.9, 2.3, 2.7]
AMPLITUDE, ANGLE, UNCERTAINTY, GRAVITY = 3e-3, 30.0, 0.005, 9.81
KINDS = {"exact theory": 0.0, "theory wrong by 0.05": 0.05}
CALIBRATIONS = ["kind", "options", "friction", "low", "high"]

# The domains of two surfaces over the tiny layer of base.toml.
DOMAINS = {
    "rolling": {"trough.throw_number": (1.0, 3.0), "grains.rolling_friction": (0.0, 0.3)},
    "angle": {"trough.throw_number": (1.0, 3.0), "trough.tan_vibration_angle": (0.25, 1.0)},
}
DESIGN, HELD_OUT = 24, 60  # simulated points of each domain: that make the surface, and that it does not see
INPUTS = ["throw_number", "tan_vibration_angle", "rolling_friction"]
POINTS = ["domain", *INPUTS, "efficiency", "half_width", "theory", "outcome"]
PREDICTIONS = ["surface", *POINTS, "predicted", "predicted_half_width"]
SOBOL, LEARNT = f"{DESIGN} Sobol points", f"learnt to +-{costs.GOAL}"  # surfaces; the latter from several starts
STEADY = ("finished", "not-precise")


def data_set(run: ValidationCase, friction: float, discrepancy: float, random: np.random.Generator) -> str:
    """speeds.csv of six settings of a machine: the theory's speeds with an error of the theory and of the measurement."""
    columns = ["throw_number", "vibration_angle_deg", "friction"]
    etas = run.efficiencies(columns, [(gamma, ANGLE, friction) for gamma in THROW_NUMBERS])
    lines = ["amplitude_mm,frequency_hz,vibration_angle_deg,speed_m_per_s,uncertainty_m_per_s"]
    for gamma, eta in zip(THROW_NUMBERS, etas):
        omega = math.sqrt(gamma * GRAVITY / (AMPLITUDE * math.sin(math.radians(ANGLE))))
        trough = omega * AMPLITUDE * math.cos(math.radians(ANGLE))
        speed = (eta + discrepancy * random.standard_normal()) * trough + UNCERTAINTY * random.standard_normal()
        lines.append(f"{1e3 * AMPLITUDE},{omega / (2 * math.pi)!r},{ANGLE},{speed!r},{UNCERTAINTY}")
    return "\n".join(lines) + "\n"


def calibrate_many(run: ValidationCase) -> None:
    """Calibrates synthetic data sets with the program, with and without model discrepancy. The errors of the theory are independent, so that
    those of layers, which it shares from setting to setting, are left out."""
    rows = []
    run.runs.mkdir(parents=True, exist_ok=True)
    for kind, discrepancy in KINDS.items():
        random = np.random.default_rng(20261122)
        for _ in range(5 if run.quick else SETS):
            friction = random.uniform(0.1, 0.9)
            path = run.runs / "speeds.csv"
            path.write_text(data_set(run, friction, discrepancy, random), encoding="utf-8")
            for options in ((), ("--without-discrepancy",)):
                answer = run.json("calibrate", path, "--free", "friction", "--common-error", "0", *options)["parameters"][0]
                rows.append([kind, " ".join(options), friction, answer["low"], answer["high"]])
    run.write_table("calibrations.csv", CALIBRATIONS, rows)


def rows_of(domain: str, folder: pathlib.Path, answers: list[Row]) -> list[list[object]]:
    """Rows of POINTS from those of `compare`, without bistable and unsteady cases."""
    table: list[list[object]] = []
    for row in answers:
        if row["outcome"] not in STEADY or not row["efficiency"]:
            continue
        frozen = tomllib.loads((folder / "cases" / row["case"] / "scenario.toml").read_text(encoding="utf-8"))
        trough, grains = frozen["trough"], frozen["grains"]
        table.append([domain, trough["throw_number"], trough["tan_vibration_angle"], grains["rolling_friction"], row["efficiency"],
                      row["efficiency_half_width_statistics"], row["efficiency_theory"], row["outcome"]])
    return table


def simulate(run: ValidationCase, domain: str, name: str, count: int, seed: int) -> list[list[object]]:
    """Simulates points that fill a domain; rows of POINTS."""
    folder = run.runs / f"{domain}-{name}"
    text = campaign_text(run.sections(), {"campaign.name": f"{domain}-{name}"}, {}).replace("[sweep]\n", "")
    text += f'[sample]\nmethod = "sobol"\ncount = {count}\nseed = {seed}\n'
    text += "".join(f'"{key}" = {{ from = {low}, to = {high} }}\n' for key, (low, high) in DOMAINS[domain].items())
    return rows_of(domain, folder, run_campaign(run.program, folder, text, run.jobs))


def predict_held_out(run: ValidationCase) -> None:
    """Simulates design and held-out points, learns surfaces, and asks both surfaces for the held-out points."""
    design, held_out = [], []
    for domain, keys in DOMAINS.items():
        design += simulate(run, domain, "design", 4 if run.quick else DESIGN, 1)
        rows = simulate(run, domain, "held-out", 2 if run.quick else HELD_OUT, 11)
        names = [POINTS.index(key.split(".")[1]) for key in keys]
        places = np.array([[row[name] for name in names] for row in rows], dtype=float)
        surfaces = {SOBOL: run.runs / f"{domain}-design"}
        for seed in range(1, 1 if run.quick else costs.STARTS + 1):
            surfaces[f"{LEARNT}, start {seed}"] = costs.learn(run, domain, keys, seed)
        for surface, folder in surfaces.items():
            held_out += [[surface, *row, *found] for row, found in zip(rows, costs.predict(run, folder, keys, places))]
    run.write_table("design.csv", POINTS, design)
    run.write_table("held_out.csv", PREDICTIONS, held_out)
    if not run.quick:
        costs.measure_costs(run, DOMAINS)


def band(count: int) -> tuple[int, int]:
    """The central 95 % of the number of intervals among `count` that hold the truth."""
    share = np.cumsum([math.comb(count, k) * 0.95**k * 0.05**(count - k) for k in range(count + 1)])
    return int(np.searchsorted(share, 0.025)), int(np.searchsorted(share, 0.975))


def judge_calibrations(run: ValidationCase) -> None:
    """In how many data sets the interval of the friction holds the true one."""
    options = "--without-discrepancy" if run.control else ""
    for kind in KINDS:
        rows = [row for row in run.table("calibrations.csv") if row["kind"] == kind and row["options"] == options]
        covered = sum(float(row["low"]) <= float(row["friction"]) <= float(row["high"]) for row in rows)
        run.between(f"{kind}: data sets of {len(rows)} whose interval holds the true friction", covered, 90, 99,
                    because="95 % intervals; the issue's band, 97 % of the binomial distribution")


def judge_surface(run: ValidationCase) -> list[Row]:
    """How often the surfaces' intervals hold the held-out points; in the control, each point beside the next one's prediction."""
    rows = run.table("held_out.csv")
    shares = []  # of the learnt surfaces
    for surface, domain in dict.fromkeys((row["surface"], row["domain"]) for row in rows):
        mine = [row for row in rows if (row["surface"], row["domain"]) == (surface, domain)]
        number = {key: np.array([float(row[key]) for row in mine]) for key in (*POINTS[4:7], *PREDICTIONS[-2:])}
        predicted, half_width = (np.roll(number[key], int(run.control)) for key in PREDICTIONS[-2:])
        error = number["efficiency"] - predicted
        inside = int(np.sum(np.abs(error) <= np.hypot(half_width, number["half_width"])))
        rms, theory = (math.sqrt(float(np.mean(np.square(values)))) for values in (error, number["efficiency"] - number["theory"]))
        run.finding(f"{domain}, {surface}: it predicts better than the theory alone", rms < theory,
                    f"root mean square error {rms:.3f} against {theory:.3f}; {inside} of {len(mine)} points of {HELD_OUT} wanted within the interval")
        if surface == SOBOL:
            low, high = band(len(mine))
            run.between(f"{domain}, {surface}: held-out points of {len(mine)} within the predicted interval", inside, low, high,
                        because="central 95 % of the binomial distribution at 95 %; both intervals are combined in squares")
        else:
            shares.append(100 * inside / len(mine))
    if shares:
        run.between(f"mean of {len(shares)} learnt surfaces: % of held-out points within the predicted interval", float(np.mean(shares)), 90, 99,
                    because="the band of the issue; errors of one surface at neighbouring places are alike, so that several count together")
    return rows


def judge_costs(run: ValidationCase) -> None:
    """Whether learning takes a third of the cases of the alternatives; findings, since the answer belongs to these layers."""
    rows = run.table("costs.csv")
    for domain in DOMAINS:
        mine = {row["method"]: row for row in rows if row["domain"] == domain}
        learnt = [int(row["cases"]) for method, row in mine.items() if method.startswith("learnt")]
        for method in ("Sobol without trend", "grid"):
            cases, reached = int(mine[method]["cases"]), float(mine[method]["largest_half_width"]) <= costs.GOAL
            share = float(np.mean(learnt)) / cases
            run.finding(f"{domain}, +-{costs.GOAL}: learning takes at most a third of a {method}", reached and share <= 1 / 3,
                        f"{100 * share:.0f} % of the cases: {', '.join(map(str, learnt))} from {len(learnt)} starts, and "
                        f"{'' if reached else 'more than '}{cases}")  # fmt: skip


def draw(run: ValidationCase, rows: list[Row]) -> None:
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    plain_axes(left)
    options = "--without-discrepancy" if run.control else ""
    calibrations = [row for row in run.table("calibrations.csv") if row["options"] == options]
    for number, kind in enumerate(KINDS):
        mine = sorted((float(row["friction"]), float(row["low"]), float(row["high"])) for row in calibrations if row["kind"] == kind)
        friction, low, high = np.array(mine).T
        left.errorbar(friction + 0.002 * number, (low + high) / 2, yerr=(high - low) / 2, fmt="none", ecolor=COLOURS[number],
                      elinewidth=1, label=kind)
    left.plot([0.1, 0.9], [0.1, 0.9], color="black", linewidth=0.8)
    left.set_xlabel("true friction  [-]")
    left.set_ylabel("95 % interval of the calibration  [-]")
    left.legend(loc="upper left")
    plain_axes(right)
    for number, (prefix, label) in enumerate([(SOBOL, f"surface of {SOBOL}"), (LEARNT, f"surfaces {LEARNT}")]):
        points = [row for row in rows if row["surface"].startswith(prefix)]
        values = [np.array([float(row[key]) for row in points]) for key in ("efficiency", "half_width", *PREDICTIONS[-2:])]
        right.errorbar(values[0], values[2], xerr=values[1], yerr=values[3], fmt=MARKERS[number], color=COLOURS[2 * number],
                       markersize=3, elinewidth=0.6, label=label, zorder=3 - number)
    points = [row for row in rows if row["surface"] == SOBOL]
    right.plot([float(row["efficiency"]) for row in points], [float(row["theory"]) for row in points], MARKERS[2], color=COLOURS[1],
               markersize=4, label="theory alone")
    right.plot([0, 1], [0, 1], color="black", linewidth=0.8)
    right.set_xlabel("velocity efficiency of held-out simulations  [-]")
    right.set_ylabel("predicted  [-]")
    right.legend()
    figure.savefig(run.figure("coverage.png"), dpi=100)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        calibrate_many(run)
        predict_held_out(run)
    judge_calibrations(run)
    draw(run, judge_surface(run))
    judge_costs(run)
    run.finish()


if __name__ == "__main__":
    main()
