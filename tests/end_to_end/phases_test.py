"""How the layer moves within the cycle: real runs, read back from their files by numpy and h5py."""

import math
import subprocess
import unittest

import h5py
import numpy as np

from trough_program import EndToEndTest

GRAINS = 60
FRICTION = 0.23


class Phases(EndToEndTest):
    def run_case(self, changes):
        """(result.h5, phases.csv as an array by name) of the case's first packing."""
        self.run_campaign(self.write_campaign({"grains.youngs_modulus": "1 MPa", "measure.packings": 1, "measure.half_width": 0.5} | changes))
        (result,) = self.results()
        text = (result.parent / "packing-1" / "phases.csv").read_text()
        table = [line for line in text.splitlines() if not line.startswith("#")]
        lines = np.genfromtxt(table, delimiter=",", names=True)
        file = h5py.File(result)
        self.addCleanup(file.close)
        return file, lines

    def check_curves(self, file, lines):
        """The stored curves, worked out again from the lines of the cycles kept."""
        curves = file["phases/1"]
        period = file["case"]["period_cycles"][0]
        discarded, kept = file["packings"]["cycles_discarded"][0], file["packings"]["cycles_measured"][0]
        first = max(discarded, 1)
        periods = (discarded + kept - first) // period
        end = discarded + kept
        rows = lines[100 * (end - periods * period) : 100 * end]
        self.assertEqual(len(curves["phase"]), 100 * period)
        np.testing.assert_allclose(curves["phase"], 2 * math.pi * np.arange(1, 100 * period + 1) / 100, rtol=1e-12)
        fold = {name: rows[name].reshape(periods, 100 * period) for name in rows.dtype.names}
        # Means of a few numbers: a few roundings.
        for stored, name, sign in (
            ("normal_force", "force_z", -1), ("tangential_force", "force_x", 1), ("velocity_x", "vx_com", 1),
            ("velocity_z", "vz_com", 1), ("touching", "touching", 1), ("energy_rotation", "energy_rotation", 1),
        ):  # fmt: skip
            np.testing.assert_allclose(curves[stored], sign * fold[name].mean(0), rtol=1e-9, atol=1e-12, err_msg=stored)
        airborne = (fold["touching"] == 0) & (fold["floor_z"] == 0)
        np.testing.assert_allclose(curves["airborne"], airborne.mean(0), atol=1e-12)
        # The trough moves as A sin(omega t): speeds of its ideal motion, up to the mover's own half percent.
        amplitude = file["case"]["amplitude"][0] * math.cos(file["case"]["vibration_angle"][0])
        speed = 2 * math.pi * file["case"]["frequency"][0] * amplitude
        np.testing.assert_allclose(curves["trough_velocity_x"], speed * np.cos(curves["phase"]), atol=0.01 * speed)
        # Over the kept cycles the trough carried the layer's weight, but for what the layer gained of momentum.
        weight = file["packings"]["mass"][0] * 9.81
        self.assertAlmostEqual(np.mean(curves["normal_force"]), weight, delta=0.02 * weight)

    def test_a_layer_that_flies(self):
        file, lines = self.run_case({"trough.throw_number": 2.0})
        self.check_curves(file, lines)
        case = {name: file["case"][name][0] for name in file["case"].dtype.names}
        self.assertTrue(file.attrs["layer_mode"].startswith(b"F"), file.attrs["layer_mode"])
        # The trough lets go at Gamma sin(omega t) = 1 (30 degrees); a layer is pressed together and lets go
        # later, by less than a twelfth of a cycle.
        self.assertGreater(case["take_off_phase"], math.radians(25))
        self.assertLess(case["take_off_phase"], math.radians(60))
        # What is in the air by the bulk's threshold is in the air by every step's force, but for stray grains.
        self.assertAlmostEqual(case["flight_number"], np.mean(file["series/1"]["flight_fraction"][2:]), delta=0.1)
        self.assertLess(case["effective_restitution"], 0.5)
        # Friction and impacts take energy, and not more than the trough could give, m g 2 r a few times.
        weight = file["packings"]["mass"][0] * 9.81
        self.assertGreater(case["dissipation"], 0)
        self.assertLess(case["dissipation"], 5 * weight * 2 * case["amplitude"])
        self.assertLess(case["largest_overlap"], 0.1 * case["grain_diameter"])
        self.assertGreater(case["largest_floor_overlap"], 0)

    def test_profiles_hold_all_grains(self):
        file, _ = self.run_case({"trough.throw_number": 2.0})
        profiles, layer = file["profiles/1"], file["case"][0]
        phases = np.unique(profiles["phase"])
        np.testing.assert_allclose(phases, 2 * math.pi * np.arange(10) / 10, atol=1e-12)
        area = layer["layer_length"][()] * layer["layer_width"][()]
        wanted = file["packings"]["mass"][0] / layer["grain_density"][()]
        for phase in phases:
            here = profiles["phase"][:] == phase
            thickness = np.diff(profiles["height"][here])[0]
            volume = np.sum(profiles["solid_fraction"][here]) * thickness * area
            # The engine writes six digits.
            self.assertAlmostEqual(volume, wanted, delta=1e-4 * wanted)
        surface = file["surface/1"]
        columns = surface["x"][surface["phase"][:] == 0]
        self.assertEqual(len(columns), round(15 / 4.5), "columns of a grain and a half, none at the end too many")
        self.assertTrue(np.all(np.isfinite(surface["height"])))

    def test_a_layer_that_slides(self):
        file, lines = self.run_case({"trough.throw_number": 0.7})
        self.check_curves(file, lines)
        self.assertEqual(file.attrs["layer_mode"], b"PN")
        self.assertEqual(file["case"]["flight_number"][0], 0)
        self.assertTrue(math.isnan(file["case"]["landing_phase"][0]))
        # The grains that touch the floor roll as well as slide: the layer's friction is below the grain's.
        ratio = file["case"]["friction_ratio"][0]
        self.assertGreater(ratio, 0.5 * FRICTION)
        self.assertLess(ratio, 1.001 * FRICTION)

    def test_a_layer_that_skips_cycles(self):
        changes = {"trough.throw_number": 4.6, "trough.amplitude": "6 mm", "layer.grains": 100}
        file, lines = self.run_case(changes)
        self.check_curves(file, lines)
        self.assertEqual(file["case"]["period_cycles"][0], 2)
        force = np.reshape(file["phases/1"]["normal_force"], (2, 100)).max(1)
        self.assertGreater(max(force), 2 * min(force), "every other landing is the hard one")
        self.assertGreater(file["case"]["flight_number"][0], 0.8)

    def test_measuring_does_not_touch_the_motion(self):
        campaign = self.write_campaign({"measure.packings": 1, "measure.max_cycles": 20})
        done = self.call("deck", campaign, "--output", self.folder / "decks")
        self.assertEqual(done.returncode, 0, done.stderr)
        (deck,) = self.folder.glob("decks/*/packing-1")
        self.run_by_hand(deck, "settle.liggghts")
        measured = self.run_by_hand(deck)
        script = deck / "in.liggghts"
        text = script.read_text()
        begin, end = text.index("# --- phases"), text.index("# --- cycles")
        script.write_text(text[:begin] + text[end:])
        self.assertEqual(self.run_by_hand(deck), measured)

    def run_by_hand(self, deck, script="in.liggghts"):
        done = subprocess.run(
            [self.engine, "-in", script], cwd=deck, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self.assertEqual(done.returncode, 0)
        cycles = deck / "cycles.csv"
        return cycles.read_bytes() if cycles.exists() else None

    def test_damage_is_noticed(self):
        self.run_case({"trough.throw_number": 2.0})
        self.take_starts()
        (result,) = self.results()
        result.unlink()
        phases = result.parent / "packing-1" / "phases.csv"
        phases.write_text(phases.read_text()[:-30])
        self.run_case({"trough.throw_number": 2.0})
        self.assertEqual(len(set(self.take_starts())), 1, "a packing whose phases.csv was cut is simulated again")


if __name__ == "__main__":
    unittest.main()
