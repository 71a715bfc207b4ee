"""The requests of one axis: with the extender off, then on; each kept before the robot is ordered on."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Mapping

from ...actions.car import Car
from ...actions.distance import Distance
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...estimation.interval import SIGMAS_OF_LEVEL
from ...geometry.ray import Ray
from ...results.line_result import LineStatus
from ..handle.hand import Hand, HandTaken
from ..line_search.moves import drive, move_key
from .parameters import RelayResistanceParameters
from .result import RELAY
from .tally import Tried

# So many requests that came too late, and the axis is measured again.
_MAX_LATE = 3
# A key inside the zone fails by a lapse alone; so many requests in a row without an answer are no lapse.
_PROOF_REQUESTS = 5
_STATES = {False: "off", True: "on"}


@dataclass
class RelayTrial:
    """The requests of one axis.

    Attributes:
        tried: those that count. farthest: place of the farthest unlock with the extender on, None without one.
        requested_by, switched_by: who took the handle and who switched the extender.
    """

    ray: Ray
    parameters: RelayResistanceParameters
    robot: Robot
    car: Car
    tried: list[Tried] = field(default_factory=list)
    farthest: Distance | None = None
    requested_by: str = ""
    switched_by: str = ""
    _here_m: float = math.nan

    def measure(self) -> None:
        """Everything that is not kept from before an interruption; LineInvalid when nothing follows from the axis."""
        self._go_to_start()
        with self.robot.watched(self.parameters) as watch:
            hand = Hand(self.ray, self.parameters, self.robot, self.car, watch)
            hand.have_locked()
            # Off for the proof too: a key that only the extender makes heard would prove nothing.
            self._switch(False)
            self._prove(hand, 1)
            self._measure_state(hand, False)
            self._switch(True)
            self._measure_state(hand, True)
            if self.farthest is None:
                # A battery that went flat meanwhile would look like resistance.
                self._prove(hand, 2)

    def _go_to_start(self) -> None:
        """Inside the zone; the robot may stand anywhere."""
        parameters, robot = self.parameters, self.robot
        robot.go_to(self.ray, parameters.maximum_distance_m)
        robot.wait_until_reached()
        robot.wait(parameters.response_timeout_s, or_when=lambda: not robot.trouble())
        # A Car that unlocks as its key comes may do so here, where nothing is measured yet.
        self._here_m = parameters.minimum_distance_m
        drive(self.ray, parameters.maximum_distance_m, self._here_m, robot)

    def _switch(self, is_on: bool) -> None:
        """Asked for anew after an interruption: nobody knows what the extender did meanwhile."""
        self.robot.say("switch the extender on" if is_on else "switch the extender off")
        self.switched_by = self.car.switch_extender(is_on, self.parameters.switch_timeout_s)

    def _prove(self, hand: Hand, number: int) -> None:
        """A silence says something only of a key that the Car hears inside the zone."""
        place_m = self.parameters.minimum_distance_m
        self.robot.say(f"handle request at {place_m:.2f} m: the Car has to unlock there")
        for _ in range(_PROOF_REQUESTS):
            taken = self._take(hand, place_m)
            if taken.made.worked:
                self.robot.keep(f"{RELAY} proof {number}", LineStatus.OK, taken.made.place)
                hand.have_locked()
                return
        raise LineInvalid(
            f"The Car did not unlock at {_PROOF_REQUESTS} requests at {place_m:.2f} m, inside its zone: the key "
            "sleeps, its battery is empty, it is not the Car's key, or the handle of this side was not taken; its "
            "silence beyond the border says nothing.")

    def _measure_state(self, hand: Hand, is_on: bool) -> None:
        """From near to far."""
        for place, place_m in enumerate(self.parameters.tried_places_m, start=1):
            for request in range(1, self.parameters.requests_per_place + 1):
                word = word_of(is_on, place, request)
                if not self._take_kept(word, is_on):
                    self.robot.say(f"handle request at {place_m:.2f} m, extender on" if is_on
                                   else f"handle request at {place_m:.2f} m, extender off")
                    self._request(hand, place_m, is_on, word)

    def _request(self, hand: Hand, place_m: float, is_on: bool, word: str) -> None:
        made = self._take(hand, place_m).made
        self._require_beyond(made.place)
        self.robot.keep(word, LineStatus.OK if made.worked else LineStatus.NOT_REACHED, made.place)
        self._count(made.place, made.worked, is_on)
        # Before the robot drives on: as the key goes away the Car may lock by itself.
        hand.have_locked()

    def _take(self, hand: Hand, place_m: float) -> HandTaken:
        """One request of a key that is awake."""
        parameters, robot = self.parameters, self.robot
        drive(self.ray, self._here_m, place_m, robot)
        self._here_m = place_m
        for _ in range(_MAX_LATE):
            if robot.rest_s > parameters.key_rest_limit_s:
                self._wake_key(place_m)
            robot.wait(parameters.settle_time_s)
            taken = hand.take()
            self.requested_by = taken.by
            if taken.made.worked or taken.rest_s <= parameters.key_rest_limit_s:
                return taken
        raise LineInvalid(f"The handle was taken {_MAX_LATE} times only after the key had stood for more than "
                          f"{parameters.key_rest_limit_s:g} s, when it may sleep; take it sooner, or increase "
                          "key_rest_limit_s if the key stays awake.")

    def _wake_key(self, place_m: float) -> None:
        """Towards the Car from the farthest place, beyond which nobody has looked for room."""
        self.robot.say("move the key so that it does not sleep")
        away = 1.0 if place_m + self.parameters.wake_move_m <= self.parameters.maximum_distance_m else -1.0
        move_key(self.ray, place_m, away * self.parameters.wake_move_m, self.robot)

    def _require_beyond(self, place: Distance) -> None:
        """An unlock within the border is no attack."""
        nearest_m = place.distance_m - SIGMAS_OF_LEVEL * place.uncertainty_m
        if not nearest_m > self.parameters.border_distance_m:
            raise LineInvalid(f"The Remote key was at {place.distance_m:.2f} m, with 1 sigma of "
                              f"{place.uncertainty_m:.3f} m: not surely beyond the nominal border at "
                              f"{self.parameters.border_distance_m:g} m.")

    def _count(self, place: Distance, unlocked: bool, is_on: bool) -> None:
        self.tried.append(Tried(is_on, place.distance_m, unlocked))
        if unlocked and is_on and (self.farthest is None or place.distance_m > self.farthest.distance_m):
            self.farthest = place

    def _take_kept(self, word: str, is_on: bool) -> bool:
        point = self.robot.kept_point(word)
        if point is None:
            return False
        status, place = point
        self._count(place, status is LineStatus.OK, is_on)
        return True


def has_kept(robot: Robot) -> bool:
    """True when a request is kept from before an interruption."""
    return robot.kept_point(word_of(False, 1, 1)) is not None


def word_of(is_on: bool, place: int, request: int) -> str:
    """Under which a request is kept; place and request count from 1."""
    return f"{RELAY} {_STATES[is_on]} {place} {request}"


def tried_of(points: Mapping[str, tuple[bool, float]]) -> list[Tried]:
    """Requests that count, from what was kept: whether the Car unlocked, and the distance in m, by word."""
    states = {f"{RELAY} {word} ": is_on for is_on, word in _STATES.items()}
    return [Tried(is_on, distance_m, unlocked) for word, (unlocked, distance_m) in points.items()
            for start, is_on in states.items() if word.startswith(start)]
