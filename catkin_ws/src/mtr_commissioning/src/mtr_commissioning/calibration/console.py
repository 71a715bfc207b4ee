"""Prompts to the person next to the robot; input and output are parameters, so that a test can answer."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Optional, TypeVar

from mtr_core.errors import range_problem

from .readings import ReadingsUnusable

Value = TypeVar("Value")


class Console:
    """Console that repeats a prompt until the answer is valid; the end of the input is an EOFError, Ctrl-C a
    KeyboardInterrupt."""

    def __init__(self, ask: Callable[[str], str], say: Callable[[str], None]):
        self._ask = ask
        self.say = say

    def go(self, text: str) -> None:
        """Prompt for an action, and wait for Enter."""
        self._ask(f"{text} Then press Enter. ")

    def number(self, question: str, low: float, high: float, unit: str) -> float:
        """Prompt for a number within a range, ends included."""
        while True:
            value = _number(self._ask(f"{question} [{unit}] "))
            if value is None:
                self.say("That is no number; a number such as 0.25 is needed.")
                continue
            problem = range_problem("It", value, low, high, unit)
            if not problem:
                return value
            self.say(problem)

    def reading(self, read: Callable[[], Value]) -> Value:
        """Return a reading of the robot, repeated until it is usable."""
        while True:
            try:
                return read()
            except ReadingsUnusable as error:
                self.go(str(error))

    def yes(self, question: str) -> bool:
        """Prompt for yes or no."""
        while True:
            answer = self._ask(f"{question} [y/n] ").strip().lower()
            if answer in ("y", "yes", "n", "no"):
                return answer.startswith("y")
            self.say("Answer y or n.")


def _number(text: str) -> Optional[float]:
    try:
        return float(text.strip().replace(",", "."))
    except ValueError:
        return None
