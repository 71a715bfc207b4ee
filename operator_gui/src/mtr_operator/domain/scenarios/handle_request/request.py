"""One handle request, judged and kept before the robot goes on, and the Car locked again after it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ...actions.car import Car
from ...actions.line_watch import LineWatch
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...geometry.ray import Ray
from ...results.line_result import LineStatus
from ..handle.hand import Hand
from ..line_search.attempt import AttemptMade
from ..line_search.moves import wake_key
from .parameters import HandleRequestParameters

# So many requests that came too late, and the axis is measured again.
_MAX_LATE = 3


@dataclass(frozen=True)
class Requester:
    """Makes the requests of one axis.

    Attributes:
        ray: where the key is carried. watch: of the axis.
    """

    ray: Ray
    parameters: HandleRequestParameters
    robot: Robot
    car: Car
    watch: LineWatch

    def request(self, word: str) -> tuple[AttemptMade, str]:
        """Take the handle where the robot stands, it has settled; what came of it, and who took it.

        word: under which the request is kept. LineInvalid when something else moved the Car's locks, or the Car is not
        locked before or after it; RobotFailed when nobody takes the handle.
        """
        hand = Hand(self.ray, self.parameters, self.robot, self.car, self.watch)
        hand.have_locked()
        for _ in range(_MAX_LATE):
            taken = hand.take()
            made = taken.made
            if made.worked or taken.rest_s <= self.parameters.key_rest_limit_s:
                self.robot.keep(word, LineStatus.OK if made.worked else LineStatus.NOT_REACHED, made.place)
                # Before the robot drives on: as the key goes away the Car may lock by itself.
                hand.have_locked()
                return made, taken.by
            wake_key(self.ray, made.place.distance_m, self.parameters, self.robot)
        raise LineInvalid(f"The handle was taken {_MAX_LATE} times only after the key had stood for more than "
                          f"{self.parameters.key_rest_limit_s:g} s, when it may sleep; take it sooner, or increase "
                          "key_rest_limit_s if the key stays awake.")
