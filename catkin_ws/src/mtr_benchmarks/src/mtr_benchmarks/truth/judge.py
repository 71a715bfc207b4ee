"""Compares the distances of a line with the true events in the world."""
# SPDX-License-Identifier: Apache-2.0
import enum
from dataclasses import dataclass
from typing import Callable, Iterable, Optional

from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineStatus, MeasuredDistance

from .car import Place
from .world import World

# Largest error of a distance that may be relied on; its sigmas may allow less.
MAX_ERROR_M = 0.05
MAX_SIGMAS = 3.0
# Largest deviation of the key from its line and height: what the scenarios allow, plus a reserve.
MAX_ASIDE_M = 0.15
MAX_HEIGHT_M = 0.08


class Verdict(enum.Enum):
    """Verdict on one line."""

    RIGHT = "right"
    WRONG = "wrong"
    INVALID = "invalid"


@dataclass(frozen=True)
class Window:
    """Interval of the world's history that belongs to the line, true time, and the ordered height."""

    begin_s: float
    end_s: float
    height_m: float


def judge_autolock(world: World, ray: Ray, told: Iterable[MeasuredDistance], window: Window) -> Verdict:
    """Check two distances: the key's places when its vicinity unlocked the Car and when its absence locked it."""
    def true_place(locked: bool) -> Optional[Place]:
        return next((change.place for change in world.car.changes
                     if change.by_key and change.locked is locked
                     and window.begin_s <= change.time_s <= window.end_s), None)

    return _verdict(ray, told, (lambda: true_place(False), lambda: true_place(True)), window)


def judge_key_press(world: World, ray: Ray, told: Iterable[MeasuredDistance], window: Window,
                    timeout_s: float) -> Verdict:
    """Check one distance: the place of the first press to which the Car reacted in time."""
    def true_place() -> Optional[Place]:
        for press in world.robot.presses:
            if any(change.press_id == press.id and change.time_s - press.start_s <= timeout_s
                   for change in world.car.changes) and press.start_s >= window.begin_s:
                return press.place
        return None

    return _verdict(ray, told, (true_place,), window)


def _verdict(ray: Ray, told: Iterable[MeasuredDistance], places: Iterable[Callable[[], Optional[Place]]],
             window: Window) -> Verdict:
    told, places = list(told), list(places)
    # A missing distance makes the line invalid.
    verdict = Verdict.RIGHT if len(told) == len(places) else Verdict.INVALID
    for distance, place in zip(told, places):
        if distance.status is LineStatus.INVALID:
            verdict = Verdict.INVALID
        elif not _is_right(ray, distance, place(), window):
            return Verdict.WRONG
    return verdict


def _is_right(ray: Ray, told: MeasuredDistance, place: Optional[Place], window: Window) -> bool:
    if told.status is LineStatus.NOT_REACHED or told.distance_m is None:
        return place is None
    if place is None:
        return False
    point = (place.x, place.y)
    aside_m = ray.direction_x * (place.y - ray.origin_y) - ray.direction_y * (place.x - ray.origin_x)
    error_m = abs(ray.distance_of(point) - told.distance_m)
    return (error_m <= MAX_ERROR_M and error_m <= MAX_SIGMAS * (told.uncertainty_m or 0.0)
            and abs(aside_m) <= MAX_ASIDE_M and abs(place.height_m - window.height_m) <= MAX_HEIGHT_M)
