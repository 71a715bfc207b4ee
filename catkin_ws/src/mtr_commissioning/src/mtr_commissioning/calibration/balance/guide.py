"""Guide through the weighing: level, with the front wheels raised, and optionally on a tilt table."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Dict, List

from ...base_contract.balance import balance_parameters
from ..console import Console
from ..record import Check
from .comparison import optimistic, values_to_set
from .estimate import Balance, balance_of
from .readings import LEAST_RISE_M, Chassis, Level, Raised, Tilt

MM_PER_M, G_PER_KG = 1000.0, 1000.0
LARGEST_KG = 200.0
# Height of a block relative to the tangent at which the described robot tips.
TIPPING_SHARE = 0.25
RISES_PER_HEIGHT = 2


def balance(console: Console, robot: Any) -> List[Check]:
    """Measure mass and centre of mass, and derive drive control's limits."""
    geometry = robot.geometry()
    wheels, described = geometry.wheels(), balance_parameters(geometry)
    chassis = Chassis(wheels.base_m, wheels.track_m, wheels.radius_m)
    step_kg = console.number("Two persons are needed, one holds the mast. Let the wheels roll freely. What is the step "
                             "of the scales?", 1.0, 500.0, "g") / G_PER_KG
    levels = _levels(console)
    raised = [each for word in ("lowest", "highest") for each in _raised(console, robot, word, chassis, described)]
    found = balance_of(chassis, levels, raised, _tilts(console, robot), step_kg)
    _say(console, found, described, geometry.key())
    how = f"scales, level {len(levels)} times and raised {len(raised)} times"
    checks = {"mass_kg": found.mass, **found.parameters()}
    return [Check(name, estimate, how) for name, estimate in checks.items()]


def _levels(console: Console) -> List[Level]:
    count = int(console.number("Put the robot on level scales. How many weighings? Lift it off between them. At least "
                               "2.", 2, 20, "weighings"))
    return [Level(*(console.number(f"{number} of {count}: what do both {side} wheels carry?", 0.0, LARGEST_KG, "kg")
                    for side in ("front", "rear", "left", "right"))) for number in range(1, count + 1)]


def _raised(console: Console, robot: Any, word: str, chassis: Chassis, described: Dict[str, float]) -> List[Raised]:
    console.go(f"Move the key to its {word} place.")
    key_height_m = console.reading(robot.key_height_m)
    centre_m = described["centre_of_mass_m"] + described["centre_of_mass_rise"] * key_height_m
    tangent = TIPPING_SHARE * described["tip_lever_along_m"] / centre_m
    largest_mm = MM_PER_M * max(chassis.base_m * math.sin(math.atan(tangent)), LEAST_RISE_M)
    readings = []
    for number in range(1, RISES_PER_HEIGHT + 1):
        rise_mm = console.number(f"{number} of {RISES_PER_HEIGHT}: hold the mast, and put level blocks under the front "
                                 "scales. How much higher are the front wheels than the rear ones?",
                                 MM_PER_M * LEAST_RISE_M, largest_mm, "mm")
        front_kg, rear_kg = (console.number(f"What do both {side} wheels carry?", 0.0, LARGEST_KG, "kg")
                             for side in ("front", "rear"))
        readings.append(Raised(key_height_m, rise_mm / MM_PER_M, front_kg, rear_kg))
    return readings


def _tilts(console: Console, robot: Any) -> List[Tilt]:
    count = int(console.number("How many readings on a tilt table, wheels blocked and the mast held by a slack rope? 0 "
                               "without one.", 0, 20, "readings"))
    readings = []
    for number in range(1, count + 1):
        key_height_m = console.reading(robot.key_height_m)
        across = console.yes(f"{number} of {count}: is the table lowered to the right of the robot? Answer n "
                             "when it is lowered to its back.")
        angle_deg = console.number("At which angle do the upper wheels lose their load?", 1.0, 60.0, "degrees")
        readings.append(Tilt(key_height_m, angle_deg, across))
    return readings


def _say(console: Console, found: Balance, described: Dict[str, float], key: Any) -> None:
    console.say(f"Mass {found.mass.value:.2f} kg (1 sigma {found.mass.sigma:.2f}); centre of mass "
                f"{MM_PER_M * found.ahead.value:.1f} mm ahead of the middle of the wheels (1 sigma "
                f"{MM_PER_M * found.ahead.sigma:.1f}) and {MM_PER_M * found.left.value:.1f} mm to its left (1 sigma "
                f"{MM_PER_M * found.left.sigma:.1f}).")
    measured, values = found.parameters(), values_to_set(found)
    for name, value in values.items():
        console.say(f"{name}: {value:.4f} (1 sigma {measured[name].sigma:.4f}); by the description "
                    f"{described[name]:.4f}.")
    console.say("Correct the masses and their places in the URDF until base_contract --robot-file states these values, "
                "and give them to drive control in the file of node_parameters. It refuses values that differ from the "
                "description by more than 5 mm.")
    for sentence in optimistic(found, described, [key.min_height_m, key.max_height_m]):
        console.say(sentence)
