"""Prompts for the release of a robot on hold, and for the presence of a person."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from mtr_operator.domain.supervision.conditions import CONDITIONS
from mtr_operator.domain.supervision.presence import Presence, PresenceParameters

from .enter import Enter

QUESTION = ("The robot stands until you have it go on: see that nobody is near it, then press Enter. Ctrl-C ends "
            "it.")


CONDITIONS_QUESTION = ("Confirm by Enter within {:g} s that these conditions hold, and that you are in sight of the "
                       "robot:")
PRESENCE_QUESTION = "Press Enter within {:g} s to confirm that you are in sight of the robot; else it stops."


class Release:
    """Prompt that is called at each step with the current hold; returns the newest released hold."""

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
        # The person has read the last prompt, if it was for this hold.
        if hold_id == self._asked:
            self._released = hold_id


class PresenceQuestion:
    """Prompt for presence. Attributes: presence: prompts for the start conditions, and later for presence alone."""

    def __init__(self, say: Callable[[str], None], enter: Enter, announcement: str = "",
                 parameters: PresenceParameters | None = None):
        """announcement: information for people next to the Car."""
        self._say = say
        self._enter = enter
        self._announcement = announcement
        self._has_asked = False
        self.presence = Presence(self._show, parameters)

    def _show(self, is_asked: bool) -> None:
        self._enter.withdraw(self.presence.confirm)
        if is_asked:
            self._say(self._question().format(self.presence.parameters.answer_s))
            self._enter.ask(self.presence.confirm)

    def _question(self) -> str:
        if self._has_asked:
            return PRESENCE_QUESTION
        self._has_asked = True
        return "\n".join((CONDITIONS_QUESTION, *(f"  {name}: {text}" for name, text in CONDITIONS.items()),
                          *filter(None, (self._announcement,))))
