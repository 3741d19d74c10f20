"""The conclusion of a campaign in words, for the top of its report. Every number is a column of `vibrotrough compare`."""

from typing import Any

from figure_style import plain

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


def conclusion(cases: list[Case]) -> list[str]:
    """Sentences about the outcome, the speeds, the theory and the atlas."""
    return [sentence for sentence in (speeds(cases), theory(cases), atlas(cases), outcomes(cases)) if sentence]
