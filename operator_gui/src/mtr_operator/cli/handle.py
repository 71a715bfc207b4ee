"""Asks the person at the command line to take the Car's handle."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from mtr_operator.station.handle_prompt import AskedPerson, HandlePrompt

from .enter import Enter

QUESTION = ("Take the Car's handle now, with the Remote key at {:.2f} m, then press Enter; when the Car unlocks, "
            "nothing more is to be done.")


class HandleQuestion:
    """Attributes: person: takes the handle when asked."""

    def __init__(self, say: Callable[[str], None], enter: Enter):
        self.person = AskedPerson(self._show)
        self._say = say
        self._enter = enter
        self._number = 0

    def _show(self, prompt: HandlePrompt | None) -> None:
        self._enter.withdraw(self._answer)
        if prompt is not None:
            self._number = prompt.number
            self._say(QUESTION.format(prompt.distance_m))
            self._enter.ask(self._answer)

    def _answer(self) -> None:
        self.person.answer(self._number)
