"""Any double in any option of the theory's commands: an answer, or one line that says what is wrong; never a crash, a hang or a
number that contradicts the energy balance.

    any_number.py PROGRAM [RUNS [SEED]]

RUNS command lines of `point`, and a tenth of this of each of `map`, `batch` and `trace`.
"""

import collections
import csv
import io
import json
import math
import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

# s of processor time of one motion. Most take a few hundredths; the slowest that were seen, a half. A second is what the
# documentation promises.
PATIENCE = 1.0
# s of a search over hundreds of motions, or a map of nine with its lines between modes.
SEARCH_PATIENCE = 30.0
SPECIAL = ["0", "-0", "1e-323", "2.2e-308", "1e-300", "1e-100", "1e-17", "1e-16", "1e-12", "1e-9", "1e-6", "0.1", "0.5", "1", "1.0000000000000002",
           "2", "3.2969084", "10", "100", "1e4", "1e6", "1e9", "1e16", "1e100", "1e300", "1.7e308", "1e309", "inf", "-inf", "nan", "-1", "-1e-300",
           "-1e300", "0x1p3", "1,5", "", " ", "1e", "٣"]  # fmt: skip
BASE: dict[str, list[list[str]]] = {
    "drive": [["--throw-number", "2"], ["--machine-number", "4"], ["--throw-number", "0.8"], ["--throw-number", "6"], ["--throw-number", "60"]],
    "angle": [["--vibration-angle", "30 deg"], ["--tan-vibration-angle", "0.25"]],
    "slope": [[], ["--inclination", "-3 deg"], ["--tan-inclination", "0.05"]],
    "friction": [["--friction", "0.3"]],
}
EXTRA = ["--restitution", "--slowest-rebound", "--static-friction", "--landing-friction", "--air-drag", "--along-ratio", "--wall-friction",
         "--wall-pressure-ratio", "--height-over-width"]  # fmt: skip
UNITS = {"--vibration-angle": " deg", "--inclination": " deg", "--along-phase": " deg", "--amplitude": " m", "--gravity": " m/s2"}
# What has nothing but the trough's sinusoid, so that its position is known here.
SINUSOIDAL = ("--along-ratio", "--along-phase", "--harmonic-along", "--harmonic-normal")
AXES = ["throw_number", "machine_number", "vibration_angle_deg", "tan_vibration_angle", "inclination_deg", "tan_inclination", "friction", "restitution",
        "static_friction", "air_drag", "along_ratio", "along_phase_deg", "wall_friction", "landing_friction"]  # fmt: skip
GRAVITY = 9.81


def any_number(generator: random.Random) -> str:
    kind = generator.random()
    if kind < 0.4:
        return generator.choice(SPECIAL)
    if kind < 0.8:
        return repr(generator.choice([1, 1, 1, -1]) * 10 ** generator.uniform(-20, 8))
    return repr(generator.uniform(-2, 6))


def any_range(generator: random.Random, low: float, high: float) -> tuple[str, str]:
    """The ends of a range: mostly within the usual one, so that there is something to solve."""
    ends = sorted(generator.uniform(low, high) for _ in range(2))
    return tuple(any_number(generator) if generator.random() < 0.2 else repr(end) for end in ends)  # type: ignore[return-value]


def any_words(generator: random.Random) -> list[str]:
    words = [word for group in BASE.values() for word in generator.choice(group)]
    for option in generator.sample(EXTRA, generator.choice([0, 0, 1, 1, 2])):
        words += [option, any_number(generator)]
    if generator.random() < 0.15:
        words += ["--along-phase", any_number(generator) + " deg"]
    if generator.random() < 0.15:
        words += [generator.choice(["--harmonic-along", "--harmonic-normal"]), f"{generator.randint(-1, 1100)},{any_number(generator)},{any_number(generator)} deg"]
    words += ["--amplitude", "6 mm"]
    for _ in range(generator.choice([0, 1, 1, 2])):
        options = [i for i in range(0, len(words), 2) if not words[i].startswith("--harmonic")]
        i = generator.choice(options)
        words[i + 1] = any_number(generator) + UNITS.get(words[i], "")
    return words


