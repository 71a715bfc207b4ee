"""Asks whether a robot that is held may go on."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from .enter import Enter

QUESTION = ("The robot stands until you have it go on: see that nobody is near it, then press Enter. Ctrl-C ends "
            "it.")


class Release:
    """Called at each step with the hold in force; gives the newest one that was released."""

    def __init__(self, say: Callable[[str], None], enter: Enter):
        self._say = say
        self._enter = enter
        self._asked = self._released = 0

    def __call__(self, hold_id: int) -> int:
        if hold_id and hold_id != self._asked:
            self._asked = hold_id
            self._say(QUESTION)
            self._enter.ask(lambda: self._answer(hold_id))
        return self._released

    def _answer(self, hold_id: int) -> None:
        # Whoever answers has read the question asked last, when that was this one.
        if hold_id == self._asked:
            self._released = hold_id
