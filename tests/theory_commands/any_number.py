"""Any double in any option of the theory's commands: an answer, or one line that says what is wrong; never a crash, a hang or a
number that contradicts the energy balance.

    any_number.py PROGRAM [RUNS [SEED]]
"""

import json
import math
import random
import resource
import subprocess
import sys
from typing import Any

# s of processor time: far more than any of these problems needs (a few hundredths), so that only a hang exceeds it.
PATIENCE = 60
SPECIAL = ["0", "-0", "1e-323", "2.2e-308", "1e-300", "1e-100", "1e-17", "1e-16", "1e-12", "1e-9", "1e-6", "0.1", "0.5", "1", "1.0000000000000002",
           "2", "3.2969084", "10", "100", "1e4", "1e6", "1e9", "1e16", "1e100", "1e300", "1.7e308", "1e309", "inf", "-inf", "nan", "-1", "-1e-300",
           "-1e300", "0x1p3", "1,5", "", " ", "1e", "٣"]  # fmt: skip
BASE: dict[str, list[list[str]]] = {
    "drive": [["--throw-number", "2"], ["--machine-number", "4"], ["--throw-number", "0.8"], ["--throw-number", "6"]],
    "angle": [["--vibration-angle", "30 deg"], ["--tan-vibration-angle", "0.25"]],
    "slope": [[], ["--inclination", "-3 deg"], ["--tan-inclination", "0.05"]],
    "friction": [["--friction", "0.3"]],
}
EXTRA = ["--restitution", "--slowest-rebound", "--static-friction", "--landing-friction", "--air-drag", "--along-ratio", "--wall-friction",
         "--wall-pressure-ratio", "--height-over-width"]  # fmt: skip
UNITS = {"--vibration-angle": " deg", "--inclination": " deg", "--along-phase": " deg", "--amplitude": " m", "--gravity": " m/s2"}


def any_number(generator: random.Random) -> str:
    kind = generator.random()
    if kind < 0.4:
        return generator.choice(SPECIAL)
    if kind < 0.8:
        return repr(generator.choice([1, 1, 1, -1]) * 10 ** generator.uniform(-20, 8))
    return repr(generator.uniform(-2, 6))


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


def value_of(answer: dict[str, Any], name: str) -> float:
    return float(answer["quantities"][name]["value"])


def check_energy(words: list[str], answer: dict[str, Any]) -> bool:
    """Work of the trough = losses + lift, J/kg per cycle, where no drag takes a part that is not printed."""
    # The command refuses this; a program before that does not.
    if answer["machine_number"] > 1e9 or not answer["converged"] or "quantities" not in answer or "--air-drag" in words or "--gravity" in words:
        return False
    parts = [value_of(answer, name) for name in ("trough_work", "friction_energy", "impact_energy")]
    slope = answer["tan_inclination"]
    rise = 9.81 * slope / math.hypot(1, slope) * value_of(answer, "conveying_speed") / value_of(answer, "frequency")
    # Rounding of forces over a stroke: g r, beside the energies themselves.
    amplitude = float(words[words.index("--amplitude") + 1].split()[0])
    scale = max(map(abs, (*parts, rise))) + 1e-6 * 9.81 * amplitude
    residual = parts[0] - parts[1] - parts[2] - rise
    # Rebounds below --slowest-rebound lose their energy without being counted: at most its square, of each of 64 cycles.
    allowance = 1e-6 * scale + (1e-2 * scale if "--slowest-rebound" in words or "--restitution" in words else 0)
    assert abs(residual) <= allowance, (words, parts, rise, residual)
    return True


def numbers_in(value: Any) -> list[float]:
    if isinstance(value, dict):
        return [one for inner in value.values() for one in numbers_in(inner)]
    if isinstance(value, list):
        return [one for inner in value for one in numbers_in(inner)]
    return [value] if isinstance(value, float) else []


def main(program: str, runs: int, seed: int) -> None:
    generator = random.Random(seed)
    ends = {0: 0, 1: 0, 2: 0}
    balanced = 0
    for _ in range(runs):
        words = any_words(generator)
        command = [program, "theory", "point", "--json"] + [f"{option}={value}" for option, value in zip(words[::2], words[1::2])]
        done = subprocess.run(command, capture_output=True, text=True, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE)))  # fmt: skip
        assert done.returncode in ends, (command, done.returncode, done.stderr)
        ends[done.returncode] += 1
        if done.returncode == 2:
            assert done.stderr.startswith("vibrotrough: ") and done.stderr.count("\n") == 1 and not done.stdout, (command, done)
            continue
        answer = json.loads(done.stdout)
        assert all(map(math.isfinite, numbers_in(answer))), (command, answer)
        assert done.returncode == (1 if answer["velocity_efficiency"] is None else 0), (command, answer)
        balanced += check_energy(words, answer)
    print(f"{runs} command lines: {ends[0]} solved, {ends[1]} run away, {ends[2]} refused; {balanced} energy balances held")
    assert balanced > runs / 20


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3, 4):
        sys.exit(__doc__)
    main(sys.argv[1], *(int(one) for one in (sys.argv[2:] + ["400", "1"][len(sys.argv) - 2 :])))
