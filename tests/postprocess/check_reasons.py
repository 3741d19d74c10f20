"""Why layers differ from the theory, in sentences of the report: none says more than its interval allows.

usage: check_reasons.py POSTPROCESS VALIDATION
"""

import pathlib
import re
import sys

sys.path.insert(0, sys.argv[1])
from vibrotrough.report import reasons  # noqa: E402

CASE = {"case": "a", "label": "layer.height 6 mm", "layer.height": 0.006, "outcome": "finished", "friction": 0.3, "efficiency": 0.65, "efficiency_half_width": 0.05,
        "efficiency_theory": 0.42, "efficiency_by_normal_force": 0.45, "conveying_speed_m_per_s": 0.20, "conveying_speed_half_width_m_per_s": 0.01,
        "larger_error": "numerical"}
SWEPT = [{"key": "layer.height", "name": "layer.height", "column": "layer.height", "unit": "mm", "meaning": ""}]
CAMPAIGN = '[grains]\nrotation = "rolling"\nrolling_friction = 0.05\n'


def told(cases, swept=SWEPT, campaign=CAMPAIGN):
    parts = reasons.reasons({"cases": cases, "swept": swept, "input": campaign})
    return {part["heading"].split()[0] + " " + part["heading"].split()[-1]: part["sentences"] for part in parts}


def same(found, wanted):
    assert found == wanted, f"\n{found}\n{wanted}"


def check_a_difference():
    (sentence,) = told([CASE])["Why theory"]
    same(sentence, "At layer height 6 mm the velocity efficiency is above the theory's: +0.23 \u00b1 0.05. Flight and landing (when and how hard the layer presses "
                   "on the trough): too little to tell (\u00b1 0.05); rolling, spin and shear (how its grains pass friction on): +0.20 \u00b1 0.07.")
    slower = dict(CASE, efficiency=0.30, efficiency_by_normal_force=0.32)
    (sentence,) = told([slower])["Why theory"]
    assert "is below the theory's: \u22120.12 \u00b1 0.05. Flight and landing" in sentence and "the trough): \u22120.10 \u00b1 0.05;" in sentence, sentence
    assert sentence.endswith("friction on): too little to tell (\u00b1 0.07)."), sentence
    assert "the trough brakes it by 0.04 of the normal impulse, and the theory's mass by up to 0.30" in told([dict(CASE, landing_friction=0.04)])["Why theory"][0]


def check_an_agreement():
    """A case within its interval says only that, whatever else was measured of it."""
    case = dict(CASE, efficiency=0.46, efficiency_rolling_layer=0.64, landing_friction=0.04)
    same(told([case])["Why theory"], ["At layer height 6 mm the layer agrees with the theory within its interval of \u00b1 0.05."])
    many = [dict(case, case=str(number)) for number in range(5)]
    same(told(many)["Why theory"][0], "In 5 cases the layer agrees with the theory within its interval.")


def check_rolling():
    (sentence,) = told([dict(CASE, efficiency_rolling_layer=0.62)])["Why theory"]
    assert "The rolling-layer law expects of a layer whose grains roll: +0.20 \u00b1 0.09; law and layer agree within both intervals." in sentence, sentence
    (sentence,) = told([dict(CASE, efficiency_rolling_layer=0.45)])["Why theory"]
    assert "grains roll: too little to tell (\u00b1 0.09);" in sentence and "it leaves +0.20 \u00b1 0.10." in sentence, sentence


def check_the_atlas():
    """Depth and slope by the atlas; what its interval hides gets no number, and what it tells is no longer called unknown."""
    told_of = {"depth": 4.2, "of_depth": {"value": -0.08, "half_width": 0.03}, "of_slope": {"value": 0.01, "half_width": 0.04}}
    found = told([dict(CASE, atlas_effects=told_of)])
    assert found["Why theory"][0].endswith("By the atlas, a depth of 4.2 instead of 3 diameters changes the efficiency by \u22120.08 \u00b1 0.03. "
                                           "By the atlas, the slope's part of the difference from the theory is too little to tell (\u00b1 0.04)."), found["Why theory"][0]
    assert not any("not varied" in sentence for sentence in found["What known"]), found["What known"]
    level = told([dict(CASE, atlas_effects={**told_of, "of_slope": None})])
    assert "the slope's part" not in level["Why theory"][0] and any(sentence.startswith("Slope: not varied") for sentence in level["What known"]), level


