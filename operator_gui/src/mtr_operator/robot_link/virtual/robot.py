"""Virtual robot without hardware: it follows Commands as the real one does, on a virtual clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import random
import secrets
from dataclasses import dataclass, replace

from mtr_operator import __version__
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import DesiredState, Waypoint
from mtr_operator.domain.robot_status import (
    CarDimensions,
    CarFrame,
    EmergencyStop,
    Mode,
    PreflightReport,
    RobotStatus,
    WaypointResult,
)

from .area import VirtualArea
from .check import VirtualCheck
from .keyholder import VirtualKeyholder
from .route import Box, Point, advance, route
from .service import VirtualService

STATUS_PERIOD_S = 0.1
_START_TIME_S = 1.0
_START_DISTANCE_M = 4.0
_TURN_RATE_RADPS = 1.0
_DEFAULT_SPEED_MPS = 0.5
_MAX_SPEED_MPS = 2.0
# Half diagonal of the robot's footprint (0.51 m x 0.43 m).
_ROBOT_RADIUS_M = 0.34
_MAX_SESSION_ID = 2 ** 63 - 1


@dataclass(frozen=True)
class VirtualWorld:
    """Environment of the virtual robot: the Car, the durations of start and mapping, and the displacement that a check
    finds.

    position_sigma_m, heading_sigma_rad, car_sigma_m: reported 1 sigma of its pose and of the Car's length and width.
    """

    car_length_m: float = 4.5
    car_width_m: float = 1.8
    key_x_m: float = 0.25
    starting_s: float = 0.5
    mapping_s: float = 3.0
    check_difference_m: float = 0.002
    position_sigma_m: float = 0.02
    heading_sigma_rad: float = 0.005
    car_sigma_m: float = 0.01


DEFAULT_WORLD = VirtualWorld()


class VirtualRobot:
    """State of the virtual robot; step() advances time, take() sets the desired state.

    robot_session_id: 1 to 2^63 - 1. None derives it from the seed, so that two robots of one seed report equal values.
    A consumer that outlives the first would mistake the second for it; use started() in that case.
    """

    def __init__(self, seed: int, world: VirtualWorld = DEFAULT_WORLD, *, robot_session_id: int | None = None):
        chance = random.Random(seed)
        bearing = chance.uniform(-math.pi, math.pi)
        self._world = world
        self._car = CarDimensions(world.car_length_m, world.car_width_m, world.car_sigma_m, world.car_sigma_m)
        self._box = Box(world.car_length_m / 2 + _ROBOT_RADIUS_M, world.car_width_m / 2 + _ROBOT_RADIUS_M)
        drawn_id = chance.randrange(1, _MAX_SESSION_ID + 1)
        self._robot_session_id = drawn_id if robot_session_id is None else robot_session_id
        self._session_id = 0
        self._command_id = 0
        self._time_s = _START_TIME_S
        self._here: Point = (_START_DISTANCE_M * math.cos(bearing), _START_DISTANCE_M * math.sin(bearing))
        self._heading = math.remainder(bearing + math.pi, 2 * math.pi)
        self._speed_mps = self._yaw_rate_radps = 0.0
        self._key = VirtualKeyholder()
        self._check = VirtualCheck(world.check_difference_m)
        self._area = VirtualArea(self._robot_session_id, self.pose)
        self._service = VirtualService()
        self._desired = DesiredState(stop=True)
        self._waypoint: Waypoint | None = None
        self._way: list[Point] = []
        self._result, self._result_text = WaypointResult.NONE, ""
        self._map_car_id = 0
        self._mapping_left_s = world.mapping_s
        self._status_id = 0

    @classmethod
    def started(cls, seed: int, world: VirtualWorld = DEFAULT_WORLD) -> VirtualRobot:
        """Return a robot with a unique session id, which identifies its clock and its map."""
        return cls(seed, world, robot_session_id=secrets.randbelow(_MAX_SESSION_ID) + 1)

    @property
    def time_s(self) -> float:
        """Virtual clock in s."""
        return self._time_s

    @property
    def pose(self) -> Pose:
        """Pose of base_link in the Car's frame, m and rad."""
        return Pose(*self._here, self._heading)

    @property
    def key_height_m(self) -> float:
        """Height of the key above ground."""
        return self._key.height_m

    @property
    def is_driving(self) -> bool:
        """True on the way to a waypoint."""
        return (self._result is WaypointResult.PENDING and not self._desired.stop
                and self._desired.waypoint is not None)

    def take(self, session_id: int, command_id: int, desired: DesiredState) -> None:
        """Follow this desired state from now on. A new session resets the ids."""
        if session_id != self._session_id:
            self._begin_session(session_id)
        self._service.take(desired)
        desired = replace(desired, stop=desired.stop or self._service.is_active)
        self._command_id, self._desired = command_id, desired
        self._area.take(session_id, desired.area)
        if self._mode() in (Mode.FOLLOWING_WAYPOINT, Mode.CHECKING_CAR):
            self._check.request(desired.check_car_id)
        if desired.stop:
            self._key.stop(desired.press, self._time_s)
        else:
            self._key.request(desired.key_height_m, desired.press, self._time_s)
        if desired.map_car_id != self._map_car_id:
            self._map_car_id = desired.map_car_id
            self._mapping_left_s = self._world.mapping_s
        waypoint = desired.waypoint
        if waypoint is not None and (self._waypoint is None or waypoint.id != self._waypoint.id):
            self._set_waypoint(waypoint)

    def _begin_session(self, session_id: int) -> None:
        self._session_id, self._map_car_id, self._waypoint = session_id, 0, None
        self._result, self._result_text = WaypointResult.NONE, ""
        self._key.begin_session()
        self._check.begin_session()

    def halt(self) -> None:
        """Stop until the next desired state: the Operator has gone or is silent."""
        self._desired = DesiredState(stop=True)
        self._key.stop(None, self._time_s)

    def leave(self) -> None:
        """Stop without a controller: the Operator has sent a goodbye."""
        self.halt()
        self._begin_session(0)

    def step(self, dt_s: float = STATUS_PERIOD_S) -> None:
        """Advance the time by dt_s."""
        self._time_s += dt_s
        self._key.step(self._time_s, dt_s)
        before, heading = self._here, self._heading
        if not self._desired.stop:
            self._check.step(dt_s)
        waypoint = None if self._desired.stop or self._desired.waypoint is None else self._waypoint
        if self._time_s >= _START_TIME_S + self._world.starting_s:
            if self._mapping_left_s > 0:
                self._map(waypoint, dt_s)
            elif waypoint is not None and self._result == WaypointResult.PENDING and not self._check.is_running:
                self._drive(waypoint, dt_s)
        dx, dy = self._here[0] - before[0], self._here[1] - before[1]
        ahead = math.cos(heading) * dx + math.sin(heading) * dy
        self._speed_mps = math.copysign(math.hypot(dx, dy), ahead) / dt_s
        self._yaw_rate_radps = math.remainder(self._heading - heading, 2 * math.pi) / dt_s

    def _map(self, waypoint: Waypoint | None, dt_s: float) -> None:
        """Map the Car before the first waypoint, or on request."""
        if waypoint is not None or (self._map_car_id and not self._desired.stop):
            self._mapping_left_s -= dt_s

    def status(self) -> RobotStatus:
        """Return the next Status message."""
        self._status_id += 1
        mapped = self._mapping_left_s <= 0
        world, mode = self._world, self._mode()
        stamp_s = round(self._time_s, 6)
        return RobotStatus(
            id=self._status_id, robot_session_id=self._robot_session_id, stamp_s=stamp_s, sent_s=stamp_s,
            steady_s=stamp_s, waits_for_answer=True, emergency_stop=EmergencyStop.RELEASED, preflight=PreflightReport(),
            x=self._here[0], y=self._here[1], heading=self._heading, speed_mps=self._speed_mps,
            yaw_rate_radps=self._yaw_rate_radps, pose_valid=mapped, position_sigma_m=world.position_sigma_m,
            heading_sigma_rad=world.heading_sigma_rad, key_x=world.key_x_m, key_y=0.0, key_height_m=self._key.height_m,
            pressed_buttons=self._key.pressed_buttons(self._time_s),
            localization_accuracy_cm=round(world.position_sigma_m * 100), battery_percent=80,
            is_mapping_car=mode is Mode.MAPPING_CAR, mode=mode,
            car=self._car if mapped else None,
            car_frame=CarFrame(revision=1) if mapped else CarFrame(), car_check=self._check.report,
            session_id=self._session_id, command_id=self._command_id,
            waypoint_id=self._waypoint.id if self._waypoint else 0, waypoint_result=self._result,
            waypoint_message=self._result_text, presses=self._key.confirmations, map_car_id=self._map_car_id,
            software_version=f"{__version__} (substitute)", simulated=True,
            service=self._service.state, notifications=self._service.notifications,
            area=self._area.state(self._session_id, self.pose, is_mapped=mapped))

    def _mode(self) -> Mode:
        if self._time_s < _START_TIME_S + self._world.starting_s:
            return Mode.STARTING
        if self._mapping_left_s <= 0:
            return Mode.CHECKING_CAR if self._check.is_running else Mode.FOLLOWING_WAYPOINT
        begun = self._waypoint is not None or self._map_car_id or self._mapping_left_s < self._world.mapping_s
        return Mode.MAPPING_CAR if begun else Mode.READY_TO_MAP_CAR

    def _set_waypoint(self, waypoint: Waypoint) -> None:
        self._waypoint = waypoint
        point = (waypoint.pose.x, waypoint.pose.y)
        self._result, self._result_text = WaypointResult.PENDING, ""
        if not all(map(math.isfinite, (*point, waypoint.pose.heading))):
            self._result, self._result_text = WaypointResult.REFUSED, "The waypoint is not a number."
        elif self._box.contains(point):
            self._result = WaypointResult.REFUSED
            self._result_text = f"The waypoint ({point[0]:.2f} m, {point[1]:.2f} m) is too close to the Car."
        else:
            self._way = route(self._here, point, self._box)

    def _drive(self, waypoint: Waypoint, dt_s: float) -> None:
        limit_mps = self._desired.max_speed_mps or _DEFAULT_SPEED_MPS
        self._here, self._way = advance(self._here, self._way, min(limit_mps, _MAX_SPEED_MPS) * dt_s)
        turn = math.remainder(waypoint.pose.heading - self._heading, 2 * math.pi)
        turn_step = _TURN_RATE_RADPS * dt_s
        self._heading = math.remainder(self._heading + min(max(turn, -turn_step), turn_step), 2 * math.pi)
        if not self._way and abs(turn) <= turn_step:
            self._result = WaypointResult.REACHED
