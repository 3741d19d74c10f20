"""The section [engine] of a campaign file with the real engine: the contact models are what `check` says, and extra lines and templates
are run where they should be, marked, and refused without leave."""

import math
import re
import shutil
import subprocess
import unittest
from pathlib import Path

import h5py
from trough_program import PATIENCE, EndToEndTest, campaign_text

GRAVITY = 9.81
ONE_SIZE = {"grains.diameter_spread": 0.0, "grains.youngs_modulus": "1 MPa", "measure.packings": 1}
RADIUS, DENSITY, YOUNG, POISSON = 1.5e-3, 1400.0, 1e6, 0.35  # of trough_program.SMALL
MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3
MODULUS = YOUNG / (2 * (1 - POISSON**2))

# Two grains meet, or one hits the floor or is pulled off it, with the contact of a deck.
WORLD = """units si
atom_style granular
atom_modify map array
newton off
communicate single vel yes
boundary p p f
soft_particles yes
region world block 0 0.015 0 0.015 -0.003 0.2 units box
create_box 2 world
neighbor 0.0009 bin
neigh_modify delay 0
timestep {step}
{contact}
{grains}
set group all diameter {diameter} density {density}
{floor}
{motion}
fix integrate all nve/sphere
variable now equal step
variable z equal xcm(all,z)
variable force equal f_trough[3]
group first id 1
variable speed equal vcm(first,x)
fix log all print {every} "${{now}},${{z}},${{force}},${{speed}}" file log.csv screen no title "step,z,force,speed"
thermo_style custom step atoms ke
thermo_modify lost error norm no flush yes
thermo 100000
run {steps}
print "VIBROTROUGH DONE"
"""


def damping_ratio(restitution):
    """z = |ln e| / sqrt(pi^2 + ln^2 e)."""
    return -math.log(restitution) / math.hypot(math.pi, math.log(restitution))


