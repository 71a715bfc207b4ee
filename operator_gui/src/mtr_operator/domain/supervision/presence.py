"""Periodic prompt for the presence of a person; reports a missing answer."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

from ..actions.standstill import since_boot_s
from ..errors import InvalidParameter
from ..limits import Limit, first_violation

PERIOD = Limit("time between two questions for presence", 60.0, 1800.0, "s")
ANSWER = Limit("time to answer the question for presence", 10.0, 120.0, "s")
_S_PER_MIN = 60.0


@dataclass(frozen=True)
class PresenceParameters:
    """Times of the prompt. period_s: wall time from a confirmation to the next prompt. answer_s: wall time limit of the
    answer."""

    period_s: float = 900.0
    answer_s: float = 60.0

    def __post_init__(self) -> None:
        violation = first_violation(((PERIOD, self.period_s), (ANSWER, self.answer_s)))
        if violation:
            raise InvalidParameter(violation)


class Presence:
    """Presence of a person; belongs to the thread of a test, but confirm() may be called in any.

    show: shows the prompt, or removes it with False. clock: wall time in s that continues while the laptop sleeps.

    Attributes:
        is_asked: a prompt waits for its answer.
    """

    def __init__(self, show: Callable[[bool], None], parameters: PresenceParameters | None = None,
                 clock: Callable[[], float] = since_boot_s):
        self.parameters = parameters or PresenceParameters()
        self.is_asked = False
        self._show = show
        self._clock = clock
        self._confirmations = self._counted = 0
        self._since_s = clock()

    def ask(self) -> None:
        """Prompt now."""
        self._since_s, self._counted = self._clock(), self._confirmations
        self._set(True)

    def confirm(self) -> None:
        """Confirm that a person is present: it answers a prompt, and postpones the next one."""
        self._confirmations += 1

    def look(self) -> str:
        """Return a sentence if a prompt was not answered in time; empty before."""
        now_s = self._clock()
        if self._confirmations != self._counted:
            self._counted, self._since_s = self._confirmations, now_s
            self._set(False)
        passed_s = now_s - self._since_s
        # The condition also counts NaN of the clock as too late.
        if self.is_asked and not passed_s < self.parameters.answer_s:
            return (f"Nobody confirmed within {self.parameters.answer_s:g} s to be present: the robot was stopped. The "
                    "test is kept; resume it in sight of the robot.")
        if not self.is_asked and not passed_s < self.parameters.period_s:
            self._since_s = now_s
            self._set(True)
        return ""

    def end(self) -> None:
        """End the prompts with the test."""
        self._set(False)

    @property
    def text(self) -> str:
        """Text for the record of a test."""
        return f"person present, asked every {self.parameters.period_s / _S_PER_MIN:g} min"

    def _set(self, is_asked: bool) -> None:
        if is_asked != self.is_asked:
            self.is_asked = is_asked
            self._show(is_asked)
