"""Kills nodes during a drive; roslaunch restarts each, and the robot must drive on."""
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

# Nodes that know the Car's position are last: the position is lost with them, and a person must put the robot at the
# starting place.
KNOWING = ("car_locator", "localization")
NODES = (*(node for node in VOICES if node not in KNOWING), *KNOWING)
ROUNDS = 3
# roslaunch waits 2 s; after a loss of the position or of the Car, the Car is mapped again, which takes a minute.
RECOVERS_LIMIT_S = 180.0
# A robot that is in FAULT for longer than the start of a node does not recover by itself.
PATIENCE_S = 10.0
# After a kill, other nodes stop the wheels, or the base stops because it receives no commands.
STANDS_WITHIN_S = 2.0
STANDS_MPS = 0.05


class Restart(NamedTuple):
    """One killed node.

    Attributes:
        stood_s: time until the wheels stopped; None if they did not within the limit, because other nodes drive on.
        recovered_s: time until the robot drove again with the new process; None if it did not.
        mapped_again: the Car had to be mapped again.
    """

    node: str
    speed_mps: float
    stood_s: Optional[float]
    recovered_s: Optional[float]
    mapped_again: bool
    why: str = ""


def restarts(robot: LiveRobot, rounds: int, nodes: Sequence[str] = NODES) -> List[Restart]:
    """Kill each node once per round; stop the measurement if the robot does not recover."""
    made: List[Restart] = []
    for node in [*nodes] * rounds:
        made.append(restart(robot, node))
        if made[-1].recovered_s is None:
            break
    return made


def restart(robot: LiveRobot, node: str) -> Restart:
    """Kill a node of a driving robot."""
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
    """Actions of an Operator: releases the emergency stop, and orders a map of the Car if the robot requests it."""

    def __init__(self, robot: LiveRobot):
        self._robot = robot
        self.mapped = False
        self._begun_s: Optional[float] = None

    def give(self) -> bool:
        """Help if necessary; return True, for use in a condition."""
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
