"""What a scenario says of the lines that it measures by search: what is tried on one, and what is recorded of it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Generic, Protocol

from ...actions.line_watch import LineWatch
from ...actions.robot import Robot
from ...actions.tolerances import Tolerances
from ...estimation.press.plan import SearchPlan
from ...geometry.ray import Ray
from ...results.document import Texts
from .attempt import AttemptMade, AttemptsMade
from .campaign import Searched


class SearchParameters(Protocol):
    """What a search needs of a scenario's parameters, beside its Tolerances; m and s."""

    @property
    def maximum_distance_m(self) -> float:
        """Where the robot enters a line."""

    @property
    def settle_time_s(self) -> float:
        """Standstill before each attempt."""

    @property
    def response_timeout_s(self) -> float:
        """How long the Car may take."""

    @property
    def key_rest_limit_s(self) -> float:
        """Standstill after which the key is moved, so that it does not sleep."""

    @property
    def attempts_limit(self) -> int:
        """Attempts after which a line ends."""

    @property
    def search_plan(self) -> SearchPlan:
        """What is wanted of each line."""


class Trial(ABC, Generic[Searched]):
    """One line.

    Attributes:
        number: of the line. start: what the robot does first, "radial 3 (45°): go to the start".
        ray: where the key is carried.
        tolerances, parameters: the scenario's.
        word: of the distance.
        first_places_m: where is tried before the search begins.
    """

    number: int
    start: str
    ray: Ray
    tolerances: Tolerances
    parameters: SearchParameters
    word: str
    first_places_m: tuple[float, ...] = ()

    def begin(self, robot: Robot) -> None:
        """Whatever goes before the way to the line; nothing by default."""

    @abstractmethod
    def action_at(self, distance_m: float) -> str:
        """What is done at a place, for a person: "press at 5.00 m"."""

    @abstractmethod
    def attempt(self, watch: LineWatch, robot: Robot, word: str) -> AttemptMade:
        """Try where the robot stands, it has settled; word: under which the attempt is kept."""

    @abstractmethod
    def invalid(self, made: AttemptsMade, reason: str, evidence: Texts = ()) -> Searched:
        """The attempts alone; nothing follows from them."""

    @abstractmethod
    def result(self, made: AttemptsMade) -> Searched:
        """What is known without the estimate, and without a word of doubt."""

    @abstractmethod
    def joined(self, before: Searched, after: Searched) -> Searched:
        """Of a line that was measured further."""

    @property
    @abstractmethod
    def silence(self) -> str:
        """Why nothing may have worked on the line, nor at its nearest place: the reason of its result."""

    @property
    @abstractmethod
    def lasting_silence(self) -> str:
        """The same after several lines, and what a person has to do."""
