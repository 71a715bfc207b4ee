"""One measured interval of the robot: it maps the Car, drives around it, and is stopped repeatedly."""
# SPDX-License-Identifier: Apache-2.0
import math
import time
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Tuple

import zmq

from ..harness.probe import cpu_s
from ..liveness.alarms import AlarmWatch
from ..liveness.judge import Motion
from ..liveness.live_robot import LiveRobot
from .arrivals import VOICES

MAP_LIMIT_S, MOVES_LIMIT_S = 180.0, 90.0
# Thresholds of wheel commands: a decrease by the first counts as braking, a value below the second as stopped (rad/s,
# too).
BRAKES_MPS, STANDS_MPS = 0.005, 0.001
ZERO_LIMIT_S = 10.0
ECHOES = 200
ECHO_BYTES = 100


class Stop(NamedTuple):
    """Times from the Operator's stop to the first slower wheel command and to zero, s; and the speed before."""

    brakes_s: float
    zero_s: float
    speed_mps: float


@dataclass(frozen=True)
class Stretch:
    """Figures of an interval; times of the monotonic clock.

    Attributes:
        starts_s: from a waypoint, sent to a stopped robot, to the first velocity at the wheels.
        cpu: share of a core, by node.
        echoes_s: round trips of a message of a Command's size through ZeroMQ, without the robot.
    """

    begin_s: float
    end_s: float
    alarms: Tuple[str, ...]
    stops: List[Stop]
    starts_s: List[float]
    cpu: Dict[str, float]
    echoes_s: List[float]


def measure(robot: LiveRobot, watch: AlarmWatch, drive_s: float, stops: int) -> Stretch:
    """Map the Car, drive for drive_s, then stop and restart the drive `stops` times.

    Raises:
        LiveError: the robot does not get through.
    """
    begin_s = time.monotonic()
    processes = {node: robot.process_of(f"/{node}") for node in VOICES}
    before = {node: cpu_s(process) for node, process in processes.items()}
    robot.map_car()
    robot.wait_for_motion(MOVES_LIMIT_S)
    # States before the start, such as the stop that held the robot, are not alarms.
    watch.take()
    robot.wait_until(lambda: robot.knows_car, "the Car mapped", MAP_LIMIT_S)
    robot.wait_for_motion(MOVES_LIMIT_S)
    robot.watch(drive_s)
    # A stop by the Operator engages a lock, which would count as an alarm.
    alarms = watch.take()
    made, starts_s = [], []
    for _ in range(stops):
        made.append(stop_once(robot))
        starts_s.append(start_once(robot))
    end_s = time.monotonic()
    cpu = {node: (cpu_s(process) - before[node]) / (end_s - begin_s) for node, process in processes.items()}
    return Stretch(begin_s, end_s, alarms, made, starts_s, cpu, echoes_s())


def stop_once(robot: LiveRobot) -> Stop:
    """Stop a driving robot."""
    robot.wait_for_motion(MOVES_LIMIT_S)
    speed_mps, first = abs(robot.commands[-1].linear_mps), len(robot.commands)
    ordered_s = robot.stop()
    deadline_s = ordered_s + ZERO_LIMIT_S
    while abs(robot.commands[-1].linear_mps) > STANDS_MPS and time.monotonic() < deadline_s:
        time.sleep(0.002)
    after = robot.commands[first:]
    braking_s = next((each.time_s for each in after if abs(each.linear_mps) < speed_mps - BRAKES_MPS), float("inf"))
    zero_s = next((each.time_s for each in after if abs(each.linear_mps) <= STANDS_MPS), float("inf"))
    return Stop(braking_s - ordered_s, zero_s - ordered_s, speed_mps)


def start_once(robot: LiveRobot) -> float:
    """Send a stopped robot to its next place; return the time to the first wheel command that moves it, s; infinite if
    none."""
    robot.wait_for_standstill(ZERO_LIMIT_S)
    first, ordered_s = len(robot.commands), robot.drive_on()
    deadline_s = ordered_s + MOVES_LIMIT_S
    while time.monotonic() < deadline_s:
        told = next((each for each in robot.commands[first:] if _tells_to_move(each)), None)
        if told:
            return told.time_s - ordered_s
        time.sleep(0.002)
    return math.inf


def _tells_to_move(command: Motion) -> bool:
    return max(abs(command.linear_mps), abs(command.angular_radps)) > STANDS_MPS


def echoes_s(count: int = ECHOES) -> List[float]:
    """Return the round trips of messages through the machine's loopback interface, s."""
    context, found = zmq.Context.instance(), []
    near, far = context.socket(zmq.PAIR), context.socket(zmq.PAIR)
    try:
        port = far.bind_to_random_port("tcp://127.0.0.1")
        near.connect(f"tcp://127.0.0.1:{port}")
        for _ in range(count):
            sent_s = time.monotonic()
            near.send(bytes(ECHO_BYTES))
            far.send(far.recv())
            near.recv()
            found.append(time.monotonic() - sent_s)
    finally:
        near.close(0)
        far.close(0)
    return found
