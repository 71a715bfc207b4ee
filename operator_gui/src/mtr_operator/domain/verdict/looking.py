"""Looks at lines with further measurements: each look is recorded with the result, so that a resumed test counts it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Callable, Generator, Sequence

from ..estimation.looks import is_spent, last_look, with_look
from ..interfaces.part import part
from ..interfaces.scenario_parts import FurtherAttempts
from ..results.line_result import LineResult, at_looks
from ..results.progress import Progress
from ..scenario import AnyScenario, ScenarioParameters


class Looking:
    """Looks at the lines of one test; keep: records a changed result; pause: answers the robot's Status."""

    def __init__(self, scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress,
                 keep: Callable[[LineResult], None], pause: Callable[[], Any]):
        self._further = part(scenario, FurtherAttempts)
        self._parameters = parameters
        self._progress = progress
        self._keep = keep
        self._pause = pause

    def look_first(self, numbers: Sequence[int]) -> None:
        """Judge lines that a single look could decide by the wider interval that allows further looks."""
        for number in numbers:
            result = self._result(number)
            share = self._further.share_of_most(self._parameters, result)
            if not result.looks and share is not None:
                self._keep(self._at(result, with_look((), share)))

    def next(self, before: LineResult, after: LineResult) -> LineResult:
        """Return the result of a line after more attempts, at its next look; the first look was at the previous
        result."""
        looks = before.looks
        for result in (before, after):
            share = self._further.share_of_most(self._parameters, result)
            if share is not None and (result is after or not looks):
                looks = with_look(looks, share)
        return self._at(after, looks)

    def look_last(self) -> None:
        """Finish the looks if no further attempts follow: the last look at each line spends the remaining error
        probability."""
        for number in self._progress.measured():
            result = self._result(number)
            if result.looks and not is_spent(result.looks):
                self._keep(self._at(result, last_look(result.looks)))

    def _result(self, number: int) -> LineResult:
        return next(result for result in self._progress.results if result.number == number)

    def _at(self, result: LineResult, looks: Sequence[Any]) -> LineResult:
        changed = at_looks(result, looks)
        results = [changed if each.number == result.number else each for each in self._progress.results]
        return self._found(self._further.looked(self._parameters, results, result.number))

    def _found(self, steps: Generator[None, None, LineResult]) -> LineResult:
        while True:
            try:
                next(steps)
            except StopIteration as end:
                found: LineResult = end.value
                return found
            self._pause()
