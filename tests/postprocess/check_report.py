"""Draws all figures of the sample and writes its report with hostile texts; then headless Chromium opens it: it renders,
sorts on a click, says no error on the console and asks the network for nothing.

usage: check_report.py SCRIPTS SAMPLE COLUMNS WORK; exits with 77 when Chromium is not installed
COLUMNS is the program that prints the columns as campaign.json describes them.
"""

import base64
import hashlib
import html
import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys


HOSTILE = "</pre><script>document.title = 'broken'</script> & \"quoted\" \u03b2"
WATCHED = pathlib.Path(__file__).parent / "watched_figures.py"
CASES = {"0123456789abcdef": 0.55, "fedcba9876543210": None}

# What `vibrotrough convergence` writes, as far as the figure reads it: of a case, and of one that is no longer there.
BUDGETS = {"format": "vibrotrough numerics", "schema_version": 1, "cases": [
    {"case": case, "numerical_error": error, "settings": [
        {"setting": "youngs_modulus", "title": "Young's modulus", "verdict": "extrapolated", "error": 0.02, "error_half_width": 0.012, "bound": 0.03},
        {"setting": "length", "title": "length of the box", "verdict": "not-resolved", "error": 0.01, "error_half_width": 0.036, "bound": 0.04},
        {"setting": "width", "title": "width of the box", "verdict": "left-out", "bound": 0.0}]}
    for case, error in (("0123456789abcdef", 0.05), ("fedcba9876543210", None), ("bbbbbbbbbbbb", 0.1))]}

# Clicks on headings, and writes the order of the rows into the page after each.
PROBE = """<script>
  const order = () => Array.from(document.querySelectorAll("#cases tbody tr")).map((row) => row.cells[0].textContent).join(" ");
  const seen = [order()];
  for (const name of ["throw_number", "throw_number", "efficiency_theory", "efficiency_theory", "outcome"]) {
    document.querySelector(`th[data-column=${name}] button`).click();
    seen.push(order());
  }
  const visible = () => Array.from(document.querySelectorAll("#cases thead th")).filter((one) => one.offsetWidth > 0).map((one) => one.dataset.column);
  const few = visible();
  document.getElementById("all-columns").click();
  const many = visible();
  const width = document.querySelector("figure svg").getBoundingClientRect().width;
  document.documentElement.style.width = "400px";  // a telephone: headless windows are at least 500 wide
  const probe = document.createElement("output");
  probe.id = "probe";
  probe.textContent = JSON.stringify({seen, few, many, title: document.title, drawn: document.querySelectorAll("figure svg path").length,
    width, narrow: document.querySelector("figure svg").getBoundingClientRect().width,
    sorted: document.querySelector("th[data-column=outcome]").getAttribute("aria-sort"), page: document.body.scrollWidth});
  document.body.append(probe);
</script>"""


