"""An open trough with the real engine: every grain that is fed is held or has left, and a killed run, a deck that loses grains and an
overfed trough end as they should."""

import json
import os
import unittest
import zipfile

import h5py
import numpy as np

from mixture_test import read_dump
from trough_program import EndToEndTest, at_night

OPEN = {
    "layer.grains": None,
    "layer.length": "75 mm",
    "feed.mass_flow": "0.05 t/h",
    "feed.length": "15 mm",
    "trough.side_wall_friction": 0,
    "measure.min_cycles": 32,
    "measure.max_cycles": 32,
    "output.checkpoint_cycles": 8,
}
LENGTH, WIDTH, SIDE, STEP, STEP_AT = 75.0, 15.0, 7.5, 3.0, 40.0  # mm, of a V of 45 degrees with a step down behind the feed


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def solid(name, triangles):
    facets = "".join("facet normal 0 0 1 outer loop " + " ".join(f"vertex {x} {y} {z}" for x, y, z in corners) + " endloop endfacet\n" for corners in triangles)
    return f"solid {name}\n{facets}endsolid {name}\n"


def vee(start, end, bottom):
    return [
        triangle
        for y in (0.0, WIDTH)
        for triangle in quad((start, y, bottom + SIDE), (end, y, bottom + SIDE), (end, WIDTH / 2, bottom), (start, WIDTH / 2, bottom))
    ]


def own_trough():
    """As text STL: the V before the step with the step, and behind it a liner."""
    step = [
        triangle
        for y in (0.0, WIDTH)
        for triangle in quad((STEP_AT, y, SIDE), (STEP_AT, WIDTH / 2, 0.0), (STEP_AT, WIDTH / 2, STEP), (STEP_AT, y, SIDE + STEP))
    ]
    return solid("floor", vee(0.0, STEP_AT, STEP) + step) + solid("liner", vee(STEP_AT, LENGTH, 0.0))


MATERIALS = """
[[materials]]
name = "fines"
mass_fraction = 0.4
diameter = "2 mm"
density = "2500 kg/m3"
trough_friction = 0.2
"""
DENSITY = {1: 1400.0, 4: 2500.0}  # by atom type: trough and side walls are 2 and 3

STAGES = """
[[stages]]
cycles = 10

[[stages]]
cycles = 6
mass_flow = "0 t/h"
throw_number = 1.6

[[stages]]
cycles = 2
standstill = true

[[stages]]
cycles = 12
throw_number = 1.1
mass_flow = "0.025 t/h"
"""

# Commands of the shell, before the engine of a packing starts.
LOSING = """test ! -f in.liggghts || sed -i '/^variable        done index/a if "${done} == 12" then "region hole block 0.04 0.05 INF INF INF INF units box" "delete_atoms region hole compress no"' in.liggghts"""


