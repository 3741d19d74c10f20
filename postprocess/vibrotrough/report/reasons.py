"""Why layers differ from the theory, what to change, and what is not known: sentences for the report. Every number is a column of
`vibrotrough compare`, and none is said to be more than its interval allows.
"""

import itertools
import math
import sys
from typing import Any

from ..figures.style import plain
from .words import place_of

Case = dict[str, Any]
Swept = list[dict[str, Any]]

MOST_CASES = 3  # that are explained one by one
LONGEST_LABEL = 80
# What a point mass under the layer's own normal force is known to, as `vibrotrough compare --help` says.
RESOLUTION = 0.05
# 95 %: the rolling-layer law misses layers that it was not fitted to with an rms error of 0.045 (validation/rolling_layer).
LAW_HALF_WIDTH = 1.96 * 0.045
FEWEST_DIAMETERS = 3  # the depth at which the atlas begins, to which its effect of depth refers


def known(case: Case, *names: str) -> bool:
    return all(case.get(name) is not None for name in names)


def half_width(case: Case) -> float:
    return float(case.get("efficiency_half_width") or 0.0)


def difference(case: Case) -> float:
    return float(case["efficiency"] - case["efficiency_theory"])


def place(case: Case) -> str:
    """By what distinguishes the case; by its id where that is too much to read."""
    label = plain(place_of(case))
    return label if len(label) <= LONGEST_LABEL else f"in case {case['case']}"


def signed(value: float, error: float) -> str:
    return f"{value:+.2f} \u00b1 {error:.2f}".replace("-", "\u2212")


def passing_on(case: Case) -> tuple[float, float]:
    """What of the difference comes from how the grains pass friction on, and its uncertainty."""
    return float(case["efficiency"] - case["efficiency_by_normal_force"]), math.hypot(RESOLUTION, half_width(case))


def amount(value: float, error: float) -> str:
    return signed(value, error) if abs(value) > error else f"too little to tell (\u00b1 {error:.2f})"


def parts_of(case: Case) -> list[str]:
    """What of the difference comes from where, as far as it was measured. What its uncertainty hides is not given a number."""
    sentences = []
    if known(case, "efficiency_by_normal_force"):
        # A point mass under the measured force of the layer parts the two.
        middle = float(case["efficiency_by_normal_force"])
        pressing, passing = amount(middle - case["efficiency_theory"], RESOLUTION), amount(*passing_on(case))
        sentences.append(f"Flight and landing (when and how hard the layer presses on the trough): {pressing}; "
                         f"rolling, spin and shear (how its grains pass friction on): {passing}.")
    if known(case, "efficiency_rolling_layer"):
        rolling = float(case["efficiency_rolling_layer"] - case["efficiency_theory"])
        rest = float(case["efficiency"] - case["efficiency_rolling_layer"])
        error = math.hypot(LAW_HALF_WIDTH, half_width(case))
        sentences.append(f"The rolling-layer law expects of a layer whose grains roll: {amount(rolling, LAW_HALF_WIDTH)}; "
                         + ("law and layer agree within both intervals." if abs(rest) <= error else f"it leaves {signed(rest, error)}."))
    if known(case, "landing_friction", "friction"):
        drives = "brakes" if case["landing_friction"] >= 0 else "drives"
        sentences.append(f"While the layer lands, the trough {drives} it by {abs(case['landing_friction']):.2f} of the normal impulse, and the theory's mass by up to "
                         f"{case['friction']:.2f}; this does not explain a difference by itself (validation/why_theory_fails).")
    if known(case, "efficiency_theory_layer"):
        rest = float(case["efficiency"] - case["efficiency_theory_layer"])
        left = f"{signed(rest, half_width(case))} remain" if abs(rest) > half_width(case) else "what remains is within the interval"
        sentences.append(f"With the measured friction of the layer as a whole, {case['friction_layer']:.2f}, in the theory, {left}.")
    return sentences


