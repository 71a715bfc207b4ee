"""Delay and deceleration of the base, from the commanded velocities and its wheels'. Pure."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.schedule import DRIVE_CONTROL

from .finding import Finding, bad, good, needs_more
from .recording import STANDING_MPS, Recording, SentSample, WheelSample

CHECK, SUBJECT = "motion.response", "base"
# Minimum loss of speed of a braking; releasing the dead-man button at slow speed gives twice as much.
MIN_DROP_MPS = 0.15
# Steady time before it, so that an acceleration of the base is over, and observed time after it.
LEAD_S, TAIL_S = 0.3, 0.8
DEAD_TIMES_S: FloatArray = np.arange(0.0, 0.605, 0.005)
# Infinity is first: of equal fits the base that follows the ramp counts.
DECELERATIONS_MPS2: FloatArray = np.concatenate(([math.inf], np.geomspace(4.0, 0.1, 120)))
# Wheels farther from the fit than this do not follow the commands.
MAX_RESIDUAL_MPS = 0.08
# Odometry arrives every 20 ms, and its velocity is a mean over its period.
DEAD_TIME_MARGIN_S = 0.03
# A base that brakes with less than this share of the commanded ramp needs a longer path than drive control assumes.
MIN_BRAKING_SHARE = 0.85
# Longest reaction_s that drive control accepts.
MAX_REACTION_S = 0.5
TICK_S = DRIVE_CONTROL.period_ns * 1e-9


class Response(NamedTuple):
    """Response of the base to a decreasing velocity.

    Attributes:
        dead_time_s: from a command's stamp until the wheels follow it.
        braking_mps2: deceleration of the wheels; infinite if they follow the commanded ramp.
        sent_mps2: the steepest commanded ramp.
        residual_mps: rms of the wheels' speed relative to this response.
    """

    dead_time_s: float
    braking_mps2: float
    sent_mps2: float
    residual_mps: float


class Braking(NamedTuple):
    """One braking: speeds without sign; sent and wheels with times in s."""

    sent_s: FloatArray
    sent_mps: FloatArray
    wheels_s: FloatArray
    wheels_mps: FloatArray


def response_findings(recording: Recording, reaction_s: float) -> List[Finding]:
    """Compare the base with drive control's reaction_s and with the commanded ramp."""
    found = response(brakings(recording.sent, recording.wheels))
    if found is None:
        return [needs_more(SUBJECT, "How late it brakes is not known yet: drive straight at a steady speed for a "
                           "second, then release the dead-man button; twice.")]
    if found.residual_mps > MAX_RESIDUAL_MPS:
        return [needs_more(SUBJECT, f"Its wheels are {found.residual_mps:.2f} m/s from any answer to what was sent, "
                           f"allowed is {MAX_RESIDUAL_MPS:g} m/s: brake again on level, firm ground.",
                           found.residual_mps, MAX_RESIDUAL_MPS, unit="m/s")]
    return [_dead_time_finding(found, reaction_s), _braking_finding(found)]


def _dead_time_finding(found: Response, reaction_s: float) -> Finding:
    needed_s, late_s = found.dead_time_s + TICK_S, found.dead_time_s
    said = f"It follows a command after {late_s:.2f} s; with a reaction_s of {reaction_s:g} s drive control allows "
    said += f"{max(0.0, reaction_s - TICK_S):.2f} s"
    if needed_s <= reaction_s + DEAD_TIME_MARGIN_S:
        return good(CHECK, SUBJECT, f"{said}.", late_s, reaction_s - TICK_S, unit="s")
    remedy = (f"set reaction_s of drive control to {math.ceil(100.0 * needed_s) / 100.0:.2f} s (node_parameters)"
              if needed_s <= MAX_REACTION_S else "remove the delay in the base's driver; no reaction_s covers it")
    return bad(CHECK, SUBJECT, f"{said}, so that it stops too near to an obstacle: {remedy}.", late_s,
               reaction_s - TICK_S, unit="s")


def _braking_finding(found: Response) -> Finding:
    least_mps2 = MIN_BRAKING_SHARE * found.sent_mps2
    if found.braking_mps2 >= least_mps2:
        return good(CHECK, SUBJECT, f"It brakes as sent, at {found.sent_mps2:.1f} m/s2.",
                    min(found.braking_mps2, found.sent_mps2), least_mps2, unit="m/s2")
    return bad(CHECK, SUBJECT, f"It brakes at {found.braking_mps2:.2f} m/s2 although drive control sends "
               f"{found.sent_mps2:.2f} m/s2, and needs more way than drive control assumes: raise max_acceleration of "
               f"its controller, or set linear_deceleration_mps2 and emergency_linear_deceleration_mps2 lower.",
               found.braking_mps2, least_mps2, unit="m/s2")


