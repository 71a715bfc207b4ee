"""What Autolock records of one axis."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from ..geometry.ray import Ray
from ..results.carried import CAUSE_DOC, DOORS_DOC, HEADING_DOC, HEIGHT_DOC, KEY_NUMBER_DOC, LATERAL_DOC, SPEED_DOC
from ..results.document import Floats, OptionalFloat, OptionalInt, Texts
from ..results.line_result import LineResult, LineStatus, Looked, MeasuredDistance, OnAxis, column, stored

UNLOCK, LOCK = "unlock", "lock"


def pass_word(word: str, number: int) -> str:
    """What a point of a pass is called in the journal: "unlock", "unlock 2"."""
    return word if number == 1 else f"{word} {number}"


def _distances(event: str) -> Any:
    return column(f"Remote key at each pass when the Car {event}, with its reaction time, in the order of the passes",
                  "m", default=())


def _speeds(event: str) -> Any:
    return column(f"speed of the robot at each of these passes; 0 for an approach in steps, when the Car {event}",
                  "m/s", default=())


def _static(what: str, unit: str = "m") -> Any:
    return column(what, unit, default=None)


STATIC_DOC = "static boundary: where a standing Remote key is noticed every other time, by all passes, when the Car"
_COMMON_DOC = "1 sigma of what all axes of the test have alike, the Car's timing, in"
_SHARED_DOC = "1 sigma of what further tests of the same Car would have alike, too, in"
_OF_PASSES = tuple(f"{word}_{name}" for word in (UNLOCK, LOCK) for name in (
    "passes", "pass_distances_m", "pass_speeds_mps", "static_m", "static_sigma_m", "static_low_m", "static_high_m",
    "reaction_s", "reaction_low_s", "reaction_high_s")) + tuple(
    f"{word}_static_{part}_sigma_m" for word in (UNLOCK, LOCK) for part in ("common", "shared"))


@dataclass(frozen=True)
class AutolockResult(OnAxis, Looked, LineResult):
    """Distances are those of the Remote key from the Car's side or corner, along the axis."""

    FILE_ORDER = ("axis", "side", "origin_x_m", "origin_y_m", "direction_x", "direction_y", "reason",
                  "unlock_distance_m", "unlock_uncertainty_m", "unlock_robot_time_s", "unlock_status",
                  "lock_distance_m", "lock_uncertainty_m", "lock_robot_time_s", "lock_status",
                  "unlock_lateral_offset_m", "unlock_heading_offset_deg", "unlock_key_height_m", "unlock_speed_mps",
                  "unlock_cause", "lock_lateral_offset_m", "lock_heading_offset_deg", "lock_key_height_m",
                  "lock_speed_mps", "lock_cause", *_OF_PASSES, "unlock_key_number", "unlock_doors",
                  "lock_key_number", "lock_doors", "told_every_s", "evidence", "look_shares", "look_spent",
                  *(f"{word}_static_look_{end}_m" for word in (UNLOCK, LOCK) for end in ("low", "high")))

    axis: int = column("number of the axis, clockwise around the Car")
    side: str = column("side or corner of the Car that the axis belongs to")
    origin_x_m: float = column("origin of the axis, Car coordinate system", "m")
    origin_y_m: float = column("origin of the axis, Car coordinate system", "m")
    direction_x: float = column("unit vector of the axis away from the Car", digits=6)
    direction_y: float = column("unit vector of the axis away from the Car", digits=6)
    unlock_status: LineStatus = column("ok, not_reached or invalid")
    unlock_distance_m: OptionalFloat = column("Remote key from the Car's side or corner when the Car unlocked", "m")
    unlock_uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m")
    unlock_robot_time_s: OptionalFloat = column("robot's clock when the Car unlocked", "s", digits=3)
    lock_status: LineStatus = column("ok, not_reached or invalid")
    lock_distance_m: OptionalFloat = column("Remote key from the Car's side or corner when the Car locked", "m")
    lock_uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m")
    lock_robot_time_s: OptionalFloat = column("robot's clock when the Car locked", "s", digits=3)
    reason: str = stored()
    unlock_lateral_offset_m: OptionalFloat = column(f"{LATERAL_DOC} when the Car unlocked", "m", default=None)
    unlock_heading_offset_deg: OptionalFloat = column(f"{HEADING_DOC} when the Car unlocked", "deg", 2, None)
    unlock_key_height_m: OptionalFloat = column(f"{HEIGHT_DOC} when the Car unlocked", "m", default=None)
    unlock_speed_mps: OptionalFloat = column(f"{SPEED_DOC} when the Car unlocked", "m/s", default=None)
    unlock_cause: str = column(f"what unlocked the Car: {CAUSE_DOC}", default="")
    lock_lateral_offset_m: OptionalFloat = column(f"{LATERAL_DOC} when the Car locked", "m", default=None)
    lock_heading_offset_deg: OptionalFloat = column(f"{HEADING_DOC} when the Car locked", "deg", 2, None)
    lock_key_height_m: OptionalFloat = column(f"{HEIGHT_DOC} when the Car locked", "m", default=None)
    lock_speed_mps: OptionalFloat = column(f"{SPEED_DOC} when the Car locked", "m/s", default=None)
    lock_cause: str = column(f"what locked the Car: {CAUSE_DOC}", default="")
    unlock_passes: int = column(
        "passes at which the Car unlocked; unlock_distance_m is the first one's, reaction time inside", default=0)
    unlock_pass_distances_m: Floats = _distances("unlocked")
    unlock_pass_speeds_mps: Floats = _speeds("unlocked")
    unlock_static_m: OptionalFloat = _static(f"{STATIC_DOC} unlocked")
    unlock_static_sigma_m: OptionalFloat = _static("1 sigma of unlock_static_m, spread of the passes included")
    unlock_static_low_m: OptionalFloat = _static("lower end of the 95 % interval of unlock_static_m")
    unlock_static_high_m: OptionalFloat = _static("upper end of the 95 % interval of unlock_static_m")
    unlock_reaction_s: OptionalFloat = _static("the Car's mean reaction time until it was unlocked", "s")
    unlock_reaction_low_s: OptionalFloat = _static("lower end of the 95 % interval of unlock_reaction_s", "s")
    unlock_reaction_high_s: OptionalFloat = _static("upper end of the 95 % interval of unlock_reaction_s", "s")
    lock_passes: int = column(
        "passes at which the Car locked; lock_distance_m is the first one's, reaction time inside", default=0)
    lock_pass_distances_m: Floats = _distances("locked")
    lock_pass_speeds_mps: Floats = _speeds("locked")
    lock_static_m: OptionalFloat = _static(f"{STATIC_DOC} locked")
    lock_static_sigma_m: OptionalFloat = _static("1 sigma of lock_static_m, spread of the passes included")
    lock_static_low_m: OptionalFloat = _static("lower end of the 95 % interval of lock_static_m")
    lock_static_high_m: OptionalFloat = _static("upper end of the 95 % interval of lock_static_m")
    lock_reaction_s: OptionalFloat = _static("the Car's mean reaction time until it was locked", "s")
    lock_reaction_low_s: OptionalFloat = _static("lower end of the 95 % interval of lock_reaction_s", "s")
    lock_reaction_high_s: OptionalFloat = _static("upper end of the 95 % interval of lock_reaction_s", "s")
    unlock_static_common_sigma_m: OptionalFloat = _static(f"{_COMMON_DOC} unlock_static_m")
    unlock_static_shared_sigma_m: OptionalFloat = _static(f"{_SHARED_DOC} unlock_static_m")
    lock_static_common_sigma_m: OptionalFloat = _static(f"{_COMMON_DOC} lock_static_m")
    lock_static_shared_sigma_m: OptionalFloat = _static(f"{_SHARED_DOC} lock_static_m")
    unlock_key_number: OptionalInt = column(f"of unlock_cause: {KEY_NUMBER_DOC}", default=None)
    unlock_doors: str = column(f"of the event that unlocked the Car: {DOORS_DOC}", default="")
    lock_key_number: OptionalInt = column(f"of lock_cause: {KEY_NUMBER_DOC}", default=None)
    lock_doors: str = column("of the event that locked the Car: doors that stayed unlocked; empty if none did, and if "
                             "its bus does not tell them apart", default="")
    told_every_s: OptionalFloat = stored(None)
    evidence: Texts = stored(())
    look_shares: Floats = stored(())
    look_spent: Floats = stored(())
    unlock_static_look_low_m: OptionalFloat = stored(None)
    unlock_static_look_high_m: OptionalFloat = stored(None)
    lock_static_look_low_m: OptionalFloat = stored(None)
    lock_static_look_high_m: OptionalFloat = stored(None)

    @property
    def ray(self) -> Ray:
        """The axis."""
        return Ray(self.origin_x_m, self.origin_y_m, self.direction_x, self.direction_y)

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult: the static boundaries, if passes tell them, else those of the one pass."""
        return self._distance(UNLOCK, self.unlock_status), self._distance(LOCK, self.lock_status)

    def passes(self, word: str) -> tuple[tuple[float, float], ...]:
        """Distance in m and speed in m/s, 0 for one in steps, of each pass at which the Car reacted."""
        return tuple(zip(getattr(self, f"{word}_pass_distances_m"), getattr(self, f"{word}_pass_speeds_mps")))

    def _distance(self, word: str, status: LineStatus) -> MeasuredDistance:
        static_m, *of_passes = (getattr(self, f"{word}_static_{name}")
                                for name in ("m", "sigma_m", "low_m", "high_m", "common_sigma_m"))
        if static_m is not None and status is LineStatus.OK:
            ends_m = getattr(self, f"{word}_static_look_low_m"), getattr(self, f"{word}_static_look_high_m")
            measured = MeasuredDistance(word, status, static_m, *of_passes)
            return replace(measured, look_m=ends_m) if self.looks else measured
        return MeasuredDistance(word, status, getattr(self, f"{word}_distance_m"),
                                getattr(self, f"{word}_uncertainty_m"))
