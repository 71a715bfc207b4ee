"""True distances of measured events: the matching true event, and the true distance of the Remote key."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Iterable, NamedTuple, Optional, Tuple

from .results import MeasuredEvent, ResultsError, TrueEvent

# A measurement belongs to the nearest true event of its kind within this time.
MATCH_WINDOW_S = 0.5

_KINDS = {"unlock": "unlocked", "lock": "locked", "press": "press", "handle": "handle"}
# Kinds of events that the Car may accept or not.
_ATTEMPTS = ("press", "handle")
_NORMALS = {"front": (1.0, 0.0), "rear": (-1.0, 0.0), "left": (0.0, 1.0), "right": (0.0, -1.0)}
_CORNERS = {"front_left": (1, 1), "front_right": (1, -1), "rear_left": (-1, 1), "rear_right": (-1, -1)}
# Zones clockwise from the front, each an eighth of the circle.
ZONE_SIDES = ("front", "front_right", "right", "rear_right", "rear", "rear_left", "left", "front_left")

# Smaller components of a direction are rounding errors.
_PARALLEL = 1e-9

Vector = Tuple[float, float]


class CarSize(NamedTuple):
    """True length and width of the Car in m."""

    length_m: float
    width_m: float


class Expected(NamedTuple):
    """Results of a perfect measurement of a line, from the Car's model; distances in m, NaN if there are none.

    Attributes:
        p50_distance_m: distance at which the Car reacts in half of all trials.
        p95_distance_m: distance at which it reacts in 95 % of them.
        static_m: boundary of passive entry for a key that moves infinitely slowly; NaN except for unlock and lock.
        border_share: share of handle requests at the nominal border that work; NaN for other events.
        coverage: part of a zone's area where at least half of the presses work; NaN for other events.
    """

    p50_distance_m: float = math.nan
    p95_distance_m: float = math.nan
    static_m: float = math.nan
    border_share: float = math.nan
    coverage: float = math.nan


class Comparison(NamedTuple):
    """Measured event with its truth; true_distance_m is None without a matching true event."""

    measured: MeasuredEvent
    true_distance_m: Optional[float]
    expected: Expected = Expected()

    @property
    def error_m(self) -> float:
        """Measured minus true distance."""
        return math.nan if self.true_distance_m is None else self.measured.distance_m - self.true_distance_m


def compare(measured: Iterable[MeasuredEvent], truth: Iterable[TrueEvent], size: CarSize) -> Iterable[Comparison]:
    """Yield a comparison for each measured event, in order."""
    truth = list(truth)
    for event in measured:
        true_event = find_true(event, truth)
        yield Comparison(event, None if true_event is None else true_distance_m(event, true_event, size))


def find_true(measured: MeasuredEvent, truth: Iterable[TrueEvent]) -> Optional[TrueEvent]:
    """Return the nearest true event of the kind; only accepted presses and handle requests count."""
    kind = _KINDS.get(measured.event)
    candidates = [e for e in truth if e.kind == kind and (e.accepted or kind not in _ATTEMPTS)]
    nearest = min(candidates, key=lambda e: abs(e.time_s - measured.time_s), default=None)
    # The comparison is false for a measurement without a time (NaN).
    return nearest if nearest and abs(nearest.time_s - measured.time_s) <= MATCH_WINDOW_S else None


def true_distance_m(measured: MeasuredEvent, event: TrueEvent, size: CarSize) -> float:
    """Return the distance from the Car's true side or corner along the axis, or from its centre for a press."""
    if measured.event == "press":
        return math.hypot(event.key_x_m, event.key_y_m)
    if measured.side in _NORMALS:
        normal_x, normal_y = _NORMALS[measured.side]
        along = normal_x * event.key_x_m + normal_y * event.key_y_m
        return along - abs(normal_x) * size.length_m / 2.0 - abs(normal_y) * size.width_m / 2.0
    (corner_x, corner_y), (along_x, along_y) = _from_corner(measured, size)
    return (event.key_x_m - corner_x) * along_x + (event.key_y_m - corner_y) * along_y


def start_and_direction(measured: MeasuredEvent, size: CarSize) -> Tuple[Vector, Vector]:
    """Return the point of the true Car with distance 0 on the line, and the unit vector along the line, both in frame
    car."""
    if measured.event == "press":
        return (0.0, 0.0), (math.cos(measured.clockwise_rad), -math.sin(measured.clockwise_rad))
    if measured.event == "reach":
        return from_outline(zone_middle_rad(measured), size)
    if measured.side not in _NORMALS:
        return _from_corner(measured, size)
    normal_x, normal_y = _NORMALS[measured.side]
    origin_x, origin_y = measured.origin
    start_x = normal_x * size.length_m / 2.0 if normal_x else origin_x
    start_y = normal_y * size.width_m / 2.0 if normal_y else origin_y
    return (start_x, start_y), (normal_x, normal_y)


def zone_middle_rad(measured: MeasuredEvent) -> float:
    """Return the direction of the middle of a zone, clockwise from the Car's front."""
    if measured.side not in ZONE_SIDES:
        raise ResultsError(f"Zone {measured.line} has side {measured.side!r}; allowed are {', '.join(ZONE_SIDES)}.")
    return ZONE_SIDES.index(measured.side) * 2.0 * math.pi / len(ZONE_SIDES)


def from_outline(clockwise_rad: float, size: CarSize) -> Tuple[Vector, Vector]:
    """Return the point of the Car's outline on a radial from its centre, and the radial's unit vector."""
    direction = (math.cos(clockwise_rad), -math.sin(clockwise_rad))
    along_m = min(whole_m / 2.0 / abs(part) for whole_m, part in zip(size, direction) if abs(part) > _PARALLEL)
    return (along_m * direction[0], along_m * direction[1]), direction


def _from_corner(measured: MeasuredEvent, size: CarSize) -> Tuple[Vector, Vector]:
    if measured.side not in _CORNERS:
        allowed = ", ".join([*_NORMALS, *_CORNERS])
        raise ResultsError(f"Axis {measured.line} has side {measured.side!r}; allowed are {allowed}.")
    sign_x, sign_y = _CORNERS[measured.side]
    direction_x, direction_y = measured.direction
    norm = math.hypot(direction_x, direction_y)
    if not norm > 0.0:
        raise ResultsError(f"Axis {measured.line} has no direction.")
    return ((sign_x * size.length_m / 2.0, sign_y * size.width_m / 2.0), (direction_x / norm, direction_y / norm))