def make_campaign(sample, columns, work):
    """The sample as a campaign's folder, with what the program writes for the figures."""
    folder = work / "campaign"
    shutil.rmtree(folder, ignore_errors=True)
    for case in CASES:
        (folder / "cases" / case).mkdir(parents=True)
        shutil.copy(sample / "result.h5", folder / "cases" / case)
    shutil.copy(sample / "campaign.h5", folder)
    data = folder / "report" / "data"
    (data / "point_mass").mkdir(parents=True)
    row = {"throw_number": 2.1, "machine_number": 4.4, "vibration_angle_deg": 28.6479, "inclination_deg": -2.86, "friction": 0.23,
           "amplitude_m": 0.006, "frequency_hz": 13.5, "efficiency": 0.82, "efficiency_half_width_statistics": 0.127, "efficiency_half_width": 0.13,
           "conveying_speed_m_per_s": 0.37, "mode_theory": "FN'", "packings": 2, "cycles_measured": 2, "cycles_discarded": 2,
           "wall_time_s": 23.75, "difference": 0.27, "outcome": "not-precise", "message": "", "packings_done": 2, "packings_wanted": 2}
    row |= {"stroke_mm": 12.0, "turns_per_minute": 810.0, "conveying_speed_half_width_m_per_s": 0.057, "mass_flow_t_per_h": 4.25,
            "mass_flow_half_width_t_per_h": 0.66, "label": ""}
    cases = [dict(row, case=case, throw_number=2.1 + number, efficiency_theory=theory, label=f"throw_number {2.1 + number}")
             for number, (case, theory) in enumerate(CASES.items())]
    failed = dict(row, case="aaaaaaaaaaaa", throw_number=1.0, outcome="lost-grains", message=HOSTILE, efficiency=None,
                  efficiency_half_width_statistics=None, efficiency_half_width=None, efficiency_theory=0.1)
    (data / "campaign.json").write_text(json.dumps({
        "campaign": "sample", "program_version": "0.1.0", "git_commit": "abcdef", "engine_version": HOSTILE,
        "written": "2026-11-21T12:00:00Z", "input": "# " + HOSTILE, "columns": columns, "swept": [], "cases": [*cases, failed]}), encoding="utf-8")
    (data / "theory_curves.csv").write_text(
        "throw_number,vibration_angle_deg,velocity_efficiency,atlas_efficiency,atlas_half_width\n"
        "2.0,28.6479,0.5,0.55,0.05\n2.7,28.6479,0.6,,\n3.5,28.6479,0.7,0.75,0.08\n", encoding="utf-8")
    (folder / "certificate.json").write_text(json.dumps({"engine": HOSTILE, "passed": True, "checks": [
        {"name": "restitution", "deviation": 0.01}, {"name": "friction", "deviation": 0.0}]}), encoding="utf-8")
    (folder / "numerics.json").write_text(json.dumps(BUDGETS), encoding="utf-8")
    return folder


