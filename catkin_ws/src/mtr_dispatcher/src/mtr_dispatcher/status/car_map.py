"""Detects whether the robot's pose is in the map in which the Car was located."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

from mtr_core.states import CarState

from .inputs import CarFields, PoseFields


class CarMap:
    """Stores the map of the located Car, because its message does not name it.

    The state machine applies the same rule: after a pose in another map, only a new mapping order helps. A
    restarted localization may reuse the number of the old map for a new one.
    """

    def __init__(self) -> None:
        self._map_car_id: Optional[int] = None
        self._map_revision = 0
        self._is_lost = False

    def is_map_of(self, pose: Optional[PoseFields], car: Optional[CarFields]) -> bool:
        """Process the messages of one Status; return False if pose and Car are in different maps."""
        if pose is None or car is None:
            return False
        if car.state != CarState.LOCATED:
            self._map_car_id = None
            return False
        if self._map_car_id != car.map_car_id:
            self._map_car_id, self._map_revision, self._is_lost = car.map_car_id, pose.map_revision, False
        self._is_lost = self._is_lost or pose.map_revision != self._map_revision
        return not self._is_lost
