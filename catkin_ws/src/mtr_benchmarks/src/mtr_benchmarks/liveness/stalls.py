"""Stops each node (SIGSTOP) for a while during a drive; checks the wheel commands when it continues."""
# SPDX-License-Identifier: Apache-2.0
import time
from dataclasses import dataclass
from typing import Iterable, List, Sequence

from mtr_description.shipped import shipped_base
from mtr_fault_injection.parts import Kind
from mtr_fault_injection.processes import ProcessFault

from ..harness.rows import Requirement, Row
from .judge import Excess, Growth, between, excess_of_commands, excess_of_wheels
from .live_robot import LiveRobot

NODES = ("drive_control", "base_guard", "localization", "motion_planner", "state_machine", "dispatcher", "peripherals",
         "controller_input", "car_locator")
DURATIONS_S = (0.3, 0.6, 1.0, 2.0)
# Acceleration limits of drive control, see mtr_drive_control/parameters.hpp.
COMMANDS = Growth(1.0, 2.0)
# Observed time in which a surge after the continuation of the node shows.
SEEN_AFTER_S = 1.5
MOVES_AGAIN_S = 60.0
# Age of the odometry when a command arrives, while the wheels brake as hard as the base can.
SEEN_LATE_S = 0.06
# Tolerance for noise of the wheel readings and compliance of the tyres.
WHEELS_TOLERANCE_MPS, WHEELS_TOLERANCE_RADPS = 0.03, 0.25
BASE = shipped_base()
LINEAR = Requirement("surge of a command after a node was stopped, beyond the limits", "m/s",
                     must=BASE.linear_acceleration_mps2 * SEEN_LATE_S)
ANGULAR = Requirement("the same of its yaw rate", "rad/s", must=BASE.angular_acceleration_radps2 * SEEN_LATE_S)
WHEELS = Requirement("step of the wheels in 20 ms, beyond what the base's limits allow", "m/s",
                     must=WHEELS_TOLERANCE_MPS)
WHEELS_ANGULAR = Requirement("the same of their yaw rate", "rad/s", must=WHEELS_TOLERANCE_RADPS)


@dataclass(frozen=True)
class Stall:
    """One stop of one node.

    Attributes:
        speed_mps: speed of the wheels when it began.
        commands, wheels: excess beyond the limits, see judge.
        recovered_s: time from continuation to the previous speed, s; a robot that had to stop needs longer.
    """

    node: str
    duration_s: float
    speed_mps: float
    commands: Excess
    wheels: Excess
    recovered_s: float


def stall(robot: LiveRobot, node: str, duration_s: float) -> Stall:
    """Stop a node of a driving robot, and let it continue."""
    robot.wait_for_motion(MOVES_AGAIN_S)
    begin_s = time.monotonic()
    speed_mps = robot.wheels[-1].linear_mps
    fault = ProcessFault(Kind.STOP, lambda: [robot.process_of(node)])
    try:
        robot.watch(duration_s)
    finally:
        fault.end()
    continued_s = time.monotonic()
    robot.watch(SEEN_AFTER_S)
    robot.wait_for_motion(MOVES_AGAIN_S)
    end_s = time.monotonic()
    commands, wheels = (between(list(each), begin_s, end_s) for each in (robot.commands, robot.wheels))
    return Stall(node, duration_s, speed_mps, excess_of_commands(commands, wheels, COMMANDS),
                 excess_of_wheels(wheels, Growth(BASE.linear_acceleration_mps2, BASE.angular_acceleration_radps2)),
                 end_s - continued_s)


def stalls(robot: LiveRobot, durations_s: Sequence[float], nodes: Iterable[str] = NODES) -> List[Stall]:
    """Stop each node for each duration."""
    return [stall(robot, node, duration_s) for node in nodes for duration_s in durations_s]


def rows(found: Sequence[Stall]) -> List[Row]:
    """Return the worst values of all stops."""
    worst = max(found, key=lambda each: each.commands.linear_mps)
    return [Row(LINEAR, worst.commands.linear_mps,
                remark=f"{len(found)} stops, worst {worst.node} {worst.duration_s:g} s"),
            Row(ANGULAR, max(each.commands.angular_radps for each in found)),
            Row(WHEELS, max(each.wheels.linear_mps for each in found)),
            Row(WHEELS_ANGULAR, max(each.wheels.angular_radps for each in found))]
