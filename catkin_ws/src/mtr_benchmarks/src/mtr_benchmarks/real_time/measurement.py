"""One stretch of time of the robot: it maps the Car, drives round it, and is stopped now and then."""
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
# Of the commands to the wheels: slower by so much is braking, below that is standing (rad/s, too).
BRAKES_MPS, STANDS_MPS = 0.005, 0.001
ZERO_LIMIT_S = 10.0
ECHOES = 200
ECHO_BYTES = 100


class Stop(NamedTuple):
    """From the Operator's stop on: when the first command to the wheels was slower, and when it was zero; s."""

    brakes_s: float
    zero_s: float
    speed_mps: float


@dataclass(frozen=True)
class Stretch:
    """What was measured in it; times of the monotonic clock.

    Attributes:
        starts_s: from a waypoint that the Operator sends to a robot that stands, to the first velocity at the wheels.
        cpu: of a core, by node.
        echoes_s: of a message of a Command's size through ZeroMQ and back, without the robot.
    """

    begin_s: float
    end_s: float
    alarms: Tuple[str, ...]
    stops: List[Stop]
    starts_s: List[float]
    cpu: Dict[str, float]
    echoes_s: List[float]


def measure(robot: LiveRobot, watch: AlarmWatch, drive_s: float, stops: int) -> Stretch:
    """Map, drive for so long, stop and set off again so often; LiveError when the robot does not get through."""
    begin_s = time.monotonic()
    processes = {node: robot.process_of(f"/{node}") for node in VOICES}
    before = {node: cpu_s(process) for node, process in processes.items()}
    robot.map_car()
    robot.wait_for_motion(MOVES_LIMIT_S)
    # What was so before it set off, as the stop that it stood by, is no alarm.
    watch.take()
    robot.wait_until(lambda: robot.knows_car, "the Car mapped", MAP_LIMIT_S)
    robot.wait_for_motion(MOVES_LIMIT_S)
    robot.watch(drive_s)
    # A stop of the Operator's is a lock like others.
    alarms = watch.take()
    made, starts_s = [], []
    for _ in range(stops):
        made.append(stop_once(robot))
        starts_s.append(start_once(robot))
    end_s = time.monotonic()
    cpu = {node: (cpu_s(process) - before[node]) / (end_s - begin_s) for node, process in processes.items()}
    return Stretch(begin_s, end_s, alarms, made, starts_s, cpu, echoes_s())


def stop_once(robot: LiveRobot) -> Stop:
    """Stop a robot that drives."""
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
    """Send a robot that was stopped to its next place; s until its wheels are told to move, infinity when never."""
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
    """How long the machine itself takes for a message there and back, through the loopback interface."""
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
