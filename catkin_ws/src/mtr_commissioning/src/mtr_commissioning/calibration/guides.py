"""Instructions to the person, and evaluation of the readings: one guide for each calibration.

No guide moves the robot: the person drives it with the manual controller, or pushes it, and operates lift and presses
in the application's Calibrate window.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Callable, Dict, List

from mtr_core.sensor_figures import ASSUMED_GYRO_SCALE, ASSUMED_WHEEL_SCALE

from .balance.guide import balance
from .console import Console
from .lever import MIN_PLACES, lever_of
from .lift import MIN_HEIGHTS, height_error
from .mast import Reading, lean_of
from .press import Press, need_of
from .readings import Estimate
from .record import LEVER, MAST, Check
from .scales import MIN_TURN_RAD, MIN_WAY_M, scale_of

# A larger deviation from the drawing must be corrected in the URDF.
TOLD_FROM_M = 0.005
# A larger deviation means that the lift is not calibrated.
HEIGHT_LIMIT_M = 0.02
MM_PER_M, HALF_TURN = 1000.0, "half a turn"


def lever(console: Console, robot: Any) -> List[Check]:
    """Measure the key's lever: the key touches a plumb line at several headings."""
    count = int(console.number(f"Hang a plumb line from a stand, at the key's height, and map the Car or anything else "
                               f"so that the robot is localized. At how many headings will the key touch the line? At "
                               f"least {MIN_PLACES}.", MIN_PLACES, 24, "headings"))
    places = []
    for number in range(1, count + 1):
        console.go(f"{number} of {count}: turn the robot by about {360 // count} degrees on the spot, and drive until "
                   "the key just touches the hanging line. Let go of the controller.")
        places.append(console.reading(robot.pose))
    found, described = lever_of(places), robot.key()
    beside_m = found.left.value - described.y_m
    error_m = found.ahead.value - described.x_m
    console.say(f"The key is {found.ahead.value:.4f} m ahead of base_link (1 sigma {MM_PER_M * found.ahead.sigma:.1f} "
                f"mm) and {found.left.value:.4f} m to its left (1 sigma {MM_PER_M * found.left.sigma:.1f} mm); the "
                f"URDF has {described.x_m:.4f} and {described.y_m:.4f} m.")
    if max(abs(error_m), abs(beside_m)) > TOLD_FROM_M:
        console.say("Write the measured place of the key into the URDF and measure again: an error in the record only "
                    "makes distances less sure, and one to the side is in no budget.")
    return [Check(LEVER, _less(found.ahead, described.x_m), f"plumb line touched at {count} headings")]


def mast(console: Console, robot: Any) -> List[Check]:
    """Measure the mast's lean: the key next to a plumb line, low and high, facing both ways."""
    count = int(console.number("Hang a long plumb line beside the mast, so that it passes the key. How many pairs of "
                               "readings, each with the robot facing both ways on the same spot? At least 2.", 2, 20,
                               "pairs"))
    pairs = []
    for number in range(1, count + 1):
        first = _reading(console, robot, f"Pair {number} of {count}, first facing")
        console.go(f"Turn the robot by {HALF_TURN} on the same spot.")
        pairs.append((first, _reading(console, robot, f"Pair {number} of {count}, turned")))
    lean, floor = lean_of(pairs)
    console.say(f"The mast leans forwards by {lean.value:.2f} degrees (1 sigma {lean.sigma:.2f}); the floor slopes by "
                f"{floor.value:.2f} degrees there, which is not recorded: one spot is no survey of a floor.")
    return [Check(MAST, lean, f"plumb line, {count} pairs of readings facing both ways")]


def _reading(console: Console, robot: Any, title: str) -> Reading:
    heights, aheads = [], []
    for word in ("low", "high"):
        console.go(f"{title}: move the key to a {word} place, and wait until it hangs still.")
        heights.append(console.reading(robot.key_height_m))
        aheads.append(console.number("How far is the key ahead of the line? Negative: behind it.", -500.0, 500.0, "mm")
                      / MM_PER_M)
    return Reading(heights[0], aheads[0], heights[1], aheads[1])