def run_script(scripts, name, *arguments):
    done = subprocess.run([sys.executable, "-B", "-m", name, *map(str, arguments)], cwd=scripts, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return [pathlib.Path(line) for line in done.stdout.splitlines()]


class Words(html.parser.HTMLParser):
    """What a reader sees, and every address that the page asks for."""

    def __init__(self):
        super().__init__()
        self.text, self.addresses = "", []

    def handle_data(self, data):
        self.text += data

    def handle_starttag(self, tag, attributes):
        self.addresses += [value for name, value in attributes if name in ("src", "href", "xlink:href", "action", "data")]


def check_page(page):
    words = Words()
    words.feed(page)
    assert HOSTILE in words.text, "what users wrote is shown as it is"
    assert "<script>document.title" not in page, "and is not part of the page"
    outside = [one for one in words.addresses if not one.startswith(("#", "data:"))]
    assert not outside, f"asks for {outside}"
    assert page.count("<svg") == len(re.findall(r"<figcaption", page)) >= 4
    assert "lost-grains" in words.text and "restitution" in words.text
    assert "\u03b7, theory" in words.text and "+0.270" in words.text and "friction_layer" not in page, "columns of the table"
    assert re.search(r">0\.820? \u00b1 0\.130?<", page), "an interval stands in the cell of its number"
    assert re.findall(r'data-column="([a-z_]*half_width[a-z_]*)"', page) == ["efficiency_half_width_statistics"], "the statistical part, at the push of a button"
    assert 'title="Velocity efficiency' in page, "a heading says what it means"
    assert "\u03b1 = -2.86\u00b0" in words.text, "what is the same in all cases is said once"
    assert "amplitude r =" not in words.text and "stroke = 12 mm" in words.text and "turns = 810 1/min" in words.text
    assert "flight: nothing touches the trough" in words.text, "letters of modes are explained"
    for name in ("efficiency", "residuals", "cycles"):
        assert f"vibrotrough plot DIR --only {name}" in words.text, f"provenance of {name}"
    # What a reader wants first comes first, and the engine's probes come last.
    order = ["0 of 3 cases are finished; the others are: 2 not-precise, 1 lost-grains.", "Results", "In all cases:", "Why the layers differ from the theory",
             "What to change", "What is not known", "Figures",
             "What failed, and why", "Input, and how to reproduce", "Single cases", "The engine's probes"]
    places = [words.text.index(one) for one in order]
    assert places == sorted(places), dict(zip(order, places))
    assert "0.370 \u00b1 0.057 m/s (4.25 \u00b1 0.66 t/h)" in words.text, "the conclusion has the user's units"
    names = re.findall(r'\bid="(figure\d+-[^"]+)"', page)
    assert len(names) > 50 and not re.search(r'url\(#(?!figure\d)', page)


def check_budget(scripts, folder):
    """Parts add in squares, so that the heights of the stack, squares over the total, add up to it: 3-4-5 triangle."""
    sys.path.insert(0, str(scripts))
    from vibrotrough.figures import budget

    budgets = budget.read_budgets(folder, list(CASES))
    assert [one["case"] for one in budgets] == list(CASES), "a case that is no longer there is left out"
    heights = budget.shares(budgets[0])
    assert abs(heights[0] - 0.018) < 1e-15 and abs(heights[1] - 0.032) < 1e-15 and heights[2] == 0.0, heights
    text = (folder / "report" / "budget.svg").read_text(encoding="utf-8")
    assert "Young" in text and "unknown" in text and "width of the box" not in text, "what is left out has no colour"

    kept = (folder / "numerics.json").read_bytes()
    (folder / "numerics.json").write_text("{", encoding="utf-8")
    failed = subprocess.run([sys.executable, "-B", "-m", "vibrotrough.figures.draw", folder, "--only", "budget"], cwd=scripts, capture_output=True, text=True)
    assert failed.returncode == 1 and failed.stderr.count("\n") == 1 and "numerics.json" in failed.stderr, failed.stderr
    (folder / "numerics.json").unlink()
    assert run_script(scripts, "vibrotrough.figures.draw", folder, "--only", "budget") == [], "without a study there is no figure"
    (folder / "numerics.json").write_bytes(kept)


def check_words(scripts):
    """Sentences of the conclusion, of cases that are easy to judge."""
    sys.path.insert(0, str(scripts))
    from vibrotrough.report.words import conclusion

    case = {"case": "a", "label": "friction 0.2", "outcome": "finished", "efficiency": 0.5, "efficiency_half_width": 0.02,
            "efficiency_theory": 0.51, "conveying_speed_m_per_s": 0.25, "conveying_speed_half_width_m_per_s": 0.01}
    other = dict(case, case="b", label="friction 0.3", efficiency=0.8, conveying_speed_m_per_s=0.4, mass_flow_per_width_t_per_h_m=14.1,
                 mass_flow_per_width_half_width_t_per_h_m=0.35)
    said = conclusion([case, other])
    assert said[0] == ("The layer is conveyed at 0.250 to 0.400 m/s. It is fastest, with 0.400 \u00b1 0.010 m/s "
                       "(14.1 \u00b1 0.35 t/h per metre of width), at friction 0.3."), said
    assert said[1].startswith("The plastic point-mass theory agrees with the layer to within the interval in 1 of 2 cases. The difference is "
                              "largest at friction 0.3, where the layer reaches \u03b7 = 0.80 and the theory 0.51"), said
    assert said[2].startswith("All 2 cases are finished"), said
    assert conclusion([case])[1].endswith("agrees with the layer to within the interval."), conclusion([case])
    # The atlas is told of where it has something to say, and where it differs by more than both intervals.
    inside = dict(case, efficiency_atlas=0.53, efficiency_atlas_half_width=0.08)
    far = dict(inside, label="friction 0.3", efficiency=0.8)
    assert "agrees with the only case inside of it" in conclusion([inside])[2], conclusion([inside])
    assert conclusion([inside, far, case])[2] == (
        "The atlas of simulated layers agrees with 1 of the 2 cases inside of it, within both intervals. It is furthest off at friction 0.3: "
        "it says \u03b7 = 0.53 \u00b1 0.08, and the layer has 0.80. One of them is wrong there."), conclusion([inside, far, case])
    # A screen and an open trough are asked for something else; the point mass is not mentioned at all.
    screen = dict(case, screening_efficiency=0.82, screening_efficiency_half_width=0.03, cut_size_mm=4.1, cut_size_half_width_mm=0.1, screen_distance_m=1.2,
                  screen_distance_half_width_m=None, mass_flow_per_width_t_per_h_m=9.3)
    assert conclusion([screen])[0].startswith("The screen passes 82 \u00b1 3 % of the undersize, with a cut size d50 of 4.1 \u00b1 0.1 mm, on a length of 1.2 m,")
    assert conclusion([dict(screen, label="friction 0.3", screening_efficiency=0.5, cut_size_mm=None), screen])[1].startswith("The next best passes 50 \u00b1 3 % of the undersize")
    trough = dict(case, outflow_t_per_h=7.2, outflow_half_width_t_per_h=0.36, residence_time_s=12.0, residence_time_half_width_s=0.5)
    assert conclusion([trough])[0] == "The trough carries 7.2 \u00b1 0.36 t/h; its grains stay in it for 12 \u00b1 0.5 s.", conclusion([trough])
    overfull = dict(case, efficiency=None, conveying_speed_m_per_s=None, label="feed 9 t/h", outcome="overfull")
    assert conclusion([trough, overfull])[1] == "It does not carry what was fed at feed 9 t/h.", conclusion([trough, overfull])
    assert not any("point-mass" in sentence for cases in ([screen], [trough]) for sentence in conclusion(cases))
    assert conclusion([])[0] == "No speed is known yet." and "no cases" in conclusion([])[-1]
    assert conclusion([dict(overfull, outcome="not-steady")]) == ["No speed is known yet.", "0 of 1 cases are finished; the others are: 1 not-steady."]


def check_swept(scripts, folder, work):
    """A campaign that sweeps something unusual: it has colours, a legend and a scale of its own. With the throw number the same in
    all cases, the swept number is the scale.
    """
    import h5py

    other = work / "swept"
    shutil.rmtree(other, ignore_errors=True)
    shutil.copytree(folder, other)
    for keys, wanted, unwanted in (("grains.rolling_friction", "grain rolling friction = 0.05", "\u03b2 ="),
                                   ("grains.rolling_friction same", "grain rolling friction  [-]", "throw number")):
        with h5py.File(other / "campaign.h5", "a") as file:
            file.attrs["swept_keys"] = "grains.rolling_friction"
            if "swept/grains.rolling_friction" not in file:
                file["swept/grains.rolling_friction"] = [0.05, 0.2]
                file["swept/grains.rolling_friction"].attrs["units"] = "1"
                file["swept/grains.rolling_friction"].attrs["description"] = ""
            if "same" in keys:
                file["throw_number"][...] = 2.1
        run_script(scripts, "vibrotrough.figures.draw", other, "--only", "efficiency", "--only", "residuals")
        text = (other / "report" / "efficiency.svg").read_text(encoding="utf-8")
        assert wanted in text and unwanted not in text, f"{wanted} is not in the figure, or {unwanted} is"
        assert "grain rolling friction" in (other / "report" / "residuals.svg").read_text(encoding="utf-8")
    check_models_over_the_swept_key(scripts, other)
    check_stroke(scripts, other)


def check_models_over_the_swept_key(scripts, folder):
    """With the throw number the same in all cases, efficiency, speed and mass flow are drawn over the swept key, with the lines of the
    theory, the law and the atlas.
    """
    data = folder / "report" / "data" / "campaign.json"
    overview = json.loads(data.read_text(encoding="utf-8"))
    key = "grains.rolling_friction"
    overview["swept"] = [{"key": key, "column": key}]
    overview["columns"].append({"name": key, "key": key, "unit": "1", "type": "number", "meaning": "", "report": None})
    for number, row in enumerate(overview["cases"]):
        row |= {key: 0.05 + 0.15 * number, "efficiency_theory": 0.5, "efficiency_rolling_layer": 0.6, "efficiency_atlas": 0.7, "efficiency_atlas_half_width": 0.08}
    data.write_text(json.dumps(overview), encoding="utf-8")
    run_script(scripts, "vibrotrough.figures.draw", folder, "--only", "efficiency", "--only", "speed", "--only", "mass_flow")
    for kind, title in (("efficiency", "velocity efficiency"), ("speed", "conveying speed"), ("mass_flow", "mass flow")):
        text = (folder / "report" / f"{kind}.svg").read_text(encoding="utf-8")
        for words in (title, "grain rolling friction", "solid: point-mass theory", "dashed: rolling-layer law", "dotted: atlas"):
            assert words in text, f"{kind}: {words}"
    assert sum("models say of the same cases" in one for one in figures_in(scripts, folder)) == 2
    check_both_theories(scripts, folder, overview)


def check_both_theories(scripts, folder, overview):
    """A sweep of the restitution is drawn beside the plastic theory and the one with restitution, over it and over the throw number."""
    import h5py

    key, data = "trough.restitution", folder / "report" / "data" / "campaign.json"
    overview = json.loads(json.dumps(overview))
    overview["swept"] = [{"key": key, "column": key}]
    overview["columns"].append({"name": key, "key": key, "unit": "1", "type": "number", "meaning": "", "report": None})
    for number, row in enumerate(overview["cases"]):
        row |= {key: 0.2 + 0.3 * number, "efficiency_theory_restitution": 0.46 + 0.1 * number}
    overview["differences"] = {"key": key, "rows": [
        {"label": "restitution 0.5", "against_label": "restitution 0.2", "efficiency_difference": -0.1, "efficiency_difference_half_width": 0.02,
         "significant": "yes"}]}
    data.write_text(json.dumps(overview), encoding="utf-8")
    with h5py.File(folder / "campaign.h5", "a") as file:
        file.attrs["swept_keys"] = key
        file[f"swept/{key}"] = [0.2, 0.5]
        file[f"swept/{key}"].attrs["units"], file[f"swept/{key}"].attrs["description"] = "1", ""
    for throw_numbers, plastic in (([2.1, 2.1], "solid: plastic theory"), ([2.1, 8.4], "plastic theory")):
        with h5py.File(folder / "campaign.h5", "a") as file:
            file["throw_number"][...] = throw_numbers
        run_script(scripts, "vibrotrough.figures.draw", folder, "--only", "efficiency")
        texts = re.findall(r">([^<>]*)<", (folder / "report" / "efficiency.svg").read_text(encoding="utf-8"))
        text = " ".join(" ".join(texts).split())  # a title may be wrapped
        for words in (plastic, "theory with restitution"):
            assert words in text, f"{words}: {throw_numbers}"
        assert "point-mass theory" not in text, "which of the two is said"
    (report,) = run_script(scripts, "vibrotrough.report.page", folder)
    page = report.read_text(encoding="utf-8")
    assert "-0.100 \u00b1 0.020" in page and 'id="differences"' in page and "restitution 0.5" in page, "the table of differences"


def check_stroke(scripts, folder):
    """A swept stroke sets the throw number, which is the scale: one series. With a swept frequency it is a series of its own."""
    import numpy as np

    sys.path.insert(0, str(scripts))
    from vibrotrough.figures.efficiency import Series

    columns = {"case": np.array(["a", "b", "c"]), "throw_number": np.array([1.4, 1.6, 2.0]), "vibration_angle": np.full(3, 0.5),
               "swept/trough.stroke": np.array([0.007, 0.008, 0.010]), "swept/trough.frequency": np.array([16.0, 16.0, 17.0])}
    units = {"swept/trough.stroke": "m", "swept/trough.frequency": "Hz"}
    alone = Series(columns, units, {"swept_keys": "trough.stroke"})
    assert alone.is_over_throw_number() and set(alone.colours) == {0} and set(alone.markers) == {0} and len(alone.panels) == 1
    both = Series(columns, units, {"swept_keys": "trough.stroke trough.frequency"})
    assert len(set(both.colours)) == 3, "the throw number does not tell the stroke"


def check_footers(scripts, folder):
    """The watch sees a footer that is moved up into the figure."""
    caught = subprocess.run([sys.executable, "-B", WATCHED, "0.3", scripts, folder, "--only", "residuals"], capture_output=True, text=True)
    assert "lies over an axis" in caught.stderr, caught.stderr


def figures_in(scripts, folder):
    (report,) = run_script(scripts, "vibrotrough.report.page", folder)
    return re.findall(r"<figcaption>Figure \d+\. ([^<]*)<", report.read_text(encoding="utf-8"))


def check_that_figures_belong_to_the_data(scripts, folder):
    report = folder / "report"
    # The figures of an earlier state of the campaign are not shown beside the table of today.
    data = json.loads((report / "data" / "campaign.json").read_text(encoding="utf-8"))
    data["cases"] = [dict(row, outcome="open", efficiency=None) for row in data["cases"]]
    (report / "data" / "campaign.json").write_text(json.dumps(data), encoding="utf-8")
    assert figures_in(scripts, folder) == []


def check_processes(scripts, folder, drawn):
    """Cases are drawn side by side: the same files in the same order as on one processor, and a process that is ended is told."""
    of_cases = [path for path in drawn if path.name.startswith(("cycles-", "portraits-"))]
    assert len(of_cases) >= 2 * len(CASES), of_cases
    before = [path.read_bytes() for path in of_cases]
    command = [sys.executable, "-B", "-m", "vibrotrough.figures.draw", folder, "--only", "cycles", "--only", "portraits"]
    alone = subprocess.run(["taskset", "--cpu-list", str(min(os.sched_getaffinity(0))), *command], cwd=scripts, capture_output=True, text=True)
    assert alone.stdout.splitlines() == [str(path) for path in of_cases], alone.stderr
    assert [path.read_bytes() for path in of_cases] == before
    if len(os.sched_getaffinity(0)) < 2:
        return
    killed = "import os, sys; sys.path.insert(0, sys.argv[1]); sys.argv[:2] = ['draw']; from vibrotrough.figures import draw; " \
             "draw.figures_of_case = lambda *_: os.abort()\ntry: draw.main()\nexcept draw.Problem as problem: print(problem)"
    done = subprocess.run([sys.executable, "-B", "-c", killed, scripts, folder], capture_output=True, text=True)
    assert done.stdout.splitlines()[-1].startswith("a process that drew figures was ended"), done.stdout + done.stderr


def check_in_browser(browser, report, work):
    probed = work / "probed.html"
    page = report.read_text(encoding="utf-8")
    own = base64.b64encode(hashlib.sha256(PROBE[len("<script>") : -len("</script>")].encode()).digest()).decode()
    policy = page.replace("script-src '", f"script-src 'sha256-{own}' '", 1)
    # The page's policy lets the page's script run, which the probe looks at, the probe, and not the one in between.
    planted = "<script>document.title = 'planted';</script>"
    probed.write_text(policy.replace("</body>", planted + PROBE + "</body>"), encoding="utf-8")
    common = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
              f"--user-data-dir={work / 'browser'}", "--enable-logging=stderr", "--v=0"]
    done = subprocess.run([*common, "--dump-dom", probed.as_uri()], capture_output=True, text=True, timeout=600)
    found = re.search(r'<output id="probe">(.*?)</output>', done.stdout, re.DOTALL)
    assert found, f"the page did not render: {done.stderr[-2000:]}"
    seen = json.loads(html.unescape(found.group(1)))
    a, b, c = "0123456789abcdef", "fedcba9876543210", "aaaaaaaaaaaa"
    assert seen["seen"] == [f"{a} {b} {c}", f"{c} {a} {b}", f"{b} {a} {c}", f"{c} {a} {b}", f"{a} {c} {b}", f"{c} {a} {b}"], seen
    assert seen["title"] == "sample \u00b7 Vibrotrough" and seen["drawn"] > 100 and seen["width"] > 300, seen
    assert seen["sorted"] == "ascending", seen
    # The button shows what only some readers look for.
    assert {"wall_time_s", "cycles_discarded"} & set(seen["many"]) and not {"wall_time_s", "cycles_discarded"} & set(seen["few"]), seen
    assert set(seen["few"]) < set(seen["many"]) and "outcome" in seen["few"], seen
    # The page itself fits into 400 pixels; tables and figures stay readable and scroll within it.
    assert seen["page"] <= 400 and seen["narrow"] > 500, seen
    said = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    assert len(said) == 1 and "Content Security Policy" in said[0], said
    picture = work / "report.png"
    subprocess.run([*common, "--window-size=1200,1600", f"--screenshot={picture}", report.as_uri()], capture_output=True,
                   timeout=600, check=True)
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size > 20000