def effects_of(case: Case) -> list[str]:
    """What depth and slope do by the atlas of simulated layers, each with the interval of the atlas."""
    effects = case.get("atlas_effects") or {}
    sentences = []
    if depth := effects.get("of_depth"):
        sentences.append(f"By the atlas, a depth of {effects['depth']:.3g} instead of {FEWEST_DIAMETERS} diameters changes the efficiency by "
                         f"{amount(depth['value'], depth['half_width'])}.")
    if slope := effects.get("of_slope"):
        sentences.append(f"By the atlas, the slope's part of the difference from the theory is {amount(slope['value'], slope['half_width'])}.")
    return sentences


def explained(case: Case) -> str:
    where = place(case)
    if abs(difference(case)) <= half_width(case):
        return f"{where[0].upper()}{where[1:]} the layer agrees with the theory within its interval of \u00b1 {half_width(case):.2f}."
    side = "above" if difference(case) > 0 else "below"
    head = f"{where[0].upper()}{where[1:]} the velocity efficiency is {side} the theory's: {signed(difference(case), half_width(case))}."
    return " ".join([head, *parts_of(case), *effects_of(case)])


def trends(cases: list[Case], swept: Swept) -> list[str]:
    """How the difference from the theory changes with each swept number, between cases that are alike in all other keys."""
    sentences = []
    for key in swept:
        name, others = key["column"], [other["column"] for other in swept if other is not key]
        alike: dict[tuple[Any, ...], list[Case]] = {}
        for case in cases:
            if isinstance(case.get(name), (int, float)):
                alike.setdefault(tuple(case.get(other) for other in others), []).append(case)
        groups = [sorted(group, key=lambda case: float(case[name])) for group in alike.values() if len(group) > 1]
        pairs = [(group[0], group[-1]) for group in groups if group[0][name] < group[-1][name]]
        if not pairs:
            continue
        low, high = max(pairs, key=lambda pair: abs(difference(pair[1]) - difference(pair[0])))
        change, error = difference(high) - difference(low), math.hypot(half_width(low), half_width(high))
        of = f"From {place(low).removeprefix('at ').removeprefix('in ')} to {place(high).removeprefix('at ').removeprefix('in ')}"
        sentences.append(f"{of}, the difference from the theory changes by {signed(change, error)}." if abs(change) > error else
                         f"{of}, the difference from the theory changes by no more than can be told (\u00b1 {error:.2f}).")
    return sentences


def why(cases: list[Case], swept: Swept) -> list[str]:
    """The cases with the largest differences, then how many agree, then what the swept keys do to it."""
    told = [case for case in cases if known(case, "efficiency", "efficiency_theory")]
    differ = sorted((case for case in told if abs(difference(case)) > half_width(case)), key=lambda case: -abs(difference(case)))
    sentences = [explained(case) for case in differ[:MOST_CASES]]
    if len(differ) > MOST_CASES:
        sentences.append(f"{len(differ) - MOST_CASES} more differ by less.")
    agree = len(told) - len(differ)
    if 0 < agree <= MOST_CASES:
        sentences += [explained(case) for case in told if case not in differ]
    elif agree:
        sentences.append(f"In {agree} cases the layer agrees with the theory within its interval.")
    return sentences + trends(told, swept)


