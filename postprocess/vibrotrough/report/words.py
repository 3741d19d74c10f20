"""The conclusion of a campaign in words, for the top of its report. Every number is a column of `vibrotrough compare`."""

from typing import Any

from ..figures.style import plain

Case = dict[str, Any]

# Columns of the mass flow and of its half-width, the whole trough's first.
FLOWS = (
    ("mass_flow_t_per_h", "mass_flow_half_width_t_per_h", "t/h"),
    ("mass_flow_per_width_t_per_h_m", "mass_flow_per_width_half_width_t_per_h_m", "t/h per metre of width"),
)


def place_of(case: Case) -> str:
    """ "at throw number 2, grains.friction 0.5", or the case's id when nothing is swept."""
    label = case.get("label")
    return f"at {plain(label)}" if label else f"in case {case['case']}"


def interval(mean: float, half_width: float | None, unit: str, digits: int = 3) -> str:
    shown = f"{mean:.{digits}f}"
    return f"{shown} {unit}" if half_width is None else f"{shown} \u00b1 {half_width:.{digits}f} {unit}"


def outcomes(cases: list[Case]) -> str:
    finished = sum(case["outcome"] == "finished" for case in cases)
    if not cases:
        return "This campaign has no cases."
    if finished == len(cases):
        many = "The only case is finished" if finished == 1 else f"All {finished} cases are finished"
        return f"{many}: the intervals are as narrow as the campaign file asks."
    counts: dict[str, int] = {}
    for case in cases:
        if case["outcome"] != "finished":
            counts[case["outcome"]] = counts.get(case["outcome"], 0) + 1
    others = ", ".join(f"{count} {name}" for name, count in counts.items())
    return f"{finished} of {len(cases)} cases are finished; the others are: {others}."


def mass_flow(case: Case) -> str:
    """The mass flow in t/h of the trough, or of a metre of its width; empty when it is not known."""
    for name, error, unit in FLOWS:
        if case.get(name) is None:
            continue
        half_width = case.get(error)
        return f"{case[name]:.3g}" + ("" if half_width is None else f" \u00b1 {half_width:.2g}") + f" {unit}"
    return ""


def speeds(cases: list[Case]) -> str:
    known = [case for case in cases if case.get("conveying_speed_m_per_s") is not None]
    if not known:
        return "No speed is known yet."
    fastest = max(known, key=lambda case: float(case["conveying_speed_m_per_s"]))
    slowest = min(known, key=lambda case: float(case["conveying_speed_m_per_s"]))
    flow = mass_flow(fastest)
    most = interval(fastest["conveying_speed_m_per_s"], fastest.get("conveying_speed_half_width_m_per_s"), "m/s") + (f" ({flow})" if flow else "")
    if len(known) == 1:
        return f"The layer is conveyed at {most}, with a velocity efficiency \u03b7 of {fastest['efficiency']:.2f}."
    return (f"The layer is conveyed at {slowest['conveying_speed_m_per_s']:.3f} to {fastest['conveying_speed_m_per_s']:.3f} m/s. It is fastest, "
            f"with {most}, {place_of(fastest)}.")


def theory(cases: list[Case]) -> str:
    known = [case for case in cases if case.get("efficiency") is not None and case.get("efficiency_theory") is not None]
    if not known:
        return ""

    def difference(case: Case) -> float:
        return float(case["efficiency"] - case["efficiency_theory"])

    agree = sum(abs(difference(case)) <= (case.get("efficiency_half_width") or 0.0) for case in known)
    worst = max(known, key=lambda case: abs(difference(case)))
    side = "faster" if difference(worst) > 0 else "slower"
    first = (f"The plastic point-mass theory agrees with the layer to within the interval in {agree} of {len(known)} cases."
             if len(known) > 1 else "The plastic point-mass theory " + ("agrees with the layer to within the interval." if agree
                                                                else "does not agree with the layer to within the interval."))
    if agree == len(known):
        return first
    return (f"{first} The difference is largest {place_of(worst)}, where the layer reaches \u03b7 = {worst['efficiency']:.2f} and the "
            f"theory {worst['efficiency_theory']:.2f}: there the layer is {side} than the theory says.")


