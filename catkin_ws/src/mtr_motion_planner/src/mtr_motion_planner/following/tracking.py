"""Controller that keeps a differential drive on its reference.

Feed-forward is the reference's velocity at the instant at which the command acts. Feedback of the pose is Kanayama's
law (Kanayama et al., "A stable tracking control method for an autonomous mobile robot", 1990). Its gains grow with
the speed, so that an offset decays over the same length at every speed.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

from mtr_core.se2 import Pose2

from ..timing.trajectory import Reference

# Delay from a pose until its velocity takes effect: half of the planner's period, one tick of drive control, and the
# response of the wheels.
DELAY_S = 0.06
ALONG_GAIN_PER_S = 2.0
HEADING_GAIN_PER_S = 5.5
# An offset decays over this length, at higher speeds over a longer one, because the loop's delay limits the gain.
OFFSET_LENGTH_M = 0.2
MAX_HEADING_GAIN_PER_S = 6.0
# Feedback is limited, so that a jump of the pose does not cause a jump of the robot.
FEEDBACK_MPS, FEEDBACK_RADPS = 0.15, 0.6
MAX_OFFSET_M = 0.10
# No correction below these at a stopped reference; the robot would only oscillate.
DEAD_M, DEAD_RAD = 0.007, math.radians(0.25)


@dataclass(frozen=True)
class Velocity:
    """Velocity of base_link."""

    linear_mps: float = 0.0
    angular_radps: float = 0.0


def deviation(reference: Reference, pose: Pose2) -> Pose2:
    """Return the reference as seen from the robot."""
    return pose.inverse() @ reference.pose


@dataclass(frozen=True)
class Tracking:
    """Velocity that follows the reference.

    Attributes:
        pace: share of its own speed at which the reference moves on. Below 1 the robot lags and the speed limit keeps
            it from catching up, so the reference waits.
    """

    velocity: Velocity
    pace: float = 1.0


def tracked(reference: Reference, ahead: Reference, pose: Pose2, limit_mps: float) -> Tracking:
    """Return the velocity that follows the reference; ahead is the reference DELAY_S later.

    The commanded speed never exceeds limit_mps, unless the reference itself is still braking to it.
    """
    error = deviation(reference, pose)
    speed = ahead.linear_mps
    bound = max(limit_mps, abs(speed))
    if speed == 0.0 and ahead.angular_radps == 0.0:
        return Tracking(_at_rest(error, min(FEEDBACK_MPS, bound)))
    along = _clamp(ALONG_GAIN_PER_S * error.x, FEEDBACK_MPS)
    length = max(OFFSET_LENGTH_M, 2.0 * abs(speed) / MAX_HEADING_GAIN_PER_S)
    gain = max(HEADING_GAIN_PER_S, 2.0 * abs(speed) / length)
    offset = _clamp(error.y, MAX_OFFSET_M) * _sinc(error.heading) / length ** 2
    turning = _clamp(gain * error.heading + speed * offset, FEEDBACK_RADPS)
    linear = speed * math.cos(error.heading) + along
    # A robot ahead of its reference waits for it, but does not reverse.
    linear = linear if linear * speed >= 0.0 else 0.0
    pace = min(1.0, bound / abs(linear)) if linear else 1.0
    return Tracking(Velocity(pace * linear, ahead.angular_radps + turning), pace)


def _at_rest(error: Pose2, limit_mps: float) -> Velocity:
    along = 0.0 if abs(error.x) < DEAD_M else _clamp(ALONG_GAIN_PER_S * error.x, limit_mps)
    turning = 0.0 if abs(error.heading) < DEAD_RAD else _clamp(HEADING_GAIN_PER_S * error.heading, FEEDBACK_RADPS)
    return Velocity(along, turning)


def _sinc(angle: float) -> float:
    return 1.0 if abs(angle) < 1e-6 else math.sin(angle) / angle


def _clamp(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))
