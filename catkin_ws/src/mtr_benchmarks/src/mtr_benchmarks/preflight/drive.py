"""Simulates a person who drives the robot for some seconds: forward, backward and a turn."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import List, NamedTuple, Tuple

import numpy as np

from mtr_core import sensor_figures as figures
from mtr_core.se2 import Pose2
from mtr_motion_check.recording import ImuSample, Recording, Sweep, WheelSample, scan_sample
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sensors.readings import Scan, Sensors
from mtr_simulation.sensors.scan_errors import ScanErrors
from mtr_simulation.sim import TICK_S, Sim, SimParameters
from mtr_simulation.site.scenario import named_scenario

SITES = ("lot", "far", "cones", "open", "lot_person", "suv")
# Sites with only the Car and at most four cones within 20 m: almost no returns for one of the LiDARs, or for both.
BARE_SITES = ("far", "cones", "open")
# Distance from the Car's centre; from a smaller one the reverse drive could end at the Car.
MIN_RADIUS_M, MAX_RADIUS_M = 4.5, 6.5
STANDING_S = 1.0
# Duration of each motion; half a second of each is lost in starting and stopping.
FORWARD_S, BACK_S, TURN_S = 2.0, 1.5, 1.5
MOTION_S = FORWARD_S + BACK_S + TURN_S
MIN_SPEED_MPS, MAX_SPEED_MPS = 0.35, 0.7
MIN_TURN_RADPS, MAX_TURN_RADPS = 0.6, 1.2
# Acceleration from a gentle person to drive control's limit.
MIN_GAIN_MPS2, MAX_GAIN_MPS2 = 0.4, 1.0
TURN_GAIN_RADPS2 = 2.0


class Leg(NamedTuple):
    """Velocity that the person commands for a time: m/s and rad/s."""

    duration_s: float
    linear_mps: float
    angular_radps: float


@dataclass(frozen=True)
class Drive:
    """One drive.

    Attributes:
        site: name of the scenario.
        seed: seed of the place, the person and the sensors.
        worst_lidar: the LiDARs are as bad as their data sheets and rain allow.
        legs: commands of the person.
    """

    site: str
    seed: int
    worst_lidar: bool
    legs: Tuple[Leg, ...] = field(default=())


def drives(seed: int, count: int) -> List[Drive]:
    """Return `count` drives; sites and LiDARs alternate."""
    return [drive_of(SITES[index % len(SITES)], 1000 * seed + index, index // len(SITES) % 2 == 1)
            for index in range(count)]


def drive_of(site: str, seed: int, worst_lidar: bool) -> Drive:
    """Return the drive of a seed; the side of the turn is random."""
    noise = np.random.default_rng(seed)
    speed, back = noise.uniform(MIN_SPEED_MPS, MAX_SPEED_MPS, 2)
    turn = noise.uniform(MIN_TURN_RADPS, MAX_TURN_RADPS) * noise.choice([-1.0, 1.0])
    return Drive(site, seed, worst_lidar, (
        Leg(STANDING_S, 0.0, 0.0), Leg(FORWARD_S, float(speed), 0.0), Leg(BACK_S, -float(back), 0.0),
        Leg(TURN_S, 0.0, float(turn))))


def record(drive: Drive) -> Recording:
    """Record the sensors of a right robot."""
    sim = simulation(drive)
    noise = np.random.default_rng([drive.seed, 1])
    gain = float(noise.uniform(MIN_GAIN_MPS2, MAX_GAIN_MPS2))
    recording, linear, angular = Recording(), 0.0, 0.0
    for leg in drive.legs:
        for _ in range(round(leg.duration_s / TICK_S)):
            linear += clipped(leg.linear_mps - linear, gain * TICK_S)
            angular += clipped(leg.angular_radps - angular, TURN_GAIN_RADPS2 * TICK_S)
            sim.command(linear, angular)
            take(recording, sim.step())
    return recording


def simulation(drive: Drive) -> Sim:
    """Return the site with the robot at a random place around the Car."""
    noise = np.random.default_rng([drive.seed, 2])
    worst = LidarParameters(noise_m=figures.WORST_RANGE_NOISE_M.value,
                            errors=ScanErrors(range_bias_m=0.03, mixed_pixel_share=0.3, dropout_share=0.05,
                                              echo_share=0.01))
    scenario = named_scenario(drive.site)
    sim = Sim(drive.seed, scenario, SimParameters(lidar=worst if drive.worst_lidar else LidarParameters()))
    angle, heading = noise.uniform(-math.pi, math.pi, 2)
    radius = noise.uniform(MIN_RADIUS_M, MAX_RADIUS_M)
    sim.kidnap(scenario.world_from_car @ Pose2(radius * math.cos(angle), radius * math.sin(angle), float(heading)))
    return sim


def take(recording: Recording, sensors: Sensors) -> None:
    """Add one tick's readings."""
    time_s = sensors.time_ns * 1e-9
    recording.wheels.append(WheelSample(time_s, sensors.odometry.linear_mps, sensors.odometry.angular_radps))
    recording.imu.append(ImuSample(time_s, sensors.imu.angular_velocity, sensors.imu.acceleration))
    for scans, scan in ((recording.front, sensors.front_scan), (recording.rear, sensors.rear_scan)):
        if scan:
            scans.append(scan_sample(sweep_of(scan)))


def sweep_of(scan: Scan) -> Sweep:
    """Convert the simulated scan to the preflight's type."""
    return Sweep(scan.stamp_ns * 1e-9, scan.angle_min_rad, scan.angle_increment_rad, scan.time_increment_s,
                 scan.range_min_m, scan.range_max_m, scan.ranges_m)


def clipped(value: float, limit: float) -> float:
    """Return the value clipped to plus and minus the limit."""
    return max(-limit, min(limit, value))
