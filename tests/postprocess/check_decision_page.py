"""The pages of a design and of a calibration: what they say, that they ask for nothing, how they look in a browser, and that one sheet
of paper is enough.

usage: check_decision_page.py POSTPROCESS WORK
"""

import html.parser
import json
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np

PLANTED = "<script>document.title = 'planted'</script>"
MADE = {"program_version": "0.1.0", "git_commit": "0123456789ab", "written": "2026-11-22T13:00:00Z"}
# A screen of a usual laptop; the pages are meant to be taken in at one look.
SCREEN = (1300, 1000)


def forecast(name, median):
    shares = np.arange(1, 40) / 40
    return {"model": name, "median_speed_m_per_s": median, "sure_speed_m_per_s": 0.8 * median, "mass_flow_t_per_h": 60 * median,
            "budget": [{"source": "rolling friction (not given: 0 to 0.2)", "sd_t_per_h": 0.6, "share_of_variance": 0.64, "sure_if_known_t_per_h": 0.4},
                       {"source": "friction on the trough", "sd_t_per_h": 0.4, "share_of_variance": 0.3, "sure_if_known_t_per_h": 0.1}],
            "mass_flow_low_t_per_h": 46 * median, "mass_flow_high_t_per_h": 74 * median, "probability": 0.962,
            "mass_flow_quantiles_t_per_h": list(60 * median * (0.8 + 0.4 * shares))}


def design():
    return {
        "kind": "design", "made": MADE, "feasible": True, "sentence": "This trough carries 12 t/h with a probability of 95 % or more.",
        "stroke_mm": 12.4, "amplitude_m": 0.0062, "rpm": 742.0, "frequency_hz": 12.37, "vibration_angle_deg": 31.5, "inclination_deg": 0.0,
        "layer_depth_mm": 38.7, "throw_number": 1.998, "machine_number": 3.82, "mode": "FN'", "velocity_efficiency_point_mass": 0.62,
        "landing_speed_m_per_s": 0.291, "friction_low": 0.21, "friction_median": 0.3, "friction_high": 0.39, "power_w": 41.2,
        "mass_flow_wanted_t_per_h": 12.0, "confidence": 0.95, "probability": 0.962, "sure_speed_m_per_s": 0.19,
        "untested": None, "objective": "least-machine-number", "models": [forecast("the point mass", 0.24), forecast("the rolling-layer law", 0.29)],
        "models_beside": [forecast("the atlas", 0.3) | {"probability": None, "sure_speed_m_per_s": None, "mass_flow_quantiles_t_per_h": []}],
        "exciter": {"static_moment_kg_m": 0.84, "centrifugal_force_n": 5074.0, "stroke_empty_mm": 12.9, "trough_mass_kg": 180.0,
                    "moving_mass_kg": 193.0, "material_kg": 41.8, "added_mass_fraction": 0.3,
                    "motors": {"text": "2 x 8 kN at 58 %", "rpm": 1000.0, "static_moment_kg_m": 0.73, "power_w": 560.0, "setting": 0.58, "frequency_converter": True},
                    "springs": {"sag_mm": 21.7, "natural_frequency_empty_hz": 3.8, "natural_frequency_loaded_hz": 3.6, "isolation": 0.91,
                                "force_on_building_n": 620.0, "stroke_ratio_at_start": 3.7, "stroke_ratio_at_stop": 11.8}},
        "depth_in_operation_mm": 28.0, "side_wall_mm": 90.0, "time_on_trough_s": 15.8, "project": "Mill 3", "revision": "B",
        "active_limits": ["layer depth <= 40 mm", "landing speed <= 0.3 m/s"],
        "rules_of_thumb": [
            {"rule": "v = 3.81 N S, of which 70 to 80 % are used in practice", "source": "Daesung Machinery", "speed_m_per_s": 0.292,
             "low_m_per_s": 0.204, "high_m_per_s": 0.234},
            {"rule": "no slip, flight of n cycles: v = g n^2 cot(beta) / (2 f)", "source": "after VDI 2333", "speed_m_per_s": 0.331,
             "low_m_per_s": None, "high_m_per_s": None}],
        "warnings": [f"If the grains can roll, the theory alone is wrong here. {PLANTED}"],
        "task": {"width_m": 0.3, "length_m": 3.0, "bulk_density_kg_per_m3": 600.0, "depth_m": [0.005, 0.04], "rpm": [200.0, 1500.0],
                 "stroke_mm": [2.0, 14.0], "vibration_angle_deg": [20.0, 40.0], "inclination_deg": [0.0, 0.0], "max_machine_number": 4.0,
                 "max_throw_number": 3.29, "max_landing_speed_m_per_s": 0.3, "grain_diameter_mm": 3.5, "rolling_friction": 0.1,
                 "material": "maize (EN 1991-4; size typical)", "surge": 1.3, "drive": "unbalance motors"},
        "quantile_shares": list(np.arange(1, 40) / 40)}


