"""The Car coordinate systems that the robot has had, and when each began."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping

from ..robot_status import CarFrame, RobotStatus


@dataclass(frozen=True)
class KnownFrame:
    """A frame since an instant of robot time, of one run of the robot's software."""

    robot_session_id: int
    frame: CarFrame
    since_s: float

    def is_same(self, other: KnownFrame) -> bool:
        """True when poses in both can be compared."""
        return (self.robot_session_id, self.frame) == (other.robot_session_id, other.frame)


class FrameHistory:
    """Frames in order of robot time.

    Attributes:
        newest: the frame that poses are in now, None before the Car was found.
    """

    def __init__(self) -> None:
        self.newest: KnownFrame | None = None

    def add(self, status: RobotStatus) -> bool:
        """Take the frame of a Status; True when it is another one than before."""
        if status.car is None:
            return False
        found = KnownFrame(status.robot_session_id, status.car_frame, status.stamp_s)
        if self.newest is not None and self.newest.is_same(found):
            return False
        was_known, self.newest = self.newest is not None, found
        return was_known


def frame_from(values: Mapping[str, Any] | None) -> KnownFrame | None:
    """Frame from the plain values of its fields; KeyError or TypeError when they are damaged."""
    if values is None:
        return None
    return KnownFrame(values["robot_session_id"], CarFrame(**values["frame"]), values["since_s"])
