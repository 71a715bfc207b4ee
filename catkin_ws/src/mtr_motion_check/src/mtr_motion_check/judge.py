"""Verdict on a drive by hand, from the whole recording."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Optional

from mtr_core import names
from mtr_description.mounts import LidarMounts

from .advance import Witnesses, advance_findings
from .finding import NEEDS_MORE, Finding, bad, good
from .inertia import Gravity, Thrust, gravity, thrust
from .recording import Recording
from .steps import Steps
from .turning import REVERSED, turn_findings, turns

# Slope of the ground during the setup, and inaccuracy of a mount.
MAX_TILT_RAD = math.radians(10.0)
# 5 mg of bias, 1 % of scale and the variation of gravity over the earth, 9.78 to 9.83 m/s2, with a margin.
MIN_GRAVITY_MPS2, MAX_GRAVITY_MPS2 = 9.4, 10.2
# Limit of the IMU's rotation about its vertical axis: starts and stops on uneven ground determine it to some degrees.
MAX_IMU_YAW_RAD = math.radians(30.0)
UP, AHEAD = "imu.up", "imu.ahead"

# Duration of motion after which faults are detected, see docs/preflight.md.
ENOUGH_MOTION_S = 5.0


def is_finished(findings: List[Finding], motion_s: float) -> bool:
    """Return True if further driving cannot change the result: all is good, or the bad findings have lasted long
    enough."""
    if not any(finding.is_bad for finding in findings):
        return True
    return motion_s >= ENOUGH_MOTION_S and not any(finding.check == NEEDS_MORE for finding in findings)


class MotionJudge:
    """Judge of a growing recording, at each call."""

    def __init__(self, mounts: LidarMounts):
        self._mounts, self._steps = mounts, Steps(mounts)

    def findings(self, recording: Recording) -> List[Finding]:
        """Return all checks in motion; too little motion is a bad finding."""
        self._steps.extend(recording)
        steps, felt = self._steps.made, gravity(recording.imu)
        turned, pushed = turns(steps), thrust(recording)
        z_is_up = felt is not None and abs(felt.tilt_rad) < math.pi / 2.0
        forward = advance_findings(steps, self._mounts,
                                   Witnesses(pushed, turned is not None and turned.wheels.value < REVERSED))
        return [*up_findings(felt), *forward, *turn_findings(steps, turned, z_is_up),
                *ahead_findings(pushed, felt, any(finding.is_bad for finding in forward))]


def up_findings(felt: Optional[Gravity]) -> List[Finding]:
    """Check that gravity is along +z of the IMU, as every node assumes."""
    if felt is None:
        return [bad(UP, names.IMU_DATA, "The accelerometer said nothing; look for the IMU's driver.")]
    if not MIN_GRAVITY_MPS2 <= felt.size_mps2 <= MAX_GRAVITY_MPS2:
        return [bad(UP, names.IMU_DATA, f"The accelerometer says {felt.size_mps2:.2f} m/s2 at rest; allowed is "
                    f"{MIN_GRAVITY_MPS2:g} to {MAX_GRAVITY_MPS2:g} m/s2: look at unit and range in its driver.",
                    felt.size_mps2, MAX_GRAVITY_MPS2, unit="m/s2")]
    tilt = math.degrees(felt.tilt_rad)
    if felt.tilt_rad <= MAX_TILT_RAD:
        return [good(UP, names.IMU_DATA, f"Up is {tilt:.1f} deg from its z axis.", tilt, math.degrees(MAX_TILT_RAD),
                     unit="deg")]
    return [bad(UP, names.IMU_DATA, f"Up is {felt.axis} of the IMU, {tilt:.0f} deg from its z axis; allowed is "
                f"{math.degrees(MAX_TILT_RAD):.0f} deg: the IMU is mounted turned; mount it with z up.", tilt,
                math.degrees(MAX_TILT_RAD), unit="deg")]


def ahead_findings(pushed: Optional[Thrust], felt: Optional[Gravity], wheels_are_doubtful: bool) -> List[Finding]:
    """Check that forward is along +x of the IMU; empty if it is unknown, or if another check has named the cause."""
    upright = felt is not None and felt.tilt_rad <= MAX_TILT_RAD
    if pushed is None or wheels_are_doubtful or not upright or math.hypot(pushed.x, pushed.y) < 0.5:
        return []
    angle, limit = math.degrees(pushed.angle_rad), math.degrees(MAX_IMU_YAW_RAD)
    if abs(pushed.angle_rad) <= MAX_IMU_YAW_RAD:
        return [good(AHEAD, names.IMU_DATA, f"Ahead is {angle:.0f} deg from its x axis.", angle, limit, unit="deg")]
    return [bad(AHEAD, names.IMU_DATA, f"Ahead is {angle:.0f} deg from the IMU's x axis, while wheels and LiDARs "
                f"agree; allowed is {limit:.0f} deg: the IMU is turned about its vertical axis; mount it with x to the "
                "front.", angle, limit, unit="deg")]
