"""What the interval that was asked for costs, against a careful user.

The careful user writes plain decks by hand: five packings, each settled for itself and started at rest, 60 cycles, the first ten
dropped, Student's t over the five means. The user takes the grains as stiff as the program chooses for a half-width of 0.05, and knows
the same bounds of the numerical errors, so that both are asked for the same whole: the root of the sum of squares of these bounds and
of the statistics that the user reached. The program is then asked for the half-width that the user reached in each case, with
one campaign for all cases. Both run one engine at a time on the same machine in the same minutes, case by case in turn where that
is possible; the processor time of the engines is compared, settling included.

    VIBROTROUGH_BENCH_CASES=6 ctest --preset release -C bench -R bench.Precision -V      # about half an hour

The program is asked for one half-width in all cases, the widest of the user's: a campaign in which every case is at least that
precise, for which the user's plan has to suit the worst case.

VIBROTROUGH_BENCH_CASES=24 runs all cases (throw numbers 1 to 3, three vibration angles); without the variable nothing is run.
VIBROTROUGH_BENCH_TWICE=1 asks for half of the half-width as well. The user then needs 13 packings, because t(0.975; 12) / sqrt(13) is
half of t(0.975; 4) / sqrt(5); their cost is worked out from that of the five.
VIBROTROUGH_BENCH_EACH=1 also asks for the half-width that the user happened to reach in each case: five packings know their scatter so
badly that it comes out much too small in some cases, which then are expensive (the mean of 1 / s^2 over samples of five is twice
1 / sigma^2).
"""

import json
import math
import os
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["VIBROTROUGH_PROGRAM"]
HERE = Path(__file__).resolve().parent
PACKINGS = 5
PACKINGS_FOR_HALF = 13
STUDENT = 2.776  # t(0.975; 4)
CASES = int(os.environ.get("VIBROTROUGH_BENCH_CASES", "0"))
TWICE = os.environ.get("VIBROTROUGH_BENCH_TWICE", "") == "1"
EACH = os.environ.get("VIBROTROUGH_BENCH_EACH", "") == "1"

THROW_NUMBERS = [1.1, 1.3, 1.5, 1.7, 1.9, 2.2, 2.6, 3.0]
TANGENTS = [0.35, 0.5, 0.7]


def child_time():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def timed(*command, **settings):
    before = child_time()
    done = subprocess.run(command, capture_output=True, text=True, **settings)
    return done, child_time() - before


