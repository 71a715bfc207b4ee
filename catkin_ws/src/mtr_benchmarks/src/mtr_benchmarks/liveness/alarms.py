"""Collects alarms of the nodes while the robot is observed."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Tuple

import rospy

from mtr_core import names
from mtr_msgs.msg import DriveStatus, LocalizedPose, MotionStatus, RobotMode


class AlarmWatch:
    """Alarms of the nodes: engaged locks, invalid poses, missing inputs, and unexpected modes."""

    def __init__(self) -> None:
        self._alarms: List[str] = []
        for topic, kind, take in ((names.DRIVE_STATUS, DriveStatus, self._take_drive),
                                  (names.LOCALIZED_POSE, LocalizedPose, self._take_pose),
                                  (names.ROBOT_MODE, RobotMode, self._take_mode),
                                  (names.MOTION_STATUS, MotionStatus, self._take_motion)):
            rospy.Subscriber(topic, kind, take, queue_size=200)

    def take(self) -> Tuple[str, ...]:
        """Return the distinct alarms since the last call, in order."""
        said, self._alarms = self._alarms, []
        return tuple(dict.fromkeys(said))

    def _take_drive(self, status: DriveStatus) -> None:
        self._alarms += [f"drive control: lock of {owner}" for owner in status.engaged_locks]
        if status.zone == DriveStatus.BLIND:
            self._alarms.append(f"drive control: {status.message}")

    def _take_pose(self, pose: LocalizedPose) -> None:
        if not pose.valid:
            self._alarms.append(f"localization: {pose.message}")

    def _take_mode(self, mode: RobotMode) -> None:
        if mode.mode in (RobotMode.STARTING, RobotMode.FAULT):
            self._alarms.append(f"state machine: {mode.message}")

    def _take_motion(self, status: MotionStatus) -> None:
        if any(problem.code.startswith("motion_planner.input") for problem in status.problems):
            self._alarms.append(f"motion planner: {status.message}")
