"""Robot, Car and the clocks between them, and the two links through which the application sees them."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import Callable, List, NamedTuple, Optional, Tuple

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.catch_up import LIMIT_S as CATCH_UP_LIMIT_S
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import CarProfile
from mtr_operator.domain.ports import CarEvent, CarLink, LinkStatistics, LockFacts, LockState, RobotLink
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import CarDimensions, Mode, PressReport, RobotStatus

from .car import LOCK_ID, CarBody, Frame
from .clocks import Clock, Way
from .robot import KEY_X_M, RobotBody

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
STATUS_PERIOD_S = 0.1
STEPS = 10
# Age of a pose when it is sent.
POSE_AGE_S = 0.06


class PoseError(NamedTuple):
    """Difference between reported and true position: a constant part and a slowly swinging one; m.

    Attributes:
        sigma_m: reported sigma.
    """

    sigma_m: float
    still: Tuple[float, float] = (0.0, 0.0)
    swing: Tuple[float, float] = (0.0, 0.0)
    swing_period_s: float = math.inf

    def at(self, time_s: float) -> Tuple[float, float]:
        """Return the reported position minus the true one."""
        share = math.sin(2.0 * math.pi * time_s / self.swing_period_s)
        return self.still[0] + share * self.swing[0], self.still[1] + share * self.swing[1]


@dataclass
class World:
    """Simulated world; true time is the laptop's.

    Attributes:
        loses: function of the true time; True if a Status or Command is lost.
        tells_steady_clock: False for a robot with older software.
        late_presses: number of following presses to which the Car reacts only after late_reaction_s.
    """

    robot: RobotBody
    car: CarBody
    robot_clock: Clock
    adapter_clock: Clock
    status_way: Way
    frame_way: Way
    press_range_m: float
    reaction_s: float
    is_stamped: bool
    tells_steady_clock: bool
    pose_error: PoseError
    loses: Callable[[float], bool] = lambda time_s: False
    late_reaction_s: float = 0.0
    late_presses: int = 0
    time_s: float = 0.0
    _status_id: int = 0
    _arrived: List[Tuple[float, Frame]] = field(default_factory=list)
    _poses: List[Tuple[float, float, float, float, float]] = field(default_factory=list)

    def step(self) -> None:
        """Advance the time by the period of one Status."""
        dt_s, gap_m = STATUS_PERIOD_S / STEPS, self._gap_m()
        for _ in range(STEPS):
            before_s, gap_before_m = self.time_s, gap_m
            self.time_s = round(self.time_s + dt_s, 9)
            for press in self.robot.step(self.time_s, dt_s):
                if math.hypot(press.place.x, press.place.y) <= self.press_range_m:
                    self.car.press(press.id, press.locks, press.start_s + self._next_reaction_s())
            gap_m = self._gap_m()
            self.car.step(before_s, self.time_s, gap_before_m, gap_m, self.robot.key(self.time_s))
            robot = self.robot
            self._poses.append((self.time_s, robot.x, robot.y, robot.heading, robot.speed_mps))
            self._arrived += [(self.frame_way.arrival_s(frame.time_s), frame) for frame in self.car.frames(self.time_s)]
        del self._poses[:-2 * STEPS]

    def frames_until(self, arrival_s: float) -> List[CanFrame]:
        """Return frames that have arrived and were not returned before."""
        count = 0
        while count < len(self._arrived) and self._arrived[count][0] <= arrival_s:
            count += 1
        taken, self._arrived = self._arrived[:count], self._arrived[count:]
        return [CanFrame(LOCK_ID, False, frame.data, arrival, self._stamp_ms(frame)) for arrival, frame in taken]

    def status(self) -> RobotStatus:
        """Return the robot's current Status."""
        robot, clock, now_s = self.robot, self.robot_clock, self.time_s
        self._status_id += 1
        pose_s, x, y, heading, speed_mps = next(pose for pose in self._poses if pose[0] >= now_s - POSE_AGE_S - 1e-6)
        error_x, error_y = self.pose_error.at(pose_s)
        steady_s = clock.steady_s(now_s) - 1e6 if self.tells_steady_clock else math.nan
        return RobotStatus(
            id=self._status_id, robot_session_id=7, stamp_s=clock.at(pose_s), sent_s=clock.at(now_s),
            steady_s=steady_s, waits_for_answer=True, x=x + error_x, y=y + error_y, heading=heading,
            speed_mps=speed_mps, pose_valid=True, position_sigma_m=self.pose_error.sigma_m, heading_sigma_rad=0.01,
            key_x=KEY_X_M, key_height_m=robot.height_m(now_s), battery_percent=80,
            mode=Mode.FOLLOWING_WAYPOINT, car=CAR, waypoint_result=robot.result,
            waypoint_id=robot.waypoint.id if robot.waypoint else 0, interventions=robot.interventions(now_s),
            presses=tuple(PressReport(press.id, clock.at(press.start_s), clock.at(press.end_s))
                          for press in robot.presses if press.end_s <= now_s))

    def _next_reaction_s(self) -> float:
        if self.late_presses <= 0:
            return self.reaction_s
        self.late_presses -= 1
        return self.late_reaction_s

    def _gap_m(self) -> float:
        key = self.robot.key(self.time_s)
        return math.hypot(max(abs(key.x) - CAR.length / 2, 0.0), max(abs(key.y) - CAR.width / 2, 0.0))

    def _stamp_ms(self, frame: Frame) -> Optional[int]:
        return int(self.adapter_clock.at(frame.time_s) * 1000.0) % 60_000 if self.is_stamped else None


class WorldRobot(RobotLink):
    """Link to the robot; each next_status advances the time by one Status.

    Attributes:
        arrival_s: true arrival time of the newest Status.
    """

    def __init__(self, world: World):
        self.statistics = LinkStatistics()
        self.arrival_s = 0.0
        self._world = world

    def connect(self) -> None:
        pass

    def next_status(self, timeout_s: float) -> Optional[RobotStatus]:
        for _ in range(max(round(timeout_s / STATUS_PERIOD_S), 1)):
            self._world.step()
            status = self._world.status()
            if not self._world.loses(self._world.time_s):
                self.arrival_s = self._world.status_way.arrival_s(self._world.time_s)
                return status
        return None

    def send(self, desired: DesiredState) -> None:
        if not self._world.loses(self._world.time_s):
            self._world.robot.take(desired, self._world.time_s)

    def close(self) -> None:
        pass


class WorldCar(CarLink):
    """Link to the Car like CanCarLink, without threads: a LockWatch receives frames in the order of their arrival."""

    def __init__(self, world: World, robot_link: WorldRobot, profile: CarProfile):
        self._world, self._robot_link, self._watch = world, robot_link, LockWatch(profile)
        self._facts = profile.facts

    def connect(self) -> None:
        pass

    def observe(self, status: RobotStatus) -> List[CarEvent]:
        watch, now_s = self._watch, self._robot_link.arrival_s
        self._feed(now_s)
        watch.status(status, now_s)
        limit_s = now_s + CATCH_UP_LIMIT_S
        while not watch.has_caught_up() and now_s < limit_s:
            now_s += 0.01
            self._feed(now_s)
        return watch.release(now_s)

    @property
    def facts(self) -> LockFacts:
        return self._facts

    @property
    def lock_state(self) -> LockState:
        return self._watch.lock_state

    @property
    def problem(self) -> str:
        return self._watch.problem

    def close(self) -> None:
        pass

    def _feed(self, until_s: float) -> None:
        for frame in self._world.frames_until(until_s):
            self._watch.frame(frame)
