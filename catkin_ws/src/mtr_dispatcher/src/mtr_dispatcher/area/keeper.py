"""The test area in force."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, replace
from typing import Any, Callable, Dict, Mapping, Optional, Protocol, Sequence, Tuple

from mtr_core.problems import NO_PROBLEM, Problem

from .. import problems
from .order import AreaOrder, corners_problem
from .polygons import Point


@dataclass(frozen=True)
class Area:
    """The area in force.

    Attributes:
        session_id, id: order that set it; 0: the launch file.
        origin_id: origin of map to which the corners refer; 0: the origin of the first pose.
    """

    session_id: int
    id: int
    origin_id: int
    corners: Tuple[Point, ...]


class Origin(Protocol):
    """Field of LocalizedPose."""

    origin_id: int


class AreaKeeper:
    """Keeps the area in force, which outlives sessions and the process.

    Attributes:
        required: the robot is real and neither maps nor tests without an area.
        is_fixed: the launch file has set the area; applications cannot change it.
        area: in force, None without one.
    """

    def __init__(self, required: bool, fixed: Sequence[Point] = (),
                 remembered: Optional[Mapping[str, Any]] = None,
                 remember: Callable[[Dict[str, Any]], None] = lambda area: None):
        """remembered: stored by an earlier process of this robot run. remember: called with each change."""
        self.required, self.is_fixed = required, bool(fixed)
        self._remember = remember
        known = _from_memory(remembered)
        self.area: Optional[Area] = known
        if fixed:
            is_same = known is not None and known.corners == tuple(fixed) and not known.session_id
            self.area = known if is_same else Area(0, 0, 0, tuple(fixed))

    def take(self, session_id: int, order: Optional[AreaOrder]) -> None:
        """Accept the area of an acceptable Command; a repeated id changes nothing."""
        if order is None or self.is_fixed:
            return
        if self.area is not None and (self.area.session_id, self.area.id) == (session_id, order.id):
            return
        self._set(Area(session_id, order.id, order.origin_id, tuple(zip(order.x, order.y))))

    def observe(self, pose: Optional[Origin]) -> None:
        """Refer a launch file's area to the origin of the first pose."""
        if self.area is not None and not self.area.origin_id and pose is not None and pose.origin_id:
            self._set(replace(self.area, origin_id=pose.origin_id))

    @property
    def corners(self) -> Tuple[Point, ...]:
        """Corners of the area in force; empty without an area."""
        return self.area.corners if self.area is not None else ()

    def problem(self, pose: Optional[Origin]) -> Problem:
        """Return why the robot neither maps nor tests."""
        if not self.corners:
            return problems.NO_AREA() if self.required else NO_PROBLEM
        if pose is not None and self.area is not None and pose.origin_id != self.area.origin_id:
            return problems.FIXED_AREA_OF_OTHER_ORIGIN() if self.is_fixed else problems.AREA_OF_OTHER_ORIGIN()
        return NO_PROBLEM

    def _set(self, area: Area) -> None:
        self.area = area
        self._remember({"session_id": str(area.session_id), "id": str(area.id), "origin_id": str(area.origin_id),
                        "x": [x for x, _ in area.corners], "y": [y for _, y in area.corners]})


def _from_memory(remembered: Optional[Mapping[str, Any]]) -> Optional[Area]:
    """Return the stored area, or None if this class did not write the data."""
    try:
        if not remembered:
            return None
        corners = tuple((float(x), float(y)) for x, y in zip(remembered["x"], remembered["y"]))
        area = Area(int(remembered["session_id"]), int(remembered["id"]), int(remembered["origin_id"]), corners)
    except (KeyError, TypeError, ValueError):
        return None
    return area if not corners or not corners_problem(area.id, corners) else None
