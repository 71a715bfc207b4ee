"""Turns: compares gyro, wheels and LiDARs, and identifies the wrong one."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, NamedTuple, Optional

from mtr_core import names

from .directions import FRONT, REAR, Lidar
from .finding import Finding, bad, good, needs_more
from .fits import Ratio, ratio
from .steps import Step

# Minimum rotation for the comparison of the sensors.
MIN_TURN_RAD = 0.6
# Minimum rotation for its direction.
MIN_SENSE_RAD = 0.2
# An uncalibrated gyro's scale is accurate to 0.5 % by data sheet; beyond 5 % its range or unit is configured wrongly.
MAX_GYRO_ERROR = 0.05
# A skid-steered base turns by slipping tyres, differently on asphalt and grass; its rotation is not relied on.
MAX_WHEELS_ERROR = 0.25
# Below this ratio the sign is wrong.
REVERSED = -0.5
CHECK = "motion.turn"


class Turns(NamedTuple):
    """Rotation by gyro and by wheels for each rad that the LiDARs saw."""

    gyro: Ratio
    wheels: Ratio


def lidar_turn(step: Step) -> Optional[float]:
    """Return the rotation of a step by the LiDARs, averaged over those available; in rad."""
    told = [pose.heading for pose in (step.front, step.rear) if pose]
    return sum(told) / len(told) if told else None


def turned_rad(steps: List[Step]) -> float:
    """Return the robot's total rotation by the LiDARs, in both directions."""
    return max(sum(abs(pose.heading) for pose in map(lidar.sensor, steps) if pose) for lidar in (FRONT, REAR))


def turns(steps: List[Step]) -> Optional[Turns]:
    """Return the ratios; None while the robot has not turned enough."""
    if turned_rad(steps) < MIN_TURN_RAD:
        return None
    rows = [(told, step.gyro_rad, step.wheels.heading, step.duration_s) for step in steps
            for told in (lidar_turn(step),) if told is not None and step.gyro_rad is not None]
    if not rows:
        return None
    seen, gyro, wheels, durations = zip(*rows)
    by_gyro, by_wheels = ratio(seen, gyro, durations), ratio(seen, wheels)
    return Turns(by_gyro, by_wheels) if by_gyro and by_wheels else None


def turn_findings(steps: List[Step], found: Optional[Turns], z_is_up: bool) -> List[Finding]:
    """Check signs and scales of the gyro and of the wheels' rotation.

    Args:
        z_is_up: by the accelerometer, the IMU is not upside down.
    """
    contradiction = lidars_contradict(steps)
    if contradiction:
        return [contradiction]
    if found is None:
        return [too_little(steps)]
    if found.gyro.value < REVERSED and found.wheels.value < REVERSED and z_is_up:
        told = [lidar for lidar in (FRONT, REAR) if against_gyro(steps, lidar)]
        return [bad(CHECK, lidar.topic, f"{lidar.frame} sees the robot turn the other way than gyro and wheels say: it "
                    "is mounted upside down, or its angles run clockwise; mount it upright.", -1.0, 1.0)
                for lidar in told]
    return [gyro_finding(found.gyro), wheels_finding(found.wheels)]


def too_little(steps: List[Step]) -> Finding:
    """Report too little rotation, or a silent gyro."""
    seen = turned_rad(steps)
    if seen >= MIN_TURN_RAD:
        return bad(CHECK, names.IMU_DATA, "The gyro said nothing while the robot turned; look for the IMU's driver.")
    return needs_more(names.FRONT_SCAN, f"The LiDARs saw a turn of {seen:.2f} rad; at least {MIN_TURN_RAD:.1f} rad are "
               "needed: turn by 90 deg.", seen, MIN_TURN_RAD, unit="rad")


def lidars_contradict(steps: List[Step]) -> Optional[Finding]:
    """Report LiDARs with opposite rotations: the one that contradicts the gyro is upside down."""
    senses = [(lidar, against_gyro(steps, lidar)) for lidar in (FRONT, REAR)]
    against = [lidar for lidar, sense in senses if sense is True]
    if len(against) != 1 or not any(sense is False for _, sense in senses):
        return None
    return bad(CHECK, against[0].topic, f"{against[0].frame} sees the robot turn the other way than the other LiDAR "
               "and the gyro: it is mounted upside down, or its angles run clockwise; mount it upright.", -1.0, 1.0)


def against_gyro(steps: List[Step], lidar: Lidar) -> Optional[bool]:
    """Return True if a LiDAR rotates opposite to the gyro; None if either saw too little of a turn."""
    rows = [(pose.heading, step.gyro_rad) for step in steps for pose in (lidar.sensor(step),)
            if pose and step.gyro_rad is not None]
    if sum(abs(seen) for seen, _ in rows) < MIN_SENSE_RAD:
        return None
    alike = sum(seen * gyro for seen, gyro in rows) / sum(seen * seen for seen, _ in rows)
    return None if abs(alike) < abs(REVERSED) else alike < 0.0


def gyro_finding(gyro: Ratio) -> Finding:
    """Check sign and scale of the gyro."""
    said = f"The gyro says {gyro.value:.3f} times the turn that the LiDARs saw"
    if 2.0 * gyro.sigma > MAX_GYRO_ERROR * max(1.0, abs(gyro.value)):
        return needs_more(names.IMU_DATA, f"{said}, to {200.0 * gyro.sigma:.0f} % only; {100.0 * MAX_GYRO_ERROR:.0f} % "
                          "are needed: turn on, or where more stands around the robot.", 200.0 * gyro.sigma,
                          100.0 * MAX_GYRO_ERROR, unit="%")
    if not gyro.differs(1.0, MAX_GYRO_ERROR):
        return good(CHECK, names.IMU_DATA, f"{said}.", gyro.value, 1.0 + MAX_GYRO_ERROR)
    allowed = f"allowed is {1.0 - MAX_GYRO_ERROR:.2f} to {1.0 + MAX_GYRO_ERROR:.2f}"
    if gyro.value < REVERSED:
        return bad(CHECK, names.IMU_DATA, f"{said}; {allowed}: the IMU is mounted upside down; mount it with z up.",
                   gyro.value, 1.0 + MAX_GYRO_ERROR)
    return bad(CHECK, names.IMU_DATA, f"{said}; {allowed}: the IMU is mounted turned or its scale is wrong; mount it "
               "with z up, and look at the range and unit in its driver.", gyro.value, 1.0 + MAX_GYRO_ERROR)


def wheels_finding(wheels: Ratio) -> Finding:
    """Check sign and scale of the wheels' rotation."""
    said = f"The wheels say {wheels.value:.2f} times the turn that the LiDARs saw"
    if not wheels.differs(1.0, MAX_WHEELS_ERROR):
        return good(CHECK, names.WHEEL_ODOMETRY, f"{said}.", wheels.value, 1.0 + MAX_WHEELS_ERROR)
    allowed = f"allowed is {1.0 - MAX_WHEELS_ERROR:.2f} to {1.0 + MAX_WHEELS_ERROR:.2f}"
    if wheels.value < REVERSED:
        return bad(CHECK, names.WHEEL_ODOMETRY, f"{said}; {allowed}: the odometry has the wrong sign, or left and "
                   "right wheels are exchanged; correct them in the configuration of the base.", wheels.value,
                   1.0 + MAX_WHEELS_ERROR)
    return bad(CHECK, names.WHEEL_ODOMETRY, f"{said}; {allowed}: correct the track (its multiplier on a skid-steered "
               "base) in the configuration of the base.", wheels.value, 1.0 + MAX_WHEELS_ERROR)
