"""Person who pulls the Car's handle, or switches an extender, when prompted, and confirms it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Union

from mtr_operator.domain.assistance import OPERATOR, ExtenderPort, HandlePort


@dataclass(frozen=True)
class HandlePrompt:
    """Prompt to a person: number counts from 1; distance_m of the Remote key on its line."""

    number: int
    distance_m: float

    @property
    def done(self) -> str:
        """Return the confirmed action, for the event list."""
        return "The handle was taken."


@dataclass(frozen=True)
class ExtenderPrompt:
    """Prompt to a person: number counts from 1, handles and extenders together; required state of the extender."""

    number: int
    is_on: bool

    @property
    def done(self) -> str:
        """Return the confirmed action, for the event list."""
        return "The extender was switched on." if self.is_on else "The extender was switched off."


Prompt = Union[HandlePrompt, ExtenderPrompt]


class AskedPerson(HandlePort, ExtenderPort):
    """Person who receives one prompt at a time. show: shows a prompt, or removes it with None; called in the thread of
    the test. answer() may be called in another one."""

    by = OPERATOR

    def __init__(self, show: Callable[[Prompt | None], None]):
        self._show = show
        self._number = self._answered = 0
        self._is_shown = False

    def request(self, distance_m: float) -> None:
        self._ask(HandlePrompt(self._number + 1, distance_m))

    def switch(self, is_on: bool) -> None:
        self._ask(ExtenderPrompt(self._number + 1, is_on))

    def _ask(self, prompt: Prompt) -> None:
        self._number = prompt.number
        self._is_shown = True
        self._show(prompt)

    def is_taken(self) -> bool:
        return self._is_shown and self._answered == self._number

    def is_switched(self) -> bool:
        return self.is_taken()

    def release(self) -> None:
        """See HandlePort and ExtenderPort."""
        if self._is_shown:
            self._is_shown = False
            self._show(None)

    def answer(self, number: int) -> None:
        """Confirm the prompt of this number; other numbers are ignored."""
        self._answered = number
