"""Corners of the range of legal machines, each alone, in pairs, all but one and all
together: `explore orbit` answers by default, or refuses in one clear line, within its
budget of evaluations.

Would catch integration that never ends (many balls, stiff contacts, slow turns),
divisions by a damping, weight or stiffness that is zero, and results that are no numbers.
"""
import copy
import itertools

from tests.machines import SET_1, entries, written
from tests.support.explore import NO_NUMBER, Case, Table, some

REGIMES = {"rest", "periodic", "quasi-periodic", "chaotic", "undecided"}
# Of 16 balls pass in a turn: 7, 61/9, nearly 7, 6.9136, and no ratio.
CAGES = [7 / 16, 61 / 9 / 16, 7 / 16 + 1e-9, 0.4321, 0.41421356237309503]


def undamped(machine):
    for body in ("stator", "rotor"):
        machine[body]["damping_ratio"] = 0


def free(machine):
    """Nothing but the bearing carries the rotor; it keeps a damper where bodies are
    damped."""
    rotor = machine["rotor"]
    rotor["natural_frequency_rad_per_s"] = 0
    if rotor["damping_ratio"]:
        del rotor["damping_ratio"]
        rotor["damping_N_s_per_m"] = 240.0


CORNERS = {
    "many balls": lambda m: m["bearing"].update(balls=200),
    "slow": lambda m: m.update(speed=1.0),
    "stiff": lambda m: m["bearing"].update(contact_stiffness_N_per_m1p5=1e12),
    "undamped": undamped,
    "no weight": lambda m: m["gravity"].update(acceleration_m_per_s2=0),
    "balanced": lambda m: m["rotor"].update(unbalance_kg_m=0),
    "free rotor": free}


def machine_at(corners, cage):
    """The tables of a machine, and its speed [Hz]."""
    machine = copy.deepcopy(SET_1)
    machine["bearing"]["cage_speed_ratio"] = cage
    for corner in CORNERS:  # `undamped` before `free`
        if corner in corners:
            CORNERS[corner](machine)
    return machine, machine.pop("speed", 33.0)


class Corners(Case):
    def ends_well(self, corners, cage):
        machine, speed = machine_at(corners, cage)
        with self.subTest(corners=corners, cage=cage):
            file = self.file("corner.toml", written(entries(machine, "corner")))
            result = self.run_explore("orbit", file, "--frequency", speed, "--points",
                                      64, timeout=1800)
            if result.returncode == 2:
                self.assertEqual((result.stdout, result.stderr.count("\n")), ("", 1),
                                 result.stderr)
                return
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIsNone(NO_NUMBER.search(result.stdout))
            table = Table.of(result.stdout)
            regime = table.value("regime")
            self.assertIn(regime, REGIMES)
            self.assertLessEqual(table.value("evaluations"), 1.1 * table.value("budget"))
            self.assertGreaterEqual(len(table), 64)
            if {"no weight", "balanced"} <= set(corners):
                self.assertEqual(regime, "rest")
                largest = max(abs(table[q]).max() for q in ("x_s", "y_s", "x_r", "y_r"))
                self.assertEqual(largest, 0)

    def test_each_alone(self):
        for cage in some(CAGES, 2):
            self.ends_well((), cage)
            for corner in CORNERS:
                self.ends_well((corner,), cage)

    def test_pairs(self):
        for corners in some(itertools.combinations(CORNERS, 2), 4):
            self.ends_well(corners, CAGES[3])

    def test_all_together_and_all_but_one(self):
        for cage in some((CAGES[4], CAGES[0]), 2):
            self.ends_well(tuple(CORNERS), cage)
            for without in CORNERS:
                self.ends_well(tuple(set(CORNERS) - {without}), cage)