class EngineSection(EndToEndTest):
    def write_engine_campaign(self, engine, changes=None, sweep=None):
        path = self.folder / "campaign.toml"
        lines = "\n".join(f"{key} = {value}" for key, value in engine.items())
        text = campaign_text({**ONE_SIZE, **(changes or {})}, sweep)
        section = f"[engine]\n{lines}\n"
        path.write_text(text.replace("[sweep]", section + "[sweep]") if sweep else text + section)
        return path

    def deck_of(self, campaign):
        decks = self.folder / "decks"
        shutil.rmtree(decks, ignore_errors=True)
        done = self.call("deck", campaign, "--output", decks, "--allow-extra")
        self.assertEqual(done.returncode, 0, done.stderr)
        return (decks / "case-001" / "packing-1" / "in.liggghts").read_text(), decks / "case-001" / "packing-1" / "trough.stl"

    def experiment(self, campaign, grains, motion, step, steps, every=1):
        """Runs single grains with the contact lines of the campaign's own deck; rows of (step, z, force on the floor, speed of grain 1)."""
        deck, floor = self.deck_of(campaign)
        contact = re.search(r"\n# --- contact.*?(?=\nfix +gravity)", deck, re.S).group()
        walls = "\n".join(re.findall(r"^fix +(?:trough|floor) .*$", deck, re.M))
        folder = self.folder / "experiment"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        shutil.copy(floor, folder)
        (folder / "in.liggghts").write_text(WORLD.format(
            step=step, steps=steps, contact=contact, grains=grains, floor=walls, motion=motion, every=every,
            diameter=2 * RADIUS, density=DENSITY))  # fmt: skip
        done = subprocess.run([shutil.which("liggghts"), "-in", "in.liggghts"], cwd=folder, capture_output=True, text=True,
                              errors="replace", timeout=PATIENCE)  # its error messages may hold bytes that are not text
        self.assertIn("VIBROTROUGH DONE\n", done.stdout, done.stdout[-2000:])
        return [[float(number) for number in line.split(",")] for line in (folder / "log.csv").read_text().splitlines()[1:]]

    def checked(self, campaign):
        """{item: measured} of the first case, and its time step in s."""
        (case,) = self.ask_json("check", campaign)["cases"]
        deck, _ = self.deck_of(campaign)
        return {one["item"]: one["measured"] for one in case["findings"]}, float(re.search(r"\ntimestep +(\S+)", deck).group(1))

    def test_an_impact_under_hooke_takes_the_time_that_check_says(self):
        """k = 16/15 E* sqrt(R*) (15 m* v^2 / (16 E* sqrt(R*)))^(1/5) at the deck's speed v; the damped half oscillation ends
        when its force does: t = 2 acos(z) / sqrt(k / m* (1 - z^2)), e = exp(-z sqrt(k / m*) t) (Schwager & Poeschel 2007),
        whatever the speed. Two equal grains have R* = R / 2 and m* = m / 2, a grain on the floor R and m."""
        for restitution in (0.3, 0.8):
            campaign = self.write_engine_campaign(
                {"contact": '"hooke"'}, {"grains.restitution": restitution, "trough.restitution": restitution})  # fmt: skip
            found, time_step = self.checked(campaign)
            deck, _ = self.deck_of(campaign)
            chosen = float(re.search(r"characteristicVelocity scalar (\S+)", deck).group(1))
            nominal = float(re.search(r"coefficientRestitution peratomtypepair \S+ (\S+)", deck).group(1))
            z = damping_ratio(nominal)
            expected = {}
            for kind, share in (("floor", 1.0), ("grains", 0.5)):
                elastic = 16 / 15 * MODULUS * math.sqrt(share * RADIUS)
                rate = math.sqrt(elastic * (share * MASS * chosen**2 / elastic) ** 0.2 / (share * MASS))
                duration = 2 * math.acos(z) / (rate * math.sqrt(1 - z * z))
                expected[kind] = duration, math.exp(-z * rate * duration)
            # `check` gives the time step over the contact time of two grains.
            by_check = time_step / found["time step / contact time at twice the trough's speed"]
            self.assertAlmostEqual(by_check / expected["grains"][0], 1, delta=2e-3)  # printed to 4 digits or more
            for speed in (chosen, chosen / 5):
                step = expected["grains"][0] / 1000
                gap = 50 * step * speed
                for kind in ("floor", "grains"):
                    duration, rebound = expected[kind]
                    if kind == "floor":
                        grains = f"create_atoms 1 single 0.0071 0.0052 {RADIUS + gap!r}\nvelocity all set 0 0 -{speed!r}"
                    else:
                        grains = (f"create_atoms 1 single 0.0061 0.0052 0.008\ncreate_atoms 1 single {0.0061 + 2 * RADIUS + gap!r} 0.0052 0.008\n"
                                  f"group left id 1\nvelocity left set {speed!r} 0 0")  # fmt: skip
                    rows = self.experiment(campaign, grains, "", step, int(2 * duration / step) + 100)
                    if kind == "floor":
                        touching = [row[0] for row in rows if row[2] != 0]
                        heights = [row[1] for row in rows[-20:]]
                        after = (heights[-1] - heights[0]) / (19 * step) / speed
                    else:
                        changes = [b[0] for a, b in zip(rows, rows[1:]) if abs(a[3] - b[3]) > 1e-9 * speed]
                        touching = changes
                        # Momentum: the first keeps (1 - e) / 2 of its speed.
                        after = 1 - 2 * rows[-1][3] / speed
                    lasted = (touching[-1] - touching[0]) * step
                    with self.subTest(kind=kind, speed=speed, restitution=restitution):
                        # A contact has about 1000 steps, each end is known to one of them, and the integrator is off by half a
                        # step where the force is damped.
                        self.assertAlmostEqual(lasted / duration, 1, delta=4e-3)
                        self.assertAlmostEqual(after, rebound, delta=4e-3)

    def pull(self, campaign, largest, overlap):
        """Pulls a grain that rests on the floor with this overlap off it, with a force that grows in 0.6 s to `largest`; the force at
        which it leaves, N."""
        steps, step = 300_000, 2e-6
        grains = f"create_atoms 1 single 0.0071 0.0052 {RADIUS - overlap!r}"
        motion = f"variable pull equal {largest!r}*step/{steps}\nfix pull all addforce 0.0 0.0 v_pull\nfix drag all viscous 1e-3"
        rows = self.experiment(campaign, grains, motion, step, steps, every=100)
        held = [row[0] for row in rows if row[2] != 0] or [0]
        return largest * held[-1] / steps

    def test_a_cohesive_grain_is_pulled_off_at_its_bond_number(self):
        """Bo m g = (2 pi^3 / 3) w^3 R^2 / E*^2 with the energy density w in J/m3 (prepare/contact.hpp)."""
        for density in (1e4, 3e4):
            campaign = self.write_engine_campaign({"cohesion": f'"{density} J/m3"'})
            found, _ = self.checked(campaign)
            formula = 2 * math.pi**3 / 3 * density**3 * RADIUS**2 / MODULUS**2
            bond = found["bond number (pull-off force of a grain from the trough / its weight)"]
            self.assertAlmostEqual(bond * MASS * GRAVITY / formula, 1, delta=1e-6)
            self.assertAlmostEqual(found["bond number / throw number"] * 2, bond, delta=1e-9 * bond)
            least = (math.pi * density / MODULUS) ** 2 * RADIUS  # the overlap of the largest pull; 9/4 of it without a pull
            pulled = self.pull(campaign, 1.1 * formula, 2.25 * least) / formula
            # The area of the engine is pi (2 R d - d^2): d / (2 R) less than in the formula, which counts three times. The pull grows
            # with the rate r while the grain leaves by this overlap, in less than (6 m d / r)^(1/3) without anything that holds it.
            rate = 1.1 / 0.6  # of the formula, 1/s
            late = rate * (6 * MASS * least / (rate * formula)) ** (1 / 3)
            self.assertGreater(pulled, 1 - 1.5 * least / RADIUS - 0.005)
            self.assertLess(pulled, 1 + late + 0.005)

    def test_hooke_with_cohesion_holds_no_pull(self):
        """Spring and attraction are both proportional to the overlap, so that nothing balances a pull: the contact opens at once."""
        campaign = self.write_engine_campaign({"contact": '"hooke"', "cohesion": '"30 kJ/m3"'})
        found, _ = self.checked(campaign)
        self.assertLess(found["attraction / spring of a contact"], 1)
        self.assertLess(self.pull(campaign, MASS * GRAVITY, 1e-6), 0.1 * MASS * GRAVITY)

    def test_what_is_not_covered_is_said(self):
        """hertz, the default, stays what it was; the rest is marked in the result, in compare and in the report."""
        campaign = self.write_engine_campaign({}, sweep={"engine.contact": ["hertz", "hooke"], "engine.cohesion": ["0 J/m3", "20 kJ/m3"]})
        done = self.run_campaign(campaign)
        told = "not covered by the engine's certificate: cohesion sjkr; contact hooke; contact hooke, cohesion sjkr\n"
        self.assertIn(told, done.stderr)
        marks = [None, "cohesion sjkr", "contact hooke", "contact hooke, cohesion sjkr"]
        table = self.table()
        self.assertEqual([row["not_covered"] for row in table], marks)
        self.assertEqual([row["outcome"] for row in table], ["finished"] * 4)
        for row, mark in zip(table, marks):
            with h5py.File(self.output / "cases" / row["case"] / "result.h5") as file:
                case = file["case"][0]
                self.assertEqual(case["not_covered"].decode() if hasattr(case["not_covered"], "decode") else str(case["not_covered"]), mark or "")
        shown = self.call("compare", self.output).stdout
        self.assertIn("contact hooke, cohesion sjkr", shown)
        self.assertEqual(self.call("report", self.output).returncode, 0)
        page = (self.output / "report" / "report.html").read_text()
        self.assertIn("not covered by the engine", page)
        self.assertIn("contact hooke, cohesion sjkr", page)
        # The case without the keys is the one that it always was.
        self.take_starts()
        plain = self.write_campaign(ONE_SIZE)
        self.run_campaign(plain)
        self.assertEqual(self.take_starts(), [])
        self.assertEqual([row["case"] for row in self.table()], [table[0]["case"]])
        self.assertNotIn("not covered", self.call("compare", self.output).stdout)

    def test_templates_of_a_folder_replace_those_of_the_program(self):
        campaign = self.write_campaign(ONE_SIZE)
        self.run_campaign(campaign)
        (plain,) = self.table()
        own = Path(__file__).parent.parent.parent / "input_templates"
        mine = self.folder / "mine"
        mine.mkdir()
        arguments = [*self.run_arguments(campaign), "--templates", mine]
        self.assert_one_line_error(self.call(*arguments), 2, "holds 0 templates")
        (mine / "contakt.mustache").write_text("")
        self.assertEqual(self.call(*arguments).returncode, 2)
        (mine / "contakt.mustache").unlink()
        # The text of a template is part of the case, were it only a comment. The engine does the same.
        (mine / "inputs.mustache").write_text("# in my own words: {{{grains}}} grains\n")
        self.assertEqual(self.call(*arguments).returncode, 0)
        (row,) = self.table()
        self.assertEqual((row["efficiency"], row["not_covered"]), (plain["efficiency"], "template inputs.mustache"))
        self.assertNotEqual(row["case"], plain["case"])
        # Commands: another case, with the result that the program's own template gives with another key.
        contact = (own / "contact.mustache").read_text()
        self.assertIn("coefficientFriction peratomtypepair {{{types}}} {{{frictions}}}", contact)
        (mine / "contact.mustache").write_text(contact.replace("{{{frictions}}}", "0.5 0.4 0.4 0.4", 1))
        done = self.call(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not covered by the engine's certificate: template contact.mustache, template inputs.mustache\n", done.stderr)
        (row,) = self.table()
        self.assertNotEqual(row["case"], plain["case"])
        self.assertEqual(row["not_covered"], "template contact.mustache, template inputs.mustache")
        deck = (self.output / "cases" / row["case"] / "packing-1" / "in.liggghts").read_text()
        self.assertIn("# in my own words: 60 grains\n", deck)
        by_key = self.folder / "by key"
        self.run_campaign(self.write_campaign({**ONE_SIZE, "trough.friction": 0.4}, name="key.toml"), output=by_key)
        # The packings start with the speed that the theory expects at the friction of the campaign file: the same layer, not the same digits.
        (wanted,) = self.table(by_key)
        spread = wanted["efficiency_half_width_statistics"] + row["efficiency_half_width_statistics"]
        self.assertAlmostEqual(row["efficiency"], wanted["efficiency"], delta=2 * spread)
        # A finished case is not run again; without the option it is the first case again.
        self.take_starts()
        self.assertEqual(self.call(*arguments).returncode, 0)
        self.run_campaign(campaign)
        self.assertEqual(self.take_starts(), [])
        self.assertEqual([one["case"] for one in self.table()], [plain["case"]])
        decks = self.folder / "decks"
        self.assertEqual(self.call("deck", campaign, "--output", decks, "--templates", mine).returncode, 0)
        self.assertIn("0.5 0.4 0.4 0.4", (decks / "case-001" / "packing-1" / "in.liggghts").read_text())


if __name__ == "__main__":
    unittest.main()