def main(scripts, sample, columns, work):
    scripts, sample, work = pathlib.Path(scripts), pathlib.Path(sample), pathlib.Path(work).resolve()
    folder = make_campaign(sample, json.loads(subprocess.run([columns], capture_output=True, check=True).stdout), work)
    done = subprocess.run([sys.executable, "-B", WATCHED, "0", scripts, folder], capture_output=True, text=True, check=True)
    assert "lies over an axis" not in done.stderr, done.stderr
    drawn = [pathlib.Path(line) for line in done.stdout.splitlines()]
    assert {path.name for path in drawn} >= {
        f"{name}.{kind}" for kind in ("svg", "png")
        for name in ("efficiency", "residuals", "budget", *(f"cycles-{case}" for case in CASES))}, drawn
    for path in drawn:
        assert path.stat().st_size > 2000, path
        if path.suffix == ".svg":
            text = path.read_text(encoding="utf-8")
            assert "sample  \u00b7  Vibrotrough" in text, f"{path} does not name campaign and program"
    check_processes(scripts, folder, drawn)
    check_footers(scripts, folder)
    check_budget(scripts, folder)
    check_words(scripts)
    check_swept(scripts, folder, work)
    only = run_script(scripts, "vibrotrough.figures.draw", folder, "--only", "cycles", "--case", "0123456789abcdef")
    assert [path.name for path in only] == ["cycles-0123456789abcdef.svg", "cycles-0123456789abcdef.png"], only
    (report,) = run_script(scripts, "vibrotrough.report.page", folder)
    check_page(report.read_text(encoding="utf-8"))
    report = shutil.copy(report, work / "report.html")  # the one with all figures
    check_that_figures_belong_to_the_data(scripts, folder)

    (folder / "report" / "data" / "campaign.json").write_text("{", encoding="utf-8")
    for script in ("figures.draw", "report.page"):
        failed = subprocess.run([sys.executable, "-B", "-m", f"vibrotrough.{script}", folder], cwd=scripts, capture_output=True, text=True)
        assert failed.returncode == 1 and failed.stderr.count("\n") == 1 and "campaign" in failed.stderr, failed.stderr

    browser = shutil.which("chromium")
    if not browser:
        print("SKIPPED: chromium is not installed")
        sys.exit(77)
    check_in_browser(browser, report, work)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