def what_to_change(cases: list[Case]) -> list[str]:
    """In the machine, and in the campaign."""
    told = [case for case in cases if known(case, "efficiency", "efficiency_theory")]
    sentences = []
    fast = [case for case in told if known(case, "conveying_speed_m_per_s")]
    if len(fast) > 1:
        first, second = sorted(fast, key=lambda case: -float(case["conveying_speed_m_per_s"]))[:2]
        error = math.hypot(first.get("conveying_speed_half_width_m_per_s") or 0.0, second.get("conveying_speed_half_width_m_per_s") or 0.0)
        ahead = first["conveying_speed_m_per_s"] - second["conveying_speed_m_per_s"]
        if ahead > error:
            sentences.append(f"Machine: of these, the fastest layer is {place(first)}, by {ahead:.3f} \u00b1 {error:.3f} m/s.")
        else:
            sentences.append(f"Machine: the two fastest layers, {place(first)} and {place(second)}, differ by no more than can be "
                             f"told (\u00b1 {error:.3f} m/s); choose between them by wear, power or cost.")
    rolling = [case for case in told if abs(difference(case)) > half_width(case) and known(case, "efficiency_by_normal_force")
               and abs(passing_on(case)[0]) > passing_on(case)[1]]
    if rolling:
        sentences.append(f"Machine: in {len(rolling)} of {len(told)} cases rolling, spin and shear make a difference that can be told. What real grains do there depends on "
                         "their own rolling friction: measure it, or sweep grains.rolling_friction, before such a machine is built.")
    numerical = [case for case in told if case.get("larger_error") == "numerical"]
    if numerical:
        sentences.append(f"Campaign: in {len(numerical)} of {len(told)} cases the numerical error is the larger part of the interval: more packings hardly "
                         "narrow it; stiffer grains and a larger box do ('vibrotrough check' says which).")
    statistical = len(told) - len(numerical)
    if statistical:
        sentences.append(f"Campaign: in {statistical} of {len(told)} cases the scatter of the packings is the larger part of the interval: a smaller "
                         "measure.half_width, with max_packings to allow it, narrows it.")
    return sentences


def not_known(cases: list[Case], campaign: dict[str, Any]) -> list[str]:
    """@param campaign  the campaign file"""
    told = [case for case in cases if known(case, "efficiency")]
    if not told:
        return []
    sentences = []
    if not any(known(case, "friction_layer") for case in told):
        sentences.append("Friction: that of a grain on the trough is an input; that of the layer as a whole was not measured ('vibrotrough friction-test').")
    grains = campaign.get("grains", {})
    varied = set(itertools.chain.from_iterable(section for name in ("sweep", "zip") if isinstance(section := campaign.get(name), dict)))
    if "grains.rolling_friction" not in varied:
        rolling = grains.get("rolling_friction", 0) if grains.get("rotation") == "rolling" else None
        state = {"blocked": "the grains cannot rotate, which real ones can"}.get(
            grains.get("rotation", "free"), "the grains roll freely" if rolling is None else f"{rolling:g} is an input")
        sentences.append(f"Rolling friction: {state}. How much the answer depends on it, a sweep over grains.rolling_friction tells.")
    told_by_atlas = {name for name in ("depth", "slope") if any((case.get("atlas_effects") or {}).get(f"of_{name}") for case in told)}
    unvaried = [name for name, keys in (("depth", ("layer.height", "layer.diameters", "layer.grains")), ("slope", ("trough.inclination",)))
                if not varied & set(keys) and name not in told_by_atlas]
    if unvaried:
        sentences.append(f"{' and '.join(unvaried).capitalize()}: not varied here, so that what {'they do' if len(unvaried) > 1 else 'it does'} to the difference from the theory is "
                         "not seen.")
    if not any(case.get("numerics_source") == "convergence" for case in told):
        sentences.append("Box, stiffness and time step: their errors are those of other layers and not those of this campaign ('vibrotrough convergence').")
    return sentences


def read_campaign(text: str) -> dict[str, Any]:
    """The campaign file; empty where this Python has no reader of TOML."""
    if sys.version_info < (3, 11):
        return {}
    import tomllib

    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return {}


def reasons(overview: dict[str, Any]) -> list[dict[str, Any]]:
    """Headings with their sentences; those without any are left out."""
    cases, swept = overview["cases"], overview["swept"]
    found = [("Why the layers differ from the theory", why(cases, swept)), ("What to change", what_to_change(cases)),
             ("What is not known", not_known(cases, read_campaign(overview["input"])))]
    return [{"heading": heading, "sentences": sentences} for heading, sentences in found if sentences]