def check_a_long_name():
    (sentence,) = told([dict(CASE, label=", ".join(f"grains.friction {number}" for number in range(9)))])["Why theory"]
    assert sentence.startswith("In case a the velocity efficiency is above"), sentence


def check_trends():
    deep = dict(CASE, case="b", label="layer.height 18 mm", **{"layer.height": 0.018}, efficiency=0.80)
    same(told([CASE, deep])["Why theory"][-1], "From layer height 6 mm to layer height 18 mm, the difference from the theory changes by +0.15 \u00b1 0.07.")
    near = dict(deep, efficiency=0.70)
    same(told([CASE, near])["Why theory"][-1],
         "From layer height 6 mm to layer height 18 mm, the difference from the theory changes by no more than can be told (\u00b1 0.07).")
    # Cases that differ in another key, too, are not compared.
    other = SWEPT + [dict(SWEPT[0], key="trough.friction", column="friction")]
    assert not any(sentence.startswith("From") for sentence in told([CASE, dict(deep, friction=0.5)], other)["Why theory"])


def check_changes():
    fast = dict(CASE, case="b", label="layer.height 18 mm", conveying_speed_m_per_s=0.205, larger_error="statistical")
    changes = told([CASE, fast])["What change"]
    assert "differ by no more than can be told (\u00b1 0.014 m/s)" in changes[0], changes
    assert changes[1].startswith("Machine: in 2 of 2 cases rolling, spin and shear make a difference"), changes
    assert "in 1 of 2 cases the numerical error is the larger part" in changes[2] and "in 1 of 2 cases the scatter" in changes[3], changes
    agreeing = told([dict(CASE, efficiency=0.46), dict(fast, efficiency=0.46)])["What change"]
    assert not any("rolling" in sentence for sentence in agreeing), agreeing
    changes = told([CASE, dict(fast, conveying_speed_m_per_s=0.25)])["What change"]
    assert "the fastest layer is at layer height 18 mm, by 0.050 \u00b1 0.014 m/s" in changes[0], changes


def check_what_is_not_known():
    same([sentence.split(":")[0] for sentence in told([CASE])["What known"]], ["Friction", "Rolling friction", "Depth and slope", "Box, stiffness and time step"])
    swept = '[sweep]\n"grains.rolling_friction" = [0, 0.1]\n"layer.height" = ["6 mm"]\n'
    assert told([CASE], campaign=swept)["What known"][1].startswith("Slope: not varied here, so that what it does"), told([CASE], campaign=swept)
    whole = dict(CASE, friction_layer=0.28, numerics_source="convergence")
    assert "What known" not in told([whole], campaign=swept + '"trough.inclination" = ["0 deg"]\n')
    assert "cannot rotate" in told([CASE], campaign='[grains]\nrotation = "blocked"\n')["What known"][1]
    assert "roll freely" in told([CASE], campaign="not TOML")["What known"][1]
    same(told([dict(CASE, efficiency=None)]), {})


def check_the_laws_error():
    """The number is that of the stored table."""
    page = (pathlib.Path(sys.argv[2]).parent / "src/manual/validation.md").read_text(encoding="utf-8")
    rms = float(re.search(r"rolling_layer\.law_rms-->([0-9.]+)<", page)[1])
    assert abs(reasons.LAW_HALF_WIDTH - 1.96 * rms) < 1e-12, rms


for check in (check_a_difference, check_an_agreement, check_rolling, check_the_atlas, check_a_long_name, check_trends, check_changes, check_what_is_not_known, check_the_laws_error):
    check()
