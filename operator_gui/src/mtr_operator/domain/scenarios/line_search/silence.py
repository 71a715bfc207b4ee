"""A key that answers nowhere is asked for: whether it sleeps or the Car's range ends nearer, nobody knows."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable, Sequence, TypeVar

from ...errors import RobotFailed
from ...results.line_result import LineResult

# So many lines without any answer, one after the other, and the test waits for a person.
MAX_SILENT_LINES = 3

Result = TypeVar("Result", bound=LineResult)


def ask_when_lasting(number: int, results: Sequence[Result], is_silent: Callable[[Result], bool],
                     sentence: str) -> None:
    """Raise RobotFailed with the sentence when the lines before a silent one were silent too.

    number: of the silent line. results: of the test's other lines, in their order.
    """
    before = [result for result in results if result.number < number][1 - MAX_SILENT_LINES:]
    if sum(map(is_silent, before)) >= MAX_SILENT_LINES - 1:
        raise RobotFailed(sentence)
