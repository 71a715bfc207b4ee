"""A person who takes the Car's handle when asked, and says so."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

from mtr_operator.domain.ports import OPERATOR, HandlePort


@dataclass(frozen=True)
class HandlePrompt:
    """What a person is asked: number counts from 1; distance_m of the Remote key on its line."""

    number: int
    distance_m: float


class AskedPerson(HandlePort):
    """show: shows a prompt, or with None takes it away; called in the thread of the test. answer() may be called in
    another one."""

    by = OPERATOR

    def __init__(self, show: Callable[[HandlePrompt | None], None]):
        self._show = show
        self._number = self._answered = 0
        self._is_shown = False

    def request(self, distance_m: float) -> None:
        """See HandlePort."""
        self._number += 1
        self._is_shown = True
        self._show(HandlePrompt(self._number, distance_m))

    def is_taken(self) -> bool:
        """See HandlePort."""
        return self._is_shown and self._answered == self._number

    def release(self) -> None:
        """See HandlePort."""
        if self._is_shown:
            self._is_shown = False
            self._show(None)

    def answer(self, number: int) -> None:
        """The person has taken the handle for the prompt of this number; for another one it says nothing."""
        self._answered = number