def deep_design():
    """A layer that is deeper than any that was tested: no probability is known."""
    data = design() | {"feasible": False, "sentence": "Not tested: no probability is known.", "untested": "it is too deep", "probability": None,
                       "sure_speed_m_per_s": None}
    for model in data["models"]:
        model |= {"sure_speed_m_per_s": None, "mass_flow_low_t_per_h": None, "mass_flow_high_t_per_h": None, "probability": None,
                  "mass_flow_quantiles_t_per_h": []}
    return data


def quantity(name, median, width, draws):
    return {"name": name, "unit": "1", "median": median, "low": median - width, "high": median + width, "rhat": 1.002, "ess": 2400,
            "remaining": 0.08, "identifiable": True, "ranges": [[median - width, median + width]], "prior": [0.02, 1.2]}, list(draws)


def calibration():
    random = np.random.default_rng(1)
    friction, friction_draws = quantity("friction", 0.45, 0.06, random.normal(0.45, 0.03, 2000))
    missed, missed_draws = quantity("model_discrepancy", 0.08, 0.05, np.exp(random.normal(np.log(0.08), 0.4, 2000)))
    measured = [{"line": line, "amplitude_m": 0.00125, "frequency_hz": rpm / 60, "speed_m_per_s": speed, "uncertainty_m_per_s": 0.003,
                 "model_m_per_s": 0.9 * speed, "model_low_m_per_s": 0.8 * speed, "model_high_m_per_s": 1.05 * speed, "misfit": 1.4}
                for line, rpm, speed in ((2, 1269, 0.0601), (3, 1453, 0.099), (4, 1558, 0.1307))]
    return {"kind": "calibration", "made": MADE, "model": "the point mass", "parameters": [friction], "model_discrepancy": missed,
            "draws": {"friction": friction_draws, "model_discrepancy": missed_draws}, "measurements": measured,
            "best_fit": {"values": [0.5], "chi_square": 31.2, "degrees_of_freedom": 2, "p_value": 1.7e-7}, "converged": True,
            "verdict": [f"No friction explains these 3 speeds by the point mass. {PLANTED}"]}


