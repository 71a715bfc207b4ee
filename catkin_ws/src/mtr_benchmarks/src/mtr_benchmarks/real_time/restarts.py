"""Nodes are killed in the middle of a drive; roslaunch starts each again, and the robot is to drive on."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import signal
import time
from typing import List, NamedTuple, Optional, Sequence

from mtr_fault_injection.parts import FaultError
from mtr_proto import robot_link_pb2 as link

from ..liveness.live_robot import LiveError, LiveRobot
from .arrivals import VOICES

# Those that know where the Car is come last: it is forgotten with them, and a person has to put the robot at the
# starting place.
KNOWING = ("car_locator", "localization")
NODES = (*(node for node in VOICES if node not in KNOWING), *KNOWING)
ROUNDS = 3
# roslaunch waits 2 s; after a loss of position or of the Car it is mapped again, which takes a minute.
RECOVERS_LIMIT_S = 180.0
# A robot that is in FAULT for longer than a node takes to start does not find back by itself.
PATIENCE_S = 10.0
# After a death the wheels are told to stop by others, or the base stops for want of commands.
STANDS_WITHIN_S = 2.0
STANDS_MPS = 0.05


class Restart(NamedTuple):
    """One death of a node.

    Attributes:
        stood_s: from it on until the wheels stood; None when they did not within the limit, as others drive on.
        recovered_s: until the robot drove again with the new process; None when it did not.
        mapped_again: the Car had to be.
    """

    node: str
    speed_mps: float
    stood_s: Optional[float]
    recovered_s: Optional[float]
    mapped_again: bool
    why: str = ""


def restarts(robot: LiveRobot, rounds: int, nodes: Sequence[str] = NODES) -> List[Restart]:
    """Each node so often; the measurement ends where the robot does not recover."""
    made: List[Restart] = []
    for node in [*nodes] * rounds:
        made.append(restart(robot, node))
        if made[-1].recovered_s is None:
            break
    return made


def restart(robot: LiveRobot, node: str) -> Restart:
    """Kill a node of a robot that drives."""
    robot.wait_until(lambda: robot.knows_car, "the Car mapped", RECOVERS_LIMIT_S)
    robot.wait_for_motion(RECOVERS_LIMIT_S)
    killed, speed_mps = robot.process_of(f"/{node}"), abs(robot.wheels[-1].linear_mps)
    os.kill(killed, signal.SIGKILL)
    begun_s = time.monotonic()
    robot.watch(STANDS_WITHIN_S)
    stood_s = next((each.time_s - begun_s for each in robot.wheels
                    if each.time_s > begun_s and abs(each.linear_mps) < STANDS_MPS), None)
    helped = _Help(robot)
    try:
        robot.wait_until(lambda: helped.give() and _is_new(robot, node, killed), f"a new {node}", RECOVERS_LIMIT_S)
        robot.wait_until(lambda: helped.give() and robot.moves and robot.knows_car, "motion", RECOVERS_LIMIT_S)
    except LiveError as error:
        return Restart(node, speed_mps, stood_s, None, helped.mapped, str(error))
    return Restart(node, speed_mps, stood_s, time.monotonic() - begun_s, helped.mapped)


class _Help:
    """What an Operator does meanwhile: releases the emergency stop, and has the Car mapped when it is asked for."""

    def __init__(self, robot: LiveRobot):
        self._robot = robot
        self.mapped = False
        self._begun_s: Optional[float] = None

    def give(self) -> bool:
        """Always True, so that it may stand in a condition."""
        status = self._robot.status
        if status.emergency_stop == link.EMERGENCY_STOP_ENGAGED:
            self._robot.hold_release()
            return True
        self._robot.let_go()
        if self._begun_s is None:
            self._begun_s = time.monotonic()
        wants_map = status.mode in (link.MODE_READY_TO_MAP_CAR, link.MODE_FAULT) and not self.mapped
        if wants_map and time.monotonic() - self._begun_s > PATIENCE_S:
            self.mapped = True
            self._robot.map_car()
        return True


def _is_new(robot: LiveRobot, node: str, killed: int) -> bool:
    with contextlib.suppress(FaultError):
        return robot.process_of(f"/{node}") != killed
    return False
