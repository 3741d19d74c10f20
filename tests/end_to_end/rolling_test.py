"""The contacts at the floor, measure.rolling: single spheres against mechanics, a layer against what numpy makes of the engine's dumps,
and what happens when the file is damaged. All with the real engine.
"""

import math
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from trough_program import EndToEndTest

GRAVITY = 9.81
FRICTION = 0.23
RADIUS = 0.0015
MASS = 1400 * 4 / 3 * math.pi * RADIUS**3

# One sphere on a trough that moves by a micrometre once per second, with 4e-6 of the acceleration of gravity: it is at rest.
ONE = {
    "trough.amplitude": "1 um", "trough.throw_number": None, "trough.frequency": "1 Hz", "grains.diameter_spread": 0,
    "grains.youngs_modulus": "5 MPa",
    "layer.grains": 1, "measure.packings": 1, "measure.max_cycles": 20, "measure.rolling": True,
}  # fmt: skip
LAYER = {"measure.packings": 1, "measure.half_width": 0.5, "measure.rolling": True}


def read_table(path):
    """Columns by name, as numpy reads them."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return np.genfromtxt(lines, delimiter=",", names=True)


def read_dumps(path):
    """The snapshots of a text dump: {step: {column: values}}."""
    lines = path.read_text().splitlines()
    snapshots, at = {}, 0
    while at < len(lines):
        count, names = int(lines[at + 3]), lines[at + 8].split()[2:]
        rows = [[float(word) for word in line.split()] for line in lines[at + 9 : at + 9 + count]]
        snapshots[int(lines[at + 1])] = dict(zip(names, np.array(rows).reshape(count, len(names)).T))
        at += 9 + count
    return snapshots


class Rolling(EndToEndTest):
    def make_deck(self, changes):
        """The folder of a packing that has settled."""
        campaign = self.write_campaign(changes)
        shutil.rmtree(self.folder / "decks", ignore_errors=True)
        done = self.call("deck", campaign, "--output", self.folder / "decks")
        self.assertEqual(done.returncode, 0, done.stderr)
        (deck,) = self.folder.glob("decks/*/packing-1")
        self.run_deck(deck, "settle.liggghts")
        return deck

    def run_deck(self, deck, script="in.liggghts"):
        done = subprocess.run([self.engine, "-in", script], cwd=deck, capture_output=True, text=True, errors="replace")
        self.assertEqual(done.returncode, 0, done.stdout[-500:])

    def run_one(self, angle, before="", after=""):
        """One cycle of one sphere under gravity tilted by `angle` (positive: downhill along x). (phases, rolling) as tables."""
        deck = self.make_deck(ONE)
        (deck / "control.in").write_text("variable stop equal 1\n")
        script = deck / "in.liggghts"
        text = script.read_text()
        level = "gravity 9.81 vector 0 0 -1"
        self.assertIn(level, text)
        text = text.replace(level, f"gravity 9.81 vector {math.sin(angle)} 0 {-math.cos(angle)}").replace(*(before or ("", "")))
        marker = "# --- drive"
        self.assertIn(marker, text)
        script.write_text(text.replace(marker, after + marker, 1))
        self.run_deck(deck)
        steps = int(text.split("variable        n equal ")[1].split()[0])
        time_step = float(text.split("timestep        ")[1].split()[0])
        rolling, phases = read_table(deck / "rolling.csv"), read_table(deck / "phases.csv")
        self.assertEqual(list(rolling["step"]), [3 * steps // 100 * i for i in range(1, 34)])
        return phases, rolling, phases["step"] * time_step

    def check_lever(self, rolling):
        """The floor's torque is its force times the lever R - overlap / 2: less than R, by a ten-thousandth here."""
        pushed = np.abs(rolling["floor_x"]) > 1e-7
        lever = -rolling["floor_torque"][pushed] / rolling["floor_x"][pushed]
        self.assertTrue(np.all((lever < RADIUS) & (lever > 0.999 * RADIUS)), lever)
        # Nothing but the floor turns a single sphere. The floor's torque was worked out with the speed at the whole step.
        np.testing.assert_allclose(rolling["torque"], rolling["floor_torque"], rtol=2e-2, atol=1e-12)
        self.assertTrue(np.all(rolling["contacts"] == 0) and np.all(rolling["all_contacts"] == 0))

    def test_a_sphere_that_rolls_down(self):
        """m a = m g sin - F and (2/5) m R^2 a/R = F R give F = (2/7) m g sin(theta), a = (5/7) g sin(theta), omega = v/R."""
        angle = math.radians(5)
        # A tangential spring without damping would swing for ever when gravity is tilted at once.
        phases, rolling, time = self.run_one(angle, before=("tangential_damping off", "tangential_damping on"))
        late = slice(10, None)  # the first 0.1 s are left to the spring
        # The overlap shortens the lever by 0.03 %; the start takes a few milliseconds of 1.3 s.
        np.testing.assert_allclose(rolling["floor_x"][late], -2 / 7 * MASS * GRAVITY * math.sin(angle), rtol=5e-3)
        np.testing.assert_allclose(rolling["floor_z"][late], MASS * GRAVITY * math.cos(angle), rtol=1e-3)
        self.assertTrue(np.all(rolling["loaded"][late] == 1) and np.all(rolling["sliding"][late] == 0))
        late = slice(30, None)
        np.testing.assert_allclose(phases["touching_vx"][late], 5 / 7 * GRAVITY * math.sin(angle) * time[late], rtol=5e-3)
        np.testing.assert_allclose(phases["touching_spin"][late], phases["touching_vx"][late], rtol=2e-3, err_msg="it does not slip")
        np.testing.assert_allclose(rolling["first_spin"], phases["touching_spin"][2::3], rtol=1e-12, atol=1e-15)
        self.check_lever(rolling)

    def test_a_sphere_that_slides_down(self):
        """tan(theta) above (7/2) mu: F = mu N, a = g (sin - mu cos), (2/5) m R^2 omega' = F R."""
        angle = math.radians(45)
        phases, rolling, time = self.run_one(angle)
        late = slice(10, None)
        normal = MASS * GRAVITY * math.cos(angle)
        np.testing.assert_allclose(rolling["floor_z"][late], normal, rtol=1e-3)
        np.testing.assert_allclose(rolling["floor_x"][late], -FRICTION * rolling["floor_z"][late], rtol=1e-9)
        np.testing.assert_allclose(rolling["friction"][late], FRICTION * normal, rtol=1e-3)
        self.assertTrue(np.all(rolling["loaded"][late] == 1) and np.all(rolling["sliding"][late] == 1))
        speed = GRAVITY * (math.sin(angle) - FRICTION * math.cos(angle)) * time
        spin = 5 / 2 * FRICTION * GRAVITY * math.cos(angle) * time
        late = slice(30, None)
        np.testing.assert_allclose(phases["touching_vx"][late], speed[late], rtol=5e-3)
        np.testing.assert_allclose(phases["touching_spin"][late], spin[late], rtol=5e-3)
        self.check_lever(rolling)

    def test_a_sphere_that_lands_with_spin(self):
        """Friction keeps v + (2/5) R omega, so that a sphere which grips in the end rolls with v' = (5 v + 2 R omega) / 7. Until then it
        slides, for 0.06 s here. The impulse of the floor up to t is m (g t - w) once the hops are over that begin with the speed w
        upwards; hence v = v_0 - mu (g t - w)."""
        speed, spin, hop = 0.3, -100.0, 0.02
        launch = f"velocity all set {speed} 0 {hop}\nset group all omegay {spin}\n"
        phases, rolling, time = self.run_one(0, after=launch)
        self.assertEqual((rolling["loaded"][0], rolling["sliding"][0]), (1, 1))
        np.testing.assert_allclose(rolling["friction"][0], FRICTION * MASS * GRAVITY, rtol=1e-2)
        np.testing.assert_allclose(phases["touching_vx"][2], speed - FRICTION * (GRAVITY * time[2] - hop), rtol=5e-3)
        # The tangential spring of the engine swings on by itself after the grip, by 0.5 % of the speed: hence means.
        late = slice(60, None)
        rolls = (5 * speed + 2 * RADIUS * spin) / 7
        self.assertAlmostEqual(np.mean(phases["touching_vx"][late]), rolls, delta=2e-3 * rolls)
        slip = phases["touching_vx"][late] - phases["touching_spin"][late]
        self.assertLess(abs(np.mean(slip)), 5e-3 * rolls)
        self.assertTrue(np.all(rolling["sliding"][20:] == 0), "it has gripped")
        kept = rolling["first_vx"] + 2 / 5 * rolling["first_spin"]
        # Besides the lever, which is shorter by the overlap of the impact (1 % of R for a thousandth of a second).
        np.testing.assert_allclose(kept, speed + 2 / 5 * RADIUS * spin, rtol=5e-3)

    def test_a_layer_in_numpy(self):
        """All columns of three cycles, worked out again by numpy from a second run, which writes a dump instead of them."""
        deck = self.make_deck(LAYER)
        (deck / "control.in").write_text("variable stop equal ${done}>=3\n")
        self.run_deck(deck)
        rolling, phases = read_table(deck / "rolling.csv"), read_table(deck / "phases.csv")[2::3]
        self.assertEqual(len(rolling), 100)
        script = deck / "in.liggghts"
        text = script.read_text()
        begin = text.index("fix             floor_lines all print ")
        end = text.index("\n", begin) + 1
        every = text[begin:end].split()[4]
        dump = (f"dump grains all custom {every} grains.dump id x y z vx omegay radius tqy f_force_floor[1] f_force_floor[2] f_force_floor[3]\n"
                f"dump_modify grains sort id format \"%d {' '.join(['%.17g'] * 10)}\"\n")  # fmt: skip
        script.write_text(text[:begin] + dump + text[end:])
        self.run_deck(deck)
        grains = read_dumps(deck / "grains.dump")
        for line, phase in zip(rolling, phases):
            self.check_grains(line, phase, grains[int(line["step"])])
            self.check_floor(line, grains[int(line["step"])])
        self.assertGreater(np.max(rolling["sliding"]), 5)
        self.assertTrue(np.any((rolling["sliding"] < rolling["loaded"]) & (rolling["loaded"] > 5)))

    def check_floor(self, line, grains):
        force_x, force_y, force_z = (grains[f"f_force_floor[{i}]"] for i in (1, 2, 3))
        loaded = force_z > 0
        self.assertEqual(line["loaded"], np.sum(loaded))
        friction = np.hypot(force_x, force_y)
        self.assertAlmostEqual(line["friction"], np.sum(friction), delta=1e-14)
        self.assertEqual(line["sliding"], np.sum(np.abs(friction[loaded] / (FRICTION * force_z[loaded]) - 1) < 1e-8))
        self.assertAlmostEqual(line["floor_z"], np.sum(force_z), delta=1e-13)
        self.assertAlmostEqual(line["floor_x"], np.sum(force_x), delta=1e-13)
        # The engine's compute works the contacts out again with the speeds at the whole step, which changes the damping; the
        # overlaps, up to 3 % of R in these soft grains, shorten the levers by half of themselves.
        most = FRICTION * RADIUS * np.sum(force_z)
        self.assertAlmostEqual(line["floor_torque"], -np.sum(force_x * grains["radius"]), delta=0.1 * most + 1e-9)

    def check_grains(self, line, phase, grains):
        x, y, z, radius = grains["x"], grains["y"], grains["z"], grains["radius"]
        base = phase["trough_z"] + max(phase["clearance"], 0)
        touches = z - radius < phase["trough_z"]
        d = 2 * RADIUS
        spin = grains["omegay"] * radius
        for name, inside in (("first", z < base + d), ("second", (z >= base + d) & (z < base + 2 * d))):
            self.assertEqual(line[name], np.sum(inside))
            self.assertAlmostEqual(line[f"{name}_vx"], np.sum(grains["vx"][inside]), delta=1e-9)
            self.assertAlmostEqual(line[f"{name}_spin"], np.sum(spin[inside]), delta=1e-9)
        for name, top in (("first_volume", base + d), ("second_volume", base + 2 * d)):
            part = np.clip(top - (z - radius), 0, 2 * radius)
            self.assertAlmostEqual(line[name], np.sum(math.pi * part**2 * (radius - part / 3)), delta=1e-15)
        self.assertAlmostEqual(line["torque"], np.sum(grains["tqy"][touches]), delta=1e-14)
        box = 0.015
        gaps = [np.abs(a[:, None] - a[None, :]) for a in (x, y)]
        gaps = [np.minimum(gap, box - gap) for gap in gaps] + [z[:, None] - z[None, :]]
        near = np.sqrt(sum(gap**2 for gap in gaps)) <= radius[:, None] + radius[None, :]
        np.fill_diagonal(near, False)
        self.assertEqual(line["all_contacts"], near.sum())
        self.assertEqual(line["contacts"], near[touches].sum())

    def test_measuring_does_not_touch_the_motion(self):
        """Every digit of the cycles and of the phases, across a checkpoint, for each kind of rotation."""
        kinds = ({}, {"grains.rotation": "blocked"}, {"grains.rotation": "rolling", "grains.rolling_friction": 0.1})
        for kind in kinds:
            with self.subTest(kind):
                written = []
                for rolling in (True, False):
                    deck = self.make_deck(LAYER | kind | {"measure.rolling": rolling, "output.checkpoint_cycles": 5, "measure.max_cycles": 20})
                    (deck / "control.in").write_text("variable stop equal ${done}>=12\n")
                    self.run_deck(deck)
                    self.assertEqual((deck / "rolling.csv").exists(), rolling)
                    written.append([(deck / name).read_bytes() for name in ("settle.liggghts", "cycles.csv", "phases.csv", "profiles.0.txt")])
                    if rolling:
                        table = read_table(deck / "rolling.csv")
                        self.assertEqual(len(table), 400)
                        self.assertTrue(np.all(np.diff(table["step"]) == table["step"][0]), "no line is missing or doubled at a checkpoint")
                self.assertEqual(*written)

    def test_stored_curves(self):
        """The curves in result.h5, worked out again from the lines of the cycles kept; plot draws them."""
        self.run_campaign(self.write_campaign(LAYER))
        (result,) = self.results()
        rolling, phases = (read_table(result.parent / "packing-1" / name) for name in ("rolling.csv", "phases.csv"))
        with h5py.File(result) as file:
            curves, kept = file["rolling/1"][:], file["packings"][0]
            units = dict(zip(file["rolling/1"].dtype.names, file["rolling/1"].attrs["units"]))
            trough = file["phases/1"]["trough_velocity_x"][:100]
        self.assertEqual((units["grain_torque"], units["floor_slip"], units["sliding_share"]), ("N m", "m/s", "1"))
        self.assertEqual(kept["rolling_problem"], b"")
        first, end = max(kept["cycles_discarded"], 1), kept["cycles_discarded"] + kept["cycles_measured"]
        place = np.arange(2, 3 * len(rolling), 3)  # in phases.csv
        used = (place >= 100 * first) & (place < 100 * end)
        for j in range(100):
            here = rolling[used & (place % 100 == j)]
            all_lines = phases[100 * first + j : 100 * end : 100]
            self.assertGreaterEqual(len(here), (end - first) // 3, "each hundredth once in three cycles")
            mean = {name: here[name].mean() for name in rolling.dtype.names}
            wanted = {"floor_contacts": mean["loaded"], "normal_force": mean["floor_z"], "tangential_force": -mean["floor_x"],
                      "floor_torque": mean["floor_torque"], "grain_torque": mean["torque"] - mean["floor_torque"],
                      "first_fraction": mean["first_volume"] / (0.015**2 * 0.003), "floor_grains": all_lines["touching"].mean(),
                      "second_spin": mean["second_spin"] / mean["second"], "first_velocity": mean["first_vx"] / mean["first"] - trough[j]}
            if mean["loaded"] > 0:
                wanted["sliding_share"] = mean["sliding"] / mean["loaded"]
            if np.sum(all_lines["touching"]) > 0:
                slip = np.sum(all_lines["touching_vx"] - all_lines["touching_spin"]) / np.sum(all_lines["touching"])
                wanted["floor_slip"] = slip - trough[j]
            for name, value in wanted.items():
                self.assertAlmostEqual(curves[name][j], value, delta=1e-9 * (1 + abs(value)), msg=f"{name} at {j}")
        done = self.call("plot", self.output, "--only", "rolling")
        self.assertEqual(done.returncode, 0, done.stderr)
        drawn = [line for line in done.stdout.splitlines() if line]
        self.assertEqual(len(drawn), 2, done.stdout)
        self.assertIn("sliding contacts", (self.output / "report" / f"rolling-{result.parent.name}.svg").read_text())

    def test_a_damaged_file_costs_no_efficiency(self):
        campaign = self.write_campaign(LAYER)
        self.run_campaign(campaign)
        self.take_starts()
        (result,) = self.results()
        with h5py.File(result) as file:
            efficiency = file["case"]["efficiency"][()]
        path = result.parent / "packing-1" / "rolling.csv"
        whole = path.read_text()
        for damaged, words in ((None, "rolling.csv is missing"), (whole[: len(whole) // 2], "rolling.csv holds"),
                               (whole.replace("\n", "\nx", 5), "rolling.csv:2: is no table of contacts at the floor")):  # fmt: skip
            result.unlink()
            path.unlink(missing_ok=True)
            if damaged is not None:
                path.write_text(damaged)
            done = self.call(*self.run_arguments(campaign))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.take_starts(), [], "the packing counts, and is not simulated again")
            with h5py.File(result) as file:
                self.assertEqual(file["case"]["efficiency"][()], efficiency)
                self.assertEqual(len(file["rolling/1"]), 0)
                problem = file["packings"]["rolling_problem"][0].decode()
            self.assertIn(words, problem)
            self.assertIn("delete the case's folder and run again", problem)
            self.assertIn(words, self.call("status", self.output).stdout)

    def test_where_it_cannot_be_measured(self):
        for changes in ({"grains.shape": "cube", "grains.diameter_spread": 0}, {"trough.side_wall_friction": 0.3}, {"layer.grains": None, "layer.block": "point", "grains.diameter_spread": 0}):
            campaign = self.write_campaign(LAYER | changes)
            done = self.call("check", campaign)
            self.assert_one_line_error(done, 2, "measure.rolling", "only in layers of spheres")


if __name__ == "__main__":
    unittest.main()
