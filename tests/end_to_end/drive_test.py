"""The mesh's motion in the real engine, read back step by step, against the motion that was asked for."""

import math
import subprocess
import shutil
import unittest

from trough_program import PATIENCE, EndToEndTest

AMPLITUDE, TAN_ANGLE = 3e-3, 0.5
ALONG, NORMAL = (AMPLITUDE * f(math.atan(TAN_ANGLE)) for f in (math.cos, math.sin))


class Drive(EndToEndTest):
    def motion(self, changes):
        """(steps per cycle, [(step, x, z), ...]) of a mesh that carries one grain over three cycles."""
        campaign = self.write_campaign({"layer.grains": 1, "measure.packings": 1, "measure.max_cycles": 20, **changes})
        decks = self.folder / "decks"
        told = self.call("deck", campaign, "--output", decks)
        self.assertEqual(told.returncode, 0, told.stderr)
        packing = decks / "case-001" / "packing-1"
        deck = packing / "in.liggghts"
        text = deck.read_text()
        # A line per step, and three cycles are enough.
        text = text.replace(
            "label           cycle\n",
            'fix             seen all print 1 "${now},${trough_x},${trough_z}" file motion.csv screen no\nlabel           cycle\n',
            1,
        ).replace('if "${done} >= 20"', 'if "${done} >= 3"')
        deck.write_text(text)
        for name in ("settle.liggghts", "in.liggghts"):
            done = subprocess.run(
                [shutil.which("liggghts"), "-in", name], cwd=packing, capture_output=True, text=True, timeout=PATIENCE
            )
            self.assertEqual(done.returncode, 0, done.stdout[-2000:])
        steps = next(int(line.split()[3]) for line in text.splitlines() if line.startswith("variable        n equal"))
        rows = [line.split(",") for line in (packing / "motion.csv").read_text().splitlines() if line[:1].isdigit()]
        self.assertEqual(len(rows), 3 * steps)
        return steps, [(int(k), float(x), float(z)) for k, x, z in rows]

    def assert_moves(self, changes, along, normal):
        """`along`, `normal`: the displacement wanted at an angle, m. The mover is exact: 1e-9 of the amplitude is
        what the sum of 10,000 increments of 15 digits may lose; offset and phase error are below that, too."""
        steps, rows = self.motion(changes)
        worst = 0
        for step, x, z in rows:
            angle = 2 * math.pi * (step % steps) / steps
            worst = max(worst, abs(x - (along(angle) - along(0))), abs(z - (normal(angle) - normal(0))))
        self.assertLess(worst, 1e-9 * AMPLITUDE)

    def test_sinusoid(self):
        self.assert_moves({}, lambda t: ALONG * math.sin(t), lambda t: NORMAL * math.sin(t))

    def test_ellipse_with_harmonics(self):
        def part(t):
            return 0.2 / 625 * math.sin(25 * t) - 0.3 / 9 * math.sin(3 * t - math.radians(40))

        self.assert_moves(
            {"trough.along_phase": "20 deg", "trough.harmonics": ["25, 0.2, 0 deg", "3, -0.3, -40 deg"]},
            lambda t: ALONG * (math.sin(t + math.radians(20)) + part(t)),
            lambda t: NORMAL * (math.sin(t) + part(t)),
        )

    def test_measured_waveform(self):
        def along(t):
            return ALONG * math.sin(t + 0.2) + 2e-4 * math.sin(4 * t - 1) + 1e-4 * math.cos(7 * t)

        def normal(t):
            return NORMAL * math.sin(t) + 3e-4 * math.sin(2 * t)

        period, count = 0.08, 64
        rows = [f"{period * i / count!r},{along(2 * math.pi * i / count)!r},{normal(2 * math.pi * i / count)!r}" for i in range(count)]
        (self.folder / "shaker.csv").write_text("\n".join(["time_s,x_m,z_m", *rows]) + "\n")
        changes = {"trough.throw_number": None, "trough.frequency": "12.5 Hz", "trough.waveform": "shaker.csv"}
        self.assert_moves(changes, along, normal)


if __name__ == "__main__":
    unittest.main()