class Words(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.text, self.addresses, self.scripts = "", [], 0

    def handle_starttag(self, tag, attributes):
        self.scripts += tag == "script"
        self.addresses += [value for name, value in attributes if name in ("src", "href", "xlink:href")]

    def handle_data(self, data):
        self.text += data


def check_words(page, expected):
    words = Words()
    words.feed(page)
    text = " ".join(words.text.split())
    for one in expected:
        assert one in text, (one, text)
    assert words.scripts == 0 and PLANTED in text, "texts are escaped"
    assert all(address.startswith(("#", "data:")) for address in words.addresses), words.addresses
    assert "Vibrotrough 0.1.0 (0123456789ab), written 2026-11-22T13:00:00Z" in text


def check_in_browser(browser, page, work):
    """The page is no wider than a narrow window, and on a usual screen no longer than it."""
    common = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
              f"--user-data-dir={work / 'browser'}"]
    probe = ("<script>document.title = JSON.stringify([innerWidth, document.documentElement.scrollWidth, "
             "document.documentElement.scrollHeight]);</script></body>")
    probed = page.with_name("probed-" + page.name)
    probed.write_text(page.read_text(encoding="utf-8").replace("default-src 'none'", "script-src 'unsafe-inline'")
                      .replace(PLANTED, "").replace("</body>", probe), encoding="utf-8")
    picture, narrow, printed = (work / f"{page.stem}{ending}" for ending in ("-screen.png", "-500.png", ".pdf"))
    for written in (picture, narrow, printed):
        written.unlink(missing_ok=True)
    for (width, height), pictures in ((SCREEN, ()), ((500, 900), (f"--screenshot={narrow}",))):
        done = subprocess.run([*common, f"--window-size={width},{height}", "--dump-dom", *pictures, probed.as_uri()], capture_output=True, text=True,
                              timeout=600)
        found = re.search(r"<title>\[(\d+),(\d+),(\d+)\]</title>", done.stdout)
        assert found, done.stderr[-2000:]
        inner, wide, long = map(int, found.groups())
        assert wide <= inner, f"{page.name} is {wide} pixels wide in a window of {inner}"
        assert width != SCREEN[0] or long <= SCREEN[1], f"{page.name} is {long} pixels long"
    # The page itself, whose policy runs no script.
    subprocess.run([*common, f"--window-size={SCREEN[0]},{SCREEN[1]}", f"--screenshot={picture}", "--no-pdf-header-footer", f"--print-to-pdf={printed}", page.as_uri()],
                   capture_output=True, timeout=600, check=True)
    for written in (picture, narrow):
        assert written.stat().st_size > 20000, written
    sheets = len(re.findall(rb"/Type\s*/Page\b", printed.read_bytes()))
    assert sheets == 1, f"{page.name} takes {sheets} sheets of paper"


def main(scripts, work):
    work = pathlib.Path(work).resolve() / "decision_page"
    work.mkdir(parents=True, exist_ok=True)
    pages = {}
    for data, expected in ((design(), ["12.4 mm", "742 1/min", "31.5\u00b0", "38.7 mm", "landing speed \u2264 0.3 m/s", "allowed 20 to 40\u00b0", "fixed", "96.2 %", "Daesung", "840 kg mm", "5.07 kN; stroke 12.9 mm when empty", "2 x 8 kN at 58 %", "sag 22 mm", "620 N", "193 kg", "15.8 s",
                                    "Mill 3", "revision B", "3.5 mm", "surge of 1.3 times 9.231 t/h",
                                    "the atlas (for comparison)0.3not known18not knownnot known"]),
                           (deep_design(), ["Not tested: no probability is known.", "the point mass0.24not known14.4not knownnot known"]),
                           (calibration(), ["0.45", "0.39 to 0.51 (95 %)", "R-hat up to 1.002", "0.0601 \u00b1 0.003"])):
        path = work / f"{data['kind']}{'_untested' if data.get('untested') else ''}.html"
        (work / "data.json").write_text(json.dumps(data), encoding="utf-8")
        done = subprocess.run([sys.executable, "-B", "-m", "vibrotrough.report.decision", work / "data.json", "--output", path],
                              cwd=scripts, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        check_words(path.read_text(encoding="utf-8"), expected)
        pages[path.stem] = path
    failed = subprocess.run([sys.executable, "-B", "-m", "vibrotrough.report.decision", work / "data.json", "--output",
                             work / "missing" / "x.html"], cwd=scripts, capture_output=True, text=True)
    assert failed.returncode == 1 and failed.stderr.count("\n") == 1 and "--page" in failed.stderr, failed.stderr
    browser = shutil.which("chromium")
    if not browser:
        print("SKIPPED: chromium is not installed")
        sys.exit(77)
    for name in ("design", "calibration"):  # a design that was not tested has the same parts
        check_in_browser(browser, pages[name], work)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