def brakings(sent: Sequence[SentSample], wheels: Sequence[WheelSample]) -> List[Braking]:
    """Extract each piece in which the commanded speed decreases by MIN_DROP_MPS or more after a steady drive."""
    times, speeds = _columns(sent)
    wheel_times, wheel_speeds = _columns(wheels)
    found = []
    for first, last in _falls(speeds):
        start_s, end_s = times[first] - LEAD_S, min(times[last] + TAIL_S, _next_rise_s(times, speeds, last))
        inside = (wheel_times >= start_s) & (wheel_times <= end_s)
        is_steady = np.ptp(speeds[(times >= start_s) & (times <= times[first])]) <= STANDING_MPS
        if times[0] <= start_s - DEAD_TIMES_S[-1] and is_steady and inside.sum() > 2 and wheel_times[-1] >= end_s:
            before = times >= start_s - DEAD_TIMES_S[-1] - 2.0 * TICK_S
            found.append(Braking(times[before], speeds[before], wheel_times[inside], wheel_speeds[inside]))
    return found


def response(found: Sequence[Braking]) -> Optional[Response]:
    """Fit dead time and deceleration to all brakings; None without any."""
    if not found:
        return None
    errors: FloatArray = np.sum([_squared_errors(each) for each in found], axis=0)
    count = sum(len(each.wheels_s) for each in found)
    late, hard = np.unravel_index(int(np.argmin(errors)), errors.shape)
    return Response(float(DEAD_TIMES_S[late]), float(DECELERATIONS_MPS2[hard]), max(map(_ramp_mps2, found)),
                    math.sqrt(float(errors[late, hard]) / count))


def _squared_errors(braking: Braking) -> FloatArray:
    """Sum of squared errors in (m/s)^2 for each of DEAD_TIMES_S and DECELERATIONS_MPS2."""
    speed = np.full((len(DEAD_TIMES_S), len(DECELERATIONS_MPS2)), braking.wheels_mps[0])
    errors, before_s = np.zeros(speed.shape), braking.wheels_s[0]
    for time_s, measured_mps in zip(braking.wheels_s, braking.wheels_mps):
        wanted = np.interp(time_s - DEAD_TIMES_S, braking.sent_s, braking.sent_mps)[:, np.newaxis]
        step_s = time_s - before_s
        slowed = speed - (DECELERATIONS_MPS2 * step_s if step_s > 0.0 else 0.0)
        speed, before_s = np.maximum(wanted, slowed), time_s
        errors += (speed - measured_mps) ** 2
    return errors


def _falls(speeds: FloatArray) -> List[Tuple[int, int]]:
    """Return first and last index of each decrease of at least MIN_DROP_MPS."""
    found, index = [], 0
    while index + 1 < len(speeds):
        last = index
        while last + 1 < len(speeds) and speeds[last + 1] < speeds[last] - 1e-6:
            last += 1
        if speeds[index] - speeds[last] >= MIN_DROP_MPS:
            found.append((index, last))
        index = max(last, index + 1)
    return found


def _next_rise_s(times: FloatArray, speeds: FloatArray, last: int) -> float:
    rising = np.flatnonzero(speeds[last:] > speeds[last] + STANDING_MPS)
    return float(times[last + rising[0]]) if len(rising) else math.inf


def _ramp_mps2(braking: Braking) -> float:
    """Return the ramp between 80 and 20 % of the decrease; a step is limited by the length of a tick."""
    high, low = float(braking.sent_mps.max()), float(braking.sent_mps.min())
    upper, lower = high - 0.2 * (high - low), low + 0.2 * (high - low)
    falling = (braking.sent_mps <= upper) & (braking.sent_mps >= lower)
    if falling.sum() < 2:
        return (high - low) / TICK_S
    times, speeds = braking.sent_s[falling], braking.sent_mps[falling]
    return float((speeds[0] - speeds[-1]) / (times[-1] - times[0]))


def _columns(samples: Sequence[Union[SentSample, WheelSample]]) -> Tuple[FloatArray, FloatArray]:
    """Return times in s and speeds without sign in m/s."""
    times = np.array([sample.time_s for sample in samples], dtype=float)
    return times, np.abs(np.array([sample.linear_mps for sample in samples], dtype=float))
