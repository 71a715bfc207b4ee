"""The robot as a scenario sees it: basic actions that block until they are done."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import math
from typing import Callable, Iterator, Mapping, Sequence, TypeVar

from ..errors import RobotFailed
from ..geometry.outline import NO_ERROR, OriginError
from ..geometry.pose import Pose
from ..geometry.ray import Ray
from ..requests import Direction, Press, Waypoint
from ..results.course import UNWATCHED
from ..results.frame_history import KnownFrame, frame_from
from ..results.journal import DECISION, POINT, PRESS, KeptPoint, plain_fields
from ..results.line_result import LineResult, LineStatus
from ..robot_status import CarCheck, CheckState, PressReport, RobotStatus, WaypointResult
from .control_loop import ControlLoop
from .distance import Distance, distance_from, measure_at
from .line_watch import LineWatch
from .pose_history import PoseUnknown
from .tolerances import Tolerances
from .trouble import LineInvalid

Answer = TypeVar("Answer")

# Robot times after which waiting is in vain.
REACH_LIMIT_S = 180.0
HEIGHT_LIMIT_S = 60.0
PRESS_LIMIT_S = 10.0
CHECK_LIMIT_S = 240.0
# The key's height is reached within this part of it or this distance, whichever is more.
_HEIGHT_PART = 0.02
_HEIGHT_M = 0.02


class Robot:
    """Waypoints, presses and checks count from 1 in a session.

    results: of the lines so far; it grows.
    """

    def __init__(self, loop: ControlLoop, results: Sequence[LineResult] = ()):
        self._loop = loop
        self._results = results
        self._waypoint_id = 0
        self._press_id = 0
        self._check_id = 0
        self._kept: dict[str, KeptPoint] = {}

    @property
    def now_s(self) -> float:
        """Robot time."""
        return self._loop.now_s

    @property
    def frame(self) -> KnownFrame | None:
        """Car coordinate system that poses are in now, None before the Car was found."""
        return self._loop.frames.newest

    @property
    def rest_s(self) -> float:
        """For how long the robot has stood, in s of robot time; infinite when nobody knows when it moved."""
        return self.now_s - self._loop.poses.moved_s

    def set_maximum_speed(self, speed_mps: float) -> None:
        """Limit the speed from now on."""
        self._loop.change(max_speed_mps=speed_mps)

    def go_to(self, ray: Ray, distance_m: float, direction: Direction = Direction.ANY) -> None:
        """Have the robot bring the Remote key to a distance on a ray, facing the Car. Does not wait."""
        status = self._loop.status
        self.drive_to(ray.base_pose(distance_m, (status.key_x, status.key_y)), direction)

    def drive_to(self, pose: Pose, direction: Direction = Direction.ANY) -> None:
        """Send base_link to a pose. Does not wait."""
        self._waypoint_id += 1
        self._loop.change(stop=False, waypoint=Waypoint(self._waypoint_id, pose, direction))

    def stop(self) -> None:
        """Have the robot stand still, and withdraw its waypoint. Does not wait. A stop that keeps the waypoint is the
        Operator's, and puts the robot on hold."""
        self._loop.change(stop=True, waypoint=None)

    def is_at_waypoint(self) -> bool:
        """True when the robot has reached the newest waypoint; LineInvalid when it refuses to go there."""
        status = self._loop.status
        if status.waypoint_id != self._waypoint_id:
            return False
        if status.waypoint_result is WaypointResult.REFUSED:
            raise LineInvalid(f"The robot refused the waypoint: {status.waypoint_message or 'no reason given.'}")
        return status.waypoint_result is WaypointResult.REACHED

    def wait_until_reached(self, or_when: Callable[[], Answer | None] = lambda: None) -> Answer | None:
        """Wait for the newest waypoint, or until or_when answers; its answer, None when the waypoint was first."""
        until_s = self._loop.waited_s + REACH_LIMIT_S
        while self._loop.waited_s < until_s:
            self._loop.step()
            answer = or_when()
            if answer or self.is_at_waypoint():
                return answer
        reason = self._loop.status.waypoint_message
        raise LineInvalid(f"The robot did not reach the waypoint within {REACH_LIMIT_S:g} s. {reason}".rstrip())

    def wait(self, duration_s: float, or_when: Callable[[], Answer | None] = lambda: None) -> Answer | None:
        """Wait for a duration of robot time, or until or_when answers; its answer."""
        until_s = self._loop.waited_s + duration_s
        answer = or_when()
        while not answer and self._loop.waited_s < until_s:
            self._loop.step()
            answer = or_when()
        return answer

    def move_key_to(self, height_m: float) -> None:
        """Move the Remote key to a height and wait until it is there; RobotFailed when it does not get there."""
        tolerance_m = max(_HEIGHT_M, _HEIGHT_PART * height_m)
        self._loop.change(key_height_m=height_m)
        until_s = self._loop.waited_s + HEIGHT_LIMIT_S
        while not abs(self._loop.step().key_height_m - height_m) <= tolerance_m:
            if self._loop.waited_s >= until_s:
                raise RobotFailed(f"The Remote key did not reach the height of {100.0 * height_m:g} cm within "
                                  f"{HEIGHT_LIMIT_S:g} s; it is at {100.0 * self._loop.status.key_height_m:.0f} cm.")

    def stand_and_lower_key(self, height_m: float) -> None:
        """Stop the wheels, then lower the key to a height if it is above it; RobotFailed when it stays up."""
        self._loop.change(waypoint=None, check_car_id=0, stop=False)
        if not self._loop.status.key_height_m <= height_m:
            self.move_key_to(height_m)

    def press(self, button: int, strength: float, duration_s: float) -> PressReport:
        """Press a button once; returns when the press is over, LineInvalid when it could not be pressed."""
        self._press_id += 1
        order = Press(self._press_id, (button,), strength, duration_s)
        self._loop.change(press=order)
        try:
            confirmation = self._confirmation_of(order)
        finally:
            self._loop.change(press=None)
        self._loop.context.journal.add(PRESS, plain_fields(confirmation))
        if confirmation.error:
            raise LineInvalid(f"The button could not be pressed: {confirmation.error}")
        return confirmation

    def _confirmation_of(self, order: Press) -> PressReport:
        until_s = self._loop.waited_s + order.duration_s + PRESS_LIMIT_S
        while self._loop.waited_s < until_s:
            for confirmation in self._loop.step().presses:
                if confirmation.id == order.id:
                    return confirmation
        raise LineInvalid(f"The robot did not confirm a button press within {PRESS_LIMIT_S:g} s.")

    @property
    def can_check_car(self) -> bool:
        """False for a robot whose software is too old."""
        return self._loop.status.car_check is not None

    def check_car(self) -> CarCheck:
        """Look at the Car again from two places; the robot's answer, RobotFailed when none comes."""
        self._check_id += 1
        self._loop.change(stop=False, check_car_id=self._check_id)
        until_s = self._loop.waited_s + CHECK_LIMIT_S
        while self._loop.waited_s < until_s:
            check = self._loop.step().car_check
            if check and check.id == self._check_id and check.state in (CheckState.PASSED, CheckState.FAILED):
                return check
        texts = [notification.text for notification in self._loop.status.notifications]
        raise RobotFailed(" ".join([f"The robot did not check the Car within {CHECK_LIMIT_S:g} s.", *texts]))

    def key_distance(self, ray: Ray, time_s: float, time_sigma_s: float, origin: OriginError = NO_ERROR) -> Distance:
        """Distance of the Remote key on the ray at an instant; LineInvalid when the pose then is unknown."""
        if not math.isfinite(time_sigma_s):
            raise LineInvalid("The instant of the event is not known.")
        try:
            return measure_at(ray, self._loop.poses, time_s, time_sigma_s, origin)
        except PoseUnknown as error:
            raise LineInvalid(str(error)) from None

    def take_up(self, points: Mapping[str, KeptPoint]) -> None:
        """A line is at hand on which these points were measured before an interruption; none on one that is begun."""
        self._kept = dict(points)

    def kept(self, word: str) -> Distance | None:
        """What was measured on the line at hand before an interruption; None unless it is in the present Car frame."""
        status, distance = self.kept_point(word) or (None, None)
        return distance if status is LineStatus.OK else None

    def kept_point(self, word: str) -> tuple[LineStatus, Distance] | None:
        """The same with what became of it, for a place where nothing happened says something too."""
        point, frame = self._kept.get(word), self.frame
        if point is None or point.distance is None or frame is None:
            return None
        measured_in = frame_from(point.frame)
        if measured_in is None or not measured_in.is_same(frame):
            return None
        return point.status, distance_from(point.distance)

    @property
    def results(self) -> tuple[LineResult, ...]:
        """Of the lines measured so far, for a scenario whose lines have something in common."""
        return tuple(self._results)

    def keep(self, word: str, status: LineStatus, distance: Distance | None = None) -> None:
        """Keep a measurement of the line at hand, before the robot is ordered on; returns when it is safe.

        word: what it is called, of the scenario's distance_words, with a number where there are several.
        """
        self._loop.context.journal.add(POINT, {
            "word": word, "status": status.value, "distance": None if distance is None else plain_fields(distance),
            "frame": None if self.frame is None else plain_fields(self.frame)})
        # Nobody reads of what follows from it before it is safe.
        self._loop.settle()

    @contextlib.contextmanager
    def watched(self, tolerances: Tolerances, *, judges_locks: bool = True) -> Iterator[LineWatch]:
        """Within the context anything that makes a measurement doubtful raises LineInvalid.

        judges_locks: so does a change of the Car's locks that nobody expects.
        """
        line = LineWatch(self._loop, tolerances, judges_locks=judges_locks)
        try:
            with self._loop.watched(line.check):
                yield line
        finally:
            self._loop.context.course.note(UNWATCHED, {})

    def trouble(self) -> str:
        """Why nothing can be measured now; empty when it can."""
        return self._loop.trouble()

    def say(self, action: str) -> None:
        """Tell the Operator what the robot does now."""
        self._loop.observer.on_action(action)
        self._loop.context.journal.add(DECISION, {"action": action, "robot_time_s": self.now_s})

    @property
    def status(self) -> RobotStatus:
        """The newest Status."""
        return self._loop.status
