"""Drive control between its core and the other parts, as mtr_drive_control's node without a manual controller."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, List, Optional, Tuple

from mtr_drive_control_core import Decision, RobotDrive
from std_msgs.msg import Header

from mtr_core import names
from mtr_core.schedule import DRIVE_CONTROL
from mtr_msgs.msg import DriveStatus, MotionLock
from mtr_simulation.sensors.readings import Sensors

from . import wire
from .topics import Topics

# Whose silence forbids motion, as in drive control's node.
LOCK_OWNERS = ("dispatcher", "state_machine")


class DriveControlPart:
    """Decides at each tick what the wheels do."""

    slot = DRIVE_CONTROL

    def __init__(self, topics: Topics, urdf: str, command: Callable[[float, float], None]):
        """command: takes the wheels' velocity, m/s and rad/s."""
        self._topics, self._command = topics, command
        self._core = RobotDrive(urdf, True, list(LOCK_OWNERS), DRIVE_CONTROL.period_ns * 1e-9)
        self._planner, self._peripherals = topics.velocity.input(), topics.peripherals.input()
        self._mode = topics.mode.input()
        self._sensors: Optional[Sensors] = None

    def sense(self, sensors: Sensors) -> None:
        """Sensors as they come over the wire."""
        self._sensors = sensors
        for is_rear, scan in enumerate((sensors.front_scan, sensors.rear_scan)):
            if scan is not None:
                self._core.take_scan(bool(is_rear), scan)

    def take_lock(self, lock: MotionLock) -> None:
        """From one of its owners."""
        self._core.take_lock(lock.owner, lock.header.stamp.to_nsec(), lock.engaged, _tuples(lock), lock.reason)

    def step(self, tick_ns: int) -> None:
        """One tick."""
        assert self._sensors is not None
        decision = self._core.step(tick_ns, odometry=self._sensors.odometry, imu=self._sensors.imu,
                                   key=self._key(tick_ns), planner=self._wanted(tick_ns),
                                   speed_limit=self._speed_limit(tick_ns))
        self._command(decision.linear_mps, decision.angular_radps)
        self._topics.drive.publish(_status(decision, tick_ns, self._core.interventions))

    def _key(self, tick_ns: int) -> Optional[Tuple[int, float]]:
        state = self._peripherals.at(tick_ns)
        return (state.header.stamp.to_nsec(), state.key_height_m) if state is not None and state.alive else None

    def _speed_limit(self, tick_ns: int) -> Optional[Tuple[int, float]]:
        mode = self._mode.at(tick_ns)
        return None if mode is None else (mode.header.stamp.to_nsec(), mode.max_speed_mps)

    def _wanted(self, tick_ns: int) -> Optional[Tuple[int, float, float, bool]]:
        wanted = self._planner.at(tick_ns)
        if wanted is None:
            return None
        return wanted.header.stamp.to_nsec(), wanted.linear_mps, wanted.angular_radps, bool(wanted.active)


def _tuples(lock: MotionLock) -> List[wire.ProblemTuple]:
    return [(each.code, each.text, list(each.names), list(each.values)) for each in lock.problems]


def _status(decision: Decision, tick_ns: int, counted: Tuple[int, int, int]) -> DriveStatus:
    manual_drives, blockages, lock_stops = counted
    return DriveStatus(
        header=Header(0, wire.stamp(tick_ns), names.BASE),
        source=decision.source, linear_mps=decision.linear_mps, angular_radps=decision.angular_radps,
        engaged_locks=decision.engaged_locks, message=decision.message, problems=wire.problems(decision.problems),
        zone=decision.zone, obstacle_m=decision.obstacle_m, obstacle_bearing=decision.obstacle_bearing,
        manual_drives=manual_drives, blockages=blockages, lock_stops=lock_stops)
