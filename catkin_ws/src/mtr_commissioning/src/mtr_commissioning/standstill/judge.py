"""Decides if the robot may be stopped for an update. Pure."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from typing import Dict, List, NamedTuple, Optional

from mtr_core.liveness import is_fresh

# Velocities of wheels at rest, with the noise of their encoders.
STANDING_MPS, STANDING_RADPS = 0.01, 0.02
# Time within which every velocity must be zero; drive control and odometry report every 20 ms.
WATCHED_S = 1.0
LEAST_MESSAGES = 10
# A lock is published every 100 ms; drive control counts one as silent after 0.25 s.
LOCK_AGE_S = 0.5
# An older velocity counts as silence.
VELOCITY_AGE_S = 0.2


class Verdict(enum.Enum):
    """Findings; the value is the exit status of the command. A defect of it ends with 1 or 2."""

    MAY_STOP = 0
    SILENT = 3
    REFUSED = 4


class Answer(NamedTuple):
    """A verdict with its sentence."""

    verdict: Verdict
    sentence: str


class Velocity(NamedTuple):
    """Commanded or measured velocity, with its arrival on the steady clock, s."""

    arrived_s: float
    linear_mps: float
    angular_radps: float

    @property
    def is_rest(self) -> bool:
        """True at rest; False also for NaN."""
        return abs(self.linear_mps) <= STANDING_MPS and abs(self.angular_radps) <= STANDING_RADPS


class Lock(NamedTuple):
    """Newest motion lock of an owner."""

    arrived_s: float
    engaged: bool
    emergency: bool


class StandstillJudge:
    """Collects the robot's reports; answer() decides at a time of the steady clock."""

    def __init__(self) -> None:
        self._commanded: List[Velocity] = []
        self._measured: List[Velocity] = []
        self._locks: Dict[str, Lock] = {}

    def take_command(self, velocity: Velocity) -> None:
        """Add a velocity that drive control sends to the wheels."""
        self._commanded.append(velocity)

    def take_odometry(self, velocity: Velocity) -> None:
        """Add a velocity of the wheels by their odometry."""
        self._measured.append(velocity)

    def take_lock(self, owner: str, lock: Lock) -> None:
        """Add a motion lock."""
        self._locks[owner] = lock

    def answer(self, now_s: float) -> Answer:
        """Decide: a robot without reports of drive control does not answer, and any other unknown value is a
        refusal."""
        commanded, measured = (_recent(velocities, now_s) for velocities in (self._commanded, self._measured))
        if not commanded:
            return Answer(Verdict.SILENT, "The robot's software does not answer: drive control reports nothing.")
        if not _is_watched(commanded, now_s):
            return Answer(Verdict.REFUSED, "Drive control reports too rarely to know whether the robot stands.")
        if not _is_watched(measured, now_s):
            return Answer(Verdict.REFUSED, "The wheel odometry is silent, so it is not known whether the robot stands.")
        moving = _fastest_moving(commanded + measured)
        if moving is not None:
            return Answer(Verdict.REFUSED, f"The robot moves at {moving.linear_mps:.2f} m/s and "
                                           f"{moving.angular_radps:.2f} rad/s; stop it first.")
        if not any(_is_engaged(lock, now_s) for lock in self._locks.values()):
            return Answer(Verdict.REFUSED, "No stop is engaged; engage the stop of the hand-held controller or of the "
                                           "hardware first.")
        return Answer(Verdict.MAY_STOP, "The robot stands and a stop is engaged.")


def _recent(velocities: List[Velocity], now_s: float) -> List[Velocity]:
    return [velocity for velocity in velocities if is_fresh(now_s - velocity.arrived_s, WATCHED_S)]


def _is_watched(velocities: List[Velocity], now_s: float) -> bool:
    return len(velocities) >= LEAST_MESSAGES and is_fresh(now_s - velocities[-1].arrived_s, VELOCITY_AGE_S)


def _fastest_moving(velocities: List[Velocity]) -> Optional[Velocity]:
    moving = [velocity for velocity in velocities if not velocity.is_rest]
    if not moving:
        return None
    return max(moving, key=lambda velocity: math.hypot(velocity.linear_mps, velocity.angular_radps))


def _is_engaged(lock: Lock, now_s: float) -> bool:
    return lock.emergency and lock.engaged and is_fresh(now_s - lock.arrived_s, LOCK_AGE_S)
