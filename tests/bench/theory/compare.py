#!/usr/bin/env python3
"""What a point of the theory costs: ours, CVODE and scipy's solve_ivp, in one run.

    cmake --build --preset release --target conveyor_bench
    tests/bench/theory/compare.py build/release/tests/bench/theory/conveyor_bench
"""

import math
import subprocess
import sys
import time
from collections.abc import Callable

from scipy.integrate import solve_ivp  # type: ignore[import-untyped]

RELATIVE, ABSOLUTE, SAME, MOST_CYCLES = 1e-9, 1e-11, 1e-8, 100
TURN = 2 * math.pi
Point = dict[str, float]


class Mass:
    """A point mass on a trough with one sine in each direction, phase by phase, for a general integrator."""

    def __init__(self, p: Point) -> None:
        self.weight = 1 / p["gamma"]
        self.gravity = p["tan_alpha"] * p["tan_beta"] * self.weight
        self.kinetic = p["mu"] * p["tan_beta"]
        self.limit = p.get("static", p["mu"]) * p["tan_beta"]
        self.landing = p.get("landing", p["mu"]) * p["tan_beta"]
        self.drag, self.lead = p.get("drag", 0.0), p.get("lead", 0.0)

    def force(self, t: float) -> float:
        return self.weight - math.sin(t) + self.drag * math.cos(t)

    def needed(self, t: float) -> float:
        return self.gravity - math.sin(t + self.lead) + self.drag * math.cos(t + self.lead)

    def contact(self, t: float, v: float) -> int:
        """The sign of the slide that begins; 0 for rest."""
        if v != 0:
            return 1 if v > 0 else -1
        if abs(self.needed(t)) <= self.limit * self.force(t) + 1e-12:
            return 0
        return 1 if self.needed(t) < 0 else -1

    def slide(self, t: float, v: float, end: float, sign: int) -> tuple[float, float, float, str]:
        """Until the slide stops, the mass takes off or `end`: time, velocity, distance and what happened."""

        def rate(s: float, y: list[float]) -> list[float]:
            return [y[1], -self.needed(s) - self.drag * y[1] - sign * self.kinetic * self.force(s)]

        def stops(_s: float, y: list[float]) -> float:
            return y[1]

        def leaves(s: float, _y: list[float]) -> float:
            return self.force(s)

        answer = integrate(rate, t, end, [0.0, v if v != 0 else sign * 1e-14], [(stops, -sign), (leaves, -1)])
        what = "stops" if len(answer.t_events[0]) else "leaves" if len(answer.t_events[1]) else "ends"
        return answer.t[-1], 0.0 if what == "stops" else answer.y[1, -1], answer.y[0, -1], what

    def fly(self, t: float, v: float, gap: float, gap_rate: float, end: float) -> tuple[float, list[float], bool]:
        def rate(s: float, y: list[float]) -> list[float]:
            return [y[1], -self.needed(s) - self.drag * y[1], y[3], -self.force(s) - self.drag * y[3]]

        def lands(_s: float, y: list[float]) -> float:
            return y[2]

        answer = integrate(rate, t, end, [0.0, v, gap, gap_rate], [(lands, -1)])
        return answer.t[-1], list(answer.y[:, -1]), len(answer.t_events[0]) > 0

    def rest(self, t: float, end: float) -> tuple[float, str]:
        """Where friction or contact gives way, by the same integrator."""
        margins = [(lambda s, _y: self.limit * self.force(s) - abs(self.needed(s)), -1), (lambda s, _y: self.force(s), -1)]
        answer = integrate(lambda _s, _y: [0.0], t, end, [0.0], margins)
        return answer.t[-1], "slips" if len(answer.t_events[0]) else "leaves" if len(answer.t_events[1]) else "ends"


def integrate(rate: Callable, t: float, end: float, y: list[float], events: list) -> "solve_ivp":  # type: ignore[valid-type]
    for function, direction in events:
        function.terminal, function.direction = True, direction
    return solve_ivp(rate, (t, end), y, method="DOP853", rtol=RELATIVE, atol=ABSOLUTE, max_step=0.5,
                     events=[function for function, _ in events])


def efficiency(p: Point) -> float:
    mass = Mass(p)
    t, v, gap, gap_rate, flying = 0.0, 0.0, 0.0, 0.0, False
    before = (math.inf, math.inf, math.inf)
    for cycle in range(1, MOST_CYCLES):
        moved, end = 0.0, TURN * cycle
        while t < end:
            if flying:
                t, (x, v, gap, gap_rate), landed = mass.fly(t, v, gap, gap_rate, end)
                moved += x
                if landed:
                    v = math.copysign(max(abs(v) - mass.landing * -gap_rate, 0.0), v)
                    gap = gap_rate = 0.0
                    flying = mass.force(t) < 0
                continue
            sign = mass.contact(t, v)
            if sign == 0:
                t, what = mass.rest(t, end)
                v = 0.0
                if what == "slips":
                    v = math.copysign(1e-14, -mass.needed(t))
            else:
                t, v, x, what = mass.slide(t, v, end, sign)
                moved += x
            flying = what == "leaves"
        now = (moved, v, gap)
        if all(abs(a - b) < SAME for a, b in zip(now, before)):
            return moved / TURN
        before = now
    return math.nan


EXTENSIONS: dict[str, Point] = {
    "plastic sine": {},
    "ellipse": {"lead": math.radians(20)},
    "static friction": {"static": 0.5},
    "air drag": {"drag": 0.1},
    "landing friction": {"landing": 0.2},
}


def solve_ivp_cost(extension: Point) -> float:
    """Milliseconds of CPU per point, the median of nine."""
    costs = []
    for gamma in (0.9, 1.6, 2.6):
        for beta in (15.0, 30.0, 45.0):
            start = time.process_time()
            efficiency({"gamma": gamma, "tan_beta": math.tan(math.radians(beta)), "tan_alpha": -0.1, "mu": 0.35} | extension)
            costs.append(1e3 * (time.process_time() - start))
    return sorted(costs)[4]


def main() -> None:
    table = subprocess.run(sys.argv[1:2], capture_output=True, text=True, check=True).stdout
    for line in table.splitlines():
        name = line[:16].strip()
        if name == "model":
            line += "  solve_ivp     ratio"
        elif name in EXTENSIONS:
            milliseconds = solve_ivp_cost(EXTENSIONS[name])
            line += f" {1e3 * milliseconds:10.0f} {1e3 * milliseconds / float(line.split()[-6]):9.0f}"
        print(line, flush=True)


if __name__ == "__main__":
    main()
