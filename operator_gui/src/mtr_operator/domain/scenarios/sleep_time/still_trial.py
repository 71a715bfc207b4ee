"""Trials with a key that is held still: moved, left at rest, asked; and what is kept of each before the next."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Mapping

from ...actions.car import Car
from ...actions.distance import Distance
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid, LineLeft
from ...geometry.ray import Ray
from ...results.line_result import LineStatus
from ..handle.hand import Hand, HandTaken
from ..line_search.moves import drive, move_key
from .parameters import SleepTimeParameters
from .result import HELD
from .waits import WaitSearch, WaitTrial

# A wait of half an hour may be disturbed by a gap of the link; so many disturbed trials, and the line is invalid.
MAX_DISTURBED = 3
# Statuses come ten times a second; the robot that moved was at rest for less than it waited, by more than this.
_MOVED_S = 0.5
# A key that was moved just now fails by a lapse alone; so many requests in a row without an answer are no lapse.
_WAKING_REQUESTS = 5


class KeySilent(LineInvalid):
    """The key answers not even right after it was moved."""


@dataclass
class StillKey:
    """The trials at one place.

    Attributes:
        search: what they say so far. place: of the key at the newest one. disturbed: trials that do not count.
        requested_by: who made the newest request. answer: where the key was at the newest one that was answered.
    """

    ray: Ray
    parameters: SleepTimeParameters
    robot: Robot
    car: Car
    search: WaitSearch
    place: Distance | None = None
    disturbed: int = 0
    requested_by: str = ""
    answer: Distance | None = None

    def recall(self) -> None:
        """Take the trials from before an interruption."""
        number = 1
        while self._take_kept(number):
            number += 1

    def measure(self) -> None:
        """Trial after trial; LineInvalid when the key is silent, or too many trials were disturbed."""
        self._go_there()
        wait_s = self.search.next_wait_s()
        while wait_s is not None:
            try:
                self._trial(wait_s)
            except (KeySilent, LineLeft):
                raise
            except LineInvalid:
                self.disturbed += 1
                if self.disturbed >= MAX_DISTURBED:
                    raise
                self.robot.say("a trial was disturbed and is made again")
                self._go_there()
            wait_s = self.search.next_wait_s()

    def _go_there(self) -> None:
        """The robot may stand anywhere."""
        parameters, robot = self.parameters, self.robot
        robot.go_to(self.ray, parameters.maximum_distance_m)
        robot.wait_until_reached()
        robot.wait(parameters.response_timeout_s, or_when=lambda: not robot.trouble())
        drive(self.ray, parameters.maximum_distance_m, parameters.minimum_distance_m, robot)

    def _trial(self, wait_s: float) -> None:
        number = len(self.search.trials) + 1
        self.robot.say(f"trial {number}: the key is held still for {wait_s:.0f} s")
        with self.robot.watched(self.parameters) as watch:
            hand = Hand(self.ray, self.parameters, self.robot, self.car, watch)
            hand.have_locked()
            since_s = self._wake()
            self.robot.wait(since_s + wait_s - self.robot.now_s)
            trial, place = self._asked(hand, since_s, number)
            if not trial.answered:
                self._prove_awake_when_moved(hand, number)
            self._take(trial, place)
            hand.have_locked()

    def _wake(self) -> float:
        """Move the key and bring it back; robot time since which it is at rest."""
        parameters, robot = self.parameters, self.robot
        move_key(self.ray, parameters.minimum_distance_m, parameters.wake_move_m, robot)
        robot.wait(parameters.settle_time_s)
        if not math.isfinite(robot.rest_s):
            raise LineInvalid("Nobody knows since when the Remote key has been at rest.")
        return robot.now_s - robot.rest_s

    def _asked(self, hand: Hand, since_s: float, number: int) -> tuple[WaitTrial, Distance]:
        """Take the handle until it is answered; what came of it, kept."""
        taken, requests = self._taken_at_rest(hand, since_s), 1
        while not taken.made.worked and requests < self.parameters.requests:
            taken, requests = self._taken_at_rest(hand, since_s), requests + 1
        made = taken.made
        place = replace(made.place, rest_s=made.place.robot_time_s - since_s)
        self.robot.keep(_word(number), LineStatus.OK if made.worked else LineStatus.NOT_REACHED, place)
        return WaitTrial(place.rest_s, made.worked), place

    def _taken_at_rest(self, hand: Hand, since_s: float) -> HandTaken:
        taken = self._taken(hand)
        if taken.rest_s < taken.made.place.robot_time_s - since_s - _MOVED_S:
            raise LineInvalid("The Remote key was moved while it was to be held still.")
        return taken

    def _prove_awake_when_moved(self, hand: Hand, number: int) -> None:
        """A silence is sleep only when a motion ends it at the same place."""
        self.robot.say("move the key: it has to answer then")
        self._wake()
        for _ in range(_WAKING_REQUESTS):
            taken = self._taken(hand)
            if taken.made.worked:
                self.robot.keep(_awake_word(number), LineStatus.OK, taken.made.place)
                return
        raise KeySilent(
            f"The key did not answer {_WAKING_REQUESTS} requests at {self.parameters.minimum_distance_m:.2f} m right "
            "after it was moved: the place lies outside the zone, the key's battery is empty, it is not the Car's key, "
            "or the handle of this side was not taken.")

    def _taken(self, hand: Hand) -> HandTaken:
        taken = hand.take()
        self.requested_by = taken.by
        if taken.made.worked:
            self.answer = taken.made.place
        return taken

    def _take(self, trial: WaitTrial, place: Distance) -> None:
        self.search.trials.append(trial)
        self.place = place

    def _take_kept(self, number: int) -> bool:
        point = self.robot.kept_point(_word(number))
        if point is None:
            return False
        status, place = point
        answered = status is LineStatus.OK
        if not answered and self.robot.kept_point(_awake_word(number)) is None:
            return False
        self._take(WaitTrial(place.rest_s, answered), place)
        self.answer = place if answered else self.answer
        return True


def has_kept(robot: Robot) -> bool:
    """True when a trial is kept from before an interruption."""
    return robot.kept_point(_word(1)) is not None


def trials_of(points: Mapping[str, tuple[bool, float]]) -> list[WaitTrial]:
    """Trials that count, from what was kept: whether the key answered, and its rest, by word."""
    trials, number = [], 1
    while _word(number) in points:
        (answered, rest_s), (is_proven, _) = points[_word(number)], points.get(_awake_word(number), (False, math.nan))
        if answered or is_proven:
            trials.append(WaitTrial(rest_s, answered))
        number += 1
    return trials


def _word(number: int) -> str:
    return f"{HELD} {number}"


def _awake_word(number: int) -> str:
    return f"{HELD} {number} moved"