class Theory:
    """The theory's commands, and how they ended."""

    def __init__(self, program: str) -> None:
        self.program = program
        self.ends: collections.Counter[tuple[str, int]] = collections.Counter()
        self.slowest = (0.0, "")

    def call(self, command: str, words: list[str], more: list[str], patience: float = PATIENCE) -> subprocess.CompletedProcess[str]:
        """Runs a command. It ends with 0, with 1 when there is no number, or with 2 and one line after the warnings; and in time."""
        line = [self.program, "theory", command, *more] + [f"{option}={value}" for option, value in zip(words[::2], words[1::2])]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        limit = math.ceil(20 * patience)  # for whom is slower than this the reason is a hang
        done = subprocess.run(line, capture_output=True, text=True, check=False, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.slowest = max(self.slowest, (seconds if patience == PATIENCE else 0.0, " ".join(line[1:])))
        assert seconds < patience, (line, seconds)
        assert done.returncode in (0, 1, 2), (line, done.returncode, done.stderr)
        if done.returncode == 2:
            errors = [said for said in done.stderr.splitlines() if not said.startswith("vibrotrough: warning: ")]
            assert len(errors) == 1 and errors[0].startswith("vibrotrough: ") and not done.stdout, (line, done)
        self.ends[command, done.returncode] += 1
        return done


def value_of(answer: dict[str, Any], name: str) -> float:
    return float(answer["quantities"][name]["value"])


def length_of(words: list[str], option: str) -> float:
    """m"""
    number, unit = words[words.index(option) + 1].split()
    return float(number) * {"m": 1.0, "mm": 1e-3}[unit]


def stored_energies(theory: Theory, words: list[str], answer: dict[str, Any]) -> tuple[float, float] | None:
    """The mass's energy at the begin and at the end of what was averaged, J/kg, and its duration in cycles."""
    done = theory.call("trace", words, ["--samples=2"])
    if done.returncode != 0:
        return None
    slope, tangent, omega = answer["tan_inclination"], answer["tan_vibration_angle"], 2 * math.pi * value_of(answer, "frequency")
    amplitude = length_of(words, "--amplitude")
    stored = []
    for row in csv.DictReader(io.StringIO(done.stdout)):
        number = {name: float(value) for name, value in row.items() if name != "phase"}
        place = amplitude * math.sin(omega * number["time_s"])
        x, y = place / math.hypot(1, tangent), place * tangent / math.hypot(1, tangent) + number["gap_m"]
        speed = number["mass_velocity_x_m_per_s"] ** 2 / 2 + number["mass_velocity_y_m_per_s"] ** 2 / 2
        stored.append((number["time_s"], speed + GRAVITY * (slope * x + y) / math.hypot(1, slope)))
    cycles = (stored[1][0] - stored[0][0]) * omega / (2 * math.pi)
    return stored[1][1] - stored[0][1], cycles


def check_energy(theory: Theory, words: list[str], answer: dict[str, Any]) -> str:
    """Work of the trough = losses + lift + what the mass has more at the end, J/kg per cycle, where no drag takes a part that is not
    printed. @return what was checked"""
    if "quantities" not in answer:
        return ""
    assert None not in [quantity["value"] for quantity in answer["quantities"].values()], (words, answer)
    if "--air-drag" in words or "--gravity" in words:
        return ""
    parts = [value_of(answer, name) for name in ("trough_work", "friction_energy", "impact_energy")]
    slope = answer["tan_inclination"]
    rise = GRAVITY * slope / math.hypot(1, slope) * value_of(answer, "conveying_speed") / value_of(answer, "frequency")
    gain, spread = 0.0, 0.0
    if not answer["converged"]:
        if any(option in words for option in SINUSOIDAL):
            return ""
        energies = stored_energies(theory, words, answer)
        if energies is None:
            return ""
        gain = energies[0] / energies[1]
        # The speed is the mean over all cycles; where the pieces are those of the last of them, it differs by its interval.
        spread = 3 * abs(rise) * answer["half_width"] / max(abs(answer["velocity_efficiency"]), 1e-300)
    # Rounding of forces over a stroke: g r, beside the energies themselves.
    scale = max(map(abs, (*parts, rise, gain))) + 1e-6 * GRAVITY * length_of(words, "--amplitude")
    residual = parts[0] - parts[1] - parts[2] - rise - gain
    # Rebounds below --slowest-rebound lose their energy without being counted: at most its square, of each of 64 cycles.
    allowance = 1e-6 * scale + spread + (1e-2 * scale if "--slowest-rebound" in words or "--restitution" in words else 0)
    assert abs(residual) <= allowance, (words, parts, rise, gain, residual, allowance)
    # A mass that is conveyed is pushed.
    if abs(answer["velocity_efficiency"]) > 1e-6 and answer["friction"] > 1e-6:
        assert value_of(answer, "largest_normal_force") > 0 or value_of(answer, "largest_impulse") > 0, (words, answer)
    return "periodic" if answer["converged"] else "averaged"


def numbers_in(value: Any) -> list[float]:
    if isinstance(value, dict):
        return [one for inner in value.values() for one in numbers_in(inner)]
    if isinstance(value, list):
        return [one for inner in value for one in numbers_in(inner)]
    return [value] if isinstance(value, float) else []


def try_points(theory: Theory, generator: random.Random, runs: int) -> collections.Counter[str]:
    balanced: collections.Counter[str] = collections.Counter()
    for _ in range(runs):
        words = any_words(generator)
        done = theory.call("point", words, ["--json"])
        if done.returncode == 2:
            continue
        answer = json.loads(done.stdout)
        assert all(map(math.isfinite, numbers_in(answer))), (words, answer)
        assert done.returncode == (1 if answer["velocity_efficiency"] is None else 0), (words, answer)
        balanced[check_energy(theory, words, answer)] += 1
    return balanced


def try_traces(theory: Theory, generator: random.Random, runs: int) -> None:
    for _ in range(runs):
        done = theory.call("trace", any_words(generator), ["--samples=50"])
        for row in csv.DictReader(io.StringIO(done.stdout)):
            assert all(math.isfinite(float(value)) for name, value in row.items() if name != "phase"), row


def try_batches(theory: Theory, generator: random.Random, runs: int, folder: Path) -> None:
    for _ in range(runs):
        names = ["throw_number", "tan_vibration_angle", "friction"] + generator.sample(AXES[8:], 2)
        rows = [[any_number(generator) if generator.random() < 0.3 else fixed for fixed in ("2", "0.5", "0.3", "", "")] for _ in range(3)]
        (folder / "in.csv").write_text("\n".join(",".join(f'"{cell}"' for cell in row) for row in [names, *rows]) + "\n")
        (folder / "out.csv").unlink(missing_ok=True)
        done = theory.call("batch", [], [str(folder / "in.csv"), f"--output={folder}/out.csv"], 3 * PATIENCE)
        if done.returncode == 0:
            for row in csv.DictReader((folder / "out.csv").open()):
                efficiency = float(row["velocity_efficiency"] or "nan")
                assert math.isfinite(efficiency) or row["converged"] in ("0", "false", "no"), row


def try_maps(theory: Theory, generator: random.Random, runs: int, folder: Path) -> None:
    for _ in range(runs):
        x, y = generator.sample(AXES, 2)
        low, high = any_range(generator, 0, 6)
        axes = [f"--x={x}={low}:{high}:3", f"--y={y}=0.1:0.6:3"]
        given = {"drive": ("throw_number", "machine_number"), "angle": ("vibration_angle_deg", "tan_vibration_angle"),
                 "slope": ("inclination_deg", "tan_inclination"), "friction": ("friction",)}  # fmt: skip
        words = [word for name, group in BASE.items() if x not in given[name] and y not in given[name] for word in generator.choice(group)]
        theory.call("map", words, [*axes, f"--output={folder}/map.h5", "--jobs=1"], SEARCH_PATIENCE)


def main(program: str, runs: int, seed: int) -> None:
    generator = random.Random(seed)
    theory = Theory(program)
    balanced = try_points(theory, generator, runs)
    with tempfile.TemporaryDirectory() as place:
        few = max(runs // 10, 1)
        try_traces(theory, generator, few)
        try_batches(theory, generator, few, Path(place))
        try_maps(theory, generator, few, Path(place))
    for command in sorted({name for name, _ in theory.ends}):
        ends = [theory.ends[command, code] for code in (0, 1, 2)]
        print(f"{command}: {sum(ends)} command lines: {ends[0]} solved, {ends[1]} without a steady speed, {ends[2]} refused")
    print(f"energy balances that held: {balanced['periodic']} periodic, {balanced['averaged']} averaged; the slowest motion took {theory.slowest[0]:.2f} s")
    assert balanced["periodic"] > runs / 20


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3, 4):
        sys.exit(__doc__)
    main(sys.argv[1], *(int(one) for one in (sys.argv[2:] + ["400", "1"][len(sys.argv) - 2 :])))
