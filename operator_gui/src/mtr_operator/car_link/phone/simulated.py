"""Simulated phone inside the application, for the first try: it reports its distance with a given error.

It is not a radio model: it has a bias, noise, random dropouts and a shadow behind the Car.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math
import random
from dataclasses import dataclass

from mtr_operator.domain.actions.distance import gap_to_outline
from mtr_operator.domain.distance_feed import REPORTED, DistanceFeed, Reported
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.limits import Limit
from mtr_operator.domain.robot_status import RobotStatus

_LIMITS = {
    "bias_m": Limit("bias_m", -5.0, 5.0, "m"), "scatter_m": Limit("scatter_m", 0.0, 5.0, "m"),
    "body_m": Limit("body_m", -5.0, 5.0, "m"), "dropouts": Limit("dropouts", 0.0, 1.0),
    "range_m": Limit("range_m", 0.0, 500.0, "m"), "shadow_m": Limit("shadow_m", 0.0, 500.0, "m")}
# Half angle of the shadow, from the Car's rear.
_SHADOW_RAD = math.radians(30.0)
_STEP_DIGITS = 2


@dataclass(frozen=True)
class PhoneModel:
    """Errors of the phone. bias_m: everywhere. body_m: in addition behind the Car, whose body blocks the path.
    scatter_m: 1 sigma of a distance. dropouts: share of missing distances. range_m, shadow_m: largest reported distance
    from the Car's outline, around it and behind it."""

    bias_m: float = 0.10
    body_m: float = 0.20
    scatter_m: float = 0.05
    dropouts: float = 0.1
    range_m: float = 20.0
    shadow_m: float = 3.0


USUAL_PHONE = PhoneModel()


def phone_model(text: str) -> PhoneModel:
    """Parse a model such as "bias_m=0.2,scatter_m=0.05"; InvalidParameter states a fault. An empty text is the default.
    """
    values: dict[str, float] = {}
    for entry in filter(None, text.split(",")):
        name, _, value = entry.partition("=")
        if name not in _LIMITS:
            raise InvalidParameter(f"A simulated phone has no {name[:40]!r}; allowed are {', '.join(_LIMITS)}.")
        try:
            values[name] = float(value)
        except ValueError:
            raise InvalidParameter(f"{name} of a simulated phone is {value[:40]!r}; allowed is a number.") from None
        wrong = _LIMITS[name].violation(values[name], "Simulated phone: ")
        if wrong:
            raise InvalidParameter(wrong)
    return dataclasses.replace(USUAL_PHONE, **values)


class SimulatedPhone(DistanceFeed):
    """Feed with one distance per Status. The same seed and the same Statuses give the same distances."""

    def __init__(self, seed: int = 1, model: PhoneModel = USUAL_PHONE):
        self._chance = random.Random(seed)
        self._model = model
        self._is_active = False

    @property
    def name(self) -> str:
        values = ", ".join(f"{name} {value:g}" for name, value in dataclasses.asdict(self._model).items())
        return f"simulated phone: {values}"

    def connect(self) -> None:
        self._is_active = True

    def observe(self, status: RobotStatus) -> list[Reported]:
        error_m, is_missing = self._chance.gauss(0.0, 1.0), self._chance.random() < self._model.dropouts
        if not self._is_active or status.car is None or not status.pose_valid or is_missing:
            return []
        gap_m = gap_to_outline(status.key_place, status.car)
        behind_rad = math.pi - abs(math.atan2(status.key_place[1], status.key_place[0]))
        if gap_m > (self._model.shadow_m if behind_rad < _SHADOW_RAD else self._model.range_m):
            return []
        body_m = self._model.body_m * (1.0 + math.cos(behind_rad)) / 2.0
        figure_m = round(gap_m + self._model.bias_m + body_m + error_m * self._model.scatter_m, _STEP_DIGITS)
        return [Reported(status.stamp_s, figure_m, status.stamp_s)] if REPORTED.allows(figure_m) else []

    @property
    def problem(self) -> str:
        return "" if self._is_active else "The simulated phone is not connected."

    def close(self) -> None:
        self._is_active = False
