"""Sets the robot's clock during a drive; checks for false alarms of silence and whether the robot drives on."""
# SPDX-License-Identifier: Apache-2.0
import time
from dataclasses import dataclass
from typing import List, Sequence, Tuple

from mtr_fault_injection.set_clock import SettableClock

from ..harness.rows import Requirement, Row
from .alarms import AlarmWatch
from .judge import longest_pause_s
from .live_robot import LiveRobot

STEPS_S = (0.05, -0.05, 0.4, -0.4, 5.0, -5.0, 60.0, -60.0, 3600.0, -3600.0)
# An effect of a step shows within the longest time-out of a node.
SEEN_AFTER_S = 2.5
MOVES_AGAIN_S = 60.0
# Sensors publish 50 times a second. If they are silent for longer, the machine is overloaded and alarms are not caused
# by the clock: the step is repeated.
MAX_SENSOR_PAUSE_S = 0.1
TRIES = 5
# Statuses come ten times a second; a tick may be missing when the clock jumps over it.
MAX_STATUS_PAUSE_S = 0.5
# Alarms would also be absent if the clock had not been set.
NOT_COUNTED = Requirement("steps of the clock that the robot has not counted as one", "(count)", must=0.0)
ALARMS = Requirement("alarms of nodes because the robot's clock was set", "(count)", must=0.0)
PAUSE = Requirement("longest time without a Status while it was set", "s", must=MAX_STATUS_PAUSE_S)


@dataclass(frozen=True)
class ClockStep:
    """One step of the clock.

    Attributes:
        alarms: distinct new alarms of the nodes.
        status_pause_s: longest time without a Status.
        speed_mps: speed of the wheels when the clock was set.
        sensor_pause_s: longest time without odometry, which is independent of the clock.
        counted: number of clock steps that the robot reports.
    """

    step_s: float
    alarms: Tuple[str, ...]
    status_pause_s: float
    speed_mps: float
    sensor_pause_s: float
    counted: int


def clock_step(robot: LiveRobot, clock: SettableClock, watch: AlarmWatch, step_s: float) -> ClockStep:
    """Set the clock of a driving robot."""
    robot.wait_for_motion(MOVES_AGAIN_S)
    watch.take()
    begin_s, speed_mps, before = time.monotonic(), robot.wheels[-1].linear_mps, _counted(robot)
    clock.set_by(step_s)
    robot.watch(SEEN_AFTER_S)
    end_s = time.monotonic()
    pause_s = longest_pause_s(list(robot.status_times_s), begin_s, end_s)
    sensor_pause_s = longest_pause_s([each.time_s for each in list(robot.wheels)], begin_s, end_s)
    return ClockStep(step_s, watch.take(), pause_s, speed_mps, sensor_pause_s, _counted(robot) - before)


def _counted(robot: LiveRobot) -> int:
    return int(robot.status.interventions.clock_steps)


def clock_steps(robot: LiveRobot, clock: SettableClock, steps_s: Sequence[float]) -> List[ClockStep]:
    """Run one step after the other; repeat a step if the machine was overloaded."""
    watch, found = AlarmWatch(), []
    for step_s in steps_s:
        for _ in range(TRIES):
            step = clock_step(robot, clock, watch, step_s)
            if step.sensor_pause_s <= MAX_SENSOR_PAUSE_S:
                break
        found.append(step)
    return found


def rows(found: Sequence[ClockStep]) -> List[Row]:
    """Return the sum or the worst value of all steps."""
    return [Row(ALARMS, sum(len(each.alarms) for each in found), remark=f"{len(found)} steps"),
            Row(PAUSE, max(each.status_pause_s for each in found)),
            Row(NOT_COUNTED, sum(each.counted != 1 for each in found))]
