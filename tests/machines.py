"""Random machines: one generator, for all tests that draw some.

A machine is the tables of a parameter file, as a dictionary of dictionaries. `extreme_machine(random)` draws from a
`random.Random`: one with a seed, or the one of hypothesis, whose choices shrink towards data set 1.

Usage: tests/machines.py SEED > machine.toml
"""
import copy
import math
import random
import sys
import tomllib
from pathlib import Path

SET_1 = tomllib.loads(Path(__file__).parents[1].joinpath("data/set1.toml").read_text(encoding="utf-8"))
del SET_1["title"]

# Powers of ten that are likely, and what may be zero.
DECADES = {
    ("stator", "mass_kg"): (-3, 4), ("rotor", "mass_kg"): (-3, 4),
    ("stator", "natural_frequency_rad_per_s"): (0, 4),
    ("rotor", "natural_frequency_rad_per_s"): (0, 4),
    ("stator", "damping_ratio"): (-6, 1), ("rotor", "damping_ratio"): (-6, 1),
    ("rotor", "unbalance_kg_m"): (-6, 1), ("bearing", "contact_stiffness_N_per_m1p5"): (5, 16),
    ("bearing", "radial_clearance_m"): (-12, -1), ("gravity", "acceleration_m_per_s2"): (-3, 3)}
MAY_BE_ZERO = {"unbalance_kg_m", "radial_clearance_m", "acceleration_m_per_s2"}
BALLS = [1, 2, 3, 4, 128, 1000, 1024]


def decade(dice, low, high):
    """10^low … 10^high, with seven digits."""
    return float(f"{10 ** (low + (high - low) * dice.randrange(2**20) / 2**20):.6e}")


def spread(dice):
    """Draws between two values, evenly in their logarithm, with four digits."""
    return lambda low, high: float(f"{math.exp(dice.uniform(math.log(low), math.log(high))):.4g}")


def one_in(dice, count):
    return dice.randrange(count) == count - 1


def extreme_machine(dice):
    """A legal machine: some values of data set 1 replaced by others, mostly of a likely size, sometimes of
    any that a double holds."""
    machine = copy.deepcopy(SET_1)
    for (table, key), (low, high) in DECADES.items():
        if one_in(dice, 2):
            machine[table][key] = decade(dice, *((-320, 308) if one_in(dice, 8) else (low, high)))
        if key in MAY_BE_ZERO and one_in(dice, 6):
            machine[table][key] = 0
    if one_in(dice, 2):
        machine["bearing"]["balls"] = dice.choice(BALLS)
    if one_in(dice, 8):
        machine["bearing"]["cage_speed_ratio"] = 0.4321
    return machine