class OpenTrough(EndToEndTest):
    def packing(self, number=1):
        return next(iter(self.output.glob(f"cases/*/packing-{number}")))

    def left_dumps(self, packing):
        """The numbers of the grains that the engine wrote when they left, by the end of the cycle; of files that overlap the later one."""
        found = {}
        for path in sorted(packing.glob("left.*.dump"), key=lambda path: int(path.name.split(".")[1])):
            start = int(path.name.split(".")[1])
            found = {step: ids for step, ids in found.items() if step <= start}
            for snapshot in path.read_text().split("ITEM: TIMESTEP\n")[1:]:
                lines = snapshot.splitlines()
                if int(lines[0]) > start:
                    found[int(lines[0])] = [int(line.split()[0]) for line in lines[8:]]
        return found

    def test_all_grains_add_up(self):
        self.run_campaign(self.write_campaign(OPEN))
        row = self.table()[0]
        self.assertEqual(row["outcome"], "finished", row)
        with h5py.File(self.results()[0]) as file:
            flow, packings = file["flow/1"][()], file["packings"][()]
            residence, along = file["residence/1"]["time"], file["along/1"][()]
            depths, stays = ([file[f"{table}/{number + 1}"][name] for number in range(len(packings))] for table, name in (("along", "depth"), ("residence", "time")))
            np.testing.assert_allclose(file["along_trough"]["depth"], np.mean(depths, axis=0), rtol=1e-12)
            np.testing.assert_allclose(file["residence_times"]["time"], np.mean(stays, axis=0), rtol=1e-12)
        self.assert_balance(flow)
        dumped = self.left_dumps(self.packing())
        numbers = [number for ids in dumped.values() for number in ids]
        self.assertEqual(len(numbers), flow["left"].sum())
        self.assertEqual(len(numbers), len(set(numbers)))
        asked = 0.05 / 3.6
        for one in packings:
            self.assertAlmostEqual(one["inflow"] / asked, 1, delta=0.03)
            self.assertAlmostEqual(one["outflow"] / asked, 1, delta=0.03)
        self.assertAlmostEqual(residence[50] / packings["residence_time"][0], 1, delta=0.1)
        # Little's law: the mass from the back wall to the edge is what flows times how long it stays.
        held = np.sum(along["depth"]) * (along["x"][1] - along["x"][0]) * 0.015 * 0.58 * 1400
        self.assertAlmostEqual(held / (packings["outflow"][0] * packings["residence_time"][0]), 1, delta=0.05)
        # Besides, the trough holds grains that have passed the edge and are not a diameter away yet.
        self.assertTrue(0.9 < held / packings["hold_up"][0] <= 1, held)
        # The mass flow of the table is speed times depth in the window, which nobody has counted at the edge.
        self.assertAlmostEqual(row["mass_flow_kg_per_s"] / asked, 1, delta=0.05)

    def test_a_killed_run_gives_the_same_numbers(self):
        campaign = self.write_campaign({**OPEN, "measure.packings": 1, "measure.min_cycles": 20, "measure.max_cycles": 20})
        one, other = self.results_with_and_without_a_kill(campaign, 8, wanted=None)
        with h5py.File(one) as file, h5py.File(other) as same:
            for table in ("flow/1", "along/1", "residence/1", "along_trough", "residence_times"):
                for name in file[table].dtype.names:
                    np.testing.assert_array_equal(file[table][name], same[table][name], f"{table}/{name}")

    def assert_balance(self, flow):
        """in = held + out at every cycle, by number and by mass."""
        self.assertTrue(np.all(flow["held"][0] + flow["fed"] == flow["held"] + np.cumsum(flow["left"])))
        lost = flow["held_mass"][0] + flow["fed_mass"] - flow["held_mass"] - np.cumsum(flow["left_mass"])
        self.assertLess(np.abs(lost).max(), 1e-12 * flow["fed_mass"][-1])

    @at_night
    def test_a_flat_mesh_is_the_flat_floor(self):
        """The same feed, walls and grains on other triangles: the same flow, and a layer that is as deep and as fast as the flat
        floor's within the scatter of one short packing."""
        floor = quad((0, 0, 0), (LENGTH, 0, 0), (LENGTH, WIDTH, 0), (0, WIDTH, 0))
        (self.folder / "own.stl").write_text(solid("floor", floor))
        found = {}
        for name, mesh in (("flat", {}), ("mesh", {"trough.mesh": "own.stl", "trough.mesh_unit": "mm"})):
            changes = {**OPEN, "measure.packings": 1, "measure.min_cycles": 24, "measure.max_cycles": 24, **mesh}
            self.run_campaign(self.write_campaign(changes, name=f"{name}.toml"), self.folder / name, wanted=None)
            with h5py.File(next((self.folder / name).glob("cases/*/result.h5"))) as file:
                found[name] = file["flow/1"][()], file["packings"][0], file["along/1"][()]
        (flat_flow, flat, flat_along), (flow, own, along) = found["flat"], found["mesh"]
        self.assert_balance(flow)
        np.testing.assert_array_equal(flow["fed"][:5], flat_flow["fed"][:5])  # the same random numbers, before the layers differ
        for column in ("inflow", "outflow", "hold_up", "window_depth", "efficiency"):
            self.assertAlmostEqual(own[column] / flat[column], 1, delta=0.06, msg=column)
        np.testing.assert_allclose(along["level"], along["depth"], rtol=1e-9)
        self.assertNotIn("level", flat_along.dtype.names)

    def test_a_trough_of_ones_own_is_killed_and_goes_on(self):
        """A V with a step and a liner with a friction of its own. All grains add up, and the level of the layer is measured against the
        mesh: h above the lowest point of a V of 45 degrees a layer has the cross-section h^2, until the V is full."""
        (self.folder / "own.stl").write_text(own_trough())
        changes = {**OPEN, "trough.mesh": "own.stl", "trough.mesh_unit": "mm", "measure.packings": 1, "measure.min_cycles": 24, "measure.max_cycles": 24}
        campaign = self.write_campaign({**changes, "output.frames_per_cycle": 1})
        with campaign.open("a") as file:
            file.write('[[pairs]]\nmaterials = ["grains", "liner"]\nfriction = 0.4\n')
        one, other = self.results_with_and_without_a_kill(campaign, 8, wanted=None)
        with h5py.File(one) as file, h5py.File(other) as same:
            for table in ("flow/1", "along/1", "residence/1"):
                np.testing.assert_array_equal(file[table][()], same[table][()], table)
            flow, along = file["flow/1"][()], file["along/1"][()]
        self.assert_balance(flow)
        self.assertGreater(flow["left"].sum(), 20)
        bottom = np.where(along["x"] < STEP_AT / 1000, STEP / 1000, 0.0)
        section = along["depth"] * WIDTH / 1000  # m2
        side = SIDE / 1000
        expected = bottom + np.where(section < side**2, np.sqrt(section), side / 2 + along["depth"])  # above the V between walls
        away = np.abs(along["x"] - STEP_AT / 1000) > 0.006  # a bin over the step has two floors
        np.testing.assert_allclose(along["level"][away], expected[away], atol=2e-4)
        for command in (("export", self.output), ("archive", self.output, "--output", self.folder / "own.zip", "--partial")):
            done = self.call(*command)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(list(self.output.glob("cases/*/frames/trough/*.vtp")))
        with zipfile.ZipFile(self.folder / "own.zip") as bundle:
            self.assertTrue([name for name in bundle.namelist() if name.endswith("own.stl")], bundle.namelist())

    def test_a_mixture_is_killed_and_goes_on(self):
        """Each material is fed with its share, and what the results say of its shares, speeds and heights along the trough is what
        numpy makes of the engine's frames, which are of the same moments."""
        changes = {**OPEN, "measure.packings": 1, "measure.min_cycles": 24, "measure.max_cycles": 24, "output.frames_per_cycle": 10}
        campaign = self.write_campaign(changes)
        with campaign.open("a") as file:
            file.write(MATERIALS)
        one, other = self.results_with_and_without_a_kill(campaign, 8, wanted=None)
        with h5py.File(one) as file, h5py.File(other) as same:
            for table in ("flow/1", "material_flow/1", "material_along/1", "materials", "materials_along"):
                self.assertEqual(file[table][()].tobytes(), same[table][()].tobytes(), table)  # some numbers are NaN
            flow, packings, flows = file["flow/1"][()], file["packings"][()], file["material_flow/1"][()]
            along, whole, steps = file["material_along/1"][()], file["along/1"][()], int(file["packings"]["steps_per_cycle"][0])
            self.assertNotIn("material_ends", file)
        self.assert_balance(flow)
        self.assertAlmostEqual(flows["outflow"].sum() / packings["outflow"][0], 1, delta=1e-5)  # a dump has six digits
        shares = along["share"].reshape(2, -1)
        np.testing.assert_allclose(shares.sum(axis=0), 1, rtol=1e-12)
        self.assertAlmostEqual(np.average(shares[1], weights=whole["depth"]), 0.4, delta=0.05)  # about 200 grains of each
        self.assert_last_cycle_is_that_of_the_frames(self.packing(), steps, 24)

    def test_stages_feed_and_stop(self):
        """What is fed and what leaves in each stage is that of the flows and times, and adds up; killed while the second feed is on."""
        changes = {**OPEN, "measure.packings": 1, "measure.max_packings": None, "measure.min_cycles": None, "measure.max_cycles": None, "output.checkpoint_cycles": 5}
        campaign = self.write_campaign(changes)
        with campaign.open("a") as file:
            file.write(STAGES)
        one, other = self.results_with_and_without_a_kill(campaign, 20)
        with h5py.File(one) as file, h5py.File(other) as same:
            for table in ("flow/1", "stages"):
                self.assertEqual(file[table][()].tobytes(), same[table][()].tobytes(), table)
            flow, stages, whole = file["flow/1"][()], file["stages"][()], file["packings"][0]
        self.assert_balance(flow)
        grain = 0.05 / 3.6 * stages["time"][0] / flow["fed"][10]  # kg, mean mass
        # A feed ends when it has fed its grains, by chance somewhat later: each of its 100 drops is rounded at random, by half a
        # grain (standard deviation) at most, of which these are three standard deviations.
        wanted = 0.05 / 3.6 * stages["time"] * np.array([1, 0, 0, 0.5])
        np.testing.assert_allclose(stages["fed_mass"], wanted, atol=15 * grain)
        # In each cycle as many as its own time needs: three standard deviations of the rounding of ten drops.
        cycle = stages["time"][3] / 12
        np.testing.assert_allclose(np.diff(flow["fed"])[18:29], 0.025 / 3.6 * cycle / grain, atol=5)
        np.testing.assert_allclose(np.diff(stages["held_mass"]), (stages["fed_mass"] - stages["left_mass"])[1:], atol=1e-12)
        self.assertAlmostEqual(stages["left_mass"].sum() / stages["time"].sum() / whole["outflow"], 1, delta=1e-12)
        self.assertGreater(stages["left_mass"][1], stages["left_mass"][2])  # it runs empty, and at a standstill it stops
        shown = self.call("compare", self.output, "--stages").stdout
        self.assertIn("held", shown)

    def assert_last_cycle_is_that_of_the_frames(self, packing, steps, cycles):
        latest = max(packing.glob("along.*.txt"), key=lambda path: int(path.name.split(".")[1]))
        lines = latest.read_text().splitlines()
        (start,) = [number for number, line in enumerate(lines) if line.split()[0] == str(cycles * steps)]
        bins = np.array([[float(word) for word in line.split()] for line in lines[start + 1 :]])
        edges = np.append(bins[:, 1], 2 * bins[-1, 1] - bins[-2, 1]) - (bins[1, 1] - bins[0, 1]) / 2
        sums = np.zeros((len(bins), 7))  # number, and mass, momentum and moment of both materials
        frames = [int(path.name.split(".")[1]) for path in packing.glob("dump/frames.*.dump")]
        chosen = [step for step in frames if (cycles - 1) * steps < step <= cycles * steps]
        self.assertEqual(len(chosen), 10)
        for step in chosen:
            frame = read_dump(packing / f"dump/frames.{step}.dump")
            mass = np.array([DENSITY[int(kind)] for kind in frame["type"]]) * 4 / 3 * np.pi * frame["radius"] ** 3
            columns = [np.ones_like(mass)]
            for kind in DENSITY:
                own = np.where(frame["type"] == kind, mass, 0)
                columns += [own, own * frame["vx"], own * frame["z"]]
            for number, values in enumerate(columns):
                sums[:, number] += np.histogram(frame["x"], edges, weights=values)[0] / len(chosen)
        found = bins[:, 2, None] * bins[:, 5:]
        np.testing.assert_allclose(bins[:, 2], sums[:, 0], atol=0.11)  # a grain at the border of a bin
        scale = np.abs(sums[:, 1:]).max(axis=0)
        self.assertLess(np.median(np.abs(found - sums[:, 1:]) / scale), 1e-4)
        np.testing.assert_allclose(found.sum(axis=0) / scale, sums[:, 1:].sum(axis=0) / scale, atol=1e-3)

    def test_lost_grains_are_noticed(self):
        """The negative control: a deck that takes grains out of the middle without telling."""
        os.environ["VIBROTROUGH_TEST_BREAK"] = LOSING
        campaign = self.write_campaign({**OPEN, "measure.packings": 1, "measure.min_cycles": 20, "measure.max_cycles": 20})
        done = self.call(*self.run_arguments(campaign))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.table()[0]["outcome"], "lost-grains")
        status = self.ask_json("status")
        self.assertIn("are missing at the end of cycle 13", json.dumps(status))

    def test_an_overfed_trough_ends_as_overfull(self):
        changes = {**OPEN, "measure.packings": 1, "trough.throw_number": 1.5, "trough.inclination": "20 deg", "feed.height": "15 mm"}
        self.run_campaign(self.write_campaign(changes), wanted=1)
        self.assertEqual(self.table()[0]["outcome"], "overfull")
        self.assertRegex(json.dumps(self.ask_json("status")), r"the layer has reached the feed after [0-9.]+ s")


if __name__ == "__main__":
    unittest.main()