def wheels(console: Console, robot: Any) -> List[Check]:
    """Measure the scales of wheels and gyro, each out and back."""
    ways, turns = [], []
    way_m = console.number("Mark a straight way on the floor. How long is it by the tape?", MIN_WAY_M, 50.0, "m")
    for sign, word in ((1.0, "forwards along the way"), (-1.0, "backwards to its start"), (1.0, "forwards again"),
                       (-1.0, "backwards again")):
        robot.begin()
        console.go(f"Drive the robot {word}, mark to mark, in a straight line.")
        ways.append((robot.way_m(), sign * way_m))
    count = int(console.number("How many full turns on the spot, back to a mark on the floor? 1 to 5.", 1, 5, "turns"))
    for sign, word in ((1.0, "left"), (-1.0, "right"), (1.0, "left"), (-1.0, "right")):
        console.go("Let the robot stand still for some seconds, so that the gyro's offset is known.")
        robot.begin()
        console.go(f"Turn it to the {word} by {count} full turns, exactly back to the mark.")
        turns.append((robot.turn_rad(), sign * 2.0 * math.pi * count))
    wheel = Check("wheel_scale", scale_of(ways, MIN_WAY_M, "m"), f"tape of {way_m:g} m, out and back twice")
    gyro = Check("gyro_scale", scale_of(turns, MIN_TURN_RAD, "rad"), f"{count} full turns, left and right twice")
    _say_scale(console, wheel, ASSUMED_WHEEL_SCALE.value, "the wheels' radius of the base's controller")
    _say_scale(console, gyro, ASSUMED_GYRO_SCALE.value, "what the IMU's driver publishes")
    return [wheel, gyro]


def _say_scale(console: Console, check: Check, assumed: float, home: str) -> None:
    scale = check.estimate
    console.say(f"{check.name} is {scale.value:.5f} (1 sigma {scale.sigma:.5f}).")
    if abs(scale.value - 1.0) > 2.0 * assumed:
        console.say(f"Localization takes it to be within {assumed:g} (1 sigma) of 1: multiply {home} by "
                    f"{scale.value:.5f}, and measure again.")


def lift(console: Console, robot: Any) -> List[Check]:
    """Measure the key's height with a tape measure."""
    count = int(console.number("At how many heights will the key's middle be measured by a tape? At least "
                               f"{MIN_HEIGHTS}.", MIN_HEIGHTS, 20, "heights"))
    pairs = []
    for number in range(1, count + 1):
        console.go(f"{number} of {count}: move the key to another height, from the lowest to the highest, and wait "
                   "until it stands.")
        said_m = console.reading(robot.key_height_m)
        pairs.append((said_m, console.number("How high is the key's middle above the floor?", 0.0, 3.0, "m")))
    found = height_error(pairs)
    console.say(f"The key is {MM_PER_M * found.middle.value:.1f} mm higher than the robot says (1 sigma "
                f"{MM_PER_M * found.middle.sigma:.1f} mm), {MM_PER_M * found.largest_m:.1f} mm at most; the lift goes "
                f"{found.scale:.4f} times as far as it says.")
    if found.largest_m > HEIGHT_LIMIT_M:
        console.say(f"More than {MM_PER_M * HEIGHT_LIMIT_M:.0f} mm: measure the travel between the stops, calibrate by "
                    "rosrun mtr_peripherals calibrate_lift, correct the key's lowest height in the URDF, and measure "
                    "again.")
    return [Check("lift_height_m", found.middle, f"tape at {count} heights")]


def press(console: Console, robot: Any) -> List[Check]:
    """Measure force and strength at which a press works."""
    count = int(console.number("How many presses, of different strengths? Order them in the Calibrate window, weak "
                               "ones too.", 2, 50, "presses"))
    presses = []
    for number in range(1, count + 1):
        strength = console.number(f"{number} of {count}: put a force gauge between servo and key, and order a press. "
                                  "With which strength?", 0.05, 1.0, "of 1")
        force_n = console.number("What is the gauge's largest reading?", 0.1, 100.0, "N")
        presses.append(Press(strength, force_n, console.yes("Did the button go down (its click, or the key's light)?")))
    need = need_of(presses)
    console.say(f"The button needs {need.force.value:.1f} N (1 sigma {need.force.sigma:.1f} N). Press with a strength "
                f"of {need.strength:.2f} at least: minimum_strength in mtr_peripherals/config/calibration.yaml.")
    return [Check("press_force_n", need.force, f"force gauge, {count} presses")]


def _less(estimate: Estimate, known: float) -> Estimate:
    return Estimate(estimate.value - known, estimate.sigma, estimate.freedom)


GUIDES: Dict[str, Callable[[Console, Any], List[Check]]] = {
    "lever": lever, "mast": mast, "wheels": wheels, "lift": lift, "press": press, "balance": balance}