def random_machine(dice):
    """A machine like those that are built: ten times more or less of most values."""
    between = spread(dice)
    balls = dice.choice([8, 9, 10, 12, 14, 16, 18, 20])
    machine = {name: dict(table) for name, table in SET_1.items()}
    for body, masses, frequencies in (("stator", (5, 60), (150, 900)), ("rotor", (5, 80), (60, 400))):
        machine[body] |= {"mass_kg": between(*masses), "natural_frequency_rad_per_s": between(*frequencies),
                          "damping_ratio": between(0.01, 0.1)}
    machine["rotor"]["unbalance_kg_m"] = between(0.003, 0.1)
    machine["bearing"] |= {"balls": balls, "contact_stiffness_N_per_m1p5": between(1e9, 3e11),
                           "radial_clearance_m": between(3e-6, 2e-4),
                           "cage_speed_ratio": dice.randint(math.ceil(0.35 * balls), balls // 2) / balls}
    return machine


DESIGNATIONS = ["6002", "6203", "6204", "6205", "6206", "6207", "6208", "6209", "6210", "6306", "6308"]


def of_another_kind(dice, machine):
    """The machine with a rigid stator, a body that only the bearing carries, dampers, loads, a bearing from the
    catalogue, contact damping, a spall, or elements beside the balls or to the ground; values as likely as in
    `extreme_machine`."""
    def number(low, high):
        return decade(dice, *((-320, 308) if one_in(dice, 16) else (low, high)))

    for body in ["stator", "rotor"]:
        if one_in(dice, 2):
            machine[body]["damping_N_s_per_m"] = number(-3, 6)
            del machine[body]["damping_ratio"]
        if one_in(dice, 2):
            machine[body]["load_N"] = [dice.choice([-1, 0, 1]) * number(-3, 6) for _ in "xy"]
    hanging = dice.choice(["stator", "rotor", None])
    if hanging:
        machine[hanging]["natural_frequency_rad_per_s"] = 0
        if "damping_ratio" in machine[hanging]:
            machine[hanging]["damping_ratio"] = 0
    if one_in(dice, 3):
        machine["stator"] = {"rigid": True}
    if one_in(dice, 3):
        machine["bearing"] = {"designation": dice.choice(DESIGNATIONS),
                              "internal_clearance": dice.choice(["C2", "CN", "C3", "C4"])}
    elif one_in(dice, 2):
        ball = number(-4, -1)
        machine["bearing"] = {
            "balls": dice.choice([1, 2, 3, 8]), "ball_diameter_m": ball, "pitch_diameter_m": 4 * ball,
            "inner_groove_ratio": 0.5 + decade(dice, -6, 3), "outer_groove_ratio": 0.5 + decade(dice, -3, 0),
            "youngs_modulus_Pa": number(8, 12), "poissons_ratio": 0.5 * dice.random(),
            "diametral_clearance_m": number(-9, -2)}
    if one_in(dice, 2):
        machine["bearing"]["contact_damping_s_per_m"] = number(-3, 4)
    if one_in(dice, 3):
        surface = dice.choice(["outer_race", "inner_race", "ball"])
        if surface == "ball" and machine["bearing"].get("cage_speed_ratio") == 0.5:
            machine["bearing"]["cage_speed_ratio"] = 0.4321
        widest = 2 * math.pi / machine["bearing"].get("balls", 20)
        machine["bearing.defect"] = {"surface": surface, "depth_m": number(-9, -3),
                                     "width_rad": widest / 2 * (0.01 + 0.99 * dice.random())}
    if one_in(dice, 4):
        bodies = ["rotor.ground"] if "rigid" in machine["stator"] else ["rotor.ground", "stator.ground"]
        direct, coupled, damper = number(3, 9), number(0, 7), number(-3, 5)
        machine[dice.choice([*bodies, "bearing.parallel"])] = {
            "cubic_stiffness_N_per_m3": number(8, 16), "stop_stiffness_N_per_m": number(3, 9), "stop_gap_m": number(-7, -3),
            "stiffness_N_per_m": [direct, coupled, -coupled, direct], "damping_N_s_per_m": [damper, 0, 0, damper]}
    return machine


def realistic_machine(dice):
    """A rotor in a bearing of the catalogue, in a sprung housing, and its speed [Hz]."""
    between = spread(dice)

    def damped(mass, hertz):
        """By a ratio, or by a damper that has such a ratio at that frequency."""
        ratio = between(0.01, 0.1)
        if hertz and one_in(dice, 2):
            return {"damping_ratio": ratio}
        damper = 4 * math.pi * ratio * mass * (hertz or 50)
        return {"damping_N_s_per_m": float(f"{damper:.4g}")}

    speed, mass = round(dice.uniform(10, 100), 2), between(2, 100)
    housing, housing_hertz = float(f"{mass * between(0.3, 3):.4g}"), between(30, 250)
    rotor_hertz = dice.choice([0, between(5, 60)])
    grade = dice.choice([2.5, 6.3, 16])  # mm/s
    unbalance = mass * grade * 1e-3 / (2 * math.pi * speed)
    machine = {
        "stator": {"mass_kg": housing,
                   "natural_frequency_rad_per_s": round(2 * math.pi * housing_hertz, 3),
                   **damped(housing, housing_hertz)},
        "rotor": {"mass_kg": mass,
                  "natural_frequency_rad_per_s": round(2 * math.pi * rotor_hertz, 3),
                  **damped(mass, rotor_hertz),
                  "unbalance_kg_m": float(f"{unbalance:.4g}")},
        "bearing": {"designation": dice.choice(DESIGNATIONS),
                    "internal_clearance": dice.choice(["C2", "CN", "C3", "C4"])},
        "gravity": {"acceleration_m_per_s2": 9.81}}
    if one_in(dice, 2):
        machine["bearing"]["contact_damping_s_per_m"] = between(0.05, 0.5)
    return machine, speed


def value_text(value):
    """As TOML and as Python would read it back."""
    return str(value).lower() if isinstance(value, bool) else f'"{value}"' if isinstance(value, str) else repr(value)


def table(name, **keys):
    """The text of a table: table("rotor", mass_kg=2)."""
    return f"[{name}]\n" + "".join(f"{key} = {value_text(value)}\n" for key, value in keys.items())


def entries(machine, title="random"):
    """The lines of the parameter file: [table, key, value as text]."""
    return [["", "title", f'"{title}"'],
            *([table, key, value_text(value)] for table, keys in machine.items() for key, value in keys.items())]


def written(lines):
    """The text of a parameter file; a table begins wherever its name changes."""
    text, current = "", ""
    for table, key, value in lines:
        if table != current:
            text += f"\n[{table}]\n"
        current = table
        text += f"{key} = {value}\n"
    return text


if __name__ == "__main__":
    print(written(entries(extreme_machine(random.Random(int(sys.argv[1]))))), end="")
