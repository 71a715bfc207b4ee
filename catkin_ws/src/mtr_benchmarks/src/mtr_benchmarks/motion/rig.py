"""Simulated robot with drive control's core alone: a wanted velocity as input, with physics and sensors."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Optional, Tuple

import mtr_drive_control_core as core

from mtr_core.schedule import SIMULATION_START_NS
from mtr_core.se2 import Pose2
from mtr_description.shipped import shipped_geometry, shipped_urdf
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sensors.readings import Scan, Sensors
from mtr_simulation.sensors.scan_errors import ScanErrors
from mtr_simulation.sim import Sim, SimParameters
from mtr_simulation.site.figures import BODIES as FIGURE_BODIES
from mtr_simulation.site.scenario import Scenario

from ..harness.speed import fastest_point_mps

ROBOT = shipped_robot()
Velocity = Tuple[float, float]
# Values of the zone in DriveStatus.
SLOWED, STOPPED = 1, 2
FOOTPRINT = shipped_geometry().footprint()
FRONT_M = FOOTPRINT.front_m
TICK_S = 0.02
# Before its first tick the robot is stopped until nothing sways, and then scans its surroundings.
SETTLING_S, LOOKING_S = 1.5, 0.2
START_S = SETTLING_S + LOOKING_S
PERSON = FIGURE_BODIES


class Rig:
    """One robot under test.

    Attributes:
        sim: physics and sensors.
        decision: drive control's newest decision; None before the first.
        site_map: map of a localized robot, from mtr_drive_control_core; None: it is not localized.
    """

    def __init__(self, scenario: Scenario, seed: int, rear_lidar: bool = True, rain: float = 0.0,
                 lift_m: float = 0.0):
        """rain: share of the beams that end on a raindrop; lift_m: height of the lift."""
        lidar = LidarParameters(errors=ScanErrors(echo_share=rain))
        self.sim = Sim(seed, scenario, SimParameters(rear_lidar=rear_lidar, lidar=lidar))
        self.decision: Optional[Any] = None
        self.site_map: Optional[Any] = None
        self._control = core.DriveControl(shipped_urdf(), rear_lidar=rear_lidar)
        self._key_height_m = ROBOT.key.min_height_m + lift_m
        self._front: Optional[Scan] = None
        self._rear: Optional[Scan] = None
        self._sensors: Sensors = self._settled(lift_m)
        for _ in range(round(LOOKING_S / TICK_S)):
            self.step((0.0, 0.0))

    @property
    def pose(self) -> Pose2:
        """True pose in world."""
        return self.sim.truth().world_from_base

    @property
    def time_s(self) -> float:
        """Simulated time since the start, including settling."""
        return (self.sim.time_ns - SIMULATION_START_NS) * 1e-9

    @property
    def corner_speed_mps(self) -> float:
        """Upper bound for the speed of every point of the robot."""
        truth = self.sim.truth()
        return fastest_point_mps(truth.linear_mps, truth.angular_radps, truth.lateral_mps)

    def step(self, velocity: Velocity, locked: bool = False, by_hand: bool = False) -> Any:
        """Run one tick with a velocity of the planner or a person, or with a motion lock; return drive control's
        decision."""
        sensors = self._sensors
        self._front = sensors.front_scan or self._front
        self._rear = sensors.rear_scan or self._rear
        wanted = {"manual" if by_hand else "planner": velocity}
        self.decision = self._control.step(
            sensors.time_ns, **wanted, locks=["operator"] if locked else [], front=self._front, rear=self._rear,
            odometry=sensors.odometry, key_height_m=self._key_height_m, imu=sensors.imu, map=self.site_map)
        self.sim.command(self.decision.linear_mps, self.decision.angular_radps)
        self._sensors = self.sim.step()
        return self.decision

    def leave_alone(self) -> None:
        """Run one tick without drive control: no command is sent to the base."""
        self._sensors = self.sim.step()

    def _settled(self, lift_m: float) -> Sensors:
        """Raise the lift and wait until nothing sways; return the last readings."""
        self.sim.set_lift(lift_m)
        self.sim.scans_wanted = False
        for _ in range(round(SETTLING_S / TICK_S)):
            self.sim.command(0.0, 0.0)
            sensors = self.sim.step()
        self.sim.scans_wanted = True
        return sensors