def atlas(cases: list[Case]) -> str:
    """What the atlas of simulated layers says of the cases inside of it; empty when there are none."""
    known = [case for case in cases if case.get("efficiency") is not None and case.get("efficiency_atlas") is not None]
    if not known:
        return ""

    def excess(case: Case) -> float:
        widths = (case.get("efficiency_half_width") or 0.0) + case["efficiency_atlas_half_width"]
        return float(abs(case["efficiency"] - case["efficiency_atlas"]) - widths)

    agree = sum(excess(case) <= 0 for case in known)
    cases_of = f"{agree} of the {len(known)} cases" if len(known) > 1 else f"{'the' if agree else 'not the'} only case"
    first = f"The atlas of simulated layers agrees with {cases_of} inside of it, within both intervals."
    if agree == len(known):
        return first
    worst = max(known, key=excess)
    return (f"{first} It is furthest off {place_of(worst)}: it says \u03b7 = {worst['efficiency_atlas']:.2f} \u00b1 "
            f"{worst['efficiency_atlas_half_width']:.2f}, and the layer has {worst['efficiency']:.2f}. One of them is wrong there.")


def kind_of(cases: list[Case]) -> str:
    """Which machine was simulated: "screen", "open trough" or "layer", a periodic piece of a trough."""
    for kind, name in (("screen", "screening_efficiency"), ("open trough", "residence_time_s")):
        if any(case.get(name) is not None for case in cases):
            return kind
    return "layer"


def measured(case: Case, name: str, unit: str, words: str = "", factor: float = 1.0) -> str:
    """A number of a column with its interval, each to three digits, and `words` behind it; empty when it is not known.

    `unit`: with which the name of the column ends, "t_per_h"; empty for a pure number."""
    end = f"_{unit}" if unit else ""
    value, half_width = case.get(f"{name}{end}"), case.get(f"{name}_half_width{end}")
    if value is None:
        return ""
    return f"{factor * value:.3g}" + ("" if half_width is None else f" \u00b1 {factor * half_width:.2g}") + words


def screens(cases: list[Case]) -> list[str]:
    """What is asked of a screen: what passes, at which size it parts, on which length, and how much of it a metre of width takes."""
    known = sorted((case for case in cases if case.get("screening_efficiency") is not None), key=lambda case: -float(case["screening_efficiency"]))
    told = []
    for number, case in enumerate(known[:2]):
        parts = (("with a cut size d50 of", measured(case, "cut_size", "mm", " mm")), ("on a length of", measured(case, "screen_distance", "m", " m")),
                 ("and conveys", mass_flow(case)), ("and lets pass", measured(case, "underflow", "t_per_h", " t/h")))  # fmt: skip
        told.append(f"{'The screen passes' if number == 0 else 'The next best passes'} "
                    + measured(case, "screening_efficiency", "", " % of the undersize", 100) + (f" {place_of(case)}" if len(known) > 1 else "")
                    + "".join(f", {words} {number_and_unit}" for words, number_and_unit in parts if number_and_unit) + ".")
    return told


def open_troughs(cases: list[Case]) -> list[str]:
    """What is asked of an open trough: how much it carries, and how long the material stays in it."""
    known = [case for case in cases if case.get("residence_time_s") is not None and case.get("outflow_t_per_h") is not None]
    if not known:
        return []
    most = max(known, key=lambda case: float(case["outflow_t_per_h"]))
    refused = [case for case in cases if case["outcome"] == "overfull"]
    told = (f"The trough carries {measured(most, 'outflow', 't_per_h', ' t/h')}" + (f" {place_of(most)}" if len(cases) > 1 else "")
            + (", the most of what was simulated" if len(known) > 1 else "") + f"; its grains stay in it for {measured(most, 'residence_time', 's', ' s')}.")
    return [told, f"It does not carry what was fed {', '.join(place_of(case) for case in refused)}." if refused else
            "No larger feed was simulated that it does not carry: 'vibrotrough capacity' finds the largest."]


def conclusion(cases: list[Case]) -> list[str]:
    """Sentences that answer the question of the kind of machine; only a layer begins with the point mass, which knows nothing of the others."""
    kind = kind_of(cases)
    first = {"screen": screens, "open trough": open_troughs}.get(kind, lambda cases: [])(cases)
    models = (theory(cases), atlas(cases)) if kind == "layer" else ()
    return [*first, *(sentence for sentence in (speeds(cases), *models, outcomes(cases)) if sentence)]