class PrecisionBench(unittest.TestCase):
    def campaign(self, points, measure):
        text = (HERE / "base.toml").read_text() + f"\n[measure]\n{measure}\n[zip]\n"
        for key in points[0]:
            text += f'"{key}" = {json.dumps([point[key] for point in points])}\n'
        path = self.folder / "campaign.toml"
        path.write_text(text)
        return path

    def with_numerics(self, points):
        """The points with the modulus that the program chooses, and the bound of the numerical errors of each."""
        found = subprocess.run([PROGRAM, "check", str(self.campaign(points, "half_width = 0.05")), "--json"], capture_output=True, text=True)
        cases = json.loads(found.stdout)["cases"]
        print(f"grains of {min(case['youngs_modulus_pa'] for case in cases):.3g} to {max(case['youngs_modulus_pa'] for case in cases):.3g} Pa; bounds of "
              f"the numerical errors {min(case['numerical_error'] for case in cases):.3f} to {max(case['numerical_error'] for case in cases):.3f}", flush=True)
        points = [dict(point, **{"grains.youngs_modulus": f"{case['youngs_modulus_pa']:g} Pa"}) for point, case in zip(points, cases)]
        return points, [case["numerical_error"] for case in cases]

    def make_plain(self, folder):
        """A deck as written by hand: it starts at rest and runs for 60 cycles. Those of `vibrotrough deck` are the program's first round."""
        deck = folder / "in.liggghts"
        lines = deck.read_text().splitlines()
        plain = [line for line in lines if "velocity all set" not in line]
        self.assertLessEqual(len(lines) - len(plain), 1)
        deck.write_text("\n".join(plain) + "\n")
        (folder / "control.in").write_text("variable stop equal ${done}>=60\n")

    def careful_user(self, points):
        """Mean, half-width and core time of each case."""
        decks = self.folder / "decks"
        campaign = self.campaign(points, f"packings = {PACKINGS}\nmax_cycles = 60")
        subprocess.run([PROGRAM, "deck", str(campaign), "--output", str(decks)], check=True, capture_output=True)
        found = []
        for number, point in enumerate(points, start=1):
            means, seconds = [], 0.0
            for packing in range(1, PACKINGS + 1):
                folder = decks / f"case-{number:03d}" / f"packing-{packing}"
                self.make_plain(folder)
                for deck in ("settle.liggghts", "in.liggghts"):
                    done, took = timed("liggghts", "-in", deck, cwd=folder)
                    self.assertEqual(done.returncode, 0)
                    seconds += took
                    if deck.startswith("settle"):
                        self.settling += took
                rows = [line.split(",") for line in (folder / "cycles.csv").read_text().splitlines() if line[:1].isdigit()]
                x = [float(row[2]) for row in rows]
                stroke = 2 * math.pi * 0.006 * math.cos(math.atan(point["trough.tan_vibration_angle"]))
                eta = [(b - a) / stroke for a, b in zip(x, x[1:])]
                self.assertEqual(len(eta), 60)
                means.append(sum(eta[10:]) / len(eta[10:]))
            found.append((statistics.mean(means), STUDENT * statistics.stdev(means) / math.sqrt(PACKINGS), seconds))
            print(f"user    {point}: {found[-1][0]:.3f} +- {found[-1][1]:.3f}, {seconds:.0f} core-seconds", flush=True)
        return found

    def ours(self, name, points, half_widths):
        wanted = [dict(point, **{"measure.half_width": math.hypot(width, error)}) for point, width, error in zip(points, half_widths, self.numerics)]
        campaign = self.campaign(wanted, "packings = 4")
        output = self.folder / f"runs-{name.split()[0]}"
        done, seconds = timed(PROGRAM, "run", str(campaign), "--output", str(output), "--jobs", "1", "--quiet", "--accept-findings")
        self.assertIn(done.returncode, (0, 1), done.stderr)
        table = json.loads(subprocess.run([PROGRAM, "compare", str(output), "--json"], capture_output=True, text=True).stdout)
        for row in table:
            print(f"program Gamma {row['throw_number']}, {row['vibration_angle_deg']:.1f} deg: {row['efficiency']} +- "
                  f"{row['efficiency_half_width_statistics']} from {row['packings']} packings, {row['outcome']}", flush=True)  # fmt: skip
        return table, seconds

    def compare(self, name, user, points, asked, spent):
        """Prints what the program spends for these half-widths, beside what the user `spent`."""
        table, seconds = self.ours(name, points, asked)
        apart = sum(abs(mean - row["efficiency"]) > math.hypot(width, row["efficiency_half_width_statistics"])
                    for (mean, width, _), row in zip(user, table) if row["efficiency"] is not None)  # fmt: skip
        finished = [row for row in table if row["outcome"] == "finished"]
        reached = [row["efficiency_half_width_statistics"] / width for row, width in zip(table, asked) if row in finished]
        run = sum((row["cycles_measured"] or 0) + (row["cycles_discarded"] or 0) for row in table)
        print(f"{name} half-width, {len(points)} cases: careful user {spent:.0f} core-seconds, program {seconds:.0f}: "
              f"{seconds / spent:.2f} of it, {run} cycles; {len(finished)} finished, with {statistics.median(reached or [math.nan]):.2f} of the half-width "
              f"asked for (median); {apart} means differ by more than both intervals together", flush=True)  # fmt: skip

    def test_cost_of_what_a_careful_user_reaches(self):
        temporary = tempfile.TemporaryDirectory(prefix="vibrotrough-precision-")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        every = [{"trough.throw_number": gamma, "trough.tan_vibration_angle": tangent} for gamma in THROW_NUMBERS for tangent in TANGENTS]
        points, self.numerics = self.with_numerics(every[:: max(1, len(every) // CASES)][:CASES])
        self.settling = 0.0
        user = self.careful_user(points)
        spent = sum(cost for _, _, cost in user)
        print(f"careful user: {spent:.0f} core-seconds, {self.settling:.0f} of them for settling; {len(user) * PACKINGS * 60} cycles", flush=True)
        widths = [half_width for _, half_width, _ in user]
        self.compare("widest", user, points, [max(widths)] * len(widths), spent)
        if TWICE:
            self.compare("half of the widest", user, points, [max(widths) / 2] * len(widths), spent * PACKINGS_FOR_HALF / PACKINGS)
        if EACH:
            self.compare("each", user, points, widths, spent)


if __name__ == "__main__":
    if CASES == 0:
        print("skipped: set VIBROTROUGH_BENCH_CASES to the number of cases, from 1 to 24")
        sys.exit(77)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that its folder is removed
    unittest.main()
