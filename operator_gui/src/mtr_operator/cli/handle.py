"""Prompts the person at the command line to pull the Car's handle, or to switch the extender."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from mtr_operator.station.handle_prompt import AskedPerson, HandlePrompt, Prompt

from .enter import Enter

QUESTION = ("Take the Car's handle now, with the Remote key at {:.2f} m, then press Enter; when the Car unlocks, "
            "nothing more is to be done.")
EXTENDER_QUESTION = "Switch the extender {} now, then press Enter."


class HandleQuestion:
    """Prompt. Attributes: person: pulls the handle, and switches the extender, when prompted."""

    def __init__(self, say: Callable[[str], None], enter: Enter):
        self.person = AskedPerson(self._show)
        self._say = say
        self._enter = enter
        self._number = 0

    def _show(self, prompt: Prompt | None) -> None:
        self._enter.withdraw(self._answer)
        if prompt is not None:
            self._number = prompt.number
            self._say(QUESTION.format(prompt.distance_m) if isinstance(prompt, HandlePrompt)
                      else EXTENDER_QUESTION.format("on" if prompt.is_on else "off"))
            self._enter.ask(self._answer)

    def _answer(self) -> None:
        self.person.answer(self._number)
